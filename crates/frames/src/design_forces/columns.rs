//! Peaks of what columns bear, one history beside another: what springs are chosen by where peaks
//! are asked for.
//!
//! ```text
//!   peak      of column shear, moment at its base and axial force: the largest magnitude below
//!             the cutoff (`Cutoff`); as it is where columns have no mass
//!   error     the largest of | peak - peak of the other | / peak of the other
//! ```
//!
//! The other is the same structure on springs of 4 Omega_n (`stiffer`): on rigid ground a landing
//! is an impulse in no time, of which the reference keeps no means.

use super::{Cutoff, ForceName, check, parts_below};
use crate::{fem::ElasticHistory, structure::ElasticStructure};
use dynamics::spring::{Chain, Springs};

/// What is compared, in this order.
pub const COMPARED: [ForceName; 3] =
    [ForceName::ColumnShear, ForceName::ColumnBaseMoment, ForceName::Axial];

/// How forces of a structure's columns are taken from its histories.
#[derive(Clone, Debug)]
pub struct ColumnForces {
    cutoff: Option<Cutoff>,
    /// Hinged at their feet.
    legs: bool,
}

/// Largest magnitudes over a history [N, N m], in the order of [`COMPARED`]; none of what does not
/// apply.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColumnPeaks(pub [Option<f64>; 3]);

impl ColumnForces {
    /// Of a structure.
    pub fn of(structure: &ElasticStructure) -> Self {
        Self {
            cutoff: Cutoff::of(structure),
            legs: matches!(structure, ElasticStructure::AFrame(_)),
        }
    }

    /// Parts of a time step (s) whose means hold what the cutoff keeps: those of a history that
    /// these peaks are of.
    pub fn parts(&self, dt: f64) -> usize {
        parts_below(self.cutoff.as_ref(), dt)
    }

    /// Peaks of a history whose forces are finely sampled.
    pub fn peaks(&self, history: &ElasticHistory) -> ColumnPeaks {
        let all = check::ForcePeaks::of(history, self.cutoff.as_ref(), f64::INFINITY);
        let applies = |kind: ForceName| !(self.legs && kind == ForceName::ColumnBaseMoment);
        let peak =
            |kind: ForceName| Some(all.get(kind).filter(|_| applies(kind))?.filtered.value.abs());
        ColumnPeaks(COMPARED.map(peak))
    }
}

impl ColumnPeaks {
    /// The largest of the errors beside others; none if nothing is in both.
    pub fn error(&self, others: &Self) -> Option<f64> {
        let relative = |x: f64, of: f64| if x == of { 0.0 } else { (x / of - 1.0).abs() };
        let pairs = self.0.into_iter().zip(others.0).filter_map(|(x, of)| x.zip(of));
        pairs.map(|(x, of)| relative(x, of)).reduce(f64::max)
    }
}

/// Springs at 4 Omega_n, whose landing is the same but four times as fast.
pub fn stiffer(springs: &[Springs<Chain>]) -> Vec<Springs<Chain>> {
    check::scaled(springs, check::FACTOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_of_what_is_in_both_decides() {
        let of = |shear: f64, moment: Option<f64>| ColumnPeaks([Some(shear), moment, Some(10.0)]);
        let error = of(1.02, Some(4.0)).error(&of(1.0, Some(4.2))).unwrap();
        assert!((error - 0.2 / 4.2).abs() < 1e-12, "{error}");
        let legs = of(1.02, None).error(&of(1.0, Some(4.2))).unwrap();
        assert!((legs - 0.02).abs() < 1e-12, "{legs}");
        assert_eq!(ColumnPeaks::default().error(&of(1.0, None)), None);
        assert_eq!(of(1.0, Some(2.0)).error(&of(1.0, Some(2.0))), Some(0.0));
    }
}
