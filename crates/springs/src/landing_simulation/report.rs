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
    fem::{Analysis, Change, Control, Observer, Start, View},
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
    let rows = parallel::map(&LEANS, |&lean| landing(body, chains, restitution, lean));
    rows.into_iter().flatten().collect()
}

fn landing(
    body: &Body<f64>,
    chains: &Springs<Chain>,
    restitution: f64,
    lean: f64,
) -> Option<LandingRow> {
    let control = Control::default();
    let uncounted = (control, &Effort::unbounded());
    let Left { kept, air: air_s, .. } =
        Release::new(body, restitution, lean).run(body, chains, uncounted)?;
    let effective = kept.max(0.0).sqrt();
    let mut speeds = Speeds::default();
    with_next(body, chains, restitution, lean, control, |case| case.observe(&mut speeds));
    let ringing = ringing(body, chains, restitution, lean, control);
    let weight = body.mass * GRAVITY;
    Some(LandingRow {
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

/// A landing and the swing after it, up to just before the next impact.
fn with_next<T>(
    body: &Body<f64>,
    chains: &Springs<Chain>,
    restitution: f64,
    lean: f64,
    control: Control,
    run: impl FnOnce(&Analysis) -> T,
) -> T {
    let p = body.p_squared().sqrt();
    let next = next_peak(lean, restitution);
    let time = quarter(lean, p) + 1.9 * quarter(next, p);
    let dt = (time / 400.0).min(0.01);
    let quiet = vec![0.0; (time / dt) as usize + 1];
    run(&Analysis {
        body: *body,
        springs: *chains,
        start: Start::Leaning(lean * body.alpha()),
        dt,
        accel: &quiet,
        vertical: &[],
        scale: 1.0,
        control,
    })
}

/// Ripple of the vertical force just before the impact after the one that follows a release from
/// `lean`, share of the weight.
pub(super) fn ringing(
    body: &Body<f64>,
    chains: &Springs<Chain>,
    restitution: f64,
    lean: f64,
    control: Control,
) -> f64 {
    let history = with_next(body, chains, restitution, lean, control, |case| case.simulate());
    let (f, n) = (&history.forces.vertical, history.motion.len());
    let ripple = |i: usize| {
        let at = |i: usize| f[0][i] + f[1][i];
        (at(i + 1) - 2.0 * at(i) + at(i - 1)).abs() / (4.0 * body.mass * GRAVITY)
    };
    (n.saturating_sub(12).max(1)..n.saturating_sub(1)).map(ripple).fold(0.0, f64::max)
}

/// Speeds at which the landing foot comes and goes.
#[derive(Default)]
struct Speeds {
    landed: Option<(usize, f64)>,
    rebound: f64,
    touch_downs: usize,
}

impl Observer for Speeds {
    fn sample(&mut self, _: usize, _: &View) -> ControlFlow<()> {
        ControlFlow::Continue(())
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
