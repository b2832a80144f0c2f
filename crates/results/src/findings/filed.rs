//! A finding with its words.

use serde::{Deserialize, Serialize};

use super::{Finding, Weight};

/// A finding as parameters.json holds it: its quantities, and the words of this version of the
/// program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FiledFinding {
    /// How much it weighs.
    pub weight: Weight,
    /// In one sentence.
    pub message: String,
    /// What to do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
    /// Its name and quantities.
    #[serde(flatten)]
    pub finding: Finding,
}

impl FiledFinding {
    /// The same of an elastic structure.
    #[must_use]
    pub fn of_elastic(self) -> Self {
        Self { remedy: self.finding.remedy_of_elastic(), ..self }
    }

    /// Message and remedy.
    pub fn line(&self) -> String {
        match &self.remedy {
            Some(remedy) => format!("{}: {remedy}", self.message),
            None => self.message.clone(),
        }
    }
}

impl From<Finding> for FiledFinding {
    fn from(finding: Finding) -> Self {
        let (weight, message, remedy) = (finding.weight(), finding.message(), finding.remedy());
        Self { weight, message, remedy, finding }
    }
}
