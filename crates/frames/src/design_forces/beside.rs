//! A force beside others: those at the same time; the same force with another mesh and on other
//! springs.

use serde::{Deserialize, Serialize};

/// Forces of a column's base, or of a leg, at one time, with their signs: what acts together. Axial
/// force is positive in tension.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcesTogether {
    /// Shear across the column (N).
    pub column_shear_n: f64,
    /// Axial force (N).
    pub axial_n: f64,
    /// Moment at the column's base (N m); a leg's hinge has none.
    pub column_base_moment_nm: f64,
    /// Moment of a leg at the apex (N m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub apex_moment_nm: Option<f64>,
}

impl ForcesTogether {
    /// Shear, axial force and moment at a base.
    pub(super) fn of_base([column_shear_n, axial_n, column_base_moment_nm]: [f64; 3]) -> Self {
        Self { column_shear_n, axial_n, column_base_moment_nm, apex_moment_nm: None }
    }
}

/// What a force is, and holds, over a part of the record from its start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldForce {
    /// With its sign (N or N m).
    pub value: f64,
    /// The part's length (s).
    pub over_s: f64,
}

/// Largest change of a force that holds.
pub const MOST_CHANGE: f64 = 0.05;

/// Largest magnitude of a force with another mesh and on other springs, below the same frequency,
/// with its sign (N or N m). None where that motion says nothing of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OtherForces {
    /// What was found on the springs of the run, whether it holds or not.
    pub found: f64,
    /// With twice as many elements; absent from columns without mass, which have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubled_elements: Option<f64>,
    /// On springs of Omega_n/4.
    pub softer: Option<f64>,
    /// On springs of 4 Omega_n.
    pub stiffer: Option<f64>,
    /// On the springs of the run, below twice the frequency; absent where there is none. It decides
    /// nothing: what it has more is of faster waves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubled_cutoff: Option<f64>,
}

impl OtherForces {
    /// The largest change of the magnitude found, as a share of it; infinite where a motion says
    /// nothing.
    pub fn change(&self) -> f64 {
        let by_elements = self.doubled_elements.map_or(0.0, |other| self.change_by(Some(other)));
        by_elements.max(self.change_by(self.softer)).max(self.change_by(self.stiffer))
    }

    /// The least and the largest magnitude of all of them; none where a motion says nothing.
    pub fn range(&self) -> Option<[f64; 2]> {
        let others = [
            Some(self.found),
            self.doubled_elements.or(Some(self.found)),
            self.softer,
            self.stiffer,
        ];
        let all: Option<Vec<f64>> = others.into_iter().map(|x| x.map(f64::abs)).collect();
        let least_and_most = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
        all.map(|all| all.into_iter().fold([f64::INFINITY, 0.0], least_and_most))
    }

    /// The change of the magnitude in one of them, as a share of that found; infinite of one that
    /// says nothing.
    pub(crate) fn change_by(&self, other: Option<f64>) -> f64 {
        other.map_or(f64::INFINITY, |other| {
            (other.abs() - self.found.abs()).abs() / self.found.abs()
        })
    }
}
