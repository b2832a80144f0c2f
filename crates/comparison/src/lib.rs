//! Run time against error: our two models and other tools on the same history, in one run. What
//! `cargo bench --bench compare` measures and prints.
//!
//! | module | what |
//! |---|---|
//! | `rigid` | Housner's equation against a float128 history, alone and in lock-step |
//! | `elements` | the finite element history: tolerance, stiffness, length |
//! | `peers` | SciPy, Octave, OpenSees, each in a process of its own |
//! | `program` | inner fit, `tune run`, `tune validate` |
//! | `skips` | what a case does not need, with and without |
//! | `measurements`, `table` | all of it as data; tables and times in words |
//! | `report`, `targets`, `page` | tables; targets and whether they are met; docs/benchmarks.md |
//!
//! Times are the least of several rounds in which the contenders take turns: other work on the
//! machine only ever adds. What counts is their ratio.

pub mod elements;
mod measurements;
pub mod page;
mod peers;
mod program;
mod report;
pub mod rigid;
mod skips;
mod table;
mod targets;

use std::{
    error::Error,
    path::{Path, PathBuf},
    time::Instant,
};

use figures::precision::{self, PrecisionFigure};
use frequency_response::inner::FitError;

use self::{peers::OpenSeesStepping, rigid::Solver};
pub use measurements::Measurements;

/// One run of a tool: a setting, what it cost and how far off it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// As "rtol 1e-6".
    pub setting: String,
    /// Least time (s).
    pub seconds: f64,
    /// In the comparison's own measure.
    pub error: f64,
    /// Anything else to tell, as steps.
    pub note: String,
}

/// A tool over a ladder of settings.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedSeries {
    pub tool: String,
    pub points: Vec<Point>,
}

impl TimedSeries {
    /// The cheapest point with an error of at most `error`.
    pub fn cheapest(&self, error: f64) -> Option<&Point> {
        self.points
            .iter()
            .filter(|p| p.error <= error)
            .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

/// Another tool's part: what it did, or in one line why it is left out.
pub type Peer = Result<TimedSeries, String>;

/// OpenSees' steps per sample; the last one is its own reference.
const OPENSEES_STEPS: [usize; 6] = [1, 10, 25, 50, 100, 200];
/// Records that `tune validate` judges.
const RECORDS: [usize; 3] = [100, 300, 1000];

/// Programs that are run beside our own code.
#[derive(Clone, Debug)]
pub struct OtherPrograms {
    /// Python with SciPy and openseespy.
    pub python: PathBuf,
    /// Our own as a whole.
    pub tune: PathBuf,
}

/// Measure everything; other programs, if there are any. `solver` stands beside ours on Housner's
/// equation; `tell` hears what comes next.
///
/// # Errors
/// An inner fit fails. Tools that are not there, or fail, are told in the result.
pub fn measure(
    [many, few]: [usize; 2],
    solver: &Solver,
    programs: Option<&OtherPrograms>,
    tell: &dyn Fn(&str),
) -> Result<Measurements, FitError> {
    let mut m = Measurements::default();
    let problem = rigid::RockingProblem::el_centro();
    tell("Housner's equation");
    m.rigid = rigid::series(&problem, solver, many);
    m.lanes = Some(rigid::lanes(&problem, 64, few));
    if let Some(OtherPrograms { python, .. }) = programs {
        tell("Housner's equation: SciPy, Octave");
        for peer in peers::scipy(&problem, python, &[1e-3, 1e-6, 1e-9], 3) {
            Measurements::add(&mut m.left_out, &mut m.rigid, peer);
        }
        Measurements::add(&mut m.left_out, &mut m.rigid, peers::octave(&problem, &[1e-3, 1e-6], 1));
    }
    tell("finite elements");
    let benches = [elements::BenchCase::arr(), elements::BenchCase::damped()]
        .map(|bench| (bench.tight(), bench));
    m.elements =
        benches.iter().map(|(tight, bench)| bench.ladder(&elements::LADDER, tight, few)).collect();
    m.own = m.elements.len();
    m.stiffness = elements::against_stiffness(&[20.0, 80.0, 320.0, 1280.0], few);
    m.length = elements::against_length(&[5.0, 10.0, 20.0, 40.0], few);
    m.skips = skips::all(few.max(10));
    m.fits = program::fits(few)?;
    if let Some(OtherPrograms { python, tune }) = programs {
        for (tight, bench) in &benches {
            tell(&format!("OpenSees, {}", bench.name));
            for stepping in [OpenSeesStepping::Even, OpenSeesStepping::Watched] {
                let peer = peers::opensees(bench, tight, python, stepping, &OPENSEES_STEPS);
                Measurements::add(&mut m.left_out, &mut m.elements, peer);
            }
        }
        tell("tune run, tune validate");
        match program::jobs(tune, &RECORDS, 3) {
            Ok(jobs) => {
                m.runs = jobs.runs;
                m.skips.extend(jobs.skips);
            }
            Err(reason) => m.left_out.push(reason),
        }
    }
    Ok(m)
}

/// Least time of each contender over `rounds` rounds in which they take turns (s).
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

/// A tool's name; its errors, each with the time (ms) that it took.
type DrawnSeries = (String, Vec<(f64, f64)>);

fn series(drawn: &[DrawnSeries]) -> Vec<precision::ToolSeries<'_>> {
    drawn.iter().map(|(label, points)| precision::ToolSeries { label, points }).collect()
}

/// `work_precision.png`: one sheet a model.
///
/// # Errors
/// The picture cannot be drawn or written.
pub fn draw(measured: &Measurements, path: &Path) -> Result<(), Box<dyn Error>> {
    // what has no finite error, as a history that went wrong, is in the table only; no error at all
    // cannot be drawn
    let points = |series: &TimedSeries| -> Vec<(f64, f64)> {
        let drawn = series.points.iter().filter(|p| p.error > 0.0 && p.error.is_finite());
        drawn.map(|p| (p.error, p.seconds * 1e3)).collect()
    };
    let all = |list: &[TimedSeries]| -> Vec<DrawnSeries> {
        let named = |s: &TimedSeries, drawn: usize| match s.points.len() - drawn {
            0 => s.tool.clone(),
            lost => format!("{} ({lost} in the table only)", s.tool),
        };
        let all = list.iter().map(|s| (s, points(s))).filter(|(_, points)| !points.is_empty());
        all.map(|(s, points)| (named(s, points.len()), points)).collect()
    };
    let (rigid, elements) = (all(&measured.rigid), all(&measured.elements));
    let (rigid, elements) = (series(&rigid), series(&elements));
    let sheets = [
        PrecisionFigure {
            title: "Housner's equation, 20 s of El Centro: time against error",
            error_label: "largest error of u against float128 [m]",
            time_label: "time [ms]",
            series: &rigid,
        },
        PrecisionFigure {
            title: "Finite elements on 160 Hz springs, 20 s of El Centro: time against error",
            error_label: "larger NRMSE of u and v",
            time_label: "time [ms]",
            series: &elements,
        },
    ];
    Ok(precision::draw(&sheets)?.save(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tool and what it measured: seconds, error.
    pub fn series(tool: &str, points: &[(f64, f64)]) -> TimedSeries {
        let point = |&(seconds, error): &(f64, f64)| Point {
            setting: "s".into(),
            seconds,
            error,
            note: String::new(),
        };
        TimedSeries { tool: tool.into(), points: points.iter().map(point).collect() }
    }

    #[test]
    fn the_cheapest_point_meets_the_error_and_no_dearer_one_is_taken() {
        let series = series("t", &[(1.0, 1e-2), (3.0, 1e-4), (2.0, 1e-5)]);
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
