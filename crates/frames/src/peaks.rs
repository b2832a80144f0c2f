//! What an elastic structure is designed by: the largest displacement, drift and uplift, beside its
//! reference on rigid ground, and the forces that columns bear, beside springs at 4 Omega_n
//! (`design_forces::ColumnPeaks`).
//!
//! ```text
//!   displacement   max |x| of a top node, against the ground
//!   drift          max of a top node against the base that it stands on, across the base's axis
//!   uplift         max height of a corner above the ground
//!   error          | peak - peak of the reference | / peak of the reference
//! ```

use serde::{Deserialize, Serialize};

use rocking::{
    json::{null_as_infinite, null_as_lost},
    statistics::largest,
};

use super::assembled::{Assembled, Watched};

/// Largest magnitudes over a history (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StructurePeaks {
    /// Of the top.
    pub displacement: f64,
    /// Of the top against its base.
    pub drift: f64,
    /// Of a corner.
    pub uplift: f64,
}

/// Relative errors of them; infinite, `null` in JSON, where histories on springs do not get as far
/// as the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StructurePeakErrors {
    /// Of the top's displacement.
    #[serde(deserialize_with = "null_as_infinite")]
    pub displacement: f64,
    /// Of the drift.
    #[serde(deserialize_with = "null_as_infinite")]
    pub drift: f64,
    /// Of the uplift of a corner.
    #[serde(deserialize_with = "null_as_infinite")]
    pub uplift: f64,
    /// Of the column shear, base moment and axial force with the largest error, where they were
    /// compared: beside springs at 4 Omega_n.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "null_as_lost")]
    pub design_forces: Option<f64>,
}

impl StructurePeaks {
    /// Of every configuration.
    pub fn of<'a>(model: &Assembled, all: impl Iterator<Item = &'a [f64]>) -> Self {
        let (frame, mut peaks) = (&model.frame, Self::default());
        for q in all {
            for &Watched { base, top } in &model.watched {
                let across = frame.displacement(top, q)[0].abs();
                peaks.displacement = peaks.displacement.max(across);
                peaks.drift = peaks.drift.max(base.drift(frame, top, q)[0].abs());
            }
            for place in frame.places() {
                peaks.uplift = peaks.uplift.max(place.reach(q).place[1]);
            }
        }
        peaks
    }

    /// The errors of these beside a reference's.
    pub fn beside(&self, reference: &Self) -> StructurePeakErrors {
        let relative = |x: f64, of: f64| if x == of { 0.0 } else { (x / of - 1.0).abs() };
        StructurePeakErrors {
            displacement: relative(self.displacement, reference.displacement),
            drift: relative(self.drift, reference.drift),
            uplift: relative(self.uplift, reference.uplift),
            design_forces: None,
        }
    }
}

impl StructurePeakErrors {
    /// Of a history that says nothing.
    pub const LOST: Self = Self {
        displacement: f64::INFINITY,
        drift: f64::INFINITY,
        uplift: f64::INFINITY,
        design_forces: None,
    };

    /// Which of them is the largest, in words.
    pub fn worst(&self) -> &'static str {
        let all =
            [("displacement", self.displacement), ("bending", self.drift), ("uplift", self.uplift)];
        let all =
            all.into_iter().chain(self.design_forces.map(|forces| ("a design force", forces)));
        all.max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or("", |(name, _)| name)
    }

    /// The largest of them.
    pub fn largest(&self) -> f64 {
        let all = [self.displacement, self.drift, self.uplift];
        largest(all.into_iter().chain(self.design_forces))
    }

    /// A statistic of each over several histories; of the design forces only if all have them.
    pub fn each(all: &[Self], statistic: impl Fn(Vec<f64>) -> Option<f64>) -> Option<Self> {
        let of = |pick: fn(&Self) -> f64| statistic(all.iter().map(pick).collect());
        let forces: Option<Vec<f64>> = all.iter().map(|errors| errors.design_forces).collect();
        Some(Self {
            displacement: of(|errors| errors.displacement)?,
            drift: of(|errors| errors.drift)?,
            uplift: of(|errors| errors.uplift)?,
            design_forces: forces.and_then(&statistic),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_shares_of_the_reference_and_the_largest_decides() {
        let reference = StructurePeaks { displacement: 2.0, drift: 0.5, uplift: 0.1 };
        let errors =
            StructurePeaks { displacement: 2.02, drift: 0.48, uplift: 0.1 }.beside(&reference);
        assert!((errors.displacement - 0.01).abs() < 1e-12 && (errors.drift - 0.04).abs() < 1e-12);
        assert!(errors.uplift == 0.0 && errors.largest() == errors.drift);
        let worse = StructurePeakErrors { design_forces: Some(0.2), ..errors };
        assert_eq!(worse.largest(), 0.2);
        let most = |all: Vec<f64>| all.into_iter().reduce(f64::max);
        assert_eq!(StructurePeakErrors::each(&[worse, errors], most).unwrap().design_forces, None);
        assert_eq!(StructurePeakErrors::each(&[], most), None);
    }
}
