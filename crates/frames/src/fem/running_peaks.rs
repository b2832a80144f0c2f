//! How forces grow, step by step: what their peaks are up to any time.

/// Some forces at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepForces<const N: usize> {
    /// (s)
    pub time: f64,
    /// [N, N m]
    pub forces: [f64; N],
}

/// Of every force the steps at which it was larger than ever before, of each sign by itself; of
/// those in one part of the record's time step the last: times are asked for by parts.
#[derive(Clone, Debug, PartialEq)]
pub struct RunningPeaks<const N: usize> {
    /// Positive, negative.
    of: [[Vec<StepForces<N>>; 2]; N],
}

impl<const N: usize> Default for RunningPeaks<N> {
    fn default() -> Self {
        Self { of: [(); N].map(|()| [Vec::new(), Vec::new()]) }
    }
}

impl<const N: usize> RunningPeaks<N> {
    /// After a step; `part` is the length of a part (s).
    pub(super) fn take(&mut self, step: StepForces<N>, part: f64) {
        let place = |time: f64| (time / part).floor();
        for (k, signs) in self.of.iter_mut().enumerate() {
            let size = |of: &StepForces<N>| of.forces[k].abs();
            let peaks = &mut signs[usize::from(step.forces[k] < 0.0)];
            if peaks.last().is_some_and(|last| size(last) >= size(&step)) {
                continue;
            }
            if peaks.last().is_some_and(|last| place(last.time) == place(step.time)) {
                peaks.pop();
            }
            peaks.push(step);
        }
    }

    /// The step at which a force is largest up to a time (s), by magnitude.
    pub fn largest(&self, force: usize, until: f64) -> Option<StepForces<N>> {
        let [positive, negative] = [0, 1].map(|sign| self.last(force, sign, until));
        let size = |of: &StepForces<N>| of.forces[force].abs();
        match (positive, negative) {
            (Some(a), Some(b)) => Some(if size(&b) > size(&a) { b } else { a }),
            (a, b) => a.or(b),
        }
    }

    /// The same of its positive values alone; none where there are none.
    pub fn most(&self, force: usize, until: f64) -> Option<StepForces<N>> {
        self.last(force, 0, until).filter(|step| step.forces[force] > 0.0)
    }

    fn last(&self, force: usize, sign: usize, until: f64) -> Option<StepForces<N>> {
        let peaks = &self.of[force][sign];
        // a step that ends there ends within rounding of it
        let count = peaks.partition_point(|step| step.time <= until * (1.0 + 1e-12));
        peaks[..count].last().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_are_those_up_to_a_time_with_what_acts_beside_them() {
        let mut peaks = RunningPeaks::<4>::default();
        for (time, shear, axial) in [
            (0.1, 1.0, -5.0),
            (0.2, -3.0, -6.0),
            (0.3, 2.0, 1.0),
            (0.4, 2.5, -9.0),
            (0.45, 2.2, 4.0),
        ] {
            peaks.take(StepForces { time, forces: [shear, axial, 0.0, 0.0] }, 0.01);
        }
        let of = |found: Option<StepForces<4>>| {
            found.map(|step| (step.time, step.forces[0], step.forces[1]))
        };
        assert_eq!(of(peaks.largest(0, 0.15)), Some((0.1, 1.0, -5.0)));
        assert_eq!(of(peaks.largest(0, 1.0)), Some((0.2, -3.0, -6.0)));
        assert_eq!(of(peaks.most(0, 1.0)), Some((0.4, 2.5, -9.0)));
        assert_eq!(of(peaks.largest(1, 1.0)), Some((0.4, 2.5, -9.0)));
        assert_eq!(of(peaks.most(1, 0.35)), Some((0.3, 2.0, 1.0)));
        assert_eq!(of(peaks.most(1, 1.0)), Some((0.45, 2.2, 4.0)));
        assert_eq!((peaks.most(1, 0.25), peaks.most(2, 1.0)), (None, None));
    }

    #[test]
    fn of_the_steps_of_a_part_the_last_peak_is_kept() {
        let mut peaks = RunningPeaks::<4>::default();
        for i in 0..1000 {
            let time = 1e-4 * (f64::from(i) + 0.5);
            peaks.take(StepForces { time, forces: [f64::from(i + 1), 0.0, 0.0, 0.0] }, 1e-2);
        }
        assert_eq!(peaks.of[0][0].len(), 10);
        assert_eq!(peaks.largest(0, 1.0).map(|step| step.forces[0]), Some(1000.0));
    }
}
