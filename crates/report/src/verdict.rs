//! What a run was asked, in one sentence.

use crate::{FiledParameters, HOUSNER, Run, predictable_to, sentence};
use files::message::{quantity, significant};
use results::{DeckEnd, Finding, FindingModel, PeakPair, Weight, feet_end};
use validation::verdict::{Fate, Verdict};

/// Share of the largest displacement below which that of a part tells nothing.
const HARDLY: f64 = 0.02;

/// Whether one model overturns and the other stands.
fn differ_on_overturning(verdict: Verdict) -> bool {
    let fell = |fate| match fate {
        Fate::Overturned => Some(true),
        Fate::Rocked | Fate::NeverLifted => Some(false),
        Fate::LeftGround | Fate::Failed => None,
    };
    let both = [verdict.housner.fate, verdict.finite_elements.fate].map(fell);
    both == [Some(true), Some(false)] || both == [Some(false), Some(true)]
}

/// Whether motions near the record, or the two models, differ on an elastic structure's
/// overturning.
fn chance_of_elastic<'a>(findings: impl Iterator<Item = &'a Finding> + Clone) -> bool {
    let fell = findings.clone().find_map(|finding| match finding {
        Finding::Overturns { .. } => Some(true),
        Finding::Stands { .. } | Finding::NeverLifts { .. } => Some(false),
        _ => None,
    });
    findings.into_iter().any(|finding| match finding {
        Finding::ModelsDisagree { .. } => true,
        Finding::NearMotions { motions, overturned: [reference, springs], .. } => {
            fell.is_some_and(|fell| reference + springs != if fell { 2 * motions } else { 0 })
        }
        _ => false,
    })
}

impl Run {
    /// What the run was asked, in one sentence.
    pub fn verdict(&self) -> String {
        self.in_a_sentence(&self.foretold())
    }

    /// The same before a run has found how far the motion can be foretold: of that nothing.
    pub fn preliminary_verdict(&self) -> String {
        self.in_a_sentence("")
    }

    /// Whether changes smaller than anybody knows a structure by decide on its overturning: of 1 %
    /// of width, scale or restitution, of an elastic structure of the record; or both models differ
    /// on it. Of a rigid body with members that is not looked for.
    pub fn by_chance(&self) -> bool {
        match &self.parameters {
            FiledParameters::Rigid(_) if self.has_members() => false,
            FiledParameters::Rigid(parameters) => {
                let overturning = parameters.conditioning.and_then(|row| row.overturning_changes);
                overturning == Some(true) || parameters.verdict.is_some_and(differ_on_overturning)
            }
            FiledParameters::Elastic(_) => {
                chance_of_elastic(self.findings.iter().map(|filed| &filed.finding))
            }
        }
    }

    fn in_a_sentence(&self, foretold: &str) -> String {
        let answer = self.findings.iter().find(|finding| finding.weight == Weight::Answer);
        let graver =
            self.findings.iter().find(|f| matches!(f.finding, Finding::ModelsDisagree { .. }));
        let gravest = answer.filter(|_| self.has_members()).or(graver).or(answer);
        let Some(told) = gravest else {
            return match self.taken.record {
                Some(_) => "Nothing rocks, as far as it could be followed.".into(),
                None => "Springs without a record: nothing rocked.".into(),
            };
        };
        if let Some(without) = self.without_members() {
            let with = match self.members_words() {
                "with members" => "with its members",
                with => with,
            };
            return sentence(&format!(
                "{with} {}{}{}{}{without}",
                told.message,
                self.left_aside(),
                self.not_computed(),
                foretold
            ));
        }
        sentence(&format!("{}{}{}{}", told.message, self.not_computed(), self.feet_end(), foretold))
    }

    /// What the answer of a rigid body with members is with: friction goes alone.
    pub(crate) fn members_words(&self) -> &'static str {
        match &self.parameters {
            FiledParameters::Rigid(parameters) if parameters.members().friction.is_some() => {
                "with friction"
            }
            _ => "with members",
        }
    }

    /// What Housner's body does without the members that the structure has.
    fn without_members(&self) -> Option<String> {
        self.findings.iter().find_map(|filed| match &filed.finding {
            Finding::MembersBeside { without, without_to_s } => {
                let held = match self.members_words() {
                    "with friction" => "without sliding",
                    _ => "without members",
                };
                let until = without_to_s.map_or(String::new(), |time| {
                    format!(" (predictable to {} s)", significant(time, 4))
                });
                Some(format!("; {held}, Housner's body {without}{until}"))
            }
            _ => None,
        })
    }

    /// Up to when the motion of Housner's body can be foretold (s), where it has no members and the
    /// structure has.
    pub(crate) fn without_to(&self) -> Option<f64> {
        self.findings.iter().find_map(|filed| match filed.finding {
            Finding::MembersBeside { without_to_s, .. } => without_to_s,
            _ => None,
        })
    }

    /// How far from where it stood a body that rocks and slides comes to rest.
    fn left_aside(&self) -> String {
        let left = self.findings.iter().find_map(|filed| match filed.finding {
            Finding::LeftAside { left_m } => Some(left_m),
            _ => None,
        });
        let words =
            |left| format!("; it also slides and ends {} from where it stood", quantity(left, "m"));
        left.map_or(String::new(), words)
    }

    /// Where the feet end, if not where they began.
    fn feet_end(&self) -> String {
        let ends = self.findings.iter().find_map(|filed| feet_end(&filed.finding));
        ends.map_or(String::new(), |ends| format!("; {ends}"))
    }

    /// Whether, and up to when, a motion can be foretold; nothing where nothing rocks or stands.
    fn foretold(&self) -> String {
        let any = |of: fn(&Finding) -> bool| self.findings.iter().any(|filed| of(&filed.finding));
        let s = |time: f64| significant(time, 4);
        let ends = self.findings.iter().find_map(|filed| match filed.finding {
            Finding::PivotLeavesGround { time_s } => Some(time_s),
            _ => None,
        });
        let alone =
            ends.map_or(String::new(), |time| format!("; after {} s by springs alone", s(time)));
        let end = self.findings.iter().find_map(|filed| match filed.finding {
            Finding::Overturns { time_s, .. } => Some(time_s),
            _ => None,
        });
        if let Some(until) =
            self.predictable_to().filter(|until| end.is_none_or(|end| *until < end))
        {
            return format!("; predictable to {} s{}{alone}", s(until), self.until_then(until));
        }
        let in_part = any(|f| match f {
            Finding::DeckJudged { end, .. } => *end != DeckEnd::Record,
            Finding::IllConditioned { holds_to_s, .. } => holds_to_s.is_some(),
            _ => matches!(
                f,
                Finding::ModelsDisagree { .. }
                    | Finding::HistoryEndsEarly { .. }
                    | Finding::NoAnswer { .. }
            ),
        });
        let stands = any(|f| matches!(f, Finding::Stands { .. }));
        // a small change moves it, though nowhere by much
        let peaks_alone = any(|f| matches!(f, Finding::IllConditioned { holds_to_s: None, .. }));
        match stands && !in_part && alone.is_empty() {
            true if peaks_alone => "; its peaks are predictable".into(),
            true => "; predictable".into(),
            false => alone,
        }
    }

    /// Of a motion that can be foretold up to a time (s): its top's displacement up to then, where
    /// it is larger later; whether the largest rotation comes later.
    fn until_then(&self, until: f64) -> String {
        let later = self.findings.iter().any(|filed| match filed.finding {
            Finding::Stands { largest_at_s, .. } => largest_at_s.is_some_and(|time| time > until),
            _ => false,
        });
        let later = if later { "; the largest rotation is not" } else { "" };
        let top = |pair: PeakPair| {
            let part = pair.foretold?;
            Some(match pair.with_members {
                Some(with) => (part.with_members_top_m?, with.top_displacement_m),
                None => (part.top_displacement_m[0], pair.reference.top_displacement_m),
            })
        };
        let then = self.peaks.and_then(top).filter(|(part, all)| part < all);
        let then = then.map_or(String::new(), |(top, largest)| match top < HARDLY * largest {
            // a change that hardly shows in the whole may be all of it
            true => " (it hardly moves until then)".into(),
            false => format!(" (top {})", quantity(top, "m")),
        });
        format!("{then}{later}")
    }

    /// Up to when a motion can be foretold (s), if that is not all of it.
    pub(crate) fn predictable_to(&self) -> Option<f64> {
        predictable_to(&self.findings)
    }

    /// What of the answer is missing, because a history ended before its record.
    fn not_computed(&self) -> String {
        let ended = self.findings.iter().filter_map(|filed| match filed.finding {
            Finding::HistoryEndsEarly { model, time_s, .. } => Some((model, time_s)),
            _ => None,
        });
        let words = |(model, time_s): (FindingModel, f64)| {
            let of = match model {
                FindingModel::Reference if self.reference == HOUSNER => "by Housner's equation",
                FindingModel::Reference => "on rigid ground",
                FindingModel::Springs => "on springs",
                FindingModel::Members => self.members_words(),
            };
            format!("; NOT computed {of} after {} s", significant(time_s, 4))
        };
        ended.map(words).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One motion of 24 near the record that does otherwise is enough.
    #[test]
    fn chance_decides_where_a_motion_near_the_record_does_otherwise() {
        let falls = Finding::Overturns { time_s: 3.0, reference_s: Some(3.0) };
        let stays = Finding::NeverLifts { pga_g: 0.1, uplift_g: 0.2 };
        let near = |overturned| Finding::NearMotions {
            motions: 24,
            change: 0.01,
            median_ratio: [None; 2],
            p90_ratio: [None; 2],
            overturned,
        };
        let chance = |all: &[Finding]| chance_of_elastic(all.iter());
        assert!(!chance(&[falls.clone(), near([24, 24])]));
        assert!(chance(&[falls.clone(), near([24, 23])]));
        assert!(!chance(&[stays.clone(), near([0, 0])]));
        assert!(chance(&[stays.clone(), near([1, 0])]));
        let [reference, springs] = ["stands", "overturns at t = 3.00 s"].map(String::from);
        assert!(chance(&[stays, Finding::ModelsDisagree { reference, springs }]));
        assert!(!chance(&[falls]));
    }
}
