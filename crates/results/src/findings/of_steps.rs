//! Springs for a program with steps of one size: what is wrong with them, and what to do.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Finding;
use files::message::{percent, quantity, signed_percent, significant};

/// What is wrong with springs that are of no use in a program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProgramFault {
    /// It does not get through half of its motions.
    Lost {
        /// Motions that it does not get through.
        lost: usize,
        /// All motions.
        motions: usize,
    },
    /// The largest displacement errs by too much in the median.
    Peaks {
        /// That error, relative.
        median: f64,
        /// Of so many motions.
        motions: usize,
        /// Whether they are like earthquakes.
        earthquakes: bool,
    },
    /// The largest top displacement on the run's record does, which can be predicted.
    OnRecord {
        /// That error, relative, with its sign.
        top: f64,
        /// Up to when it can be (s), if not to the record's end.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until_s: Option<f64>,
    },
    /// Steps too long for anything to be measured.
    TooLong {
        /// Error of a history that the step alone makes, by 13 p dt.
        floor: f64,
    },
}

/// What to do about springs that are of no use in a program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProgramAdvice {
    /// A shorter step: by the law of the floor, 13 p dt, it errs by less than a tenth.
    Step {
        /// That step (s): 1, 2 or 5 times a power of ten.
        step_s: f64,
    },
    /// Another step, measured in the run.
    MeasuredStep {
        /// That step (s).
        step_s: f64,
        /// What peaks err by there, in the median of motions.
        median: f64,
    },
    /// The program's usual integrator, measured in the run.
    MeasuredIntegrator {
        /// Whether OpenSees has to be named for it.
        give_for: bool,
        /// What peaks err by with it, in the median of motions.
        median: f64,
    },
    /// No other settings that were measured are of use.
    NoneHelps {
        /// The shortest step of these (s).
        shortest_s: f64,
    },
    /// The error is not the step's: no shorter one can be promised to help.
    OffLaw {
        /// It over 13 p dt.
        times: f64,
    },
    /// The integrator that the program is to be set to.
    DefaultIntegrator,
    /// The same of a program without a name whose integrator OpenSees has.
    ForOpenSees,
    /// No law tells which step.
    AnotherStep,
    /// Another deck, for none has such steps.
    OtherDeck,
}

/// Why springs are not to be used in a program, and what to do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NotToBeUsed {
    /// What is wrong.
    pub fault: ProgramFault,
    /// What to do.
    pub advice: ProgramAdvice,
}

impl fmt::Display for ProgramFault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Lost { lost, motions } => write!(f, "fails on {lost} of {motions} motions"),
            Self::Peaks { median, motions, earthquakes } => {
                let like = if *earthquakes { "earthquake-like " } else { "" };
                let median = percent(*median);
                write!(f, "peaks err by {median} in the median of {motions} {like}motions")
            }
            Self::OnRecord { top, until_s } => {
                let to = until_s.map(|until| format!(" to {} s", significant(until, 3)));
                let (to, errs) = (to.unwrap_or_default(), signed_percent(*top));
                write!(f, "this record's top displacement{to} errs by {errs}")
            }
            Self::TooLong { floor } => write!(
                f,
                "such steps are too long to be measured, a history errs by {} or more",
                significant(*floor, 2)
            ),
        }
    }
}

impl fmt::Display for ProgramAdvice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Step { step_s } => {
                write!(f, "give --step {step_s} or less (by the law of the step, not measured)")
            }
            Self::DefaultIntegrator => {
                write!(f, "take the default integrator (leave --integrator out)")
            }
            Self::MeasuredStep { step_s, median } => {
                write!(
                    f,
                    "give --step {step_s}: peaks err by {} there (measured)",
                    percent(*median)
                )
            }
            Self::MeasuredIntegrator { give_for, median } => {
                let what = match give_for {
                    true => "give --for opensees-even",
                    false => "take the default integrator (leave --integrator out)",
                };
                write!(f, "{what}: peaks err by {} with it (measured)", percent(*median))
            }
            Self::NoneHelps { shortest_s } => write!(
                f,
                "other settings, to steps of {}, do not help (measured): take OpenSees' deck, \
                    whose steps follow touches",
                quantity(*shortest_s, "s")
            ),
            Self::OffLaw { times } => write!(
                f,
                "this is {times:.0} times the error of the step alone, so a shorter step may not \
                    help: take OpenSees' deck, whose steps follow touches"
            ),
            Self::ForOpenSees => {
                write!(f, "give --for opensees-even, whose integrator loses least")
            }
            Self::AnotherStep => write!(f, "try another --step, also a longer one"),
            Self::OtherDeck => write!(f, "take OpenSees' deck: no other has its dampers or tendon"),
        }
    }
}

impl fmt::Display for NotToBeUsed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "NOT to be used: {}; {}", self.fault, self.advice)
    }
}

impl Finding {
    /// Springs for a program with fixed time steps.
    pub(super) fn program(&self) -> Option<String> {
        Some(match self {
            Self::ProgramStepTooLong { step_s, .. } => format!(
                "steps of {} are too long for this structure: nothing is promised of its springs \
                    for them",
                quantity(*step_s, "s")
            ),
            Self::ProgramLoses { program, step_s, lost, histories, .. } => format!(
                "on the springs for steps of {} {program} loses {lost} of {histories} histories",
                quantity(*step_s, "s")
            ),
            Self::ProgramNotToBeUsed { program, step_s, fault, .. } => format!(
                "the springs for steps of {} in {program} are not to be used: {fault}",
                quantity(*step_s, "s")
            ),
            Self::ProgramErrsOnEarthquakes { program, step_s, median, motions, floor, .. } => {
                let errs = match median {
                    Some(median) => format!("errs by {} (median peak)", percent(*median)),
                    None => "loses most histories".into(),
                };
                format!(
                    "{program} at {} {errs} on {motions} earthquake-like motions; the step alone \
                        makes a history err by {}",
                    quantity(*step_s, "s"),
                    percent(*floor)
                )
            }
            Self::ProgramSpread {
                program, step_s, median, ninety, motions, earthquakes, ..
            } => {
                let like = if *earthquakes { "earthquake-like " } else { "" };
                format!(
                    "in {program} at {} peaks err by more than {} on one {like}motion in ten \
                        (median {}, of {motions})",
                    quantity(*step_s, "s"),
                    percent(*ninety),
                    percent(*median)
                )
            }
            Self::ProgramStepForAccuracy { step_s, needed_s, accuracy } => format!(
                "a history within {} (NRMSE) needs steps of {}: with steps of {} no springs reach \
                    it",
                significant(*accuracy, 3),
                quantity(*needed_s, "s"),
                quantity(*step_s, "s")
            ),
            Self::ProgramRestitution { .. } => {
                "no springs for fixed time steps: they exist only for equation 2's restitution"
                    .into()
            }
            _ => return None,
        })
    }

    /// Of springs for steps of one size.
    pub(super) fn remedy_of_steps(&self) -> Option<String> {
        let text = match self {
            Self::ProgramStepTooLong { longest_s, .. } => {
                return Some(ProgramAdvice::Step { step_s: *longest_s }.to_string());
            }
            Self::ProgramErrsOnEarthquakes { .. } | Self::ProgramSpread { .. } => {
                "take a shorter step, or OpenSees' deck"
            }
            Self::ProgramNotToBeUsed { advice, .. } => return Some(advice.to_string()),
            Self::ProgramLoses { csi: true, .. } => {
                "check that the history runs to its end; else try another --step, also a longer one"
            }
            Self::ProgramLoses { .. } => {
                "check that the history runs to its end; else try another --step"
            }
            Self::ProgramStepForAccuracy { .. } => {
                "take such steps, or substeps at touches: tune export --stepping"
            }
            Self::ProgramRestitution { .. } => {
                "leave the restitution out, or follow touches: OpenSees' deck"
            }
            _ => return None,
        };
        Some(text.into())
    }
}
