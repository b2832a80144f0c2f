//! What a program with fixed time steps finds on a record.

use serde::{Deserialize, Serialize};

/// What an emulation of a program finds on a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgramOnRecord {
    /// Its largest top displacement over that of the reference, less one, up to when the motion can
    /// be predicted; none where one of them falls or ends before that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub top: Option<f64>,
    /// NRMSE of its history beside the reference's over the same part: of u, or of rotations of an
    /// elastic structure, as that of motions is; none where `top` is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nrmse: Option<f64>,
    /// When it gives up, if it does (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gives_up_s: Option<f64>,
    /// When the structure has fallen over, turned by 1 rad, if it does (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falls_s: Option<f64>,
    /// Whether the motion is well conditioned, so that these errors say something about the
    /// springs; none: not checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predictable: Option<bool>,
    /// Up to when the motion can be predicted (s), if not to its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Below this a displacement is rounding (m).
const ROUNDING_M: f64 = 1e-12;

impl ProgramOnRecord {
    /// When it ends, if not with the record (s).
    pub fn ends_s(&self) -> Option<f64> {
        self.gives_up_s.or(self.falls_s)
    }

    /// From the largest top displacements of a history and of the reference, where both stand.
    pub fn of(tops: Option<[f64; 2]>, gives_up_s: Option<f64>) -> Self {
        let top = tops.filter(|[_, reference]| *reference > ROUNDING_M && gives_up_s.is_none());
        Self {
            top: top.map(|[found, reference]| found / reference - 1.0),
            nrmse: None,
            gives_up_s,
            falls_s: None,
            predictable: None,
            until_s: None,
        }
    }

    /// The same with the NRMSE of the history.
    #[must_use]
    pub fn with_history(self, nrmse: f64) -> Self {
        Self { nrmse: Some(nrmse).filter(|x| x.is_finite() && self.top.is_some()), ..self }
    }
}
