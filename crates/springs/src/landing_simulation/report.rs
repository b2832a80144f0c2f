//! What landings on given springs do, from large leans to small, without any record.
//!
//! ```text
//!  restitution   sqrt( E after / E before ), E the energy above that of the body balanced on one foot at theta = 0,
//!                from the release to the next peak: what equation (2) is compared with
//!  rebound       fastest upward speed with which the landing foot lifts over that with which it first touches down
//!  ringing       |N(i+1) - 2 N(i) + N(i-1)| / 4 m g, the largest just before the next impact
//! ```

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::{
    LEANS,
    landing::{Left, Release, next_peak, quarter},
};
use dynamics::{
    effort::Effort,
    fem::{Analysis, Change, Control, Finish, Observer, Start, View, histories},
    spring::{Chain, Springs},
};
use rocking::{scalar::GRAVITY, structure::Body};

/// What one landing does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LandingRow {
    /// Lean from which the body falls back, share of alpha.
    pub lean: f64,
    /// Effective velocity restitution, sqrt(E after / E before).
    pub restitution: f64,
    /// Its relative error against the restitution asked for.
    pub restitution_error: f64,
    /// Time with both feet in the air (s).
    pub air_s: f64,
    /// Fastest upward speed with which the landing foot lifts, over the speed with which it touched
    /// down; 0 if it stays or only sinks.
    pub rebound: f64,
    /// Touch-downs until the next peak; 1 if nothing bounces.
    pub touch_downs: usize,
    /// Ripple of the vertical force just before the next impact, share of the weight.
    pub ringing: f64,
    /// Depth at which the landed foot then stands below the unloaded ground (m).
    pub settlement_m: f64,
}

/// Landings of a body on these springs, which shall have the velocity restitution `restitution`;
/// one whose run did not finish is left out.
pub fn landings(body: &Body<f64>, chains: &Springs<Chain>, restitution: f64) -> Vec<LandingRow> {
    let control = Control::default();
    let left = parallel::map(&LEANS, |&lean| {
        Release::new(body, restitution, lean).run(body, chains, (control, &Effort::unbounded()))
    });
    let swings = LEANS.map(|lean| Swing::new(body, restitution, lean));
    let cases: Vec<Analysis> =
        swings.iter().map(|swing| swing.case(body, chains, control)).collect();
    let followed = histories(&cases, |_| SwingWatch::default());
    // on one foot: the whole weight on k1 and k2 in series
    let weight = body.mass * GRAVITY;
    let settlement_m = weight * (chains.vertical.k1.recip() + chains.vertical.k2.recip());
    let row = |(lean, (left, (watch, _))): (f64, (Option<Left>, (SwingWatch, Finish)))| {
        let Left { kept, air: air_s, .. } = left?;
        let effective = kept.max(0.0).sqrt();
        Some(LandingRow {
            lean,
            restitution: effective,
            restitution_error: effective / restitution - 1.0,
            air_s,
            rebound: watch.rebound,
            touch_downs: watch.touch_downs,
            ringing: watch.ringing(weight),
            settlement_m,
        })
    };
    LEANS.into_iter().zip(left.into_iter().zip(followed)).filter_map(row).collect()
}

/// A landing and the swing after it, up to just before the next impact.
struct Swing {
    /// The lean from which the body is released (rad).
    start: f64,
    dt: f64,
    /// The ground's acceleration.
    quiet: Vec<f64>,
}

impl Swing {
    fn new(body: &Body<f64>, restitution: f64, lean: f64) -> Self {
        let p = body.p();
        let next = next_peak(lean, restitution);
        let time = quarter(lean, p) + 1.9 * quarter(next, p);
        let dt = (time / 400.0).min(0.01);
        Self { start: lean * body.alpha(), dt, quiet: vec![0.0; (time / dt) as usize + 1] }
    }

    fn case(&self, body: &Body<f64>, chains: &Springs<Chain>, control: Control) -> Analysis<'_> {
        Analysis {
            start: Start::Leaning(self.start),
            control,
            ..Analysis::new(*body, *chains, self.dt, &self.quiet)
        }
    }
}

/// Speeds at which the landing foot comes and goes, and the force on the ground.
#[derive(Default)]
struct SwingWatch {
    /// Vertical force of each foot (N): the largest since the last sample.
    largest: [f64; 2],
    /// The sum of both at every sample.
    vertical: Vec<f64>,
    /// The landed foot, and the speed with which it came (m/s).
    landed: Option<(usize, f64)>,
    rebound: f64,
    touch_downs: usize,
}

impl SwingWatch {
    /// Largest ripple of the force just before the end, share of the weight; `weight` in N.
    fn ringing(&self, weight: f64) -> f64 {
        let (n, f) = (self.vertical.len(), &self.vertical);
        let ripple = |i: usize| (f[i + 1] - 2.0 * f[i] + f[i - 1]).abs() / (4.0 * weight);
        (n.saturating_sub(12).max(1)..n.saturating_sub(1)).map(ripple).fold(0.0, f64::max)
    }
}

impl Observer for SwingWatch {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        if index == 0 {
            self.step(view);
        }
        let [left, right] = std::mem::take(&mut self.largest);
        self.vertical.push(left + right);
        ControlFlow::Continue(())
    }

    fn step(&mut self, view: &View) {
        for (foot, largest) in self.largest.iter_mut().enumerate() {
            let force = view.vertical_force(foot);
            if force.abs() > largest.abs() {
                *largest = force;
            }
        }
    }

    fn event(&mut self, foot: usize, change: Change, view: &View) {
        let speed = view.foot_speed(foot);
        match (change, self.landed) {
            (Change::TouchDown, None) => {
                (self.landed, self.touch_downs) = (Some((foot, -speed)), 1)
            }
            (Change::TouchDown, Some((landed, _))) => {
                self.touch_downs += usize::from(landed == foot)
            }
            (Change::LiftOff, Some((landed, first))) if landed == foot => {
                self.rebound = self.rebound.max(speed / first);
            }
            (Change::LiftOff, _) => {}
        }
    }
}
