//! A motion sampled at the record's instants: what both models answer with, and what is compared.

pub use strong_motion::largest_magnitude;

/// Motion of the centre of mass, relative to the ground, at the record's samples (t = i dt).
///
/// The three vectors have one length. It is shorter than the record when the body toppled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Horizontal displacement, positive to the right (m).
    pub u: Vec<f64>,
    /// Vertical displacement, positive up, from the settled position (m).
    pub v: Vec<f64>,
    /// Rotation, positive leaning to the right (rad).
    pub theta: Vec<f64>,
}

impl Motion {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.u.len()
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.u.is_empty()
    }

    /// A motion with room for n samples. Public for the crates that make motions.
    #[doc(hidden)]
    pub fn with_capacity(n: usize) -> Self {
        Self { u: Vec::with_capacity(n), v: Vec::with_capacity(n), theta: Vec::with_capacity(n) }
    }

    /// Its first n samples, or all if it has fewer.
    pub fn first(&self, n: usize) -> Self {
        let of = |x: &[f64]| x[..n.min(x.len())].to_vec();
        Self { u: of(&self.u), v: of(&self.v), theta: of(&self.theta) }
    }

    /// Append one sample: u, v (m) and theta (rad). Public for the crates that make motions.
    #[doc(hidden)]
    pub fn push(&mut self, u: f64, v: f64, theta: f64) {
        self.u.push(u);
        self.v.push(v);
        self.theta.push(theta);
    }
}

/// A value, with its sign, and when it came: the largest magnitude of a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimedPeak {
    /// In the quantity's unit.
    pub value: f64,
    /// (s)
    pub time: f64,
}

impl TimedPeak {
    /// Of samples dt (s) apart: the first of the largest; none of no samples.
    pub fn of(dt: f64, series: &[f64]) -> Option<Self> {
        let sample = |(i, &value): (usize, &f64)| Self { value, time: i as f64 * dt };
        series.iter().enumerate().map(sample).reduce(Self::larger)
    }

    /// The one of the larger magnitude, this one if both are equal.
    pub fn larger(self, other: Self) -> Self {
        if other.value.abs() > self.value.abs() { other } else { self }
    }
}

/// sqrt( sum (x - x_ref)^2 / sum x_ref^2 ) over the common length; infinite when the reference is
/// zero and x is not, zero when both are.
pub fn nrmse(x: &[f64], reference: &[f64]) -> f64 {
    nrmse_of(x.iter().zip(reference))
}

/// The same of pairs (x, x_ref).
pub fn nrmse_of<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    let (mut above, mut below) = (0.0, 0.0);
    for (a, b) in pairs {
        above += (a - b) * (a - b);
        below += b * b;
    }
    if above == 0.0 { 0.0 } else { (above / below).sqrt() }
}

/// An NRMSE with four decimals, or two significant digits where it is smaller; a dash where there
/// is nothing to compare with.
pub fn shown(nrmse: f64) -> String {
    if !nrmse.is_finite() {
        return "-".into();
    }
    let decimals =
        if nrmse > 0.0 { (1.0 - nrmse.log10().floor()).clamp(4.0, 9.0) as usize } else { 4 };
    format!("{nrmse:.decimals$}")
}

/// Samples dt (s) apart up to a time (s), if there is one, the one at that time included; at least
/// the first. 1e-6 of a step: 20 s at 0.01 s are 2001 samples although 20/0.01 may round to below
/// 2000.
pub fn samples_until(time: Option<f64>, dt: f64) -> usize {
    time.map_or(usize::MAX, |time| ((time / dt + 1e-6) as usize).saturating_add(1))
}

/// The largest |x|, with its sign; zero for an empty slice.
pub fn peak(x: &[f64]) -> f64 {
    x.iter().copied().fold(0.0, |best: f64, x| if x.abs() > best.abs() { x } else { best })
}

/// Where it first stands; 0 of none.
pub fn peak_index(x: &[f64]) -> usize {
    let farther = |best: (usize, f64), (i, x): (usize, &f64)| {
        if x.abs() > best.1 { (i, x.abs()) } else { best }
    };
    x.iter().enumerate().fold((0, 0.0), farther).0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_up_to_a_samples_time_are_those_up_to_it() {
        for dt in [0.005, 0.01, 0.02] {
            assert!((0..4000).all(|i| samples_until(Some(i as f64 * dt), dt) == i + 1));
        }
        // as a screen shows times
        let shown = |i: usize| (i as f64 * 5.0).round() / 1e3;
        assert!((0..4000).all(|i| samples_until(Some(shown(i)), 0.005) == i + 1));
        assert_eq!((samples_until(Some(0.035), 0.01), samples_until(None, 0.01)), (4, usize::MAX));
    }

    #[test]
    fn nrmse_of_a_scaled_copy_is_the_scale_error() {
        let reference = [1.0, -2.0, 3.0];
        let scaled: Vec<f64> = reference.iter().map(|x| 1.1 * x).collect();
        assert!((nrmse(&scaled, &reference) - 0.1).abs() < 1e-15);
        assert_eq!(nrmse(&reference, &reference), 0.0);
        assert_eq!(
            (shown(0.1), shown(nrmse(&reference, &[0.0; 3]))),
            ("0.1000".into(), "-".into())
        );
    }

    #[test]
    fn a_peak_is_the_first_of_the_largest_with_its_sign() {
        let at = |value, time| Some(TimedPeak { value, time });
        assert_eq!(TimedPeak::of(0.5, &[1.0, -3.0, 3.0]), at(-3.0, 0.5));
        assert_eq!((TimedPeak::of(0.5, &[0.0; 3]), TimedPeak::of(0.5, &[])), (at(0.0, 0.0), None));
    }

    #[test]
    fn peak_keeps_the_sign() {
        assert_eq!(peak(&[1.0, -3.0, 2.0]), -3.0);
        assert_eq!(peak(&[]), 0.0);
        assert_eq!(peak_index(&[1.0, -3.0, 3.0]), 1);
    }
}
