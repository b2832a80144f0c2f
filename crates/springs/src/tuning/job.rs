//! A whole case: the inner design by the case's objective, Omega_n by the accuracy asked for, and
//! the paper's procedure at the same Omega_n beside it.

mod error;
mod procedure;

use std::{cmp::Ordering, f64::consts::TAU};

use super::{
    at_once, capped_springs,
    fixed_steps::ProgramSprings,
    landing::design::{Geometry, springs_at_stiffness},
    landing_simulation,
    paper_procedure::{
        inner::Fit,
        outer::{self, Benchmark, Bracket},
    },
    stiffness_search::{self, Rung, Tuned},
    suite::Suites,
};
pub use error::JobError;
use procedure::Procedure;

use crate::{
    case::{Asked, Case, Objective, Yardstick},
    results::{Finding, NotDone},
};
use dynamics::{
    effort::{CutBy, Effort, StopSignal},
    fem::Control,
    spring::{Design, Springs},
};
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
/// Omega_n of springs that are to have another restitution than equation 2's, where no cap is given
/// (Hz): they must bounce, and gravity bring them back.
const BOUNCING_HZ: f64 = 160.0;
/// Ratio of typical errors up to which springs within a cap are alike on some twenty motions: more
/// motions decide.
const ALIKE: f64 = 1.25;

/// What the paper's procedure gives: families of the inner fit, and the outer loop over Omega_n on
/// the record.
#[derive(Debug)]
pub struct Paper {
    pub vertical: Vec<Fit>,
    pub horizontal: Vec<Fit>,
    pub tuned: outer::OmegaSearch,
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
    /// None where the record cannot be tuned on: it does not lift the structure, or Housner's
    /// answer is ill-conditioned.
    pub paper: Option<Paper>,
    /// Springs for a program with fixed time steps; none for a restitution that such springs have
    /// not.
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
    /// No springs that settle as little as asked for; for the paper's procedure, a record that does
    /// not lift the structure.
    pub fn new(
        case: &Case,
        progress: &(dyn Fn(usize, usize, f64) + Sync),
    ) -> Result<Self, JobError> {
        Self::within(case, &Effort::of(MOST_WORK, StopSignal::default()), progress)
    }

    /// The same within an effort; what that cuts is in `cut`, with the best springs so far.
    ///
    /// # Errors
    /// As above.
    pub fn within(
        case: &Case,
        effort: &Effort,
        progress: &(dyn Fn(usize, usize, f64) + Sync),
    ) -> Result<Self, JobError> {
        let record = case.record.truncated(case.duration_s);
        if record.len() < 2 {
            return Err(JobError::TooShort { record: record.name.clone(), samples: record.len() });
        }
        within_reach(&record)?;
        let body = case.structure.body::<f64>();
        let options = housner::RockingOptions {
            restitution: Some(case.restitution),
            vertical: record.vertical_accel(),
            ..Default::default()
        };
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

        let mut not_done = Vec::new();
        let mut left_out = |what: NotDone| {
            if effort.cut().is_some() {
                not_done.push(what);
            }
        };
        let (tuned, capped, paper) = match case.tuning.objective {
            Objective::Landing => {
                let design =
                    LandingDesign { case, body, suites: &suites, procedure: &procedure, effort };
                let (tuned, capped) = design.tune(progress)?;
                left_out(NotDone::Stiffnesses);
                let hz = tuned.best.springs.vertical.omega_n_hz;
                // on an ill-conditioned record it would tune to noise
                let beside = suites.has_whole_record() && !effort.stops();
                let paper = if beside { procedure.beside(hz, progress) } else { None };
                if suites.has_whole_record() {
                    left_out(NotDone::PaperProcedure);
                }
                (tuned, capped, paper)
            }
            Objective::Arr if !lifted => {
                return Err(JobError::NeverLifts {
                    record: record.name.clone(),
                    pga_g: record.pga_g(),
                    limit_g: body.half_width / body.height,
                });
            }
            Objective::Arr => {
                let found = procedure.tune(&suites, progress)?;
                left_out(NotDone::Stiffnesses);
                found
            }
        };
        let paper = paper.map(|tuned| Paper {
            vertical: procedure.vertical,
            horizontal: procedure.horizontal,
            tuned,
        });
        let springs = tuned.best.springs;
        let program = ProgramSprings::of_case(case, &body, &suites, effort);
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
            paper,
            program,
            cut,
            not_done,
            unfinished,
        };
        Ok(found)
    }
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

/// The design from the geometry, and Omega_n.
struct LandingDesign<'a> {
    case: &'a Case,
    body: Body<f64>,
    suites: &'a Suites,
    procedure: &'a Procedure<'a>,
    effort: &'a Effort,
}

impl LandingDesign<'_> {
    /// The outer loop, and whether a cap decided.
    fn tune(
        &self,
        progress: &(dyn Fn(usize, usize, f64) + Sync),
    ) -> Result<(Tuned, bool), JobError> {
        let tuning = &self.case.tuning;
        let asked = tuning.asked();
        if landing_simulation::differs_from_housner(&self.body, self.case.restitution) {
            let hz = tuning.max_omega_hz.unwrap_or(BOUNCING_HZ);
            let bracket = self.bracket(hz)?;
            let springs = capped_springs::with_restitution(
                &self.body,
                self.case.restitution,
                bracket,
                self.effort,
                progress,
            );
            let springs = springs.ok_or(JobError::NoCandidate)?;
            return Ok((
                evaluate(self.suites, &self.body, asked, springs, self.effort),
                tuning.max_omega_hz.is_some(),
            ));
        }
        let p = self.body.p_squared().sqrt();
        let springs = |stiffness: f64| springs_at_stiffness(&self.body, stiffness);
        let said = |rungs: usize, over: f64| {
            progress(rungs, 0, over * stiffness_search::MARGIN * asked.error)
        };
        // the ladder up to an Omega_n/p, from where landings hold; if none of those rungs does, the
        // better of that and of the whole ladder
        let ladder = |stiffest: f64, springs: &dyn Fn(f64) -> Option<Springs<Design<f64>>>| {
            let from = |softest: f64| {
                let range = (softest, stiffest);
                stiffness_search::tune(
                    self.suites,
                    self.body.mass,
                    asked,
                    (range, self.effort),
                    springs,
                    &said,
                )
            };
            let soft = self.settling(stiffness_search::SOFTEST, stiffest);
            let landings_hold =
                at_once::softest(&self.body, asked, stiffness_search::last_rung(stiffest))
                    .max(soft);
            let tuned = from(landings_hold);
            let done = landings_hold == soft || tuned.as_ref().is_some_and(|tuned| tuned.reached);
            if done || tuned.is_some() && self.effort.stops() {
                return tuned;
            }
            let over = |tuned: &Tuned| (!tuned.reached, tuned.best.errors.over(asked));
            tuned
                .into_iter()
                .chain(from(soft))
                .min_by(|a, b| over(a).partial_cmp(&over(b)).unwrap_or(Ordering::Equal))
        };
        let Some(cap) = tuning.max_omega_hz else {
            let stiffest = stiffness_search::last_rung(TAU * CEILING_HZ / p);
            self.settles_at(stiffest)?;
            return ladder(stiffest, &springs)
                .map(|tuned| (tuned, false))
                .ok_or(JobError::NoCandidate);
        };
        // a cap holds for the stiffest of the springs: those beyond it are clipped, or all are as
        // much softer
        let highest = TAU * cap / p;
        let clipped = |stiffness: f64| {
            springs(stiffness).map(|mut springs| {
                springs.horizontal.omega_n_hz = springs.horizontal.omega_n_hz.min(cap);
                springs
            })
        };
        let in_limit = |stiffness| {
            Geometry::of(&self.body, stiffness).is_ok_and(|geometry| geometry.in_stiff_limit())
        };
        let mut found: Vec<Tuned> = ladder(highest, &clipped).into_iter().collect();
        if found.iter().all(|tuned| !tuned.reached) && (found.is_empty() || !self.effort.stops()) {
            let softer = self.within(cap, highest).filter(|stiffness| in_limit(*stiffness));
            found.extend(softer.and_then(|stiffness| ladder(stiffness, &springs)));
        }
        found.retain(|tuned| self.settles(tuned));
        if let Some(tuned) = found.iter().find(|tuned| tuned.reached) {
            return Ok((tuned.clone(), false));
        }
        if found.is_empty() || !in_limit(highest) && !self.effort.stops() {
            found.push(self.followed(cap, progress)?);
        }
        let typical = |tuned: &Tuned| typical(tuned, asked.by);
        let best = found.into_iter().min_by(|a, b| typical(a).total_cmp(&typical(b)));
        Ok((best.ok_or(JobError::NoCandidate)?, true))
    }

    /// The stiffest rung up to `highest` whose horizontal springs are below the cap (Hz), too;
    /// `None` if clipping does nothing, or none is.
    fn within(&self, cap: f64, highest: f64) -> Option<f64> {
        let hz = |stiffness| {
            springs_at_stiffness(&self.body, stiffness).map(|springs| springs.horizontal.omega_n_hz)
        };
        let last = stiffness_search::last_rung(highest);
        let mut stiffness = last;
        while hz(stiffness)? > cap {
            stiffness = stiffness_search::last_rung(0.99 * stiffness);
            if stiffness < stiffness_search::SOFTEST {
                return None;
            }
        }
        (stiffness < last).then_some(stiffness)
    }

    /// The least Omega_n/p from `softest` on at which the body settles by no more than is allowed;
    /// `stiffest` if there is none.
    fn settling(&self, softest: f64, stiffest: f64) -> f64 {
        let mut stiffness = softest;
        while stiffness < stiffest && self.settlement(stiffness) > self.case.tuning.max_settlement_m
        {
            stiffness = (1.1 * stiffness).min(stiffest);
        }
        stiffness
    }

    /// How far the body settles at an Omega_n/p (m).
    fn settlement(&self, stiffness: f64) -> f64 {
        springs_at_stiffness(&self.body, stiffness)
            .map_or(f64::INFINITY, |springs| springs.settlement(self.body.mass))
    }

    /// Whether the stiffest springs settle by no more than is allowed.
    fn settles_at(&self, stiffest: f64) -> Result<(), JobError> {
        let (asked_m, least_m) = (self.case.tuning.max_settlement_m, self.settlement(stiffest));
        if least_m > asked_m {
            Err(JobError::Settlement { asked_m, max_hz: CEILING_HZ, least_m })
        } else {
            Ok(())
        }
    }

    /// The springs within a cap (Hz) that follow best what is judged on, of those followed down
    /// from the stiff limit and those of the paper's procedure: so soft, neither is the better one
    /// for every body.
    fn followed(
        &self,
        cap: f64,
        progress: &(dyn Fn(usize, usize, f64) + Sync),
    ) -> Result<Tuned, JobError> {
        let mut found = capped_springs::follow(
            &self.body,
            self.case.restitution,
            self.bracket(cap)?,
            self.effort,
        );
        if self.suites.has_whole_record() && (found.is_empty() || !self.effort.stops()) {
            found.extend(self.procedure.at(cap, progress).map(|tuned| tuned.best.springs));
        }
        let asked = self.case.tuning.asked();
        let judged = found
            .into_iter()
            .map(|springs| evaluate(self.suites, &self.body, asked, springs, self.effort));
        let typical = |tuned: &Tuned| typical(tuned, asked.by);
        let mut judged: Vec<Tuned> = judged.filter(|tuned| self.settles(tuned)).collect();
        judged.sort_by(|a, b| typical(a).total_cmp(&typical(b)));
        let best = judged.first().map_or(f64::INFINITY, &typical);
        judged.retain(|tuned| typical(tuned) <= ALIKE * best);
        if judged.len() > 1 && !self.effort.stops() {
            let more = self.suites.more(self.case.restitution, self.effort);
            // no record: what it has to say was counted, and it is one motion
            let median = |tuned: &Tuned| {
                more.error_by(
                    asked.by,
                    &tuned.best.springs.chains(self.body.mass),
                    Control::search(),
                )
            };
            let medians: Vec<f64> =
                judged.iter().map(|tuned| median(tuned).unwrap_or(f64::INFINITY)).collect();
            let least = (0..medians.len()).min_by(|a, b| medians[*a].total_cmp(&medians[*b]));
            judged.swap(0, least.unwrap_or(0));
        }
        judged.into_iter().next().ok_or(JobError::NoCandidate)
    }

    fn settles(&self, tuned: &Tuned) -> bool {
        tuned.best.springs.settlement(self.body.mass)
            <= self.case.tuning.max_settlement_m * (1.0 + 1e-3)
    }

    /// A cap (Hz) and the settlement allowed.
    fn bracket(&self, cap: f64) -> Result<Bracket, JobError> {
        let bracket = Bracket { max_hz: cap, max_settlement: self.case.tuning.max_settlement_m };
        let least_m = bracket.least_settlement(capped_springs::LARGEST_K);
        if least_m > bracket.max_settlement {
            return Err(JobError::Settlement {
                asked_m: bracket.max_settlement,
                max_hz: cap,
                least_m,
            });
        }
        Ok(bracket)
    }
}

/// The typical error of springs: the geometric mean of that on the record and of the median of
/// synthetic motions.
fn typical(tuned: &Tuned, yardstick: Yardstick) -> f64 {
    let measured = tuned.best.errors.by(yardstick);
    let median = measured.synthetic_median.map(|median| median.value);
    match (measured.record, median) {
        (Some(record), Some(median)) => (record * median).sqrt(),
        (one, other) => one.or(other).unwrap_or(f64::INFINITY),
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
    let found = suites.accuracy_within(&springs.chains(body.mass), (Control::search(), effort));
    let stiffness = TAU * springs.vertical.omega_n_hz / body.p_squared().sqrt();
    let best = Rung { stiffness, springs, errors: found };
    Tuned { rungs: vec![best], best, reached: found.over(asked) <= 1.0 }
}
