//! Springs of elastic structures for programs with fixed time steps.
//!
//! ```text
//!   k_e  s (M/n) p/(alpha^2 dt)   vertical, both springs of a unit in series; n bases; s: the stance;
//!                                 M, p, alpha of the rigid body of the same size
//!   K    1/4, or 1/10             units of what lands at a corner (`landing::part`)
//!   k1_h 4 k1_v                   horizontal units, which land as before, only slower
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
//! (`cargo bench --bench elastic_fixed_steps`).
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
use crate::fixed_steps::LONGEST;
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
    standing::Standing,
};
use rocking::{scalar::GRAVITY, structure::Body};

/// Times as long a step as a program's usual one, tried where it loses most motions.
const LONGER: [f64; 3] = [2.0, 4.0, 8.0];
/// K of the units that are tried.
const TRIED: [f64; 2] = [0.25, 0.1];
/// Stances over the recipe's that are tried after it, in this order.
const STIFFER: [f64; 2] = [4.0, 16.0];

/// Springs of elastic structures in programs with fixed time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticFixedStepDesign {
    /// k_e over (M/n) p/(alpha^2 dt).
    pub stance: f64,
    /// k2/k1 of vertical units.
    pub k: f64,
    /// k1 and k2 of horizontal units over those of the vertical ones.
    pub horizontal_over_vertical: f64,
}

impl ElasticFixedStepDesign {
    /// The first that is tried.
    pub const RECIPE: Self =
        Self { stance: FixedStepDesign::RECIPE.stance, k: TRIED[0], horizontal_over_vertical: 4.0 };

    /// Springs for a step (s); `body` is the rigid body of the same size.
    pub fn springs(&self, standing: &Standing, step: f64, body: &Body<f64>) -> CornerSprings {
        let (p, bases) = (body.p_squared().sqrt(), standing.footings.len().max(1) as f64);
        let in_series = self.stance * standing.mass / bases * p / (body.alpha().powi(2) * step);
        let k1 = in_series * (1.0 + self.k) / self.k;
        with_vertical(standing, k1, self.k).with_horizontal(standing, self.horizontal_over_vertical)
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
}

impl ElasticProgramSprings {
    /// Of a structure, measured on its suite; none if it does not stand. Where a step that nobody
    /// gave loses most motions, the first longer one that does not.
    pub(crate) fn measured(
        suite: &ElasticSuite,
        program: FixedStepProgram,
        body: &Body<f64>,
        effort: &Effort,
    ) -> Option<Self> {
        let first = Self::at_step(suite, program, body, effort)?;
        if program.step_is_given || !first.loses_most() {
            return Some(first);
        }
        let longer = |times: f64| {
            let step = times * program.step;
            Self::at_step(suite, FixedStepProgram { step, ..program }, body, effort)
        };
        let mut others = LONGER.into_iter().map_while(longer);
        Some(others.find(|found| found.measured.is_some() && !found.loses_most()).unwrap_or(first))
    }

    /// Whether the program loses half of the motions or more.
    fn loses_most(&self) -> bool {
        self.measured.as_ref().is_some_and(|errors| !errors.quantile(0.5).is_finite())
    }

    fn at_step(
        suite: &ElasticSuite,
        program: FixedStepProgram,
        body: &Body<f64>,
        effort: &Effort,
    ) -> Option<Self> {
        let standing = stand(&suite.model)?;
        let mut design = ElasticFixedStepDesign::RECIPE;
        let mut best = Self::at(&standing, &design, program, body);
        if body.p_squared().sqrt() * program.step > LONGEST {
            return Some(best);
        }
        best.measured = best.errors(suite, effort);
        let errs_less = |design: &ElasticFixedStepDesign, than: &mut Self| {
            if effort.stopped() {
                return false;
            }
            let mut springs = Self::at(&standing, design, program, body);
            springs.measured = springs.errors(suite, effort);
            let less = springs.rank() < than.rank();
            if less {
                *than = springs;
            }
            less
        };
        for k in &TRIED[1..] {
            let other = ElasticFixedStepDesign { k: *k, ..design };
            if errs_less(&other, &mut best) {
                design = other;
            }
        }
        for times in STIFFER {
            let stance = times * ElasticFixedStepDesign::RECIPE.stance;
            if !errs_less(&ElasticFixedStepDesign { stance, ..design }, &mut best) {
                break;
            }
        }
        Some(best)
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
        Self { program, springs, settings, floor, measured: None }
    }

    /// Lost motions, then the median of rotations.
    fn rank(&self) -> (usize, f64) {
        self.measured.as_ref().map_or((0, 0.0), |errors| (errors.lost(), errors.quantile(0.5)))
    }

    fn errors(&self, suite: &ElasticSuite, effort: &Effort) -> Option<ErrorsOverMotions> {
        errors_on(suite, &self.springs, self.settings, effort)
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

/// A history of the structure in a program beside the reference's.
fn stepped(
    model: &Assembled,
    springs: &[Springs<Chain>],
    settings: StepSettings,
    trial: &ElasticTrial,
) -> Option<StepErrors> {
    let frame = FixedStepFrame::new(&model.frame, springs).ok()?;
    let analysis = FixedStepAnalysis::new(&frame, settings, trial.dt, &trial.accel);
    let analysis = FixedStepAnalysis { vertical: &trial.vertical, ..analysis };
    let FixedStepFrameHistory { coordinates, outcome, work } = analysis.history().ok()?;
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
