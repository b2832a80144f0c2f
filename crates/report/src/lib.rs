//! A run as data, and what is made of it: one renderer each for the terminal, Markdown, HTML and
//! JSON (serde).
//!
//! | from | to |
//! |---|---|
//! | `rigid::RigidRun`, `elastic::ElasticRun`: histories and springs | [`Run`]: what is said of them |
//! | [`Run`] | `screen` (at most 30 lines), `markdown`, `page` (HTML), serde (JSON) |
//!
//! No renderer knows whether the structure is rigid, and none reads another's words.

#![warn(missing_docs)]

pub mod accuracy;
pub mod displacements;
pub mod elastic;
pub mod html;
pub mod judged;
pub mod markdown;
pub mod page;
pub mod program;
pub mod reference;
pub mod rigid;
pub mod screen;
pub mod stiffness_tradeoff;
pub mod table;
mod verdict;

use dynamics::spring::Chain;
use rocking::structure::Kind;
use serde::Serialize;

pub use accuracy::{AccuracyOn, AccuracyReport};
use cases::{
    assumptions::{AssumedQuantity, Assumption},
    doubts::Doubt,
};
pub use displacements::{peak_table, summary};
pub use markdown::{force_value, forces_to_design_with, height};
use parameters::{Parameters, corner::UnitRow, elastic::ElasticParameters};
pub use program::ProgramReport;
pub use results::predictable_to;
use results::{
    DesignForce, DesignForces, FiledFinding, Finding, ForceName, PeakChange, PeakPair, Peaks,
    Weight,
};
use strong_motion::Record;
pub use table::Table;

/// A value the user did not give, and the key that sets it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assumed {
    /// What, with its value: "restitution 0.98 by equation 2".
    pub what: String,
    /// The key or option that sets it.
    pub key: String,
}

impl Assumed {
    /// What was assumed, but for what the line of the record tells.
    fn all(assumptions: &[Assumption]) -> Vec<Self> {
        let told = |a: &&Assumption| a.quantity != AssumedQuantity::ElCentro;
        let one = |assumption: &Assumption| {
            let [what, key] = assumption.told();
            Self { what, key: key.trim_start_matches("structure.").to_string() }
        };
        assumptions.iter().filter(told).map(one).collect()
    }
}

/// Doubts as findings; of a vertical component that is left out a finding of its own tells what it
/// would change.
fn doubts(all: Vec<Doubt>) -> impl Iterator<Item = Finding> {
    let those = all.into_iter().filter(|doubt| doubt.vertical_left_out().is_none());
    those.map(|doubt| Finding::Doubt { message: doubt.message(), remedy: doubt.remedy() })
}

/// Names of a rigid body's forces.
fn force_words(kind: Kind) -> fn(ForceName) -> &'static str {
    match kind {
        Kind::Block => ForceName::words_of_block,
        Kind::AFrame => ForceName::words,
    }
}

/// What changes from one run to another: top displacement and the design forces that both give.
fn changes(
    words: fn(ForceName) -> &'static str,
    (peaks, forces): (Option<PeakPair>, Option<DesignForces>),
    (with_peaks, with_forces): (PeakPair, DesignForces),
    until: Option<f64>,
) -> Vec<PeakChange> {
    // what is largest after the motion can be predicted is one of many values
    let told = |time: Option<f64>| until.is_none_or(|until| time.is_some_and(|t| t <= until));
    let change = |quantity: &str, unit: &str, without: f64, with: f64| PeakChange {
        quantity: quantity.into(),
        unit: unit.into(),
        without,
        with,
    };
    // with members, theirs; else the reference's, which springs may follow badly, unless it ends
    // before the record
    let whole = peaks.iter().chain([&with_peaks]).all(|pair| pair.reference_ends_s.is_none());
    let answer = |pair: &PeakPair| {
        let without = if whole { pair.reference } else { pair.springs };
        pair.with_members.unwrap_or(without)
    };
    let top = |pair: &PeakPair| answer(pair).top_displacement_m;
    let at = answer(&with_peaks).times.map(|times| times.top_displacement_s);
    let given = peaks.filter(|_| told(at));
    let top = given.map(|peaks| change("top displacement", "m", top(&peaks), top(&with_peaks)));
    let with: Vec<_> = with_forces.all().collect();
    let forces = forces.into_iter().flat_map(|forces| forces.all().collect::<Vec<_>>()).filter_map(
        |(name, force)| {
            let (_, other) = with.iter().find(|(other, _)| *other == name)?;
            told(Some(other.time_s)).then_some(())?;
            Some(change(words(name), name.unit(), force.value?.abs(), other.value?.abs()))
        },
    );
    top.into_iter().chain(forces).collect()
}

/// That the part of a record that is taken ends when the displacement is largest.
fn cut_at_largest(peaks: &Peaks, whole: &Record, taken: &Record) -> Option<Finding> {
    let (time_s, dt) = (taken.duration(), taken.dt);
    let is_cut = time_s + 0.5 * dt < whole.duration();
    let at_end = peaks.times?.top_displacement_s + 0.5 * dt > time_s;
    (is_cut && at_end).then_some(Finding::CutAtLargest { time_s })
}

/// The case as it was understood.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Taken {
    /// The structure in a few words.
    pub structure: String,
    /// More of it: names and values with units.
    pub facts: Vec<(String, String)>,
    /// The record, its scale, length, step and peak; none of springs without a record.
    pub record: Option<String>,
    /// The same in a shorter line, for a screen.
    #[serde(skip)]
    pub(crate) short_record: Option<String>,
    /// Whether a vertical motion is taken: then what lifts is more, or less.
    #[serde(skip)]
    pub(crate) vertical: bool,
    /// What was not given.
    pub assumed: Vec<Assumed>,
}

impl Taken {
    /// A structure without a record.
    pub fn new(structure: String, facts: Vec<(String, String)>) -> Self {
        Self { structure, facts, ..Self::default() }
    }
}

/// A spring-absorber unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unit {
    /// Which: "vertical", or with its place where places differ.
    pub name: String,
    /// Its numbers.
    #[serde(flatten)]
    pub row: UnitRow,
}

/// When a structure first lifts (s), as a fact.
pub(crate) fn first_lift(time: f64) -> (String, String) {
    ("first lifts at".into(), format!("{} s", files::message::significant(time, 4)))
}

impl Unit {
    /// Of a name.
    pub fn new(name: &str, chain: &Chain) -> Self {
        Self { name: name.into(), row: chain.into() }
    }
}

/// Part of a report: text, a table, commands.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Section {
    /// Its id in the page (anchor).
    pub id: &'static str,
    /// Its heading.
    pub title: String,
    /// Paragraphs above the table.
    pub text: Vec<String>,
    /// Its table.
    pub table: Option<Table>,
    /// Paragraphs below it.
    pub notes: Vec<String>,
    /// Commands to type.
    pub commands: Vec<String>,
}

/// parameters.json.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum FiledParameters {
    /// Of a rigid body.
    Rigid(Box<Parameters>),
    /// Of an elastic structure.
    Elastic(Box<ElasticParameters>),
}

/// Everything that is said of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    /// The case.
    pub taken: Taken,
    /// What the springs are compared with: "Housner", "rigid ground".
    pub reference: &'static str,
    /// Largest displacements; none without a record.
    pub peaks: Option<PeakPair>,
    /// Friction coefficient that the reference needs.
    pub friction_needed: Option<f64>,
    /// Whether a rigid body's landings need it, more than the motion between them.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub friction_in_landings: bool,
    /// Forces to design with; none without a record.
    pub design_forces: Option<DesignForces>,
    /// "each foot", "each corner".
    pub springs_at: &'static str,
    /// The units.
    pub springs: Vec<Unit>,
    /// Those for a program with fixed time steps.
    pub program: Option<ProgramReport>,
    /// Measured in this run.
    pub accuracy: Option<AccuracyReport>,
    /// The answer first, then by weight.
    pub findings: Vec<FiledFinding>,
    /// Whether there is a deck for SAP2000.
    pub sap2000: bool,
    /// What the report has besides.
    pub sections: Vec<Section>,
    /// What parameters.json holds.
    pub parameters: FiledParameters,
}

/// The reference of rigid bodies.
pub(crate) const HOUSNER: &str = "Housner";
/// What an elastic structure lifts at, in tables.
pub(crate) const STEADY: &str = "lifts at a steady ground acceleration of";

/// Findings for a run: answers first, then what weighs most.
pub fn filed(findings: impl IntoIterator<Item = Finding>) -> Vec<FiledFinding> {
    filed_as(FiledFinding::from, findings)
}

/// The same of an elastic structure.
pub fn filed_of_elastic(findings: impl IntoIterator<Item = Finding>) -> Vec<FiledFinding> {
    filed_as(|finding| FiledFinding::from(finding).of_elastic(), findings)
}

fn filed_as(
    file: fn(Finding) -> FiledFinding,
    findings: impl IntoIterator<Item = Finding>,
) -> Vec<FiledFinding> {
    let mut all: Vec<Finding> = findings.into_iter().collect();
    // of forces that a search which was cut has not checked its own finding tells
    let cut = all.iter().any(|finding| matches!(finding, Finding::SearchCut { .. }));
    all.retain(|f| !(cut && matches!(f, Finding::ForceWithheld { change: None, .. })));
    let slides = all.iter().any(|finding| matches!(finding, Finding::Sliding { .. }));
    for finding in &mut all {
        if let Finding::Stands { if_feet_hold, .. } = finding {
            *if_feet_hold |= slides;
        }
    }
    let mut all: Vec<FiledFinding> = all.into_iter().map(file).collect();
    if let Some(until) = predictable_to(&all) {
        for filed in &mut all {
            let Some(message) = filed.finding.by_chance(until) else { continue };
            (filed.message, filed.remedy) =
                (message, Some("judge by many: tune init sweep".into()));
        }
    }
    design_by_near_motions(&mut all);
    let rank = |weight: Weight| match weight {
        Weight::Answer => 0,
        Weight::Fault => 1,
        Weight::Warning => 2,
        Weight::Note => 3,
    };
    all.sort_by_key(|finding| rank(finding.weight));
    all
}

/// Motions near the record that rotate a structure by so much more than it does, for one in ten of
/// them, are not left to a note.
const NEAR_ROTATE_MORE: f64 = 1.25;

/// A warning of motions near the record that do much more than it.
fn design_by_near_motions(all: &mut [FiledFinding]) {
    let own = all.iter().find_map(|filed| match filed.finding {
        Finding::Stands { reference_share, share_of_overturning, .. } => {
            Some(reference_share.unwrap_or(share_of_overturning))
        }
        _ => None,
    });
    let Some(own) = own else { return };
    for filed in all {
        let Finding::NearMotions { p90_ratio: [ninety, _], .. } = filed.finding else { continue };
        if ninety.is_none_or(|ninety| ninety > NEAR_ROTATE_MORE * own) {
            filed.weight = Weight::Warning;
            filed.remedy = Some("design by these, or by several records".into());
        }
    }
}

impl Run {
    /// Names of forces: a block has no column.
    pub(crate) fn force_words(&self) -> fn(ForceName) -> &'static str {
        match &self.parameters {
            FiledParameters::Rigid(parameters) => force_words(parameters.structure.kind),
            FiledParameters::Elastic(_) => ForceName::words,
        }
    }

    /// Whether the largest rotation, or an overturning, is one of many that the record might as
    /// well have made.
    pub(crate) fn one_of_many(&self) -> bool {
        let holds_to = self.findings.iter().find_map(|filed| match filed.finding {
            Finding::IllConditioned { holds_to_s, .. } => holds_to_s,
            _ => None,
        });
        let late = |holds_to: f64| {
            self.findings.iter().any(|filed| match filed.finding {
                Finding::Stands { largest_at_s, .. } => largest_at_s.is_none_or(|t| t > holds_to),
                Finding::Overturns { time_s, .. } => time_s > holds_to,
                _ => false,
            })
        };
        holds_to.is_some_and(late)
    }

    /// Whether some design forces are those of one motion of many that the record might as well
    /// have made: then they are no forces to design with alone.
    pub fn asks_for_many_motions(&self) -> bool {
        self.design_forces.is_some() && (self.one_of_many() || self.has_doubted_forces())
    }

    /// Whether some design force is given, though the motion cannot be foretold up to it.
    pub(crate) fn has_doubted_forces(&self) -> bool {
        self.design_forces.iter().any(|forces| forces.all().any(|(_, force)| Self::doubts(&force)))
    }

    /// Whether a force is given, though the motion cannot be foretold up to it.
    pub(crate) fn doubts(of: &DesignForce) -> bool {
        of.holds && !Self::foretells(of)
    }

    /// Whether the motion can be foretold up to a force's largest value.
    pub(crate) fn foretells(of: &DesignForce) -> bool {
        of.predictable != Some(false)
    }

    /// Whether its answer is that of a rigid body with members: what Housner's body does stands
    /// beside.
    pub(crate) fn has_members(&self) -> bool {
        self.findings.iter().any(|f| matches!(f.finding, Finding::MembersBeside { .. }))
    }

    /// All that is to be said besides the verdict, gravest first.
    pub(crate) fn remarks(&self) -> impl Iterator<Item = &FiledFinding> {
        let told =
            self.findings.iter().position(|f| matches!(f.finding, Finding::ModelsDisagree { .. }));
        self.findings
            .iter()
            .enumerate()
            .filter(move |(i, finding)| match told {
                Some(told) if !self.has_members() => *i != told && finding.weight != Weight::Answer,
                _ => finding.weight != Weight::Answer,
            })
            .map(|(_, finding)| finding)
    }
}

/// With a capital letter and a full stop; a key stays as it is written.
pub fn sentence(message: &str) -> String {
    if message.split(' ').next().is_some_and(|word| word.contains('_')) {
        return format!("{}.", message.trim_end_matches('.'));
    }
    let mut letters = message.chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>()).unwrap_or_default();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}
