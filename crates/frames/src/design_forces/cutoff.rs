//! The frequency below which forces of a column are given.

use crate::{frame::FrameError, structure::ElasticStructure};

/// Cutoff over the third bending mode: at which a Butterworth filter of order 4, forwards and
/// backwards, has a gain of 1/(1 + 1.5^-8) = 0.96.
const ABOVE_THIRD: f64 = 1.5;
/// Bending modes that are kept.
const MODES: usize = 3;
/// Elements by which the modes are found: lumped masses are then within 1 % of the third.
const ELEMENTS: usize = 32;
/// Parts to a period of the cutoff over which forces are averaged: a mean then loses (pi/16)^2/6 =
/// 0.6 % of what is at the cutoff.
pub(crate) const PARTS_A_PERIOD: f64 = 16.0;

/// Frequency below which a column's forces are given, and what it keeps.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutoff {
    /// (Hz)
    pub cutoff_hz: f64,
    /// Bending modes of the column fixed at its foot, its top mass on it, undamped (Hz): all below
    /// the cutoff.
    pub modes_hz: Vec<f64>,
}

impl Cutoff {
    /// Of a structure whose columns have a mass of their own.
    pub(crate) fn of(structure: &ElasticStructure) -> Option<Self> {
        let modes = bending_modes(structure)?.ok()?;
        let modes_hz: Vec<f64> = modes.into_iter().take(MODES).collect();
        let last = *modes_hz.last()?;
        Some(Self { cutoff_hz: ABOVE_THIRD * last, modes_hz })
    }
}

/// Bending modes of one column fixed at its foot, from the lowest (Hz).
fn bending_modes(structure: &ElasticStructure) -> Option<Result<Vec<f64>, FrameError>> {
    let layout = structure.column_alone(ELEMENTS)?;
    Some(layout.fixed().frame().map(|frame| frame.lateral_frequencies()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cantilever with a tip mass M on a hinge, line mass m: 1 + cos x cosh x + x M/(m L) (cos x
    /// sinh x - sin x cosh x) = 0, f = x^2/(2 pi L^2) sqrt(EI/m) (Blevins, *Formulas for Natural
    /// Frequency and Mode Shape*, table 8-8).
    #[test]
    fn three_bending_modes_are_those_of_the_closed_form_and_are_kept() {
        let text = "kind = 'pier'\nheight_m = 14.0\nwidth_m = 3.2\nmass_kg = 450e3\n\
                    footing_mass_kg = 90e3\nfooting_height_m = 1.5\n\
                    ei_nm2 = 7.65e9\nga_n = 1e19\ndamping_ratio = 0.05\ncolumn_mass_kg = 79e3\n";
        let structure: ElasticStructure = toml::from_str(text).unwrap();
        let cutoff = Cutoff::of(&structure).unwrap();
        let (length, line): (f64, f64) = (12.5, 79e3 / 12.5);
        let ratio = 450e3 / 79e3;
        let f = |x: f64| {
            1.0 + x.cos() * x.cosh() + x * ratio * (x.cos() * x.sinh() - x.sin() * x.cosh())
        };
        let mut roots = Vec::new();
        let mut x: f64 = 0.01;
        while roots.len() < 3 {
            let (mut a, mut b) = (x, x + 0.01);
            if f(a) * f(b) < 0.0 {
                for _ in 0..60 {
                    let c = 0.5 * (a + b);
                    if f(a) * f(c) <= 0.0 { b = c } else { a = c }
                }
                roots.push(a);
            }
            x += 0.01;
        }
        assert_eq!(cutoff.modes_hz.len(), 3);
        for (mode, root) in cutoff.modes_hz.iter().zip(roots) {
            let exact =
                root * root / (std::f64::consts::TAU * length * length) * (7.65e9 / line).sqrt();
            assert!((mode / exact - 1.0).abs() < 0.01, "{mode} {exact}");
            assert!(*mode < cutoff.cutoff_hz);
        }
    }
}
