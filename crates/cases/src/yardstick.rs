//! What the stiffness of springs is chosen for: an error of histories, or of peaks.

use serde::{Deserialize, Serialize};

use super::CaseError;

/// What an error is measured by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Yardstick {
    /// The whole history: normalised root mean square error, NRMSE.
    #[default]
    Histories,
    /// The largest displacement, uplift and forces.
    Peaks,
}

impl Yardstick {
    /// Whether it is the one that nobody needs to ask for.
    pub fn is_histories(&self) -> bool {
        *self == Self::Histories
    }
}

/// An error that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// What it is an error of.
    pub by: Yardstick,
    /// At most.
    pub error: f64,
}

impl Asked {
    /// An error of peaks, if it is given, else of histories.
    pub fn new(accuracy: f64, peaks: Option<f64>) -> Self {
        match peaks {
            Some(error) => Self { by: Yardstick::Peaks, error },
            None => Self { by: Yardstick::Histories, error: accuracy },
        }
    }

    /// A share of it.
    pub fn times(self, share: f64) -> Self {
        Self { error: share * self.error, ..self }
    }
}

/// Refuse a case file that asks for both.
pub(super) fn one_of_two(path: &str, text: &str) -> Result<(), CaseError> {
    let Ok(file) = text.parse::<toml::Table>() else { return Ok(()) };
    let Some(tuning) = file.get("tuning").and_then(toml::Value::as_table) else { return Ok(()) };
    match (tuning.get("peaks"), tuning.get("accuracy")) {
        (Some(peaks), Some(accuracy)) => Err(CaseError::TwoYardsticks {
            path: path.into(),
            peaks: peaks.to_string(),
            accuracy: accuracy.to_string(),
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Case;

    #[test]
    fn a_case_asks_for_one_error_of_histories_or_of_peaks() {
        let body =
            "[structure]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.4\nmass_kg = 1e3\n[tuning]\n";
        let read = |tuning: &str| Case::parse("c.toml", &format!("{body}{tuning}"));
        let asked = |tuning: &str| read(tuning).unwrap().tuning.asked();
        assert_eq!(asked(""), Asked { by: Yardstick::Histories, error: 0.002 });
        assert_eq!(asked("accuracy = 0.01"), Asked { by: Yardstick::Histories, error: 0.01 });
        assert_eq!(asked("peaks = 0.02"), Asked { by: Yardstick::Peaks, error: 0.02 });
        let said = read("peaks = 0.02\naccuracy = 0.01").unwrap_err().to_string();
        assert_eq!(
            said,
            "c.toml: tuning.peaks is 0.02 and tuning.accuracy is 0.01; springs are chosen by one \
                of them, leave the other out"
        );
        let said = read("peaks = 0.0").unwrap_err().to_string();
        assert!(
            said.starts_with("c.toml, line 7: tuning.peaks is 0.0; give an error of peaks between"),
            "{said}"
        );
    }
}
