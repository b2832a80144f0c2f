//! The impact objective: what springs must do for any record, measured without one.
//!
//! ```text
//!  landings   released at phi alpha, the body lands once on the other foot and swings to its next peak:
//!               r = w_e ( sqrt(E_end/E_start) / e - 1 )             every landing loses what equation (2) says
//!               r = w_a ( time with both feet in the air - 8.5 ms )+
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
/// Time in the air that a landing may take [s].
const AIR_S: f64 = 0.0085;

/// All scenarios of a structure.
#[derive(Clone, Debug)]
pub struct Impact {
    body: Body<f64>,
    restitution: f64,
    weight: f64,
    drops: Vec<Drop>,
    uplifts: Vec<Uplift>,
}

impl Impact {
    /// Scenarios of a body that is to land with velocity restitution `restitution`.
    pub fn new(body: &Body<f64>, restitution: f64) -> Self {
        let another = (restitution / body.restitution() - 1.0).abs() > ANOTHER;
        Self {
            body: *body,
            restitution,
            weight: if another { WEIGHT_ASKED } else { WEIGHT_RESTITUTION },
            drops: LEANS.iter().map(|&phi| Drop::new(body, restitution, phi)).collect(),
            uplifts: uplift::all(body),
        }
    }

    /// All residuals, in a fixed order; infinite where a run did not finish.
    pub fn residuals<S: Scalar>(&self, springs: &Springs<Design<S>>, control: Control) -> Vec<S> {
        let body = Body {
            mass: real(self.body.mass),
            half_width: real(self.body.half_width),
            height: real(self.body.height),
            inertia: real(self.body.inertia),
        };
        let chains = springs.chains(body.mass);
        let n = self.drops.len();
        let (w_e, w_l) = (self.weight / (n as f64).sqrt(), (self.uplifts.len() as f64).sqrt().recip());
        let each: Vec<Vec<S>> = (0..n + self.uplifts.len())
            .into_par_iter()
            .with_max_len(1)
            .map(|i| match self.drops.get(i) {
                Some(drop) => match drop.run(&body, &chains, control) {
                    Some((kept, air)) => {
                        let e = if kept.re() > 0.0 { kept.sqrt() / self.restitution } else { S::zero() };
                        let air = air - AIR_S;
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
