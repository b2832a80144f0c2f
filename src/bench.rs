//! Run time against error: our two models and other tools on the same history, in one run.
//!
//! | file | what |
//! |---|---|
//! | [`rigid`] | Housner's equation against a float128 history, alone and in lock-step |
//! | `diffsol` | the same by diffsol, stopped at every sample (feature `diffsol`) |
//! | [`elements`] | the finite element history: tolerance, stiffness, length |
//! | [`peers`] | SciPy, Octave, OpenSees, each in a process of its own |
//! | [`program`] | inner fit, `tune run`, `tune validate` |
//! | [`skips`] | what a case does not need, with and without |
//! | [`report`], `targets` | tables; targets and whether they are met |
//!
//! Times are the least of several rounds in which the contenders take turns: other work on the machine only ever adds.
//! What counts is their ratio.

pub mod elements;
pub mod peers;
pub mod program;
pub mod report;
pub mod rigid;
pub mod skips;
mod targets;

#[cfg(feature = "diffsol")]
pub mod diffsol;

use std::{path::Path, time::Instant};

pub use targets::Target;

use self::peers::Stepping;
use crate::tuning::arr::inner::FitError;
use report::Measured;

/// One run of a tool: a setting, what it cost and how far off it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// As "rtol 1e-6".
    pub setting: String,
    /// Least time [s].
    pub seconds: f64,
    /// In the comparison's own measure.
    pub error: f64,
    /// Anything else to tell, as steps.
    pub note: String,
}

/// A tool over a ladder of settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub tool: String,
    pub points: Vec<Point>,
}

impl Series {
    /// The cheapest point with an error of at most `error`.
    pub fn cheapest(&self, error: f64) -> Option<&Point> {
        self.points.iter().filter(|p| p.error <= error).min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

/// Another tool's part: what it did, or in one line why it is left out.
pub type Peer = Result<Series, String>;

/// How much is measured.
#[derive(Clone, Debug)]
pub struct Effort {
    /// Rounds for what takes less than a millisecond, and for what takes longer.
    pub rounds: [usize; 2],
    /// Whether other programs, and our own as a whole, are run.
    pub programs: bool,
    /// OpenSees' steps per sample; the last one is its own reference.
    pub opensees: &'static [usize],
    /// Records that `tune validate` judges.
    pub records: &'static [usize],
}

impl Effort {
    /// A few seconds, nothing but our own code.
    pub fn quick() -> Self {
        Self { rounds: [20, 3], programs: false, opensees: &[], records: &[] }
    }

    /// A few minutes.
    pub fn full() -> Self {
        Self { rounds: [400, 40], programs: true, opensees: &[1, 10, 25, 50, 100, 200], records: &[100, 300, 1000] }
    }
}

/// Measure everything. `tell` hears what comes next.
///
/// # Errors
/// An inner fit fails. Tools that are not there, or fail, are told in the result.
pub fn measure(effort: &Effort, python: &Path, program: &Path, tell: &dyn Fn(&str)) -> Result<Measured, FitError> {
    let [many, few] = effort.rounds;
    let mut m = Measured::default();
    let problem = rigid::Problem::el_centro();
    tell("Housner's equation");
    m.rigid = rigid::series(&problem, many);
    m.lanes = Some(rigid::lanes(&problem, 64, few));
    if !cfg!(feature = "diffsol") {
        m.left_out.push("diffsol: not built in; cargo run --release --features diffsol -- bench".into());
    }
    if effort.programs {
        tell("Housner's equation: SciPy, Octave");
        for peer in peers::scipy(&problem, python, &[1e-3, 1e-6, 1e-9], 3) {
            Measured::add(&mut m.left_out, &mut m.rigid, peer);
        }
        Measured::add(&mut m.left_out, &mut m.rigid, peers::octave(&problem, &[1e-3, 1e-6], 1));
    }
    tell("finite elements");
    let scenes = [elements::Scene::arr(), elements::Scene::impact()].map(|scene| (scene.tight(), scene));
    m.elements = scenes.iter().map(|(tight, scene)| scene.ladder(&elements::LADDER, tight, few)).collect();
    m.own = m.elements.len();
    m.stiffness = elements::against_stiffness(&[20.0, 80.0, 320.0, 1280.0], few);
    m.length = elements::against_length(&[5.0, 10.0, 20.0, 40.0], few);
    m.skips = skips::all(few.max(10));
    m.fits = program::fits(few)?;
    if effort.programs {
        for (tight, scene) in &scenes {
            tell(&format!("OpenSees, {}", scene.name));
            for stepping in [Stepping::Even, Stepping::Watched] {
                let peer = peers::opensees(scene, tight, python, stepping, effort.opensees);
                Measured::add(&mut m.left_out, &mut m.elements, peer);
            }
        }
        tell("tune run, tune validate");
        match program::jobs(program, effort.records, 3) {
            Ok(jobs) => {
                m.runs = jobs.runs;
                m.skips.extend(jobs.skips);
            }
            Err(reason) => m.left_out.push(reason),
        }
    }
    Ok(m)
}

/// Least time of each contender over `rounds` rounds in which they take turns [s].
pub fn alternate(contenders: &mut [&mut dyn FnMut()], rounds: usize) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; contenders.len()];
    for _ in 0..rounds {
        for (contender, least) in contenders.iter_mut().zip(&mut least) {
            let began = Instant::now();
            contender();
            *least = least.min(began.elapsed().as_secs_f64());
        }
    }
    least
}

/// Least time of one contender over `rounds` rounds, and what it returned last.
pub fn least<T>(rounds: usize, mut contender: impl FnMut() -> T) -> (f64, T) {
    let began = Instant::now();
    let mut out = contender();
    let mut least = began.elapsed().as_secs_f64();
    for _ in 1..rounds {
        let began = Instant::now();
        out = std::hint::black_box(contender());
        least = least.min(began.elapsed().as_secs_f64());
    }
    (least, out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(seconds: f64, error: f64) -> Point {
        Point { setting: String::new(), seconds, error, note: String::new() }
    }

    #[test]
    fn the_cheapest_point_meets_the_error_and_no_dearer_one_is_taken() {
        let series = Series { tool: "t".into(), points: vec![point(1.0, 1e-2), point(3.0, 1e-4), point(2.0, 1e-5)] };
        assert_eq!(series.cheapest(1e-3).map(|p| p.seconds), Some(2.0));
        assert_eq!(series.cheapest(1e-1).map(|p| p.seconds), Some(1.0));
        assert_eq!(series.cheapest(1e-6), None);
    }

    #[test]
    fn contenders_take_turns() {
        let order = std::cell::RefCell::new(String::new());
        let (mut a, mut b) = (|| order.borrow_mut().push('a'), || order.borrow_mut().push('b'));
        let times = alternate(&mut [&mut a, &mut b], 3);
        assert_eq!(*order.borrow(), "ababab");
        assert!(times.len() == 2 && times.iter().all(|t| t.is_finite()));
    }
}
