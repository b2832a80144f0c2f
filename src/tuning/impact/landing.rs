//! One landing: the body falls back from a lean, lands on the other foot and swings to its next peak.

use std::ops::ControlFlow;

use serde::Serialize;

use crate::{
    fem::{Case, Change, Control, Observer, Outcome, Start, View, energy_on_one_foot},
    scalar::{GRAVITY, Scalar, real},
    spring::{Chain, Springs},
    structure::Body,
};

/// A release at rest.
#[derive(Clone, Debug)]
pub(super) struct Drop {
    lean: f64,
    dt: f64,
    /// Samples to just after the next peak.
    samples: usize,
}

/// Time from a lean of phi alpha to the upright, or back, by the small-angle theory [s].
fn quarter(phi: f64, p: f64) -> f64 {
    (1.0 / (1.0 - phi)).acosh() / p
}

/// The next peak after phi: 1 - sqrt(1 - e^2 [1 - (1 - phi)^2]).
fn next_peak(phi: f64, restitution: f64) -> f64 {
    1.0 - (1.0 - restitution.powi(2) * (1.0 - (1.0 - phi).powi(2))).max(0.0).sqrt()
}

impl Drop {
    /// From phi alpha of a body that lands with `restitution`.
    pub fn new(body: &Body<f64>, restitution: f64, phi: f64) -> Self {
        let p = body.p_squared().sqrt();
        let time = 1.12 * (quarter(phi, p) + quarter(next_peak(phi, restitution), p));
        let dt = time / 30.0;
        Self { lean: phi * body.alpha(), dt, samples: (time / dt) as usize + 2 }
    }

    /// The share of the energy that is left after the landing, and the time with both feet in the air [s]; `None` unless
    /// the run finished.
    pub fn run<S: Scalar>(&self, body: &Body<S>, chains: &Springs<Chain<S>>, control: Control) -> Option<(S, S)> {
        let quiet = vec![0.0; self.samples];
        let mut flight = Flight { since: None, total: S::zero() };
        let case = Case {
            body: *body,
            springs: *chains,
            start: Start::Leaning(real(self.lean)),
            dt: self.dt,
            accel: &quiet,
            scale: S::one(),
            control,
        };
        let finish = case.observe(&mut flight);
        if finish.outcome != Outcome::Completed {
            return None;
        }
        let rest = energy_on_one_foot(body, chains);
        Some(((finish.energy.stored - rest) / (finish.energy.initial - rest), flight.total))
    }
}

/// Sums the time with both feet in the air.
struct Flight<S> {
    since: Option<S>,
    total: S,
}

impl<S: Scalar> Observer<S> for Flight<S> {
    fn sample(&mut self, _: usize, _: &View<S>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn event(&mut self, _: usize, change: Change, view: &View<S>) {
        match change {
            Change::LiftOff if !view.presses(0) && !view.presses(1) => self.since = Some(view.time),
            Change::TouchDown => {
                if let Some(since) = self.since.take() {
                    self.total += view.time - since;
                }
            }
            Change::LiftOff => {}
        }
    }
}

/// What one landing does, as the engineer reads it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LandingReport {
    /// Lean from which the body falls back, share of alpha.
    pub lean: f64,
    /// Effective velocity restitution, sqrt(E after / E before).
    pub restitution: f64,
    /// Its relative error against the restitution asked for.
    pub restitution_error: f64,
    /// Time with both feet in the air [s].
    pub air_s: f64,
    /// Fastest lift-off of the landing foot over the speed at which it touched down; 0 if it stays.
    pub rebound: f64,
    /// Touch-downs until the next peak; 1 if nothing bounces.
    pub touch_downs: usize,
    /// Ripple of the vertical force just before the next impact, share of the weight.
    pub ringing: f64,
    /// Depth at which the landed foot then stands below the unloaded ground [m].
    pub settlement_m: f64,
}

/// What a landing of a body on these springs does; `None` if the run did not finish.
pub fn report(
    body: &Body<f64>,
    chains: &Springs<Chain<f64>>,
    restitution: f64,
    lean: f64,
    control: Control,
) -> Option<LandingReport> {
    let drop = Drop::new(body, restitution, lean);
    let (kept, air_s) = drop.run(body, chains, control)?;
    let effective = kept.max(0.0).sqrt();
    // on to just before the next impact
    let p = body.p_squared().sqrt();
    let next = next_peak(lean, restitution);
    let time = quarter(lean, p) + 1.9 * quarter(next, p);
    let dt = (time / 400.0).min(0.01);
    let quiet = vec![0.0; (time / dt) as usize + 1];
    let case = Case {
        body: *body,
        springs: *chains,
        start: Start::Leaning(lean * body.alpha()),
        dt,
        accel: &quiet,
        scale: 1.0,
        control,
    };
    let mut speeds = Speeds::default();
    case.observe(&mut speeds);
    let history = case.simulate();
    let f = &history.forces.vertical;
    let weight = body.mass * GRAVITY;
    let n = history.motion.len();
    let ripple = |i: usize| {
        let at = |i: usize| f[0][i] + f[1][i];
        (at(i + 1) - 2.0 * at(i) + at(i - 1)).abs() / (4.0 * weight)
    };
    let ringing = (n.saturating_sub(12).max(1)..n.saturating_sub(1)).map(ripple).fold(0.0, f64::max);
    Some(LandingReport {
        lean,
        restitution: effective,
        restitution_error: effective / restitution - 1.0,
        air_s,
        rebound: speeds.rebound,
        touch_downs: speeds.touch_downs,
        ringing,
        // on one foot: the whole weight on k1 and k2 in series
        settlement_m: weight * (chains.vertical.k1.recip() + chains.vertical.k2.recip()),
    })
}

/// Speeds at which the landing foot comes and goes.
#[derive(Default)]
struct Speeds {
    landed: Option<(usize, f64)>,
    rebound: f64,
    touch_downs: usize,
}

impl Observer<f64> for Speeds {
    fn sample(&mut self, _: usize, _: &View<f64>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn event(&mut self, foot: usize, change: Change, view: &View<f64>) {
        let speed = view.gap_speed(foot).abs();
        match (change, self.landed) {
            (Change::TouchDown, None) => (self.landed, self.touch_downs) = (Some((foot, speed)), 1),
            (Change::TouchDown, Some((landed, _))) => self.touch_downs += usize::from(landed == foot),
            (Change::LiftOff, Some((landed, first))) if landed == foot => {
                self.rebound = self.rebound.max(speed / first);
            }
            (Change::LiftOff, _) => {}
        }
    }
}
