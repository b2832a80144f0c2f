//! Springs of elastic structures for programs with fixed time steps.
//!
//! ```text
//!   k_e  s (M/n) p/(alpha^2 dt)   vertical, both springs of a unit in series; n bases; s: the stance;
//!                                 M, p, alpha of the rigid body of the same size
//!   K    1/4, or 1/10             units of what lands at a corner (`landing::part`)
//!   k1_h 4 k1_v, or less          horizontal units, which land as before, only slower
//! ```
//!
//! **Stance.** The recipe's 12 (`fixed_steps::recipe`) is tried first. A structure on low footings
//! sways on such springs before it lifts: four and sixteen times as much are tried, too, as long as
//! they err less.
//!
//! **Horizontal springs.** A footing that lands stops across at once, and the force that stops it
//! turns it. Horizontal springs as stiff as those of steps that follow touches, some 60 times the
//! vertical ones, turn it so far within a step that a corner which presses lifts, while one that is
//! open goes into the ground: the step has no end, in whatever iteration. Of springs four times as
//! stiff as the vertical ones few steps are such, and they err no more
//! (`cargo bench --bench elastic_fixed_steps`). Stiffer stances lose motions with them; with
//! horizontal springs as soft as the first vertical ones they lose hardly any, and are tried, too.
//! Where motions are lost all the same, or the program gives up on the record, softer springs are
//! tried: across, then upwards, too.
//!
//! Which K and stance are better depends on what lands, the step and the integrator: springs are
//! stepped as the program does, on the motions that the structure's other springs are judged on and
//! on the record, and those are kept that lose fewer of them, then those that err less.

use super::{
    design::{CornerSprings, with_vertical},
    stand,
    suite::ElasticSuite,
    trial::ElasticTrial,
};
use crate::fixed_steps::{
    LONGEST,
    instead::{ProgramInstead, USELESS, instead},
};
use dynamics::{
    effort::Effort,
    spring::{Chain, Springs},
};
use fixed_steps::{
    FixedStepAnalysis, FixedStepFrame, FixedStepFrameHistory, FixedStepOutcome, FixedStepProgram,
    StepSettings,
    expected::FLOOR,
    measured::{ErrorsOverMotions, StepErrors},
    recipe::FixedStepDesign,
};
use frames::{
    assembled::{Assembled, errors},
    peaks::StructurePeaks,
    reference::GroundAcceleration,
    standing::Standing,
};
use rocking::{scalar::GRAVITY, structure::Body};

/// Times as long a step as a program's usual one, tried where it loses most motions.
const LONGER: [f64; 3] = [2.0, 4.0, 8.0];
/// K of the units that are tried.
const TRIED: [f64; 2] = [0.25, 0.1];
/// Stances of vertical and horizontal units that are tried after the recipe's, in this order, each
/// row as long as springs err less.
const STIFFER: [[[f64; 2]; 2]; 2] =
    [[[48.0, 192.0], [192.0, 768.0]], [[48.0, 12.0], [192.0, 12.0]]];
/// Those that are tried while something is lost.
const SOFTER: [[f64; 2]; 4] = [[12.0, 12.0], [12.0, 3.0], [3.0, 3.0], [3.0, 0.75]];

/// Springs of elastic structures in programs with fixed time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticFixedStepDesign {
    /// k_e over (M/n) p/(alpha^2 dt), of vertical units.
    pub stance: f64,
    /// k2/k1 of vertical units.
    pub k: f64,
    /// The stance at which vertical units would have the k1 of the horizontal ones.
    pub horizontal_stance: f64,
}

impl ElasticFixedStepDesign {
    /// The first that is tried.
    pub const RECIPE: Self = Self {
        stance: FixedStepDesign::RECIPE.stance,
        k: TRIED[0],
        horizontal_stance: 4.0 * FixedStepDesign::RECIPE.stance,
    };

    /// Springs for a step (s); `body` is the rigid body of the same size.
    pub fn springs(&self, standing: &Standing, step: f64, body: &Body<f64>) -> CornerSprings {
        let (p, bases) = (body.p_squared().sqrt(), standing.footings.len().max(1) as f64);
        let in_series = self.stance * standing.mass / bases * p / (body.alpha().powi(2) * step);
        let k1 = in_series * (1.0 + self.k) / self.k;
        let over_vertical = self.horizontal_stance / self.stance;
        with_vertical(standing, k1, self.k).with_horizontal(standing, over_vertical)
    }
}

/// Springs for a structure in a program, and what they err.
#[derive(Clone, Debug)]
pub struct ElasticProgramSprings {
    /// The program.
    pub program: FixedStepProgram,
    /// Under every corner.
    pub springs: CornerSprings,
    /// How the program is to step.
    pub settings: StepSettings,
    /// 13 p dt of the rigid body of the same size.
    pub floor: f64,
    /// Measured on the suite's motions and the record, as far as these can be foretold: of
    /// rotations, and of the displacement, drift or uplift that errs most. None of a step too long
    /// to promise anything, or if there is nothing to measure on.
    pub measured: Option<ErrorsOverMotions>,
    /// Whether the program does not get through the record, in its whole length.
    record_lost: bool,
    /// Other settings, measured where these were asked for and are of no use.
    pub instead: Option<ProgramInstead>,
}

impl ElasticProgramSprings {
    /// Of a structure, measured on its suite; the whole record only has to be got through. None if
    /// it does not stand. Where a step that nobody gave loses most motions, the first longer one
    /// that does not.
    pub(crate) fn measured(
        suite: &ElasticSuite,
        record: Option<GroundAcceleration>,
        program: FixedStepProgram,
        body: &Body<f64>,
        effort: &Effort,
    ) -> Option<Self> {
        let at_step = |program| Self::at_step(suite, record, program, body, effort);
        let first = at_step(program)?;
        let longer = |times: f64| {
            let step = times * program.step;
            at_step(FixedStepProgram { step, ..program })
        };
        let mut others = LONGER.into_iter().map_while(longer);
        let found = match program.step_is_given || !first.loses_most() {
            true => first,
            false => others
                .find(|found| found.measured.is_some() && !found.loses_most())
                .unwrap_or(first),
        };
        let asked = program != FixedStepProgram::usual() && !effort.stopped();
        Some(if asked { found.with_instead(suite, body, at_step, effort) } else { found })
    }

    /// Of settings that a user asked for: with others that are measured where these are of no use.
    fn with_instead(
        self,
        suite: &ElasticSuite,
        body: &Body<f64>,
        at: impl Fn(FixedStepProgram) -> Option<Self>,
        effort: &Effort,
    ) -> Self {
        let (median, of_use) = self.peaks(suite);
        if of_use {
            return self;
        }
        let measure = |other| {
            let other = at(other)?;
            (!effort.stopped()).then(|| other.peaks(suite))
        };
        // on softer springs, which go with longer steps, more motions come through
        let lost = self.loses_most() || median <= USELESS;
        let instead = instead(self.program, body.p_squared().sqrt(), (median, lost), measure);
        Self { instead, ..self }
    }

    /// The median of peaks, infinite where nothing was measured; whether they are of use, on the
    /// record, too.
    fn peaks(&self, suite: &ElasticSuite) -> (f64, bool) {
        let median = self.measured.as_ref().map_or(f64::INFINITY, |e| e.peak_quantile(0.5));
        let of_record = |trial| stepped(&suite.model, &self.springs.corners, self.settings, trial);
        let record = suite.record.as_ref().and_then(of_record).map_or(0.0, |errors| errors.peak);
        (median, median.max(record) <= USELESS && !self.record_lost)
    }

    /// Whether the program loses half of the motions or more.
    fn loses_most(&self) -> bool {
        self.measured.as_ref().is_some_and(|errors| !errors.quantile(0.5).is_finite())
    }

    fn at_step(
        suite: &ElasticSuite,
        record: Option<GroundAcceleration>,
        program: FixedStepProgram,
        body: &Body<f64>,
        effort: &Effort,
    ) -> Option<Self> {
        let standing = stand(&suite.model)?;
        let mut best = Self::at(&standing, &ElasticFixedStepDesign::RECIPE, program, body);
        if body.p_squared().sqrt() * program.step > LONGEST {
            return Some(best);
        }
        best.measure(suite, record, effort);
        let errs_less = |other: ElasticFixedStepDesign, (best, design): &mut (Self, _)| {
            if effort.stopped() {
                return false;
            }
            let mut springs = Self::at(&standing, &other, program, body);
            springs.measure(suite, record, effort);
            let less = springs.rank() < best.rank();
            if less {
                (*best, *design) = (springs, other);
            }
            less
        };
        let mut found = (best, ElasticFixedStepDesign::RECIPE);
        for k in &TRIED[1..] {
            errs_less(ElasticFixedStepDesign { k: *k, ..found.1 }, &mut found);
        }
        for row in STIFFER {
            for [stance, horizontal_stance] in row {
                let other = ElasticFixedStepDesign { stance, horizontal_stance, ..found.1 };
                if !errs_less(other, &mut found) {
                    break;
                }
            }
        }
        for [stance, horizontal_stance] in SOFTER {
            for k in TRIED {
                if found.0.rank().0 > 0 {
                    let other = ElasticFixedStepDesign { stance, k, horizontal_stance };
                    errs_less(other, &mut found);
                }
            }
        }
        Some(found.0)
    }

    fn at(
        standing: &Standing,
        design: &ElasticFixedStepDesign,
        program: FixedStepProgram,
        body: &Body<f64>,
    ) -> Self {
        let springs = design.springs(standing, program.step, body);
        let uplift = standing.uplift().unwrap_or(GRAVITY * body.alpha().tan());
        let settings = program.settings(standing.mass * uplift);
        let floor = FLOOR * body.p_squared().sqrt() * program.step;
        let (measured, record_lost, instead) = (None, false, None);
        Self { program, springs, settings, floor, measured, record_lost, instead }
    }

    /// Step the springs on the suite's motions, and on the whole record to see that the program
    /// gets through, unless that is one of these.
    fn measure(
        &mut self,
        suite: &ElasticSuite,
        record: Option<GroundAcceleration>,
        effort: &Effort,
    ) {
        self.measured = errors_on(suite, &self.springs, self.settings, effort);
        let corners = &self.springs.corners;
        let of_suite = suite.record.as_ref().map_or(0, |trial| trial.accel.len());
        let record = record.filter(|ground| ground.accel.len() > of_suite);
        let whole = record.and_then(|ground| history(&suite.model, corners, self.settings, ground));
        self.record_lost = whole.is_some_and(|history| match history.outcome {
            FixedStepOutcome::Finished => false,
            FixedStepOutcome::GaveUp(_) => true,
            // of a record that is no trial the structure may fall on rigid ground, too
            FixedStepOutcome::Fallen { .. } => suite.record.is_some(),
        });
    }

    /// Histories that are lost, then the median of rotations; springs that were not measured come
    /// last.
    fn rank(&self) -> (usize, f64) {
        self.measured.as_ref().map_or((usize::MAX, f64::INFINITY), |errors| {
            (errors.lost() + usize::from(self.record_lost), errors.quantile(0.5))
        })
    }
}

/// What springs err in a program on a suite's motions and its record; none if there are no motions
/// or the work is stopped from outside.
pub fn errors_on(
    suite: &ElasticSuite,
    springs: &CornerSprings,
    settings: StepSettings,
    effort: &Effort,
) -> Option<ErrorsOverMotions> {
    let shaken = |trial: &&ElasticTrial| trial.lean.is_none();
    let trials: Vec<&ElasticTrial> =
        suite.motions.iter().chain(&suite.record).filter(shaken).collect();
    let one = |trial: &&ElasticTrial| {
        if effort.stopped() {
            return None;
        }
        stepped(&suite.model, &springs.corners, settings, trial)
    };
    let all: Vec<StepErrors> = parallel::map(&trials, one).into_iter().flatten().collect();
    (!all.is_empty()).then(|| ErrorsOverMotions::of(all))
}

/// Springs for the substeps at touches of a structure whose springs for the program are at K, the
/// substep in s; none if the structure does not stand.
pub fn for_substep(model: &Assembled, k: f64, substep: f64) -> Option<CornerSprings> {
    let design = ElasticFixedStepDesign { k, ..ElasticFixedStepDesign::RECIPE };
    Some(design.springs(&stand(model)?, substep, &model.structure.body()))
}

/// A history of the structure in a program; none if it does not stand.
fn history(
    model: &Assembled,
    springs: &[Springs<Chain>],
    settings: StepSettings,
    GroundAcceleration { dt, accel, vertical }: GroundAcceleration,
) -> Option<FixedStepFrameHistory> {
    let frame = FixedStepFrame::new(&model.frame, springs).ok()?;
    let analysis = FixedStepAnalysis::new(&frame, settings, dt, accel);
    FixedStepAnalysis { vertical, ..analysis }.history().ok()
}

/// A history of the structure in a program beside the reference's.
fn stepped(
    model: &Assembled,
    springs: &[Springs<Chain>],
    settings: StepSettings,
    trial: &ElasticTrial,
) -> Option<StepErrors> {
    let ground =
        GroundAcceleration { dt: trial.dt, accel: &trial.accel, vertical: &trial.vertical };
    let FixedStepFrameHistory { coordinates, outcome, work } =
        history(model, springs, settings, ground)?;
    let lost = StepErrors { outcome, history: f64::INFINITY, peak: f64::INFINITY, work };
    if outcome != FixedStepOutcome::Finished {
        return Some(lost);
    }
    let sways = model.sways(coordinates.iter().map(Vec::as_slice));
    let [rotations, _] = errors(&trial.reference, &sways, trial.accel.len());
    let peak = StructurePeaks::of(model, coordinates.iter().map(Vec::as_slice))
        .beside(&trial.peaks)
        .largest();
    Some(StepErrors { history: rotations, peak, ..lost })
}
