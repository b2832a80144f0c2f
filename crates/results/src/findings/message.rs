//! The words of findings.

mod feet;
mod forces;
mod regime;
mod taken;

pub use feet::feet_end;
pub(super) use regime::USUAL_FRICTION;

use super::{Finding, FindingModel, ForceName, PeakChange};
use dynamics::effort::CutBy;
use files::message::{percent, quantity, significant};

fn on(model: FindingModel) -> &'static str {
    match model {
        FindingModel::Reference => "of the reference",
        FindingModel::Springs => "on the springs",
        FindingModel::Members => "with members",
    }
}

/// Part by which largest rotations on springs and without differ, both of which are then said.
const SHARES_DIFFER: f64 = 0.05;

/// Share of overturning below which a body that lifts hardly rocks.
pub const HARDLY_ROCKS: f64 = 1e-4;

/// What is said of such a one.
const HARDLY: &str = "the structure lifts but hardly rocks";

fn s(time: f64) -> String {
    format!("{} s", significant(time, 4))
}

/// Names of forces in a sentence.
fn listed(forces: &[ForceName]) -> String {
    joined(&forces.iter().map(|force| force.words().to_string()).collect::<Vec<_>>())
}

/// Words in a sentence: one, two and three.
fn joined(words: &[String]) -> String {
    match words {
        [all @ .., one, last] => [all, &[format!("{one} and {last}")]].concat().join(", "),
        few => few.concat(),
    }
}

/// Design forces whose largest value comes after what can be predicted.
fn later(forces: &[ForceName]) -> String {
    match forces.len() {
        0 => String::new(),
        1 => format!("{} comes after what can be predicted: ", listed(forces)),
        _ => format!("{} come after what can be predicted: ", listed(forces)),
    }
}

/// That a structure overturns, and what is to be added about that.
fn overturns(time_s: f64, reference_s: Option<f64>, added: &str) -> String {
    let reference = reference_s.map(|time| format!(" (in the reference at {})", s(time)));
    let reference = reference.unwrap_or_default();
    format!(
        "the structure overturns at t = {}{reference}{added}; numbers count up to then",
        s(time_s)
    )
}

impl Finding {
    /// The words for an overturning that comes later than a motion can be predicted, `until` (s).
    pub fn by_chance(&self, until: f64) -> Option<String> {
        match *self {
            Self::Overturns { time_s, reference_s } if until < time_s => {
                let added = ", not predictable: a motion hardly different may leave it standing";
                Some(overturns(time_s, reference_s, added))
            }
            _ => None,
        }
    }

    /// In one sentence.
    pub(crate) fn message(&self) -> String {
        let words = [
            Self::slip,
            Self::outcome,
            Self::comparison,
            Self::springs,
            Self::forces,
            Self::program,
            Self::effort,
            Self::feet,
            Self::regime,
            Self::taken,
        ];
        words.iter().find_map(|words| words(self)).unwrap_or_default()
    }

    /// How it slides, and that it goes on.
    fn slip(&self) -> Option<String> {
        Some(match self {
            Self::Slides { friction, uplift_g, largest_m, left_m } => format!(
                "the structure slides and does not rock: uplift takes {} g, but friction of {} \
                    gives way first; it slides by {} at most and ends {} from where it stood",
                significant(*uplift_g, 3),
                significant(*friction, 3),
                quantity(*largest_m, "m"),
                quantity(*left_m, "m")
            ),
            Self::CutAtLargest { time_s } => format!(
                "the part of the record used ends at {}, just when the displacement is largest",
                s(*time_s)
            ),
            Self::LeftAside { left_m } => {
                format!(
                    "the structure also slides and ends {} from where it stood",
                    quantity(*left_m, "m")
                )
            }
            _ => return None,
        })
    }

    /// What the structure does.
    fn outcome(&self) -> Option<String> {
        Some(match self {
            Self::NeverLifts { pga_g, uplift_g } => {
                let short = if pga_g > uplift_g { " for longer than its peaks last" } else { "" };
                format!(
                    "the record does not lift the structure: its peak is {} g, uplift takes {} \
                        g{short}",
                    significant(*pga_g, 4),
                    significant(*uplift_g, 4)
                )
            }
            Self::Stands {
                share_of_overturning,
                reference_share,
                largest_at_s,
                if_feet_hold,
                of_columns,
                tied,
                ..
            } => {
                let of = if *tied { "overturning without its tendon" } else { "overturning" };
                let differs = |reference: &f64| {
                    (reference - share_of_overturning).abs()
                        > SHARES_DIFFER * share_of_overturning.max(*reference)
                };
                let found = percent(*share_of_overturning);
                let largest = match reference_share.filter(differs) {
                    Some(reference) => format!(
                        "{} of overturning without springs, {found} on springs",
                        percent(reference)
                    ),
                    None => format!("{found} of {of}"),
                };
                if *share_of_overturning < HARDLY_ROCKS {
                    return Some(format!("{HARDLY}: largest rotation {found} of {of}"));
                }
                format!(
                    "it rocks and stands{}: largest rotation {}{}{}",
                    if *if_feet_hold { ", if its feet hold" } else { "" },
                    if *of_columns { "of columns " } else { "" },
                    largest,
                    largest_at_s.map_or(String::new(), |time| format!(", at {}", s(time)))
                )
            }
            Self::Overturns { time_s, reference_s } => overturns(*time_s, *reference_s, ""),
            Self::NoAnswer { model, time_s } => {
                format!(
                    "the history {} could not be followed beyond t = {}",
                    on(*model),
                    s(*time_s)
                )
            }
            Self::ModelsDisagree { reference, springs } => {
                format!(
                    "the models disagree: the reference {reference}, the structure on its springs \
                        {springs}"
                )
            }
            Self::PivotLeavesGround { time_s } => {
                format!("Housner's pivot leaves the ground at {} and his solution ends", s(*time_s))
            }
            Self::WithoutVertical { does, share_of_overturning } => {
                let largest = match *share_of_overturning {
                    share if share < 1.0 => {
                        format!("; its largest rotation is {} of overturning", percent(share))
                    }
                    _ => String::new(),
                };
                format!("without the vertical component it {does}{largest}")
            }
            _ => return None,
        })
    }

    /// What a comparison one to one is worth.
    fn comparison(&self) -> Option<String> {
        Some(match self {
            // up to when it can be predicted the verdict tells, on what springs were judged the
            // accuracy
            Self::IllConditioned {
                moved_by_width,
                moved_by_scale,
                moved_by_restitution,
                holds_to_s,
                ..
            } => {
                let by = [
                    ("width", *moved_by_width),
                    ("scale", *moved_by_scale),
                    ("restitution", moved_by_restitution.unwrap_or(0.0)),
                ];
                let (what, most) = by
                    .into_iter()
                    .fold(by[0], |most, other| if other.1 > most.1 { other } else { most });
                let nowhere = match holds_to_s {
                    Some(_) => "",
                    None => {
                        " (NRMSE), but at no time by more than 5 % of its largest displacement: \
                        peaks are predictable, the history itself is not"
                    }
                };
                let most = significant(100.0 * most, 2);
                format!(
                    "ill-conditioned: a change of the {what} by 0.1 % moves the history by \
                        {most} %{nowhere}"
                )
            }
            Self::ForetoldUpTo { time_s, later_forces, .. } => format!(
                "{}after t = {} a small change of the motion has grown more than 30-fold",
                later(later_forces),
                s(*time_s)
            ),
            Self::SlidesOn { time_s, later_forces, .. } => format!(
                "{}a corner slides as it lands at t = {}: how far depends on friction",
                later(later_forces),
                s(*time_s)
            ),
            Self::NearMotions { motions, change, median_ratio, p90_ratio, overturned } => {
                let cell = |x: Option<f64>| {
                    let of_overturning = |x| format!("{} of overturning", percent(x));
                    x.map_or("an overturning".into(), of_overturning)
                };
                let fallen = match overturned {
                    [0, 0] => String::new(),
                    [reference, springs] => {
                        format!("; {reference} overturn on rigid ground, {springs} on springs")
                    }
                };
                format!(
                    "in {motions} motions within {} of the record the largest rotation is {} \
                        (median), {} (90 %); on springs {}, {}{fallen}",
                    percent(*change),
                    cell(median_ratio[0]),
                    cell(p90_ratio[0]),
                    cell(median_ratio[1]),
                    cell(p90_ratio[1]),
                )
            }
            _ => return None,
        })
    }

    /// What the springs do not reach.
    fn springs(&self) -> Option<String> {
        Some(match self {
            Self::AccuracyMissed { asked, .. } => {
                format!(
                    "the accuracy asked for (history, NRMSE {}) was not reached",
                    significant(*asked, 3)
                )
            }
            Self::PeaksMissed { asked, .. } => {
                format!("the accuracy asked for (peaks within {}) was not reached", percent(*asked))
            }
            Self::AccuracyNotMeasured => {
                "the accuracy could not be measured: no motion tried rocks this structure and can \
                    be predicted"
                    .into()
            }
            Self::RestitutionMissed { asked, lowest, highest, .. } => {
                let due = significant(*asked, 4);
                let [low, high] = [lowest, highest].map(|x| significant(*x, 4));
                match (lowest + highest).is_finite() {
                    true => {
                        format!("landings have a restitution of {low} to {high} instead of {due}")
                    }
                    false => format!("no test landing has the required restitution, {due}"),
                }
            }
            Self::RestitutionOutOfReach { asked, share, least, most } => format!(
                "restitution {} is {} times equation 2's; springs were tested only from {} to {} \
                    times",
                significant(*asked, 4),
                significant(*share, 3),
                significant(*least, 3),
                significant(*most, 3)
            ),
            Self::SpringsForRestitution { asked, share, equation_2, peaks, nrmse } => {
                let err = |i: usize| {
                    let peaks = peaks[i].map_or("unknown".into(), percent);
                    let nrmse = nrmse[i].map_or("unknown".into(), |x| significant(x, 2));
                    format!("peaks {peaks}, NRMSE {nrmse}")
                };
                let names = ["equation 2's springs", "springs that bounce for it"];
                let [chosen, other] = if *equation_2 { [0, 1] } else { [1, 0] };
                format!(
                    "restitution {} is {} times equation 2's: {} ({}) have a smaller product of \
                        both errors than {} ({})",
                    significant(*asked, 4),
                    significant(*share, 4),
                    names[chosen],
                    err(chosen),
                    names[other],
                    err(other)
                )
            }
            Self::LandingsUnfinished { finished, all } => {
                format!("{} of {all} test landings did not finish on these springs", all - finished)
            }
            Self::MembersBeside { .. } => {
                "springs are tuned for the structure without its dampers, tendon and friction"
                    .into()
            }
            _ => return None,
        })
    }

    /// What the search did not do.
    fn effort(&self) -> Option<String> {
        Some(match self {
            Self::SearchCut { by, not_done, stiffnesses, reached, asked } => {
                let by = match by {
                    CutBy::Work => "the bound on work",
                    CutBy::TimeLimit => "the time limit",
                    CutBy::Interrupt => "^C",
                };
                let missing: Vec<&str> = not_done.iter().map(|what| what.words()).collect();
                let reached = match reached {
                    Some(error) => format!(
                        " after {stiffnesses} stiffness{}: error {}, asked {}",
                        if *stiffnesses == 1 { "" } else { "es" },
                        significant(*error, 3),
                        significant(*asked, 3)
                    ),
                    None => ", no error was measured".into(),
                };
                format!("{by} ended the search{reached}; not done: {}", missing.join(", "))
            }
            Self::HistoriesUnfinished { histories, left_out } => {
                let of = if *histories == 1 { "history" } else { "histories" };
                let then =
                    if *left_out { "their motions are left out" } else { "they count as lost" };
                format!("{histories} {of} of the search reached the bound on steps: {then}")
            }
            Self::NearMotionsLeftOut { all: true, .. } => {
                "motions near the record are left out: they need more steps than allowed".into()
            }
            Self::NearMotionsLeftOut { motions, .. } => {
                format!(
                    "{motions} motions near the record reached the bound on steps and are left out"
                )
            }
            _ => return None,
        })
    }
}
