//! The impact objective: what springs must do for any record, measured without one.
//!
//! ```text
//!  landings   released at phi alpha, the body lands once on the other foot and swings to its next peak:
//!               r = w_e ( sqrt(E_end/E_start) / e - 1 )             every landing loses what equation (2) says
//!               r = w_a ( time with both feet in the air - 0.85 t_a )+          t_a = 10 ms, or one period of the stiffest spring
//!  uplifts    the ground acceleration swings through the uplift limit:
//!               r = ( du' + p du ) / ( p R alpha / 4 ),  du = u - u_H    uplift begins when, and as fast as, it should
//! ```
//!
//! E is the energy above that of the body balanced on one foot at theta = 0. An elastic stance sways before it lifts, and
//! this head start (the lead) and the error of restitution are all that sets the two models apart to first order. The
//! lead is counted by the growing part of what it becomes, for the body on one foot is an inverted pendulum: u' + p u.
//! Both are in units of the error of a history (a share 1e-3 of e is worth 2 to 6 %, the more impacts the more). Every residual is generic in the
//! scalar, so its gradient by the springs is exact, through the integrator and its events.
//!
//! **Another restitution than equation 2's.** While a foot lands fast, all forces pass through it, so that the body keeps its
//! angular momentum about that foot whatever the springs: that is equation 2, and why springs that do not bounce have it.
//! To have another they must bounce: what they give back adds to the body's energy, and what the horizontal springs hold
//! when a foot lifts is lost each time. Housner's e times 0.95 to 1.02 can be had so, at the price of up to
//! 0.17 s in the air a landing; for blocks, which have inertia of their own, 0.9 too.

mod landing;
pub mod order;
pub mod report;
mod uplift;

use rayon::prelude::*;

use crate::{
    fem::Control,
    scalar::{Scalar, real},
    spring::{Design, Springs},
    structure::Body,
};
use landing::Drop;
use uplift::Uplift;

/// Leans from which landings are judged, shares of alpha.
const LEANS: [f64; 8] = [0.9, 0.6, 0.4, 0.25, 0.15, 0.1, 0.05, 0.02];
/// History error per relative error of restitution.
const WEIGHT_RESTITUTION: f64 = 40.0;
/// The same where another restitution than equation 2's is asked for: then that goes first, and the feet may bounce for it.
const WEIGHT_ASKED: f64 = 400.0;
/// Relative difference from equation 2 that counts as another.
const ANOTHER: f64 = 1e-3;
/// History error per second in the air beyond what is allowed.
const WEIGHT_AIR: f64 = 15.0;
/// Time in the air that a landing may take [s], or in periods of the stiffest spring allowed, whichever is longer: a softer
/// spring cannot stop a landing sooner.
const AIR_S: f64 = 0.010;
const AIR_PERIODS: f64 = 1.0;
/// The share of it from which on it counts.
const AIR_FREE: f64 = 0.85;

/// All scenarios of a structure.
#[derive(Clone, Debug)]
pub struct Impact {
    body: Body<f64>,
    restitution: f64,
    weight: f64,
    /// Time in the air that a landing may take [s].
    air_s: f64,
    drops: Vec<Drop>,
    uplifts: Vec<Uplift>,
    another: bool,
}

impl Impact {
    /// Scenarios of a body that is to land with velocity restitution `restitution` on springs of Omega_n up to `max_hz` [Hz].
    pub fn new(body: &Body<f64>, restitution: f64, max_hz: f64) -> Self {
        let another = (restitution / body.restitution() - 1.0).abs() > ANOTHER;
        Self {
            another,
            body: *body,
            restitution,
            air_s: AIR_S.max(AIR_PERIODS / max_hz),
            weight: if another { WEIGHT_ASKED } else { WEIGHT_RESTITUTION },
            drops: LEANS.iter().map(|&phi| Drop::new(body, restitution, phi)).collect(),
            uplifts: uplift::all(body),
        }
    }

    /// Whether another restitution than equation 2's is asked for.
    pub fn another(&self) -> bool {
        self.another
    }

    /// All residuals, in a fixed order; infinite where a run did not finish.
    pub fn residuals<S: Scalar>(&self, springs: &Springs<Design<S>>, control: Control) -> Vec<S> {
        self.run(springs, control, self.drops.len() + self.uplifts.len())
    }

    /// The residuals of the landings alone: restitution and time in the air of each.
    fn landings(&self, springs: &Springs<Design<f64>>, control: Control) -> Vec<f64> {
        self.run(springs, control, self.drops.len())
    }

    /// Weight of a landing's relative error of restitution.
    fn weight_restitution(&self) -> f64 {
        self.weight / (self.drops.len() as f64).sqrt()
    }

    /// The residuals of the first `scenarios`, landings before uplifts.
    fn run<S: Scalar>(&self, springs: &Springs<Design<S>>, control: Control, scenarios: usize) -> Vec<S> {
        let body = Body {
            mass: real(self.body.mass),
            half_width: real(self.body.half_width),
            height: real(self.body.height),
            inertia: real(self.body.inertia),
        };
        let chains = springs.chains(body.mass);
        let n = self.drops.len();
        let (w_e, w_l) = (self.weight_restitution(), (self.uplifts.len() as f64).sqrt().recip());
        let each: Vec<Vec<S>> = (0..scenarios)
            .into_par_iter()
            .with_max_len(1)
            .map(|i| match self.drops.get(i) {
                Some(drop) => match drop.run(&body, &chains, control) {
                    Some((kept, air)) => {
                        let e = if kept.re() > 0.0 { kept.sqrt() / self.restitution } else { S::zero() };
                        let air = air - AIR_FREE * self.air_s;
                        vec![(e - 1.0) * w_e, if air.re() > 0.0 { air * WEIGHT_AIR } else { S::zero() }]
                    }
                    None => vec![real(f64::INFINITY), S::zero()],
                },
                None => vec![self.uplifts[i - n].lead(&body, &chains, control) * w_l],
            })
            .collect();
        each.into_iter().flatten().collect()
    }
}
