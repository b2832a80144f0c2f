//! Findings: what a reader of a run must know beside its numbers. Each is data; its words are made
//! here and nowhere else.

use serde::{Deserialize, Serialize};

use dynamics::effort::CutBy;

mod advice;
mod deck_end;
mod filed;
mod message;
mod not_done;
mod of_steps;
mod peak_change;
mod predictable;
mod weight;

pub use deck_end::DeckEnd;
pub use filed::FiledFinding;
pub use frames::design_forces::ForceName;
pub use message::{HARDLY_ROCKS, feet_end};
pub use not_done::NotDone;
pub use of_steps::{NotToBeUsed, ProgramAdvice, ProgramFault};
pub use peak_change::PeakChange;
pub use weight::Weight;

/// Which of the two models.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingModel {
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
    /// On feet with friction, without rocking.
    Slides {
        friction: f64,
        /// What lifts it, over its weight.
        uplift_g: f64,
        largest_m: f64,
        left_m: f64,
    },
    /// The part of the record that is taken ends when the displacement is largest.
    CutAtLargest {
        time_s: f64,
    },
    /// It rocks on feet with friction, and ends elsewhere than it stood.
    LeftAside {
        left_m: f64,
    },
    Stands {
        /// On springs.
        share_of_overturning: f64,
        /// Of the reference, where it can be told.
        #[serde(skip_serializing_if = "Option::is_none")]
        reference_share: Option<f64>,
        over_s: f64,
        /// When its rotation on springs is largest (s), where that is known.
        #[serde(skip_serializing_if = "Option::is_none")]
        largest_at_s: Option<f64>,
        /// Whether it would need more friction than there is.
        #[serde(default)]
        if_feet_hold: bool,
        /// Whether shares are of columns that rock on footings of their own.
        #[serde(default)]
        of_columns: bool,
        /// Whether a tendon holds it: it overturns elsewhere than the share is of.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        tied: bool,
    },
    Overturns {
        time_s: f64,
        reference_s: Option<f64>,
    },
    NoAnswer {
        model: FindingModel,
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
        #[serde(skip_serializing_if = "Option::is_none")]
        moved_by_restitution: Option<f64>,
        /// Up to when no change of 0.1 %, of width, scale or restitution, moves it by a twentieth
        /// of its largest displacement so far (s); none: to its end.
        #[serde(skip_serializing_if = "Option::is_none")]
        holds_to_s: Option<f64>,
        springs_judged: bool,
    },
    ForetoldUpTo {
        time_s: f64,
        softer_hz: Option<f64>,
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        later_forces: Vec<ForceName>,
    },
    SlidesOn {
        time_s: f64,
        softer_hz: Option<f64>,
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        later_forces: Vec<ForceName>,
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
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        another_restitution: bool,
    },
    PeaksMissed {
        asked: f64,
        capped: bool,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        another_restitution: bool,
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
    /// Springs of equation 2's restitution beside springs that bounce for another: which were
    /// chosen, and what both err, in that order.
    SpringsForRestitution {
        asked: f64,
        share: f64,
        equation_2: bool,
        peaks: [Option<f64>; 2],
        nrmse: [Option<f64>; 2],
    },
    LandingsUnfinished {
        finished: usize,
        all: usize,
    },
    // springs for a program with fixed time steps
    /// p dt is beyond what anything is known of; `longest_s` errs by a tenth, by the law of the
    /// floor.
    ProgramStepTooLong {
        step_s: f64,
        longest_s: f64,
        asked: bool,
    },
    /// Histories that the program does not get through.
    ProgramLoses {
        program: String,
        step_s: f64,
        lost: usize,
        histories: usize,
        /// Whether it is SAP2000 or ETABS, which have no integrator that loses fewer.
        #[serde(default)]
        csi: bool,
        asked: bool,
    },
    /// The springs err much on earthquake-like motions, which no step mends; `floor` is what the
    /// step alone makes a history err.
    ProgramErrsOnEarthquakes {
        program: String,
        step_s: f64,
        median: Option<f64>,
        motions: usize,
        floor: f64,
        #[serde(default)]
        asked: bool,
    },
    /// One motion in ten errs much more than the median there: `ninety` is what 90 % are below.
    ProgramSpread {
        program: String,
        step_s: f64,
        median: f64,
        ninety: f64,
        motions: usize,
        earthquakes: bool,
        #[serde(default)]
        asked: bool,
    },
    /// The springs are of no use there.
    ProgramNotToBeUsed {
        program: String,
        step_s: f64,
        fault: ProgramFault,
        advice: ProgramAdvice,
        asked: bool,
    },
    /// The error asked for takes shorter steps, whatever the springs.
    ProgramStepForAccuracy {
        step_s: f64,
        needed_s: f64,
        accuracy: f64,
    },
    /// There are none: of a restitution other than equation 2's.
    ProgramRestitution {
        asked: bool,
    },
    ForceWithheld {
        force: ForceName,
        change: Option<f64>,
        /// Of a rigid body: what Housner's equation gives (N or N m).
        #[serde(skip_serializing_if = "Option::is_none")]
        housner: Option<f64>,
        /// Error of peaks on springs, as a share, where that is so much that they check no force.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        springs_err: Option<f64>,
        /// Of a block, which has no column.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        of_block: bool,
    },
    ForcesHeldInPart {
        over_s: f64,
        changes: Vec<PeakChange>,
    },
    /// Forces below a frequency, without, that are much larger below twice it, with.
    ForcesOfCutoff {
        below_hz: f64,
        changes: Vec<PeakChange>,
    },
    /// Largest forces that the structure bears before it moves, with what they are made of.
    ForcesAtRest {
        forces: Vec<ForceName>,
        /// By a tendon, whose pretension is in them.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        tied: bool,
    },
    /// What was cut, after how many stiffnesses, and the error that was reached of what was asked
    /// for.
    SearchCut {
        by: CutBy,
        not_done: Vec<NotDone>,
        stiffnesses: usize,
        reached: Option<f64>,
        asked: f64,
    },
    /// Histories of the search that met their own bound on steps: they count as not followed.
    HistoriesUnfinished {
        histories: usize,
        left_out: bool,
    },
    /// Motions near the record whose histories met their own bound on steps.
    NearMotionsLeftOut {
        motions: usize,
        /// Whether these are all.
        #[serde(default)]
        all: bool,
    },
    // whether the models hold
    Sliding {
        needed: f64,
        time_s: Option<f64>,
        available: f64,
        /// Force that presses the footing then, over its share of the weight, of an elastic
        /// structure.
        #[serde(skip_serializing_if = "Option::is_none")]
        press_over_weight: Option<f64>,
    },
    FreeFlight {
        time_s: f64,
        lowest_over_weight: f64,
    },
    /// How near a body comes to leaving the ground, if it does not.
    HardlyPresses {
        time_s: f64,
        press_over_weight: f64,
    },
    /// How far the body at rest presses its springs down (m), over the distance between its feet,
    /// and the tilt over alpha that lifts a foot off such springs.
    SinksOnSprings {
        settlement_m: f64,
        share_of_width: f64,
        lifts_at_share: f64,
    },
    /// How far feet on springs walk that Housner's body does not move (m).
    WalksOnSprings {
        largest_m: f64,
        end_m: f64,
    },
    TooStocky {
        restitution: f64,
        friction_needed: f64,
        available: f64,
    },
    HistoryEndsEarly {
        model: FindingModel,
        time_s: f64,
        ending: Ending,
    },
    SmallestSteps {
        model: FindingModel,
        steps: usize,
    },
    MembersBeside {
        /// What Housner's body does without members.
        #[serde(default)]
        without: String,
        /// Up to when that can be foretold (s), if not to its end.
        #[serde(skip_serializing_if = "Option::is_none")]
        without_to_s: Option<f64>,
    },
    /// Feet that landed elsewhere than they stood: the structure stands beside its place, or bent,
    /// held by friction.
    #[serde(alias = "feet_apart")]
    FeetMoved {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        aside_m: Option<f64>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        apart_m: Option<f64>,
        /// When all feet last press (s), of one that still rocks at the end.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rocks_on_from_s: Option<f64>,
        /// Whether the motion can be foretold up to then.
        #[serde(default)]
        predictable: bool,
    },
    VerticalLeftOut {
        vertical_g: f64,
        horizontal_g: f64,
        /// When the structure overturns with it (s).
        #[serde(skip_serializing_if = "Option::is_none")]
        overturns_s: Option<f64>,
        changes: Vec<PeakChange>,
        /// Up to when the motion with it can be predicted (s), if not to its end: what is largest
        /// later is not among the changes.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        predictable_to_s: Option<f64>,
        /// Whether forces are measured to be the structure's, as design forces are.
        #[serde(default)]
        checked: bool,
    },
    // what was taken
    // a filed finding has a message and a remedy already
    Doubt {
        #[serde(rename = "doubt")]
        message: String,
        #[serde(rename = "advice")]
        remedy: String,
    },
    // what `tune verify` judges of the deck
    DeckJudged {
        judged_s: f64,
        record_s: f64,
        end: DeckEnd,
    },
}

#[cfg(test)]
mod tests;
