//! What to do about findings, and what they mean.

use super::{Ending, Finding, message::USUAL_FRICTION};
use dynamics::effort::CutBy;

/// What to do about a landing that bounces: slender bodies lack friction, stocky ones do not rock.
fn of_landing(restitution: f64, friction_needed: f64) -> &'static str {
    match restitution > 0.0 && friction_needed <= USUAL_FRICTION {
        true => "--friction sets what the ground offers",
        false => "check height and width; rely on tests for such a body",
    }
}

impl Finding {
    /// What to do, if there is anything to do.
    pub(crate) fn remedy(&self) -> Option<String> {
        let text = match self {
            Self::Stands { .. }
            | Self::Slides { .. }
            | Self::LeftAside { .. }
            | Self::ForcesAtRest { .. }
            | Self::MembersBeside { .. }
            | Self::NearMotions { .. }
            | Self::DeckJudged { .. }
            | Self::WithoutVertical { .. } => return None,
            Self::CutAtLargest { .. } => "take more of it: --duration",
            Self::NeverLifts { .. } => "give a stronger record, or scale it: --scale",
            Self::Overturns { .. } => "scale the record down for the margin: --scale",
            Self::NoAnswer { .. } | Self::HistoryEndsEarly { ending: Ending::WorkBound, .. } => {
                "take softer or more strongly damped springs: --max-hz; or a shorter record: \
                    --duration"
            }
            Self::ModelsDisagree { .. } => {
                "vary the scale by 1 %, and judge by many records: tune validate"
            }
            Self::PivotLeavesGround { .. } | Self::FreeFlight { .. } => "compare up to then",
            Self::IllConditioned { .. } => "judge by many: tune init sweep",
            Self::ForetoldUpTo { later_forces, .. } | Self::SlidesOn { later_forces, .. }
                if !later_forces.is_empty() =>
            {
                "design by several records"
            }
            Self::ForetoldUpTo { softer_hz, .. } | Self::SlidesOn { softer_hz, .. } => {
                let hz = (*softer_hz)?;
                return Some(format!(
                    "up to then --max-hz {:.0} is stiff enough, with fewer steps",
                    hz.ceil()
                ));
            }
            Self::AccuracyMissed { capped: true, .. } | Self::PeaksMissed { capped: true, .. } => {
                "raise or drop --max-hz"
            }
            Self::AccuracyMissed { another_restitution: true, .. }
            | Self::PeaksMissed { another_restitution: true, .. } => {
                "leave the restitution out: springs are exact with equation 2's alone"
            }
            Self::AccuracyMissed { .. } | Self::PeaksMissed { .. } => {
                "ask for less, or judge the springs by many records: tune validate"
            }
            Self::AccuracyNotMeasured => "judge the springs on records of your own: tune validate",
            Self::RestitutionMissed { of_equation_2: true, .. } => {
                "allow stiffer springs: --max-hz"
            }
            Self::RestitutionMissed { .. } | Self::RestitutionOutOfReach { .. } => {
                "ask for a restitution nearer to equation 2's"
            }
            Self::LandingsUnfinished { .. } => "allow other springs: --max-hz, --accuracy",
            Self::Sliding { .. } => {
                "add a shear key, or let the feet slide ([friction]); --friction sets what the \
                    ground offers"
            }
            Self::TooStocky { restitution, friction_needed, .. } => {
                of_landing(*restitution, *friction_needed)
            }
            Self::HistoryEndsEarly { .. } => {
                "take stiffer springs, or rotational_inertia_kgm2 above 0.002 m R^2"
            }
            Self::SinksOnSprings { .. } => {
                "take stiffer springs: raise or drop --max-hz, or drop a restitution that is given"
            }
            Self::FeetMoved { .. } => "tie the feet, or design for what stays",
            Self::SmallestSteps { .. } => "compare with OpenSees: tune verify",
            Self::VerticalLeftOut { .. } => "take it: --vertical auto",
            Self::Doubt { remedy, .. } => return Some(remedy.clone()),
            _ => {
                return self
                    .remedy_of_steps()
                    .or_else(|| self.remedy_of_forces())
                    .or_else(|| self.remedy_of_search());
            }
        };
        Some(text.into())
    }

    /// What to do about an elastic structure's, which `tune validate` does not take.
    pub(crate) fn remedy_of_elastic(&self) -> Option<String> {
        let text = match self {
            Self::ModelsDisagree { .. } => "vary the scale by 1 %, and judge by several records",
            Self::AccuracyMissed { capped: false, another_restitution: false, .. }
            | Self::PeaksMissed { capped: false, another_restitution: false, .. } => {
                "ask for less, or judge the springs by several records"
            }
            Self::AccuracyNotMeasured | Self::HistoriesUnfinished { left_out: false, .. } => {
                "judge the springs on records of your own"
            }
            Self::Sliding { .. } => {
                "add a shear key: feet do not slide here; --friction sets what the ground offers"
            }
            _ => return self.remedy(),
        };
        Some(text.into())
    }

    /// Of forces that do not hold, or not of all.
    fn remedy_of_forces(&self) -> Option<String> {
        let text = match self {
            Self::ForceWithheld { springs_err: Some(_), .. } => {
                "first find springs that follow Housner (see the accuracy), or take forces from \
                    another kind of model"
            }
            Self::ForceWithheld { housner: Some(_), .. } => {
                "design for the larger, or take stiffer springs: --accuracy"
            }
            Self::ForceWithheld { .. } => "refine: --accuracy, or, of columns with mass, elements",
            Self::ForcesHeldInPart { .. } => "design for the larger, and by several records",
            Self::ForcesOfCutoff { .. } => "design brittle parts for the larger",
            _ => return None,
        };
        Some(text.into())
    }

    /// Of a search that did not end.
    fn remedy_of_search(&self) -> Option<String> {
        let text = match self {
            Self::SearchCut { by: CutBy::Work, .. } => {
                "allow more: --work 10; or ask for less: --accuracy, --max-hz"
            }
            Self::SearchCut { by: CutBy::TimeLimit, .. } => "raise or leave out --time-limit",
            Self::SearchCut { by: CutBy::Interrupt, .. } => "run it again to its end",
            Self::HistoriesUnfinished { left_out: true, .. } | Self::NearMotionsLeftOut { .. } => {
                "allow more: --work 10"
            }
            Self::HistoriesUnfinished { .. } => "judge the springs by many records: tune validate",
            _ => return None,
        };
        Some(text.into())
    }

    /// What it means, for a report that has the room.
    pub fn meaning(&self) -> Option<&'static str> {
        Some(match self {
            Self::NeverLifts { .. } => {
                "Nothing rocks, so there is no history to compare. The springs follow from the \
                    geometry, and their accuracy was measured on synthetic motions."
            }
            Self::Slides { .. } => {
                "Its springs are for rocking, and nothing rocks. Slip depends on the friction \
                    coefficient: take the least and the most that it may be."
            }
            Self::Overturns { .. } => {
                "Peaks, errors and forces count up to the time of overturning only; what follows \
                    is a fall."
            }
            Self::ModelsDisagree { .. } => {
                "Near the edge of overturning the smallest change decides; elsewhere the springs \
                    are too soft."
            }
            Self::PivotLeavesGround { .. } => {
                "His equation holds while the foot presses on the ground. The finite elements go \
                    on, without anything to compare them with."
            }
            Self::IllConditioned { .. } => {
                "A change far below the uncertainty of a real structure gives another history. No \
                    two models and no two tests agree on this history one to one, whatever the \
                    springs."
            }
            Self::AccuracyMissed { .. } | Self::PeaksMissed { .. } => {
                "These are the best springs found within what was allowed; the table of accuracy \
                    says by how much they miss."
            }
            Self::SearchCut { .. } => {
                "The springs are the best of those judged until then. Nothing that was measured of \
                    them depends on where the search ended."
            }
            Self::HistoriesUnfinished { .. } => {
                "A history has a bound of its own on its steps, so that every search ends; the \
                    springs that it was on, or the motion, had to be judged without its end."
            }
            Self::AccuracyNotMeasured => {
                "No motion that was tried rocks this structure and can be followed one to one."
            }
            Self::RestitutionMissed { .. } | Self::RestitutionOutOfReach { .. } => {
                "A body on soft springs sways before it lifts and loses less; a restitution other \
                    than equation 2's is met by a search, not exactly."
            }
            Self::SpringsForRestitution { .. } => {
                "Springs have equation 2's restitution unless they bounce, and bouncing spoils \
                    forces. The springs with the smaller product of both errors are taken: medians \
                    over synthetic motions, and this record's where it can be judged on."
            }
            Self::HistoryEndsEarly { .. } | Self::NoAnswer { .. } => {
                "Both models are compared up to there."
            }
            Self::ForceWithheld { springs_err: Some(_), .. } => {
                "A force that agrees on springs with another motion does so by chance."
            }
            Self::ForceWithheld { .. } => {
                "A force that grows with the springs or the mesh is the model's, not the \
                    structure's. Where a finer model does not settle it, take it from another kind \
                    of model."
            }
            _ => return self.meaning_of_contact(),
        })
    }

    /// The same of feet that slide, fly or walk.
    fn meaning_of_contact(&self) -> Option<&'static str> {
        Some(match self {
            Self::Sliding { press_over_weight: Some(_), .. } => {
                "Rigid ground and the springs hold the feet at any force. A real structure would \
                    slide, and rock less."
            }
            Self::Sliding { .. } => {
                "Housner's body and the springs hold the feet at any force. A real structure would \
                    slide, and rock less."
            }
            Self::HardlyPresses { .. } => {
                "With a little more vertical motion or a faster rotation the body would leave the \
                    ground: there Housner's equation ends, and only the springs tell what follows."
            }
            Self::SinksOnSprings { .. } => {
                "A body on rigid ground lifts as soon as its weight is overcome. On springs the \
                    lifting foot must first rise by what its spring is pressed down, and the other \
                    sink as far."
            }
            Self::WalksOnSprings { .. } => {
                "Feet that bounce land beside where they stood. The walk belongs to the springs, \
                    not to the structure."
            }
            Self::FreeFlight { .. } => {
                "Housner's equation would have to pull the foot down there; the finite elements \
                    let it go."
            }
            _ => return None,
        })
    }
}
