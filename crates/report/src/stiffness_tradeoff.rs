//! The front: error against Omega_n, of the design from the geometry and of the paper's procedure;
//! and what stiffness costs.

use std::{
    f64::consts::TAU,
    ops::ControlFlow,
    sync::atomic::{AtomicUsize, Ordering},
};

use decks::deck_steps;
use dynamics::{
    effort::Effort,
    fem::{Analysis, Change, Control, Observer, View},
    spring::{Design, Springs},
};
use landing::design::springs_at_stiffness;
use rocking::scalar::GRAVITY;
use springs::{
    job::{Job, Paper},
    paper_procedure::outer::{self, Benchmark, Bracket, Refinement},
};

/// Omega_n of the front's points (Hz); the one that was chosen is added.
const LADDER_HZ: [f64; 8] = [160.0, 320.0, 640.0, 1280.0, 2560.0, 5120.0, 10240.0, 20480.0];

/// One point of the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TradeoffPoint {
    /// Omega_n of the vertical units (Hz).
    pub omega_n_hz: f64,
    /// Whether springs of this Omega_n were chosen.
    pub chosen: bool,
    /// NRMSE of u on the springs of the landing: on the record, or the median of the synthetic
    /// motions where the record cannot be followed one to one.
    pub landing: Option<f64>,
    /// The same of the paper's procedure, springs up to this Omega_n.
    pub arr: Option<f64>,
    /// Largest vertical foot force on the record, in weights, on the springs of the landing: the
    /// springs' force, not the structure's.
    pub foot_force_weights: f64,
    /// Steps that an exported deck of these takes on the record at least, by its own rule along our
    /// history.
    pub deck_steps: usize,
}

/// The front of a job.
pub fn front(job: &Job, progress: &(dyn Fn(usize, usize) + Sync)) -> Vec<TradeoffPoint> {
    let chosen = job.springs.vertical.omega_n_hz;
    let mut ladder: Vec<f64> =
        LADDER_HZ.into_iter().filter(|hz| (hz / chosen).ln().abs() > 0.05).collect();
    ladder.push(chosen);
    ladder.sort_by(f64::total_cmp);
    let (done, total) = (AtomicUsize::new(0), 2 * ladder.len());
    let told = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, total);
    progress(0, total);
    // springs of the paper's procedure are no design from the geometry
    let by_paper = job.paper.as_ref().is_some_and(|of| of.is_asked);
    let paper = || paper_errors(job, &ladder, &told);
    // the stiffest takes longest, and is begun first
    let begun = AtomicUsize::new(0);
    let ours = || {
        parallel::map_range(0..ladder.len(), |_| {
            let hz = ladder[ladder.len() - 1 - begun.fetch_add(1, Ordering::Relaxed)];
            let springs = if hz == chosen && !by_paper {
                Some(job.springs)
            } else {
                springs_at_stiffness(&job.body, TAU * hz / job.body.p())
            };
            let found = springs.map(|springs| (hz, error_and_cost(job, &springs)));
            told();
            found
        })
    };
    let (paper, ours) = parallel::join(paper, ours);
    let of_paper = |hz: f64| ladder.iter().zip(&paper).find(|(of, _)| **of == hz)?.1.to_owned();
    let point = |(hz, (landing, (foot_force_weights, deck_steps))): (f64, _)| TradeoffPoint {
        omega_n_hz: hz,
        chosen: hz == chosen,
        landing,
        arr: of_paper(hz),
        foot_force_weights,
        deck_steps,
    };
    let mut points: Vec<TradeoffPoint> = ours.into_iter().flatten().map(point).collect();
    points.sort_by(|a, b| a.omega_n_hz.total_cmp(&b.omega_n_hz));
    points
}

fn error(job: &Job, springs: &Springs<Design<f64>>) -> Option<f64> {
    job.suites
        .error(&springs.chains(job.body.mass), Control::search())
        .filter(|error| error.is_finite())
}

/// Errors of the paper's procedure at these Omega_n (Hz).
fn paper_errors(job: &Job, ladder: &[f64], told: &(dyn Fn() + Sync)) -> Vec<Option<f64>> {
    let Some(Paper { vertical, horizontal, tuned, tuned_hz, is_asked }) = &job.paper else {
        return vec![None; ladder.len()];
    };
    let benchmark = Benchmark {
        body: job.body,
        dt: job.record.dt,
        accel: &job.record.accel,
        vertical: job.record.up(),
        housner: &job.housner,
        effort: &Effort::unbounded(),
    };
    let chosen = job.springs.vertical.omega_n_hz;
    let others = ladder.iter().filter(|hz| **hz != chosen);
    let brackets: Vec<Bracket> =
        others.map(|&max_hz| Bracket { max_hz, max_settlement: f64::INFINITY }).collect();
    let families = [vertical.as_slice(), horizontal.as_slice()];
    let followed =
        outer::follow(&benchmark, families, &brackets, (tuned, *tuned_hz), &Refinement::DRAWN);
    let mut followed = followed.into_iter();
    let mut best =
        |hz: &f64| if *hz == chosen { Some(tuned.best) } else { followed.next().flatten() };
    let best: Vec<_> = ladder.iter().map(|hz| (*hz == chosen && *is_asked, best(hz))).collect();
    parallel::map(&best, |(is_answer, best)| {
        let found = match best {
            // springs that were followed from there
            _ if *is_answer => error(job, &job.springs),
            // the procedure's own history on the record
            Some(best) if job.suites.has_whole_record() => {
                Some(best.of_u).filter(|error| error.is_finite())
            }
            Some(best) => error(job, &best.springs),
            None => None,
        };
        told();
        found
    })
}

/// Keeps the largest vertical force of either foot (N), and when contact changed (s).
struct ForceWatch {
    largest: f64,
    changes: Vec<f64>,
}

impl Observer for ForceWatch {
    fn sample(&mut self, _: usize, _: &View) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn step(&mut self, view: &View) {
        self.largest = self.largest.max(view.vertical_force(0)).max(view.vertical_force(1));
    }

    fn event(&mut self, _: usize, _: Change, view: &View) {
        self.changes.push(view.time);
    }
}

/// The error of springs of the landing; on the record, the largest vertical foot force in weights
/// and a deck's steps.
fn error_and_cost(job: &Job, springs: &Springs<Design<f64>>) -> (Option<f64>, (f64, usize)) {
    let chains = springs.chains(job.body.mass);
    // forces at every sample
    let control = Control::search();
    let mut watch = ForceWatch { largest: 0.0, changes: Vec::new() };
    let error = match job.suites.error_on_whole_record(&chains, control, &mut watch) {
        Some(error) => Some(error).filter(|error| error.is_finite()),
        None => {
            let case = Analysis {
                vertical: job.record.up(),
                control,
                ..Analysis::new(job.body, chains, job.record.dt, &job.record.accel)
            };
            case.observe(&mut watch);
            measured_error(job, springs).or_else(|| error(job, springs))
        }
    };
    let duration = job.record.len().saturating_sub(1) as f64 * job.record.dt;
    let landing = (TAU * springs.vertical.omega_n_hz).recip();
    let steps = deck_steps(&watch.changes, duration, job.record.dt, landing);
    (error, (watch.largest / (job.body.mass * GRAVITY), steps))
}

/// What the search has measured of these springs on synthetic motions, where those are compared.
fn measured_error(job: &Job, springs: &Springs<Design<f64>>) -> Option<f64> {
    let measured = job.tuned.best.errors.histories.synthetic_median;
    let chosen = *springs == job.springs && !job.suites.has_record();
    measured.filter(|_| chosen).map(|median| median.value).filter(|error| error.is_finite())
}
