//! Peaks of two histories beside each other: what an engineer reads first.

use rocking::{
    motion::{Motion, peak},
    structure::Body,
};

/// Share of alpha that a body must lean beyond, on either side, for a swing to count: less is the
/// tremble of a body at rest.
const SWING: f64 = 0.01;

/// The largest of a quantity in our own history and in OpenSees'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedPeak {
    /// What it is.
    pub quantity: &'static str,
    /// Its unit: metres or radians.
    pub unit: &'static str,
    /// In our own history.
    pub ours: f64,
    /// In OpenSees'.
    pub opensees: f64,
    /// Below this neither is a motion: no difference is told.
    pub least: f64,
}

impl ComparedPeak {
    /// From the two histories of a quantity.
    pub fn new(
        (quantity, unit): (&'static str, &'static str),
        ours: &[f64],
        opensees: &[f64],
        least: f64,
    ) -> Self {
        Self { quantity, unit, ours: peak(ours), opensees: peak(opensees), least }
    }

    /// Displacement of the mass, uplift of a foot and rotation of a rigid body.
    pub(crate) fn rigid(ours: &Motion, opensees: &Motion, body: &Body<f64>) -> Vec<Self> {
        let width = 2.0 * body.half_width;
        let uplift = |motion: &Motion| {
            motion.theta.iter().map(|theta| width * theta.sin().abs()).collect::<Vec<_>>()
        };
        let small = SMALL * body.half_width;
        vec![
            Self::new(("displacement of the mass", "m"), &ours.u, &opensees.u, small),
            Self::new(("uplift", "m"), &uplift(ours), &uplift(opensees), small),
            Self::new(("rise of the mass", "m"), &ours.v, &opensees.v, small),
            Self::new(("rotation", "rad"), &ours.theta, &opensees.theta, SMALL),
        ]
    }

    /// OpenSees' over ours, less one (%); none of what hardly moves.
    pub fn difference_percent(&self) -> Option<f64> {
        (self.ours.abs() > self.least).then(|| 100.0 * (self.opensees / self.ours - 1.0))
    }
}

/// Share of the half width, and rotation (rad), below which nothing moves to speak of.
const SMALL: f64 = 1e-6;

/// Number of times the body changes the side to which it leans.
pub fn swings(theta: &[f64], alpha: f64) -> usize {
    let mut side = 0.0;
    let mut count = 0;
    for theta in theta.iter().filter(|theta| theta.abs() > SWING * alpha) {
        count += usize::from(side * theta < 0.0);
        side = *theta;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_of_five_periods_swings_nine_times_and_its_tremble_does_not_count() {
        let sine = |amplitude: f64| -> Vec<f64> {
            (0..500)
                .map(|i| amplitude * (std::f64::consts::TAU * (f64::from(i) + 0.5) / 100.0).sin())
                .collect()
        };
        assert_eq!(swings(&sine(0.1), 0.2), 9);
        assert_eq!(swings(&sine(0.001), 0.2), 0);
    }

    #[test]
    fn the_difference_of_peaks_has_a_sign_and_rest_has_none() {
        let of = |ours: &[f64], opensees: &[f64]| {
            ComparedPeak::new(("top displacement", "m"), ours, opensees, 1e-6)
        };
        let difference = of(&[0.0, -2.0, 1.0], &[0.0, -1.98, 1.5]).difference_percent().unwrap();
        assert!((difference + 1.0).abs() < 1e-12);
        assert_eq!(of(&[1e-9], &[2e-9]).difference_percent(), None);
    }
}
