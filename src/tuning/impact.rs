//! The impact objective: what springs must do for any record, measured without one.
//!
//! ```text
//!  landings   released at phi alpha, the body lands once on the other foot and swings to its next peak:
//!               r = w_e ( sqrt(E_end/E_start) / e - 1 )             every landing loses what equation (2) says
//!               r = w_a ( time with both feet in the air - 8.5 ms )+
//!  ramps      the ground acceleration swings through the uplift limit within a time tr:
//!               r = ( u' - u'_H ) / ( p R alpha / 4 )               uplift begins when, and as fast as, it should
//! ```
//!
//! E is the energy above that of the body balanced on one foot at theta = 0. The lead of a ramp is the head start that
//! an elastic stance gives the body over Housner's, who starts from rest; it and the error of restitution are all that
//! sets the two models apart to first order, and both are here in units of the error of a history (a share 1e-3 of
//! e is worth about 2 %). Every residual is generic in the scalar, so its gradient by the springs is exact, through the
//! integrator and its events.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::{
    fem::{Case, Change, Control, Observer, Outcome, Start, View, energy_on_one_foot},
    housner,
    scalar::{GRAVITY, Scalar, real},
    spring::{Design, Springs},
    structure::Body,
};

/// Leans from which landings are judged, shares of alpha.
const LEANS: [f64; 8] = [0.9, 0.6, 0.4, 0.25, 0.15, 0.1, 0.06, 0.03];
/// Duration of the ramps [s], as earthquakes have them whatever the structure.
const RAMPS_S: [f64; 3] = [0.03, 0.06, 0.12];
/// Duration of the ramps, in 1/p.
const RAMPS_P: [f64; 3] = [0.06, 0.12, 0.24];
/// Ground acceleration before and after a ramp, in g tan alpha.
const RAMP: (f64, f64) = (-0.8, 1.7);
/// History error per relative error of restitution.
const WEIGHT_RESTITUTION: f64 = 20.0;
/// History error per second in the air beyond what is allowed.
const WEIGHT_AIR: f64 = 5.0;
/// Time in the air that a landing may take [s].
const AIR_S: f64 = 0.0085;

/// A motion that the springs are judged by.
#[derive(Clone, Debug)]
enum Scenario {
    Landing { lean: f64, dt: f64, samples: usize },
    Ramp { dt: f64, accel: Vec<f64>, speed: f64, last: usize },
}

/// All scenarios of a structure.
#[derive(Clone, Debug)]
pub struct Impact {
    body: Body<f64>,
    restitution: f64,
    scenarios: Vec<Scenario>,
}

impl Impact {
    /// Scenarios of a body that is to land with velocity restitution `restitution`.
    pub fn new(body: &Body<f64>, restitution: f64) -> Self {
        let p = body.p_squared().sqrt();
        let quarter = |phi: f64| (1.0 / (1.0 - phi)).acosh() / p;
        let mut scenarios: Vec<Scenario> = LEANS
            .iter()
            .map(|&phi| {
                // to just after the second peak, by the small-angle amplitude and period of theory
                let next = 1.0 - (1.0 - restitution.powi(2) * (1.0 - (1.0 - phi).powi(2))).sqrt();
                let time = 1.12 * (quarter(phi) + quarter(next));
                let dt = (time / 60.0).min(0.05);
                Scenario::Landing { lean: phi * body.alpha(), dt, samples: (time / dt) as usize + 2 }
            })
            .collect();
        scenarios.extend(RAMPS_S.iter().copied().chain(RAMPS_P.iter().map(|t| t / p)).map(|tr| ramp(body, tr)));
        Self { body: *body, restitution, scenarios }
    }

    /// All residuals, in a fixed order; infinite where a run did not finish.
    pub fn residuals<S: Scalar>(&self, springs: &Springs<Design<S>>, control: Control) -> Vec<S> {
        let each: Vec<[S; 2]> = self.scenarios.par_iter().map(|s| self.judge(s, springs, control)).collect();
        let leads = self.scenarios.iter().filter(|s| matches!(s, Scenario::Ramp { .. })).count() as f64;
        let landings = self.scenarios.len() as f64 - leads;
        self.scenarios
            .iter()
            .zip(each)
            .flat_map(|(scenario, [a, b])| match scenario {
                Scenario::Landing { .. } => vec![a * landings.sqrt().recip(), b],
                Scenario::Ramp { .. } => vec![a * leads.sqrt().recip()],
            })
            .collect()
    }

    fn judge<S: Scalar>(&self, scenario: &Scenario, springs: &Springs<Design<S>>, control: Control) -> [S; 2] {
        let body = Body {
            mass: real(self.body.mass),
            half_width: real(self.body.half_width),
            height: real(self.body.height),
            inertia: real(self.body.inertia),
        };
        let chains = springs.chains(body.mass);
        let case = |start, dt, accel| Case { body, springs: chains, start, dt, accel, scale: S::one(), control };
        let lost = [real(f64::INFINITY), S::zero()];
        match scenario {
            &Scenario::Landing { lean, dt, samples } => {
                let quiet = vec![0.0; samples];
                let mut flight = Flight { since: None, total: S::zero() };
                let finish = case(Start::Leaning(real(lean)), dt, &quiet).observe(&mut flight);
                if finish.outcome != Outcome::Completed {
                    return lost;
                }
                let rest = energy_on_one_foot(&body, &chains);
                let kept = (finish.energy.stored - rest) / (finish.energy.initial - rest);
                if kept.re() <= 0.0 {
                    return [real(-WEIGHT_RESTITUTION), S::zero()];
                }
                let e = kept.sqrt() / self.restitution - 1.0;
                let air = flight.total - AIR_S;
                [e * WEIGHT_RESTITUTION, if air.re() > 0.0 { air * WEIGHT_AIR } else { S::zero() }]
            }
            Scenario::Ramp { dt, accel, speed, last } => {
                let first = accel.len() - 1 - last;
                let (mut from, mut to) = (None, None);
                let mut observer = |i: usize, view: &View<S>| {
                    if i == first {
                        from = Some(view.x());
                    } else if i == accel.len() - 1 {
                        to = Some(view.x());
                    }
                    ControlFlow::Continue(())
                };
                let finish = case(Start::Settled, *dt, accel.as_slice()).observe(&mut observer);
                match (from, to) {
                    (Some(from), Some(to)) if finish.outcome == Outcome::Completed => {
                        let unit = self.body.p_squared().sqrt() * self.body.radius() * self.body.alpha() / 4.0;
                        [((to - from) / (*last as f64 * dt) - *speed) / unit, S::zero()]
                    }
                    _ => lost,
                }
            }
        }
    }
}

/// The ground swings from one side to beyond the uplift limit of the other within `tr`.
fn ramp(body: &Body<f64>, tr: f64) -> Scenario {
    let lift = GRAVITY * body.half_width / body.height;
    let dt = tr / 4.0;
    let before = (0.1 / dt).ceil() as usize;
    let after = ((0.08 / dt).ceil() as usize).max(4);
    let mut accel: Vec<f64> = (0..=before).map(|i| RAMP.0 * lift * i as f64 / before as f64).collect();
    accel.extend((1..=4).map(|i| lift * (RAMP.0 + (RAMP.1 - RAMP.0) * i as f64 / 4.0)));
    accel.extend(std::iter::repeat_n(lift * RAMP.1, after));
    let rocking = housner::solve(body, dt, &accel, &housner::Options::default());
    let u: Vec<f64> = rocking.theta.iter().map(|&theta| body.u(theta)).collect();
    let n = u.len();
    let last = ((0.04 / dt).ceil() as usize).clamp(2, n / 2);
    Scenario::Ramp { dt, speed: (u[n - 1] - u[n - 1 - last]) / (last as f64 * dt), accel, last }
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
