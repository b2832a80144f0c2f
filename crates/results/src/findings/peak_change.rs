//! What something that was left out changes.

use serde::{Deserialize, Serialize};

/// A quantity without and with something that was left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeakChange {
    /// What it is, in words.
    pub quantity: String,
    /// Unit.
    pub unit: String,
    /// As printed.
    pub without: f64,
    /// With what was left out.
    pub with: f64,
}
