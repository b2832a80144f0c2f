//! What a case does not need is skipped: time with and without each skip, and what the skip
//! changes.

use std::{hint::black_box, ops::ControlFlow};

use crate::{
    alternate,
    elements::{BenchCase, at, structure},
};
use dynamics::{
    effort::Effort,
    fem::{Analysis, Control, Observer, Recorder, View},
    spring::{Design, Springs},
};
use rocking::housner;
use rocking::motion::nrmse;
use springs::paper_procedure::outer::Benchmark;
use validation::ComparisonObserver;

/// One thing that is skipped.
#[derive(Clone, Debug)]
pub struct Skip {
    pub what: &'static str,
    /// Time with the skip, and without it (s).
    pub with: f64,
    pub without: f64,
    /// What both ways agree in.
    pub same: String,
}

impl Skip {
    /// Time both ways, and say what they agree in.
    fn timed(
        what: &'static str,
        rounds: usize,
        mut with: impl FnMut(),
        mut without: impl FnMut(),
        same: String,
    ) -> Self {
        let times = alternate(&mut [&mut with, &mut without], rounds);
        Self { what, with: times[0], without: times[1], same }
    }

    /// A case followed at two controls: with the skip, and without it.
    fn of_control(
        what: &'static str,
        bench: &BenchCase,
        [skip, follow]: [Control; 2],
        rounds: usize,
    ) -> Self {
        let (a, b) = (bench.simulate(skip), bench.simulate(follow));
        let error = nrmse(&a.motion.u, &b.motion.u);
        let same = format!("u to {error:.0e} (NRMSE), {} impacts", a.impacts());
        let run = |control| move || drop(black_box(bench.simulate(control)));
        Self::timed(what, rounds, run(skip), run(follow), same)
    }
}

/// All skips that have a switch.
pub fn all(rounds: usize) -> Vec<Skip> {
    vec![
        rest("still ground before the record (10 s)", &silent(10.0, 1.0, 0.0), rounds),
        rest(
            "body at rest in the silent tail (40 s; El Centro times 0.25)",
            &silent(0.0, 0.25, 40.0),
            rounds,
        ),
        toppled(rounds),
        open_foot(rounds),
        candidates(rounds.div_ceil(8)),
        history(rounds),
    ]
}

/// The impact springs on El Centro, times a factor, with silence around it (s).
fn silent(before: f64, factor: f64, after: f64) -> BenchCase {
    let mut bench = BenchCase::damped();
    let zeros = |seconds: f64| vec![0.0; (seconds / bench.record.dt).round() as usize];
    let shaking: Vec<f64> = bench.record.accel.iter().map(|a| factor * a).collect();
    bench.record.accel = [zeros(before), shaking, zeros(after)].concat();
    bench
}

fn rest(what: &'static str, bench: &BenchCase, rounds: usize) -> Skip {
    let controls = [true, false].map(|skip_rest| Control { skip_rest, ..Control::default() });
    Skip::of_control(what, bench, controls, rounds)
}

/// Watches like another observer, but never stops the run.
struct NonStopping<'a>(ComparisonObserver<'a>);

impl Observer for NonStopping<'_> {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        let _ = self.0.sample(index, view);
        ControlFlow::Continue(())
    }
}

/// A push that topples the body, and then half a minute of silence: followed until the fall is
/// certain, or until the body lies flat.
fn toppled(rounds: usize) -> Skip {
    let bench = BenchCase::damped();
    let body = structure().body::<f64>();
    let dt = bench.record.dt;
    let mut accel = vec![4.0; (3.0 / dt) as usize];
    accel.resize((33.0 / dt) as usize, 0.0);
    let theta = housner::history(&body, dt, &accel).theta;
    let case = Analysis { accel: &accel, ..bench.case(1.0, Control::default()) };
    let watch = || ComparisonObserver::new(&body, &theta, &accel);
    let fallen = |last: (f64, f64)| last.0.abs() > body.alpha();
    let with = || _ = black_box(case.observe(&mut watch()));
    let without = || _ = black_box(case.observe(&mut NonStopping(watch())));
    let (mut stopped, mut non_stopping) = (watch(), NonStopping(watch()));
    case.observe(&mut stopped);
    case.observe(&mut non_stopping);
    let word = |fallen| if fallen { "topples" } else { "stands" };
    let same = format!("{}, {}", word(fallen(stopped.last)), word(fallen(non_stopping.0.last)));
    Skip::timed("toppled body (0.4 g for 3 s, then silence)", rounds, with, without, same)
}

/// Chains of a foot in the air, solved with the body or by themselves.
fn open_foot(rounds: usize) -> Skip {
    let bench = BenchCase::damped();
    let controls = [true, false].map(|skip_open| Control { skip_open, ..Control::default() });
    Skip::of_control("chains of an open foot", &bench, controls, rounds)
}

/// Springs from stiff to soft, judged against Housner: abandoned when their running error exceeds
/// the best, or followed.
fn candidates(rounds: usize) -> Skip {
    let sets =
        [BenchCase::arr().springs, BenchCase::damped().springs, BenchCase::plain(160.0).springs];
    let scaled = |chain: Design<f64>, hz: f64| Design { omega_n_hz: hz, ..chain };
    let springs: Vec<Springs<Design<f64>>> = [160.0, 120.0, 80.0, 60.0, 40.0, 30.0]
        .into_iter()
        .flat_map(|hz| {
            sets.map(|s| Springs {
                vertical: scaled(s.vertical, hz),
                horizontal: scaled(s.horizontal, hz),
            })
        })
        .collect();
    let (body, record) = (structure().body::<f64>(), BenchCase::arr().record);
    let rocking = housner::history(&body, record.dt, &record.accel);
    let motion = rocking.motion(&body);
    let benchmark = Benchmark {
        body,
        dt: record.dt,
        accel: &record.accel,
        vertical: &[],
        housner: &motion,
        effort: &Effort::unbounded(),
    };
    let best = |abandon: bool| {
        let mut best = (f64::INFINITY, 0);
        for (i, springs) in springs.iter().enumerate() {
            let limit = if abandon { best.0 } else { f64::INFINITY };
            let judged = benchmark.judge_with(springs, limit, Control::search());
            if !judged.abandoned && judged.error < best.0 {
                best = (judged.error, i);
            }
        }
        best
    };
    let with = || _ = black_box(best(true));
    let without = || _ = black_box(best(false));
    let ((a, i), (b, j)) = (best(true), best(false));
    let same = format!("candidates {i} and {j} win with {a:.6} and {b:.6}");
    Skip::timed("candidates that cannot win (18 springs)", rounds, with, without, same)
}

/// A search needs the motion at the samples only, not forces, energies and events.
fn history(rounds: usize) -> Skip {
    let bench = BenchCase::damped();
    let case = bench.case(1.0, at(1e-7));
    let watched = || {
        let mut last = 0.0;
        case.observe(&mut |_: usize, view: &View| {
            last = view.x();
            ControlFlow::Continue(())
        });
        last
    };
    let kept = || {
        let mut recorder = Recorder::new(case.accel.len());
        let finish = case.observe(&mut recorder);
        recorder.finish(finish)
    };
    let with = || _ = black_box(watched());
    let without = || drop(black_box(kept()));
    let end = kept().motion.u.last().copied().unwrap_or_default();
    let same = format!("last u differs by {:e} m", (watched() - end).abs());
    Skip::timed("histories nobody asked for", rounds, with, without, same)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resting_body_that_is_skipped_has_the_history_of_one_that_is_followed() {
        for (bench, saved) in [(silent(3.0, 1.0, 0.0), 250), (silent(0.0, 0.25, 20.0), 1000)] {
            let [a, b] = [true, false]
                .map(|skip_rest| bench.simulate(Control { skip_rest, ..Control::default() }));
            assert_eq!(
                (a.motion.len(), a.impacts(), a.bounces()),
                (b.motion.len(), b.impacts(), b.bounces())
            );
            assert!(a.work.steps + saved < b.work.steps, "{:?} {:?}", a.work, b.work);
            assert!(
                nrmse(&a.motion.u, &b.motion.u) < 1e-7,
                "{:e}",
                nrmse(&a.motion.u, &b.motion.u)
            );
            assert!(nrmse(&a.motion.v, &b.motion.v) < 1e-7);
            let weight = structure().mass_kg * rocking::scalar::GRAVITY;
            let tail = a.motion.len() - 1;
            for foot in 0..2 {
                let [x, y] = [&a, &b].map(|h| h.forces.vertical[foot][tail]);
                assert!((x - y).abs() < 1e-6 * weight, "{x} {y}");
            }
        }
    }

    #[test]
    fn no_skip_changes_its_result() {
        let skips = all(1);
        assert_eq!(toppled(1).same, "topples, topples");
        // the same numbers in another order of summation
        let nrmse: f64 = skips[3].same.split(' ').nth(2).unwrap().parse().unwrap();
        assert!(nrmse < 1e-6, "{}", skips[3].same);
        let history = skips.last().unwrap();
        assert_eq!(history.same, "last u differs by 0e0 m");
        let words: Vec<&str> = skips[4].same.split(' ').collect();
        assert_eq!((words[1], words[6]), (words[3], words[8]), "{}", skips[4].same);
    }
}
