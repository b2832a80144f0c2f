//! One landing: the body is released at rest from a lean, lands on the other foot and swings to its
//! next peak.
//!
//! ```text
//!  growing part   (du' + p du) / u_H',  du = u - u_H      averaged over the rise to the next peak
//! ```
//!
//! of the distance from Housner's free rocking: the body on one foot is an inverted pendulum, so
//! that this part of a head start grows with exp(p t) and the other part dies. It counts what a
//! landing leaves, too fast or too early.

use std::ops::ControlFlow;

use dynamics::{
    effort::Effort,
    fem::{Analysis, Change, Control, HistoryOutcome, Observer, Start, View, energy_on_one_foot},
    spring::{Chain, Springs},
};
use rocking::{housner, structure::Body};

/// A release at rest.
#[derive(Clone, Debug)]
pub(super) struct Release {
    lean: f64,
    dt: f64,
    /// Samples to just after the next peak.
    samples: usize,
    /// Those on the rise to it, between which the growing part is averaged.
    rise: std::ops::Range<usize>,
    /// Housner's u (m) and u' (m/s) there.
    housner: Vec<(f64, f64)>,
    p: f64,
}

/// Share of the rise to the next peak over which the growing part is averaged.
const RISE: (f64, f64) = (0.3, 0.8);

/// A release ends before so many rises after its landing: the next landing is two after it.
const BEFORE_THE_NEXT: f64 = 1.7;

/// What a landing left.
pub(super) struct Left {
    /// Share of the energy that is left.
    pub kept: f64,
    /// The growing part.
    pub growing: f64,
    /// Time with both feet in the air (s).
    pub air: f64,
}

/// Time from a lean of phi alpha to the upright, or back, by the small-angle theory (s).
pub(super) fn quarter(phi: f64, p: f64) -> f64 {
    // acosh, which the standard library computes itself, and not alike in every version of it
    let x = 1.0 / (1.0 - phi);
    (x + ((x - 1.0) * (x + 1.0)).sqrt()).ln() / p
}

/// The next peak after phi: 1 - sqrt(1 - e^2 [1 - (1 - phi)^2]).
pub(super) fn next_peak(phi: f64, restitution: f64) -> f64 {
    1.0 - (1.0 - restitution.powi(2) * (1.0 - (1.0 - phi).powi(2))).max(0.0).sqrt()
}

impl Release {
    /// From phi alpha of a body that lands with `restitution`.
    pub(crate) fn new(body: &Body<f64>, restitution: f64, phi: f64) -> Self {
        let p = body.p();
        let (fall, rise) = (quarter(phi, p), quarter(next_peak(phi, restitution), p));
        let time = 1.12 * (fall + rise);
        let dt = time / 30.0;
        let samples = (time / dt) as usize + 2;
        let lean = phi * body.alpha();
        let options = housner::RockingOptions {
            restitution: Some(restitution),
            initial: Some((lean, 0.0)),
            ..Default::default()
        };
        let rocking = housner::solve(body, dt, &vec![0.0; samples], &options);
        // the exact fall takes a little longer than the small-angle one
        let landed = rocking.impacts.first().map_or(fall, |impact| impact.time);
        // a body that keeps little of its speed lands again soon
        let samples = samples.min(((landed + BEFORE_THE_NEXT * rise) / dt) as usize + 1);
        let at = |share: f64| ((landed + share * rise) / dt).round() as usize;
        let rise = at(RISE.0)..at(RISE.1).min(samples - 1).max(at(RISE.0) + 1);
        let motion = |i: usize| {
            let (theta, rate) = (
                rocking.theta.get(i).copied().unwrap_or(0.0),
                rocking.rate.get(i).copied().unwrap_or(0.0),
            );
            let slope = body.half_width * theta.signum() * theta.sin() + body.height * theta.cos();
            (body.u(theta), slope * rate)
        };
        Self { lean, dt, samples, housner: rise.clone().map(motion).collect(), rise, p }
    }

    /// Release the body on these springs; `None` unless the run finished.
    pub(crate) fn run(
        &self,
        body: &Body<f64>,
        chains: &Springs<Chain>,
        (control, effort): (Control, &Effort),
    ) -> Option<Left> {
        let quiet = vec![0.0; self.samples];
        let mut flight = LandingWatch { release: self, since: None, air: 0.0, growing: 0.0 };
        let case = Analysis {
            start: Start::Leaning(self.lean),
            control,
            ..Analysis::new(*body, *chains, self.dt, &quiet)
        };
        let finish = case.observe(&mut flight);
        finish.spend(effort);
        if finish.outcome != HistoryOutcome::Completed {
            return None;
        }
        let rest = energy_on_one_foot(body, chains);
        Some(Left {
            kept: (finish.energy.stored - rest) / (finish.energy.initial - rest),
            growing: flight.growing / self.rise.len() as f64,
            air: flight.air,
        })
    }
}

/// Sums the growing part and the time with both feet in the air.
struct LandingWatch<'a> {
    release: &'a Release,
    since: Option<f64>,
    air: f64,
    growing: f64,
}

impl Observer for LandingWatch<'_> {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        let Release { rise, housner, p, .. } = self.release;
        if rise.contains(&index) {
            let (u, speed) = housner[index - rise.start];
            self.growing += (view.speed() - speed + (view.x() - u) * *p) / speed;
        }
        ControlFlow::Continue(())
    }

    fn event(&mut self, _: usize, change: Change, view: &View) {
        match change {
            Change::LiftOff if !view.presses(0) && !view.presses(1) => self.since = Some(view.time),
            Change::TouchDown => {
                if let Some(since) = self.since.take() {
                    self.air += view.time - since;
                }
            }
            Change::LiftOff => {}
        }
    }
}
