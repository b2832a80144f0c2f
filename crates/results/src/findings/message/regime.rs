//! The words of findings on whether the models hold.

use super::{on, s};
use crate::findings::{Ending, Finding};
use files::message::{percent, quantity, significant};

/// Share of what a footing bears at rest below which its load is said where friction is.
const LIGHT: f64 = 0.5;

/// Friction that ground commonly offers: a body that needs more to land is stocky.
pub(in crate::findings) const USUAL_FRICTION: f64 = 0.5;

impl Finding {
    /// Whether the models hold.
    pub(super) fn regime(&self) -> Option<String> {
        Some(match self {
            Self::Sliding { needed, time_s, available, press_over_weight } => {
                let when =
                    time_s.map_or("in a landing".into(), |time| format!("at t = {}", s(time)));
                let light = press_over_weight.filter(|share| *share < LIGHT);
                let when = light.map_or(when.clone(), |share| {
                    format!("{when}, under {} of its load at rest", percent(share))
                });
                format!(
                    "the feet would slide: friction of {} is needed {when}, {} is available",
                    significant(*needed, 3),
                    significant(*available, 3)
                )
            }
            Self::FreeFlight { time_s, .. } => {
                format!(
                    "free flight: the ground would have to pull the pivot down at t = {}",
                    s(*time_s)
                )
            }
            Self::HardlyPresses { time_s, press_over_weight } => format!(
                "Housner's body nearly leaves the ground: at t = {} it presses with {} of its \
                    weight",
                s(*time_s),
                percent(*press_over_weight)
            ),
            Self::SinksOnSprings { settlement_m, share_of_width, lifts_at_share } => format!(
                "at rest the structure settles by {} on its springs, {} of the distance between \
                    its feet: no foot lifts below a tilt of {} of overturning; until then the \
                    structure sways",
                quantity(*settlement_m, "m"),
                percent(*share_of_width),
                percent(*lifts_at_share)
            ),
            Self::WalksOnSprings { largest_m, end_m } => format!(
                "on springs the feet walk by up to {} ({} at the end); Housner's feet do not: the \
                    walk is part of the top displacement, not of the drift ratio",
                quantity(*largest_m, "m"),
                quantity(*end_m, "m")
            ),
            // given enough of it a slender body lands as Housner says
            Self::TooStocky { restitution, friction_needed, available }
                if *restitution > 0.0 && *friction_needed <= USUAL_FRICTION =>
            {
                format!(
                    "the friction given is too little to land without bouncing: {} is needed, {} \
                        is available",
                    significant(*friction_needed, 3),
                    significant(*available, 3)
                )
            }
            Self::TooStocky { restitution, friction_needed, .. } => format!(
                "the body is too stocky to land without bouncing: friction of {} is needed, \
                    equation 2 gives e = {}",
                significant(*friction_needed, 3),
                significant(*restitution, 3)
            ),
            Self::HistoryEndsEarly { model, time_s, ending } => {
                let why = match ending {
                    Ending::WorkBound => "the bound on steps was reached",
                    Ending::Unstable => "the rotation lost its balance",
                    Ending::Stopped => "it could not be followed further",
                };
                format!("the history {} ends at t = {}: {why}", on(*model), s(*time_s))
            }
            Self::SmallestSteps { model, steps } => {
                format!(
                    "{steps} steps of the history {} were taken at the smallest size, whatever \
                        their error",
                    on(*model)
                )
            }
            _ => return None,
        })
    }
}
