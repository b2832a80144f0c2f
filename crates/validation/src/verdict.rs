//! What a run found, in a form that can be filed: what the body did in both models, and whether the
//! two can be compared.

use serde::{Deserialize, Serialize};

use dynamics::compare::Match;
use dynamics::fem::{self, History};
use rocking::{
    conditioning::Conditioning,
    housner::{self, Rocking},
    members::Members,
    motion::{largest_magnitude, samples_until},
    overturning::overturned_with,
    structure::Body,
};

/// What a body did on a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// No foot left the ground.
    NeverLifted,
    /// It rocked and stood at the end.
    Rocked,
    /// It fell over.
    Overturned,
    /// Housner's pivot let go of the ground: his solution ends there.
    LeftGround,
    /// The history ended before the record did, without having overturned.
    Failed,
}

/// One model's answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// What it did.
    pub fate: Fate,
    /// When |theta| last grew past alpha (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overturned_s: Option<f64>,
    /// When Housner's pivot let go of the ground, which ends his solution (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_ground_s: Option<f64>,
    /// Largest |theta|/alpha, of a body that overturned or left the ground up to then; zero if it
    /// never lifted.
    pub peak_ratio: f64,
}

/// Both models' answers to one record, and what their comparison is worth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Housner's body.
    pub housner: Answer,
    /// His answer without the record's vertical component, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub housner_without_vertical: Option<Answer>,
    /// The finite element body on its springs.
    pub finite_elements: Answer,
    /// Whether Housner's history is well conditioned: whether the two can be compared one to one.
    pub well_conditioned: bool,
    /// NRMSE of u over the length compared; none where there is nothing to compare.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nrmse_horizontal: Option<f64>,
    /// NRMSE of v over the length compared; none where there is nothing to compare.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nrmse_vertical: Option<f64>,
    /// Length compared: up to the first overturning (s).
    pub compared_s: f64,
}

impl Answer {
    fn of_housner(body: &Body<f64>, dt: f64, rocking: &Rocking<f64>) -> Self {
        let fate = match rocking.outcome {
            housner::RockingOutcome::NeverMoved => Fate::NeverLifted,
            housner::RockingOutcome::Rocked => Fate::Rocked,
            housner::RockingOutcome::Overturned { .. } => Fate::Overturned,
            housner::RockingOutcome::LeavesGround { .. } => Fate::LeftGround,
            housner::RockingOutcome::WorkBound { .. }
            | housner::RockingOutcome::NotFinite { .. } => Fate::Failed,
        };
        let left_ground_s = rocking.left_ground();
        Self { left_ground_s, ..Self::new(body, dt, fate, rocking.overturned(), &rocking.theta) }
    }

    /// Of a history on springs, with these members.
    #[doc(hidden)]
    pub fn of_history(body: &Body<f64>, members: Members, dt: f64, history: &History) -> Self {
        let theta = &history.motion.theta;
        let time = overturned_with(body, members, dt, theta);
        let fate = match history.outcome {
            _ if time.is_some() => Fate::Overturned,
            fem::HistoryOutcome::WorkBound { .. } | fem::HistoryOutcome::Unstable { .. } => {
                Fate::Failed
            }
            _ if history.landings.is_empty() && history.airborne == 0.0 => Fate::NeverLifted,
            _ => Fate::Rocked,
        };
        Self::new(body, dt, fate, time, theta)
    }

    fn new(
        body: &Body<f64>,
        dt: f64,
        fate: Fate,
        overturned_s: Option<f64>,
        theta: &[f64],
    ) -> Self {
        let standing = samples_until(overturned_s, dt).min(theta.len());
        let peak = largest_magnitude(&theta[..standing]) / body.alpha();
        // a standing finite element body sways without lifting
        Self {
            fate,
            overturned_s,
            left_ground_s: None,
            peak_ratio: if fate == Fate::NeverLifted { 0.0 } else { peak },
        }
    }
}

impl Verdict {
    /// From both histories at the same samples, their match, and the conditioning of Housner's.
    /// Public for the crates that compare.
    #[doc(hidden)]
    pub fn new(
        body: &Body<f64>,
        dt: f64,
        (rocking, history): (&Rocking<f64>, &History),
        matched: &Match,
        conditioning: &Conditioning,
    ) -> Self {
        let housner = Answer::of_housner(body, dt, rocking);
        let comparable = !matches!(housner.fate, Fate::NeverLifted | Fate::Failed);
        let number = |x: f64| Some(x).filter(|x| comparable && x.is_finite());
        Self {
            housner,
            housner_without_vertical: None,
            finite_elements: Answer::of_history(body, Members::default(), dt, history),
            well_conditioned: conditioning.well_conditioned(),
            nrmse_horizontal: number(matched.nrmse_horizontal),
            nrmse_vertical: number(matched.nrmse_vertical),
            compared_s: matched.duration_s,
        }
    }

    /// Beside Housner's history without the vertical component.
    #[doc(hidden)]
    #[must_use]
    pub fn beside(self, body: &Body<f64>, dt: f64, level: &Rocking<f64>) -> Self {
        Self { housner_without_vertical: Some(Answer::of_housner(body, dt, level)), ..self }
    }

    /// Whether both models say the same: overturned, rocked, or stayed down. Where Housner's body
    /// leaves the ground only the finite elements say it, and nothing disagrees with them.
    pub fn agrees(&self) -> bool {
        match self.housner.fate {
            Fate::Failed => false,
            Fate::LeftGround => self.finite_elements.fate != Fate::Failed,
            fate => fate == self.finite_elements.fate,
        }
    }
}

#[cfg(test)]
mod tests;
