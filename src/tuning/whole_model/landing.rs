//! One landing: the body falls back from a lean, lands on the other foot and swings to its next peak.

use std::ops::ControlFlow;

use crate::{
    fem::{Case, Change, Control, Observer, Outcome, Start, View, energy_on_one_foot},
    scalar::{Scalar, real},
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
pub(super) fn quarter(phi: f64, p: f64) -> f64 {
    (1.0 / (1.0 - phi)).acosh() / p
}

/// The next peak after phi: 1 - sqrt(1 - e^2 [1 - (1 - phi)^2]).
pub(super) fn next_peak(phi: f64, restitution: f64) -> f64 {
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
