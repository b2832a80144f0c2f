//! Housner's equation, 20 s of El Centro: ours and its peers against a float128 history.

use std::hint::black_box;

use crate::{Point, TimedSeries, alternate};
use rocking::{
    housner::{RockingOptions, history, solve, solve_lanes},
    structure::{Body, Structure},
};
use strong_motion::Record;

/// Length of the history (s).
pub const SECONDS: f64 = 20.0;

/// The history that every tool follows, and its reference.
#[derive(Clone, Debug)]
pub struct RockingProblem {
    pub body: Body<f64>,
    pub record: Record,
    /// Sample and theta (rad).
    reference: Vec<(usize, f64)>,
}

impl RockingProblem {
    /// The paper's A-frame on the first 20 s of El Centro.
    pub fn el_centro() -> Self {
        let reference = include_str!("el_centro_float128.csv")
            .lines()
            .filter_map(|line| line.split_once(','))
            .filter_map(|(i, theta)| Some((i.parse().ok()?, theta.parse().ok()?)))
            .collect();
        Self {
            body: Structure::paper().body(),
            record: Record::el_centro().truncated(SECONDS),
            reference,
        }
    }

    /// Largest error of u over the samples that the reference tells (m); infinite if the history is
    /// too short.
    pub fn error(&self, theta: &[f64]) -> f64 {
        let error = |&(i, reference): &(usize, f64)| {
            theta
                .get(i)
                .map_or(f64::INFINITY, |&theta| (self.body.u(theta) - self.body.u(reference)).abs())
        };
        // a NaN is no small error
        self.reference
            .iter()
            .map(error)
            .fold(0.0, |worst, e| if worst.is_nan() || e <= worst { worst } else { e })
    }

    fn ours(&self) -> Vec<f64> {
        history(&self.body, self.record.dt, &self.record.accel).theta
    }
}

/// Another solver of Housner's equation.
pub struct Solver<'a> {
    /// What the tables call it.
    pub tool: &'a str,
    /// Tolerances.
    pub ladder: [f64; 2],
    /// theta at every sample (rad) with a relative tolerance; none if it gives up.
    pub theta: &'a dyn Fn(&RockingProblem, f64) -> Option<Vec<f64>>,
}

/// Our solver, and beside it another.
pub fn series(problem: &RockingProblem, other: &Solver, rounds: usize) -> Vec<TimedSeries> {
    let mut ours = || drop(black_box(problem.ours()));
    let own = |seconds| TimedSeries {
        tool: "groundspring".into(),
        points: vec![Point {
            setting: "one Taylor step a sample".into(),
            seconds,
            error: problem.error(&problem.ours()),
            note: String::new(),
        }],
    };
    let mut peers = other.ladder.map(|rtol| move || drop(black_box((other.theta)(problem, rtol))));
    let [a, b] = &mut peers;
    let times = alternate(&mut [&mut ours, a, b], rounds);
    let points = other
        .ladder
        .iter()
        .zip(&times[1..])
        .map(|(&rtol, &seconds)| Point {
            setting: format!("rtol {rtol:.0e}"),
            seconds,
            error: (other.theta)(problem, rtol)
                .map_or(f64::INFINITY, |theta| problem.error(&theta)),
            note: String::new(),
        })
        .collect();
    vec![own(times[0]), TimedSeries { tool: other.tool.into(), points }]
}

/// Many structures on one record: time of each, one by one and in lock-step.
#[derive(Clone, Copy, Debug)]
pub struct LaneTimes {
    pub structures: usize,
    /// (s)
    pub single: f64,
    /// (s)
    pub lanes: f64,
}

/// Structures of nearly the paper's size: width and height up to a fifth more or less.
pub fn lanes(problem: &RockingProblem, structures: usize, rounds: usize) -> LaneTimes {
    let Record { dt, accel, .. } = &problem.record;
    let share = |i: usize, step: f64| 0.8 + 0.4 * (i as f64 * step).fract();
    let bodies: Vec<Body<f64>> = (0..structures)
        .map(|i| Body {
            half_width: problem.body.half_width * share(i, 0.618_033_988_75),
            height: problem.body.height * share(i, 0.754_877_666_25),
            ..problem.body
        })
        .collect();
    let options = RockingOptions::default();
    let mut together =
        || drop(black_box(solve_lanes(&bodies, *dt, accel, std::slice::from_ref(&options))));
    let mut each = || {
        drop(black_box(
            bodies.iter().map(|body| solve(body, *dt, accel, &options)).collect::<Vec<_>>(),
        ))
    };
    // from within the pool, as a program at work calls it; a call from outside wakes two threads at
    // once, which Linux often puts on the same core for some milliseconds
    let times = rayon::scope(|_| alternate(&mut [&mut together, &mut each], rounds));
    LaneTimes {
        structures,
        lanes: times[0] / structures as f64,
        single: times[1] / structures as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_reference_has_the_peaks_of_the_float128_program() {
        let problem = RockingProblem::el_centro();
        assert_eq!(problem.reference.len(), 201);
        assert_eq!(problem.reference[50], (500, 4.691_153_314_764_106e-3));
        assert_eq!(problem.reference[200].0, 2000);
    }

    #[test]
    fn our_history_is_within_1e_10_m_of_the_reference() {
        let problem = RockingProblem::el_centro();
        let theta = problem.ours();
        assert!(problem.error(&theta) < 1e-10);
    }

    #[test]
    fn a_short_or_wrong_history_is_an_error() {
        let problem = RockingProblem::el_centro();
        let mut theta = problem.ours();
        assert_eq!(problem.error(&theta[..1500]), f64::INFINITY);
        theta[1000] = f64::NAN;
        assert!(problem.error(&theta).is_nan());
        theta[1000] = 0.0;
        assert!(problem.error(&theta) > 1e-3);
    }
}
