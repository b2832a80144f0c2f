//! The finite element history: what an error costs, and what stiffness and length cost.

use std::hint::black_box;

use crate::{Point, TimedSeries, least};
use dynamics::{
    fem::{Analysis, Control, History},
    spring::{Design, Springs},
};
use parameters::Parameters;
use rocking::{
    members::Members,
    motion::{Motion, nrmse},
    structure::Structure,
};
use strong_motion::Record;

/// The tolerance of the history that errors are told against; the next tighter one confirms it.
const TIGHT: f64 = 1e-12;
/// Tolerances of the ladder.
pub const LADDER: [f64; 8] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];

/// The paper's A-frame on springs, on a record.
#[derive(Clone, Debug)]
pub struct BenchCase {
    pub name: &'static str,
    pub springs: Springs<Design<f64>>,
    pub record: Record,
}

/// The paper's structure, with the little rotational inertia that a deck for OpenSees needs.
pub fn structure() -> Structure {
    decks::with_inertia(&Structure::paper(), &Members::default())
}

impl BenchCase {
    fn on_el_centro(name: &'static str, vertical: Design<f64>, horizontal: Design<f64>) -> Self {
        Self { name, springs: Springs { vertical, horizontal }, record: el_centro() }
    }

    /// 160 Hz springs as the paper's procedure tunes them.
    pub fn arr() -> Self {
        let vertical = Design { mu: 1.0, f: 0.862_809_649, xi: 1.023_922_665, omega_n_hz: 160.0 };
        let horizontal =
            Design { mu: 10.0, f: 0.948_312_333, xi: 0.197_421_228, omega_n_hz: 160.0 };
        Self::on_el_centro("paper's procedure", vertical, horizontal)
    }

    /// 160 Hz springs, fixed so that times can be compared: stiff, strongly damped horizontal
    /// chains, which hardly bounce.
    pub fn damped() -> Self {
        let vertical = Design { mu: 0.5158, f: 0.6521, xi: 0.8992, omega_n_hz: 160.0 };
        let horizontal = Design { mu: 0.0272, f: 33.19, xi: 40.06, omega_n_hz: 160.0 };
        Self::on_el_centro("strongly damped", vertical, horizontal)
    }

    /// The same ratios, which hardly bounce, at any frequency (Hz).
    pub fn plain(omega_n_hz: f64) -> Self {
        let chain = Design::from_kc(0.5, 0.2, 0.92, omega_n_hz);
        Self::on_el_centro("mu 0.5, K 0.2, C 0.92", chain, chain)
    }

    /// What the engineer's deck is made of.
    pub fn parameters(&self) -> Parameters {
        Parameters::new(structure(), &self.springs)
    }

    /// The record at a scale.
    pub fn case(&self, scale: f64, control: Control) -> Analysis<'_> {
        let body = structure().body::<f64>();
        Analysis {
            scale,
            control,
            ..Analysis::new(
                body,
                self.springs.chains(body.mass),
                self.record.dt,
                &self.record.accel,
            )
        }
    }

    /// The history at a tolerance.
    pub fn simulate(&self, control: Control) -> History {
        self.case(1.0, control).simulate()
    }

    /// The history that errors are told against.
    pub fn tight(&self) -> Motion {
        self.simulate(at(TIGHT)).motion
    }

    /// Time, error and work at each tolerance.
    pub fn ladder(&self, tolerances: &[f64], reference: &Motion, rounds: usize) -> TimedSeries {
        let point = |&tolerance: &f64| {
            let (seconds, history) = least(rounds, || self.simulate(black_box(at(tolerance))));
            Point {
                setting: format!("tolerance {tolerance:.0e}"),
                seconds,
                error: error(&history.motion, reference),
                note: format!(
                    "{} steps, energy residual {:.0e}",
                    steps(&history),
                    history.energy_residual
                ),
            }
        };
        TimedSeries {
            tool: format!("groundspring, {}", self.name),
            points: tolerances.iter().map(point).collect(),
        }
    }
}

/// The default control at another tolerance.
pub fn at(tolerance: f64) -> Control {
    Control { tolerance, ..Control::default() }
}

/// The larger NRMSE of u and v; infinite for a history cut short.
pub fn error(motion: &Motion, reference: &Motion) -> f64 {
    if motion.len() != reference.len() {
        return f64::INFINITY;
    }
    nrmse(&motion.u, &reference.u).max(nrmse(&motion.v, &reference.v))
}

/// Steps tried, repeated ones included.
pub fn steps(history: &History) -> usize {
    let work = &history.work;
    work.steps + work.rejected + work.located
}

/// What one history cost.
#[derive(Clone, Copy, Debug)]
pub struct HistoryCost {
    /// Omega_n (Hz) or length (s).
    pub at: f64,
    pub seconds: f64,
    pub steps: usize,
    pub impacts: usize,
    /// Against `TIGHT`.
    pub error: f64,
}

/// Cost against stiffness, 20 s of El Centro.
pub fn against_stiffness(hz: &[f64], rounds: usize) -> Vec<HistoryCost> {
    hz.iter().map(|&hz| cost(hz, &BenchCase::plain(hz), rounds)).collect()
}

/// Cost against length; the record is El Centro's first 20 s, over and over.
pub fn against_length(seconds: &[f64], rounds: usize) -> Vec<HistoryCost> {
    let once = el_centro();
    let bench = |length: f64| {
        let samples = (length / once.dt).round() as usize + 1;
        let accel = once.accel[..once.len() - 1].iter().copied().cycle().take(samples).collect();
        BenchCase { record: Record { accel, ..once.clone() }, ..BenchCase::plain(160.0) }
    };
    seconds.iter().map(|&length| cost(length, &bench(length), rounds)).collect()
}

fn cost(at: f64, bench: &BenchCase, rounds: usize) -> HistoryCost {
    let (seconds, history) = least(rounds, || bench.simulate(black_box(Control::default())));
    let error = error(&history.motion, &bench.tight());
    HistoryCost { at, seconds, steps: steps(&history), impacts: history.impacts(), error }
}

fn el_centro() -> Record {
    Record::el_centro().truncated(super::rigid::SECONDS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_history_is_within_its_promise_of_the_tight_one_which_the_next_tighter_confirms()
    {
        for bench in [BenchCase::arr(), BenchCase::damped()] {
            let tight = bench.tight();
            assert!(error(&bench.simulate(at(0.1 * TIGHT)).motion, &tight) < 5e-6);
            assert!(error(&bench.simulate(Control::default()).motion, &tight) < 5e-4);
        }
    }

    #[test]
    fn a_history_cut_short_has_no_error() {
        let bench = BenchCase::plain(20.0);
        let mut motion = bench.tight();
        let reference = motion.clone();
        assert_eq!(error(&motion, &reference), 0.0);
        motion.u.pop();
        assert_eq!(error(&motion, &reference), f64::INFINITY);
    }
}
