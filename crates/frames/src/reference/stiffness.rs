//! Whether stiffness, not accuracy, chooses the steps of the explicit method (Hairer & Wanner,
//! Solving Ordinary Differential Equations II, section IV.2).

use nalgebra::DVector;

use super::state::{Rates, ReferenceState};

/// h times the fastest rate beyond which it does: the method is stable up to 6.1, and as accurate
/// as asked to about 1.
const STIFF: f64 = 3.0;
/// Steps that tell that it is so, and those in a row that tell that it is not.
const STIFF_STEPS: usize = 15;
const CALM_STEPS: usize = 6;

/// The last stage of an explicit step, like the result at its end: what the two differ by tells how
/// stiff the equations are.
#[derive(Clone, Debug)]
pub(crate) struct LastStage {
    pub q: DVector<f64>,
    pub v: DVector<f64>,
    pub a: DVector<f64>,
}

impl LastStage {
    /// The fastest rate of the equations, roughly, from the end of the step and its rates (1/s).
    pub(crate) fn fastest(&self, end: &ReferenceState, rates: &Rates) -> f64 {
        let dv = (&end.v - &self.v).norm_squared();
        let (da, dq) = ((&rates.a - &self.a).norm_squared(), (&end.q - &self.q).norm_squared());
        let apart = dq + dv;
        if apart > 0.0 { ((dv + da) / apart).sqrt() } else { 0.0 }
    }
}

/// Explicit steps that stiffness cut short, and others since the last of these.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stiffness {
    cut: usize,
    calm: usize,
}

impl Stiffness {
    /// Take note of an explicit step: its length times the fastest rate.
    pub(crate) fn note(&mut self, h_rate: f64) {
        if h_rate > STIFF {
            (self.cut, self.calm) = (self.cut + 1, 0);
        } else {
            self.calm += 1;
            if self.calm == CALM_STEPS {
                *self = Self::default();
            }
        }
    }

    /// Whether they have told so.
    pub(crate) fn found(&self) -> bool {
        self.cut >= STIFF_STEPS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_steps_cut_short_tell_stiffness_and_a_few_calm_ones_in_a_row_that_there_is_none() {
        let mut stiffness = Stiffness::default();
        // calm ones between do not count, if they are few
        for k in 0..STIFF_STEPS {
            assert!(!stiffness.found(), "{k}");
            stiffness.note(0.5 * STIFF);
            stiffness.note(2.0 * STIFF);
        }
        assert!(stiffness.found());
        (0..CALM_STEPS).for_each(|_| stiffness.note(0.5 * STIFF));
        assert!(!stiffness.found());
    }

    /// q'' = -w^2 q - 2 z w q', z large: its fastest rate is 2 z w.
    #[test]
    fn the_fastest_rate_is_that_of_the_overdamped_mode() {
        let (w, z) = (1e3, 20.0);
        let one = |x: f64| DVector::from_element(1, x);
        let a = |q: f64, v: f64| -w * w * q - 2.0 * z * w * v;
        let end = ReferenceState { q: one(1e-3), v: one(0.2), work: [0.0; 3] };
        let rates = Rates { a: one(a(1e-3, 0.2)), power: [0.0; 3], forces: vec![] };
        let last = LastStage { q: one(1e-3), v: one(0.21), a: one(a(1e-3, 0.21)) };
        assert!((last.fastest(&end, &rates) / (2.0 * z * w) - 1.0).abs() < 1e-3);
    }
}
