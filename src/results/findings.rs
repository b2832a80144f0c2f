//! Findings: what a reader of a run must know beside its numbers. Each is data; its words are made here and nowhere else.

use serde::{Deserialize, Serialize};

use crate::message::{percent, significant};

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Weight {
    /// What the run was asked.
    Answer,
    /// Good to know.
    Note,
    /// Numbers need judgement.
    Warning,
    /// Numbers must not be used as they are.
    Fault,
}

/// Which of the two models.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// Housner's rigid body; an elastic structure on rigid ground with plastic landings.
    Reference,
    /// On its springs.
    Springs,
    /// On its springs, with dampers, tendon or friction.
    Members,
}

/// Why a history ended before its record did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The bound on steps was reached.
    WorkBound,
    /// The rotation lost its balance.
    Unstable,
    /// The numbers overflowed, or no step could be made.
    Stopped,
}

/// A design force, by its key in parameters.json.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ForceName {
    ColumnShear,
    ColumnBaseMoment,
    Axial,
    ApexMoment,
    SoleShear,
    SoleVertical,
}

impl ForceName {
    /// As an engineer says it.
    pub fn words(self) -> &'static str {
        match self {
            Self::ColumnShear => "column shear",
            Self::ColumnBaseMoment => "moment at column base",
            Self::Axial => "axial force",
            Self::ApexMoment => "moment at the apex",
            Self::SoleShear => "shear at the sole, footing included",
            Self::SoleVertical => "vertical force at the sole, footing included",
        }
    }
}

/// A finding with its quantities, SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "finding", rename_all = "snake_case")]
#[allow(missing_docs)] // `message` says what variants and their fields are
pub enum Finding {
    // what the structure does
    NeverLifts {
        pga_g: f64,
        uplift_g: f64,
    },
    Stands {
        share_of_overturning: f64,
        over_s: f64,
    },
    Overturns {
        time_s: f64,
        reference_s: Option<f64>,
    },
    NoAnswer {
        model: Model,
        time_s: f64,
    },
    ModelsDisagree {
        reference: String,
        springs: String,
    },
    PivotLeavesGround {
        time_s: f64,
    },
    WithoutVertical {
        does: String,
        share_of_overturning: f64,
    },
    // what a comparison is worth
    IllConditioned {
        moved_by_width: f64,
        moved_by_scale: f64,
        springs_judged: bool,
    },
    ForetoldUpTo {
        time_s: f64,
        softer_hz: Option<f64>,
    },
    SlidesOn {
        time_s: f64,
        softer_hz: Option<f64>,
    },
    NearMotions {
        motions: usize,
        change: f64,
        median_ratio: [Option<f64>; 2],
        p90_ratio: [Option<f64>; 2],
        overturned: [usize; 2],
    },
    // how accurate the springs are
    AccuracyMissed {
        asked: f64,
        capped: bool,
    },
    PeaksMissed {
        asked: f64,
        capped: bool,
    },
    AccuracyNotMeasured,
    RestitutionMissed {
        asked: f64,
        lowest: f64,
        highest: f64,
        of_equation_2: bool,
    },
    RestitutionOutOfReach {
        asked: f64,
        share: f64,
        least: f64,
        most: f64,
    },
    LandingsUnfinished {
        finished: usize,
        all: usize,
    },
    ForceWithheld {
        force: ForceName,
        change: Option<f64>,
    },
    // whether the models hold
    Sliding {
        needed: f64,
        time_s: Option<f64>,
        available: f64,
    },
    FreeFlight {
        time_s: f64,
        lowest_over_weight: f64,
    },
    TooStocky {
        restitution: f64,
        friction_needed: f64,
        available: f64,
    },
    HistoryEndsEarly {
        model: Model,
        time_s: f64,
        ending: Ending,
    },
    SmallestSteps {
        model: Model,
        steps: usize,
    },
    MembersBeside,
    VerticalLeftOut {
        vertical_g: f64,
        horizontal_g: f64,
        changes: Vec<PeakChange>,
    },
    // what was taken
    Doubt {
        message: String,
        remedy: String,
    },
    DeckMisses {
        message: String,
        remedy: String,
    },
}

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

/// A finding as parameters.json holds it: its quantities, and the words of this version of the program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FiledFinding {
    /// How much it weighs.
    pub weight: Weight,
    /// In one sentence.
    pub message: String,
    /// What to do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
    /// Its name and quantities.
    #[serde(flatten)]
    pub finding: Finding,
}

impl From<Finding> for FiledFinding {
    fn from(finding: Finding) -> Self {
        let (weight, message, remedy) = (finding.weight(), finding.message(), finding.remedy());
        Self { weight, message, remedy, finding }
    }
}

fn on(model: Model) -> &'static str {
    match model {
        Model::Reference => "of the reference",
        Model::Springs => "on the springs",
        Model::Members => "with members",
    }
}

fn s(time: f64) -> String {
    format!("{} s", significant(time, 4))
}

impl Finding {
    /// How much it weighs.
    pub fn weight(&self) -> Weight {
        match self {
            Self::NeverLifts { .. } | Self::Stands { .. } | Self::Overturns { .. } => Weight::Answer,
            Self::ModelsDisagree { .. }
            | Self::NoAnswer { .. }
            | Self::AccuracyMissed { .. }
            | Self::PeaksMissed { .. }
            | Self::HistoryEndsEarly { .. } => Weight::Fault,
            Self::ForetoldUpTo { .. }
            | Self::NearMotions { .. }
            | Self::MembersBeside
            | Self::WithoutVertical { .. } => Weight::Note,
            _ => Weight::Warning,
        }
    }

    /// In one sentence.
    pub fn message(&self) -> String {
        match self {
            Self::NeverLifts { pga_g, uplift_g } => format!(
                "the record does not lift the structure: its peak is {} g, uplift takes {} g",
                significant(*pga_g, 4),
                significant(*uplift_g, 4)
            ),
            Self::Stands { share_of_overturning, .. } => format!(
                "the structure rocks and stands: its largest rotation is {} of overturning",
                percent_3(*share_of_overturning)
            ),
            Self::Overturns { time_s, reference_s } => match reference_s {
                Some(reference) => format!(
                    "the structure overturns at t = {} (in the reference at {}); numbers count up to then",
                    s(*time_s),
                    s(*reference)
                ),
                None => format!("the structure overturns at t = {}; numbers count up to then", s(*time_s)),
            },
            Self::NoAnswer { model, time_s } => {
                format!("the history {} could not be followed beyond t = {}", on(*model), s(*time_s))
            }
            Self::ModelsDisagree { reference, springs } => {
                format!("the models disagree: the reference {reference}, the structure on its springs {springs}")
            }
            Self::PivotLeavesGround { time_s } => {
                format!("the pivot of Housner's body leaves the ground at t = {}, where his solution ends", s(*time_s))
            }
            Self::WithoutVertical { does, share_of_overturning } => format!(
                "without the vertical component it {does}; its largest rotation is {} of overturning",
                percent_3(*share_of_overturning)
            ),
            Self::IllConditioned { moved_by_width, springs_judged, .. } => {
                let judged = if *springs_judged { "; the springs were judged on synthetic motions" } else { "" };
                format!(
                    "this motion is ill-conditioned: 0.1 % of the width moves it by {}, so no model can foretell it{judged}",
                    percent_3(*moved_by_width)
                )
            }
            Self::ForetoldUpTo { time_s, .. } => format!(
                "from t = {} on a change of a millionth grows above a thousandth of the peak: no model foretells it",
                s(*time_s)
            ),
            Self::SlidesOn { time_s, .. } => format!(
                "at t = {} a corner lands so flat that it slides on, by an impulse that depends on friction",
                s(*time_s)
            ),
            Self::NearMotions { motions, change, median_ratio, p90_ratio, overturned } => {
                let cell = |x: Option<f64>| x.map_or("overturned".into(), percent_3);
                let fallen = match overturned {
                    [0, 0] => String::new(),
                    [reference, springs] => format!("; {reference} and {springs} overturn"),
                };
                format!(
                    "over {motions} motions within {} of the record the largest rotation is {} and {} of overturning in \
                     the median, {} and {} for 90 % (rigid ground, springs){fallen}",
                    percent_3(*change),
                    cell(median_ratio[0]),
                    cell(median_ratio[1]),
                    cell(p90_ratio[0]),
                    cell(p90_ratio[1]),
                )
            }
            Self::AccuracyMissed { asked, .. } => {
                format!("the accuracy asked for (history, NRMSE {}) was not reached", significant(*asked, 3))
            }
            Self::PeaksMissed { asked, .. } => {
                format!("the accuracy asked for (peaks within {}) was not reached", percent_3(*asked))
            }
            Self::AccuracyNotMeasured => {
                "the accuracy could not be measured: no motion tried rocks this structure and can be foretold".into()
            }
            Self::RestitutionMissed { asked, lowest, highest, .. } => format!(
                "landings have a restitution of {} to {} where {} is due",
                significant(*lowest, 4),
                significant(*highest, 4),
                significant(*asked, 4)
            ),
            Self::RestitutionOutOfReach { asked, share, least, most } => format!(
                "restitution {} is {} of equation 2's; springs reach {} to {} of it",
                significant(*asked, 4),
                significant(*share, 3),
                significant(*least, 3),
                significant(*most, 3)
            ),
            Self::LandingsUnfinished { finished, all } => {
                format!("{} of {all} test landings came to no end on these springs", all - finished)
            }
            Self::ForceWithheld { force, change } => {
                let by =
                    change.map_or("could not be checked".into(), |change| format!("changes by {}", percent_3(change)));
                format!("{} is withheld: it {by} with the springs or the mesh", force.words())
            }
            Self::Sliding { needed, time_s, available } => {
                let when = time_s.map_or("in a landing".into(), |time| format!("at t = {}", s(time)));
                format!(
                    "the feet would slide: friction of {} is needed {when}, {} is available",
                    significant(*needed, 3),
                    significant(*available, 3)
                )
            }
            Self::FreeFlight { time_s, .. } => {
                format!("free flight: the ground would have to pull the pivot down at t = {}", s(*time_s))
            }
            Self::TooStocky { restitution, friction_needed, .. } => format!(
                "the body is too stocky to land without bouncing: friction of {} is needed, equation 2 gives e = {}",
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
                    "{steps} steps of the history {} were taken at the smallest size, whatever their error",
                    on(*model)
                )
            }
            Self::MembersBeside => {
                "springs are tuned for the structure without its dampers, tendon and friction".into()
            }
            Self::VerticalLeftOut { vertical_g, horizontal_g, changes } => {
                let changed: Vec<String> = changes
                    .iter()
                    .map(|c| {
                        let [with, without] = [c.with, c.without].map(|x| crate::message::quantity(x, &c.unit));
                        format!("{} {with} instead of {without}", c.quantity)
                    })
                    .collect();
                let changed =
                    if changed.is_empty() { String::new() } else { format!("; with it {}", changed.join(", ")) };
                format!(
                    "the record's vertical component of {} g beside {} g is left out{changed}",
                    significant(*vertical_g, 3),
                    significant(*horizontal_g, 3)
                )
            }
            Self::Doubt { message, .. } | Self::DeckMisses { message, .. } => message.clone(),
        }
    }

    /// What to do, if there is anything to do.
    pub fn remedy(&self) -> Option<String> {
        let text = match self {
            Self::Stands { .. } | Self::MembersBeside | Self::NearMotions { .. } | Self::WithoutVertical { .. } => {
                return None;
            }
            Self::NeverLifts { .. } => "give a stronger record, or scale it: --scale",
            Self::Overturns { .. } => "scale the record down for the margin: --scale",
            Self::NoAnswer { .. } | Self::HistoryEndsEarly { ending: Ending::WorkBound, .. } => {
                "take softer or more strongly damped springs: --max-hz"
            }
            Self::ModelsDisagree { .. } => "vary the scale by 1 %, and judge by many records: tune validate",
            Self::PivotLeavesGround { .. } => "compare up to that time only",
            Self::IllConditioned { .. } => "judge by many records: tune validate",
            Self::ForetoldUpTo { softer_hz, .. } | Self::SlidesOn { softer_hz, .. } => {
                let hz = (*softer_hz)?;
                return Some(format!("up to then --max-hz {:.0} is stiff enough, with fewer steps", hz.ceil()));
            }
            Self::AccuracyMissed { capped: true, .. } | Self::PeaksMissed { capped: true, .. } => {
                "raise or drop --max-hz"
            }
            Self::AccuracyMissed { .. } | Self::PeaksMissed { .. } => {
                "ask for less, or judge the springs by many records: tune validate"
            }
            Self::AccuracyNotMeasured => "judge the springs on records of your own: tune validate",
            Self::RestitutionMissed { of_equation_2: true, .. } => "allow stiffer springs: --max-hz",
            Self::RestitutionMissed { .. } | Self::RestitutionOutOfReach { .. } => {
                "ask for a restitution nearer to equation 2's"
            }
            Self::LandingsUnfinished { .. } => "allow other springs: --max-hz, --accuracy",
            Self::ForceWithheld { .. } => "take it from a model of your own, or refine: elements, --accuracy",
            Self::Sliding { .. } => "give a shear key, --friction, or [friction] in the case file",
            Self::FreeFlight { .. } => "compare up to that time only",
            Self::TooStocky { .. } => "check height and width; rely on tests for such a body",
            Self::HistoryEndsEarly { .. } => "take stiffer springs, or rotational_inertia_kgm2 above 0.002 m R^2",
            Self::SmallestSteps { .. } => "compare with OpenSees: tune verify",
            Self::VerticalLeftOut { .. } => "--vertical auto includes it",
            Self::Doubt { remedy, .. } | Self::DeckMisses { remedy, .. } => return Some(remedy.clone()),
        };
        Some(text.into())
    }

    /// What it means, for a report that has the room.
    pub fn meaning(&self) -> Option<&'static str> {
        Some(match self {
            Self::NeverLifts { .. } => {
                "Nothing rocks, so there is no history to compare. The springs follow from the geometry, and their \
                 accuracy was measured on synthetic motions."
            }
            Self::Overturns { .. } => {
                "Peaks, errors and forces count up to the time of overturning only; what follows is a fall."
            }
            Self::ModelsDisagree { .. } => {
                "Near the edge of overturning the smallest change decides; elsewhere the springs are too soft."
            }
            Self::PivotLeavesGround { .. } => {
                "His equation holds while the foot presses on the ground. The finite elements go on, without anything to \
                 compare them with."
            }
            Self::IllConditioned { .. } => {
                "A change far smaller than what is unknown of a real structure makes another history of it. No two models, \
                 and no two tests, agree on it one to one, whatever the springs."
            }
            Self::AccuracyMissed { .. } | Self::PeaksMissed { .. } => {
                "These are the best springs found within what was allowed; the table of accuracy says by how much they miss."
            }
            Self::AccuracyNotMeasured => {
                "No motion that was tried rocks this structure and can be followed one to one."
            }
            Self::RestitutionMissed { .. } | Self::RestitutionOutOfReach { .. } => {
                "A body on soft springs sways before it lifts and loses less; a restitution other than equation 2's is met \
                 by a search, not exactly."
            }
            Self::Sliding { .. } => {
                "Housner's body and the springs hold the feet at any force. A real structure would slide, and rock less."
            }
            Self::FreeFlight { .. } => {
                "Housner's equation would have to pull the foot down there; the finite elements let it go."
            }
            Self::HistoryEndsEarly { .. } | Self::NoAnswer { .. } => "Both models are compared up to there.",
            Self::ForceWithheld { .. } => {
                "A force that grows with the springs or the mesh is the model's, not the structure's."
            }
            _ => return None,
        })
    }
}

fn percent_3(share: f64) -> String {
    percent(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_is_filed_with_its_quantities_and_read_back() {
        let finding = Finding::Sliding { needed: 0.61, time_s: Some(3.25), available: 0.5 };
        let filed = FiledFinding::from(finding.clone());
        let json = serde_json::to_value(&filed).unwrap();
        assert_eq!(json["finding"], "sliding");
        assert_eq!(json["needed"], 0.61);
        assert_eq!(json["weight"], "warning");
        assert_eq!(json["message"], "the feet would slide: friction of 0.61 is needed at t = 3.25 s, 0.5 is available");
        assert_eq!(serde_json::from_value::<FiledFinding>(json).unwrap(), filed);
        assert_eq!(filed.finding, finding);
    }

    #[test]
    fn answers_come_first_and_faults_weigh_most() {
        assert!(Weight::Answer < Weight::Note && Weight::Warning < Weight::Fault);
        let fault = Finding::AccuracyMissed { asked: 0.002, capped: true };
        assert_eq!((fault.weight(), fault.remedy().unwrap().as_str()), (Weight::Fault, "raise or drop --max-hz"));
        assert!(fault.message().contains("NRMSE 0.002"));
    }

    #[test]
    fn what_was_left_out_is_told_with_what_it_would_change() {
        let changes = vec![PeakChange {
            quantity: "moment at column base".into(),
            unit: "N m".into(),
            without: 10.8e6,
            with: 20.9e6,
        }];
        let finding = Finding::VerticalLeftOut { vertical_g: 1.84, horizontal_g: 0.99, changes };
        assert_eq!(
            finding.message(),
            "the record's vertical component of 1.84 g beside 0.99 g is left out; with it moment at column base 20.9 MN m \
             instead of 10.8 MN m"
        );
    }
}
