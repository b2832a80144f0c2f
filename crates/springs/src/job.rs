//! A whole case: the inner design by the case's objective, Omega_n by the accuracy asked for, and
//! the paper's procedure at the same Omega_n beside it.

mod error;
mod landing_design;
mod procedure;
mod restitution;

use std::f64::consts::TAU;

use parallel::join;

use super::{
    SearchProgress,
    fixed_steps::ProgramSprings,
    landing_simulation::differs_from_housner,
    paper_procedure::outer::{self, Benchmark},
    stiffness_search::{Rung, Tuned},
    suite::Suites,
};
pub use error::JobError;
use frequency_response::inner::Fit;
use landing_design::LandingDesign;
use procedure::{Procedure, SearchUpTo};
pub use restitution::{RestitutionChoice, RestitutionErrors};

use cases::{Asked, Case, Objective};
use dynamics::{
    effort::{CutBy, Effort, StopSignal},
    fem::Control,
    spring::{Design, Springs},
};
use results::{Finding, NotDone};
use rocking::{
    housner::{self, Rocking},
    motion::Motion,
    structure::Body,
};
use strong_motion::Record;

/// Units of work that a search may take unless told otherwise: about a minute on two cores.
pub const MOST_WORK: u64 = 100_000_000;
/// Stiffest springs that are tried where no cap is given (Hz).
pub const CEILING_HZ: f64 = 2e5;

/// What the paper's procedure gives: families of the inner fit, and the outer loop over Omega_n on
/// the record.
#[derive(Debug)]
pub struct Paper {
    pub vertical: Vec<Fit>,
    pub horizontal: Vec<Fit>,
    pub tuned: outer::OmegaSearch,
    /// Omega_n that `tuned` was found up to (Hz).
    pub tuned_hz: f64,
    /// Whether the job's springs are of the procedure: followed from `tuned` to the accuracy asked
    /// for where no cap is given.
    pub is_asked: bool,
}

/// A case's springs and all that led to them.
#[derive(Debug)]
pub struct Job {
    pub body: Body<f64>,
    /// The record over the length compared.
    pub record: Record,
    pub rocking: Rocking<f64>,
    /// Housner's motion.
    pub housner: Motion,
    pub springs: Springs<Design<f64>>,
    /// The outer loop; its best rung has the springs.
    pub tuned: Tuned,
    pub suites: Suites,
    /// Whether a cap on Omega_n decided.
    pub capped: bool,
    /// Which springs were chosen for another restitution than equation 2's.
    pub restitution_choice: Option<RestitutionChoice>,
    /// None where the record cannot be tuned on: it does not lift the structure, or Housner's
    /// answer is ill-conditioned.
    pub paper: Option<Paper>,
    /// Springs for a program with fixed time steps; none beside springs that bounce for another
    /// restitution.
    pub program: Option<ProgramSprings>,
    /// What cut the job, if anything was left out of it, and what that is.
    pub cut: Option<CutBy>,
    pub not_done: Vec<NotDone>,
    /// Histories of the search that met their own bound on steps.
    pub unfinished: usize,
}

impl Job {
    /// Tune a case. `progress` gets a count, the planned number (0 if unknown), and the least error
    /// so far.
    ///
    /// # Errors
    /// A record of less than two samples, or of more steps than a history may take; no springs that
    /// settle as little as asked for, or that follow the record to its end; a target, bounds or
    /// mass ratios that cannot be; for the paper's procedure, a record that does not lift the
    /// structure.
    pub fn new(case: &Case, progress: SearchProgress) -> Result<Self, JobError> {
        Self::within(case, &Effort::of(MOST_WORK, StopSignal::default()), progress)
    }

    /// The same within an effort; what that cuts is in `cut`, with the best springs so far.
    ///
    /// # Errors
    /// As above.
    pub fn within(
        case: &Case,
        effort: &Effort,
        progress: SearchProgress,
    ) -> Result<Self, JobError> {
        let record = case.record.truncated(case.duration_s);
        if record.len() < 2 {
            return Err(JobError::TooShort { record: record.name.clone(), samples: record.len() });
        }
        within_reach(&record)?;
        let body = case.structure.body::<f64>();
        let options = housner::RockingOptions::on(&record, case.restitution);
        let rocking = housner::solve(&body, record.dt, &record.accel, &options);
        let housner = rocking.motion(&body);
        let suites = Suites::within(&body, case.restitution, Some(&record), effort);
        let lifted = !rocking.uplifts.is_empty();
        let benchmark = Benchmark {
            body,
            dt: record.dt,
            accel: &record.accel,
            vertical: record.up(),
            housner: &housner,
            effort,
        };
        let procedure = Procedure::new(case, &benchmark)?;

        let found = match case.tuning.objective {
            Objective::Landing => {
                let design =
                    LandingDesign { case, body, suites: &suites, procedure: &procedure, effort };
                SearchedSprings::by_landing(&design, progress)?
            }
            Objective::Arr if !lifted => {
                return Err(JobError::NeverLifts {
                    record: record.name.clone(),
                    pga_g: record.pga_g(),
                    limit_g: body.half_width / body.height,
                });
            }
            Objective::Arr => {
                SearchedSprings::by_paper_procedure(&procedure, &suites, effort, progress)?
            }
        };
        let SearchedSprings { tuned, capped, restitution_choice, paper, program, not_done } = found;
        let is_asked = case.tuning.objective == Objective::Arr;
        let paper = paper.map(|(tuned, tuned_hz)| Paper {
            tuned_hz,
            is_asked,
            vertical: procedure.vertical,
            horizontal: procedure.horizontal,
            tuned,
        });
        let springs = tuned.best.springs;
        let (cut, unfinished) = (effort.cut(), effort.unfinished());
        let found = Self {
            body,
            record,
            rocking,
            housner,
            springs,
            tuned,
            suites,
            capped,
            restitution_choice,
            paper,
            program,
            cut,
            not_done,
            unfinished,
        };
        Ok(found)
    }
}

/// What the search for springs comes to.
struct SearchedSprings {
    tuned: Tuned,
    /// Whether a cap on Omega_n decided.
    capped: bool,
    restitution_choice: Option<RestitutionChoice>,
    paper: Option<SearchUpTo>,
    program: Option<ProgramSprings>,
    not_done: Vec<NotDone>,
}

impl SearchedSprings {
    /// By the design from the geometry, with the paper's procedure at the same Omega_n beside it.
    fn by_landing(design: &LandingDesign, progress: SearchProgress) -> Result<Self, JobError> {
        let &LandingDesign { case, body, suites, procedure, effort } = design;
        // separate budgets: which of the two spends first would depend on the threads
        let rest = effort.share(1);
        let program = |effort: &Effort| ProgramSprings::of_case(case, &body, suites, effort);
        let compared = suites.has_whole_record();
        // a core is free in the paper's refinement; without it, between the stiffnesses tried
        let (found, early) = match compared {
            true => (design.tune(progress), None),
            false => join(|| design.tune(progress), || Some(program(&rest))),
        };
        let (tuned, capped, restitution_choice) = found?;
        let mut not_done = left_out(NotDone::Stiffnesses, effort);
        let hz = tuned.best.springs.vertical.omega_n_hz;
        // on an ill-conditioned record it would tune to noise
        let sampled =
            (compared && !effort.stops()).then(|| procedure.sampled_beside(hz, progress)).flatten();
        let for_program = if effort.stopped() { effort } else { &rest };
        // springs that bounce for another restitution have no like for steps of one size
        let bounces = differs_from_housner(&body, case.restitution)
            && restitution_choice.is_none_or(|choice| !choice.equation_2);
        let (paper, program) = join(
            || sampled.and_then(|sampled| procedure.refined_beside(sampled, progress)),
            || early.unwrap_or_else(|| program(for_program)),
        );
        let paper = paper.map(|found| (found, hz));
        let program = program.filter(|_| !bounces);
        effort.join(&rest);
        if suites.has_whole_record() {
            not_done.extend(left_out(NotDone::PaperProcedure, effort));
        }
        Ok(Self { tuned, capped, restitution_choice, paper, program, not_done })
    }

    /// By the paper's procedure alone.
    fn by_paper_procedure(
        procedure: &Procedure,
        suites: &Suites,
        effort: &Effort,
        progress: SearchProgress,
    ) -> Result<Self, JobError> {
        let (tuned, capped, paper) = procedure.tune(suites, progress)?;
        let body = &procedure.benchmark.body;
        let own = !differs_from_housner(body, procedure.case.restitution);
        let program =
            own.then(|| ProgramSprings::of_case(procedure.case, body, suites, effort)).flatten();
        let not_done = left_out(NotDone::Stiffnesses, effort);
        let restitution_choice = None;
        Ok(Self { tuned, capped, restitution_choice, paper, program, not_done })
    }
}

/// This, if the effort was cut by now.
fn left_out(what: NotDone, effort: &Effort) -> Vec<NotDone> {
    if effort.cut().is_some() { vec![what] } else { Vec::new() }
}

/// A record whose moving ground has more samples than a history may take steps is refused.
fn within_reach(record: &Record) -> Result<(), JobError> {
    let up = record.up();
    let moves = |i: usize| record.accel[i] != 0.0 || up.get(i).is_some_and(|a| *a != 0.0);
    let steps = (1..record.len()).filter(|&i| moves(i) || moves(i - 1)).count();
    let most = Control::default().most_steps;
    if steps <= most {
        Ok(())
    } else {
        Err(JobError::OutOfReach { record: record.name.clone(), steps, most })
    }
}

impl Job {
    /// What of the search was cut or not followed to its end.
    pub fn findings(&self, asked: Asked) -> Vec<Finding> {
        let not_done = self.not_done.clone();
        let reached = self
            .tuned
            .best
            .errors
            .measured(asked.by)
            .then(|| self.tuned.best.errors.over(asked) * asked.error);
        let stiffnesses = if reached.is_some() { self.tuned.rungs.len() } else { 0 };
        let cut = self.cut.filter(|_| !not_done.is_empty());
        let cut = cut.map(|by| Finding::SearchCut {
            by,
            not_done,
            stiffnesses,
            reached,
            asked: asked.error,
        });
        let unfinished = Some(self.unfinished).filter(|histories| *histories > 0);
        let unfinished =
            unfinished.map(|histories| Finding::HistoriesUnfinished { histories, left_out: false });
        cut.into_iter().chain(unfinished).collect()
    }
}

/// Springs that are not the outer loop's, with their errors.
fn evaluate(
    suites: &Suites,
    body: &Body<f64>,
    asked: Asked,
    springs: Springs<Design<f64>>,
    effort: &Effort,
) -> Tuned {
    let found = suites.accuracy(&springs.chains(body.mass), (Control::search(), effort));
    let stiffness = TAU * springs.vertical.omega_n_hz / body.p();
    let best = Rung { stiffness, springs, errors: found };
    Tuned { rungs: vec![best], best, reached: found.over(asked) <= 1.0 }
}
