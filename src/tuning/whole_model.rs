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
//! Springs are in order if no landing misses e by more than 0.2 % or takes longer than t_a in the air, and if the vertical
//! force has come to rest before the next impact: an absorber that swings on spoils landings that follow each other.
//!
//! E is the energy above that of the body balanced on one foot at theta = 0. An elastic stance sways before it lifts, and
//! this head start (the lead) and the error of restitution are all that sets the two models apart to first order. The
//! lead is counted by the growing part of what it becomes, for the body on one foot is an inverted pendulum: u' + p u.
//! Both are in units of the error of a history (a share 1e-3 of e is worth 1 to 2 %, and more the more impacts). Every
//! residual is generic in the scalar, so its gradient by the springs is exact, through the integrator and its events.
//!
//! **Another restitution than equation 2's.** While a foot lands fast, all forces pass through it, so that the body keeps its
//! angular momentum about that foot whatever the springs: that is equation 2, and why springs that do not bounce have it.
//! To have another they must bounce: what they give back adds to the body's energy, and what the horizontal springs hold
//! when a foot lifts is lost each time. Housner's e times 0.9 to 1.02 can be had so, at the price of up to 0.5 s in the air a
//! landing.

mod landing;
pub mod report;
mod uplift;

use rayon::prelude::*;

use crate::{
    compare::LEAST_LEAN,
    fem::Control,
    scalar::{Scalar, real},
    spring::{Design, Springs},
    structure::Body,
};
use landing::Drop;
use uplift::Uplift;

/// Leans from which landings are judged and reported, shares of alpha.
pub const LEANS: [f64; 8] = [0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05, LEAST_LEAN];
/// History error per relative error of restitution.
const WEIGHT_RESTITUTION: f64 = 15.0;
/// The same where another restitution than equation 2's is asked for: then that goes first, and the feet may bounce for it.
const WEIGHT_ASKED: f64 = 400.0;
/// Relative difference from equation 2 that counts as another.
const ANOTHER: f64 = 1e-3;
/// History error per second in the air beyond what is allowed.
const WEIGHT_AIR: f64 = 15.0;
/// The same where another restitution is asked for.
const WEIGHT_AIR_ASKED: f64 = 0.5;
/// Time in the air that a landing may take [s], or in periods of the stiffest spring allowed, whichever is longer: a softer
/// spring cannot stop a landing sooner.
const AIR_S: f64 = 0.010;
const AIR_PERIODS: f64 = 1.0;
/// The share of it from which on it counts.
const AIR_FREE: f64 = 0.85;
/// Leans from which the ringing is judged: it is much the same from all between 0.7 and 0.2.
const RINGING_LEANS: [f64; 2] = [0.5, 0.2];
/// Largest relative error of restitution of a landing that is in order.
const RESTITUTION_ERROR: f64 = 2e-3;

/// Whether this velocity restitution is another than equation 2's.
pub fn is_another(body: &Body<f64>, restitution: f64) -> bool {
    (restitution / body.restitution() - 1.0).abs() > ANOTHER
}

/// All scenarios of a structure.
#[derive(Clone, Debug)]
pub struct WholeModel {
    body: Body<f64>,
    restitution: f64,
    /// History error per relative error of restitution, and per second in the air.
    weight: f64,
    weight_air: f64,
    /// Time in the air that a landing may take [s].
    air_s: f64,
    drops: Vec<Drop>,
    uplifts: Vec<Uplift>,
    another: bool,
}

impl WholeModel {
    /// Scenarios of a body that is to land with velocity restitution `restitution` on springs of Omega_n up to `max_hz` [Hz].
    pub fn new(body: &Body<f64>, restitution: f64, max_hz: f64) -> Self {
        let another = is_another(body, restitution);
        Self {
            another,
            body: *body,
            restitution,
            air_s: AIR_S.max(AIR_PERIODS / max_hz),
            weight: if another { WEIGHT_ASKED } else { WEIGHT_RESTITUTION },
            weight_air: if another { WEIGHT_AIR_ASKED } else { WEIGHT_AIR },
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
        let body = Body {
            mass: real(self.body.mass),
            half_width: real(self.body.half_width),
            height: real(self.body.height),
            inertia: real(self.body.inertia),
        };
        let chains = springs.chains(body.mass);
        let n = self.drops.len();
        let (w_e, w_l) = (self.weight_restitution(), (self.uplifts.len() as f64).sqrt().recip());
        let each: Vec<Vec<S>> = (0..n + self.uplifts.len())
            .into_par_iter()
            .with_max_len(1)
            .map(|i| match self.drops.get(i) {
                Some(drop) => match drop.run(&body, &chains, control) {
                    Some((kept, air)) => {
                        let e = if kept.re() > 0.0 { kept.sqrt() / self.restitution } else { S::zero() };
                        let air = air - AIR_FREE * self.air_s;
                        vec![(e - 1.0) * w_e, if air.re() > 0.0 { air * self.weight_air } else { S::zero() }]
                    }
                    None => vec![real(f64::INFINITY), S::zero()],
                },
                None => vec![self.uplifts[i - n].lead(&body, &chains, control) * w_l],
            })
            .collect();
        each.into_iter().flatten().collect()
    }

    /// Whether the landings from all leans are in order by the residuals of springs: none misses the restitution wanted by
    /// more than 0.2 %, none keeps both feet in the air for longer than 10 ms and a period of the stiffest spring allowed.
    pub fn in_order(&self, residuals: &[f64]) -> bool {
        self.disorder(residuals, 1.0) <= 0.0
    }

    /// By how much the landings are out of order, were only this share (0.85 to 1) of either limit allowed: the sum over
    /// leans of what goes beyond, in limits. Zero if none is.
    pub fn disorder(&self, residuals: &[f64], share: f64) -> f64 {
        let most_error = share * RESTITUTION_ERROR * self.weight_restitution();
        let most_air = share * self.air_s * self.weight_air;
        // residuals count the time in the air from this on
        let free = AIR_FREE * self.air_s * self.weight_air;
        let landings = residuals[..2 * self.drops.len()].chunks_exact(2);
        let error = |r: &[f64]| (r[0].abs() - most_error).max(0.0) / most_error;
        let air = |r: &[f64]| (r[1] - (most_air - free)).max(0.0) / most_air;
        landings.map(|r| error(r) + air(r)).sum()
    }

    /// Ripple of the vertical force that landings on springs leave to the next impact, share of the weight.
    pub fn ringing(&self, springs: &Springs<Design<f64>>) -> f64 {
        // what hardly damps rings on at a fine tolerance only
        let control = Control::default();
        let chains = springs.chains(self.body.mass);
        let each: Vec<f64> = RINGING_LEANS
            .par_iter()
            .map(|&lean| report::ringing(&self.body, &chains, self.restitution, lean, control))
            .collect();
        each.into_iter().fold(0.0, f64::max)
    }

    /// Weight of a landing's relative error of restitution.
    fn weight_restitution(&self) -> f64 {
        self.weight / (self.drops.len() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Structure;

    /// Chains found by search, one that absorbs by a light mass in resonance and a plain one, and Table 1's, which rebounds.
    #[test]
    fn landings_on_plastic_chains_are_in_order_and_on_table_1_they_are_not() {
        let body = Structure::paper().body::<f64>();
        let impact = WholeModel::new(&body, body.restitution(), 160.0);
        let in_order = |v: [f64; 4], h: [f64; 4]| {
            let chain = |[hz, k, c, mu]: [f64; 4]| Design::from_kc(mu, k, c, hz);
            let springs = Springs { vertical: chain(v), horizontal: chain(h) };
            impact.in_order(&impact.residuals(&springs, Control::search()))
        };
        assert!(in_order([160.0, 0.20539, 36.9068, 1.10888], [77.9056, 0.01895, 0.01102, 0.00566]));
        assert!(in_order([160.0, 0.13868, 0.85004, 0.50195], [160.0, 21.2428, 0.74129, 0.054]));
        assert!(!in_order([160.0, 9.214, 4.4, 10.2], [160.0, 9.214, 4.4, 10.2]));
    }

    /// Landings that miss both limits by known factors.
    #[test]
    fn disorder_is_what_goes_beyond_the_limits_in_limits() {
        let body = Structure::paper().body::<f64>();
        let impact = WholeModel::new(&body, body.restitution(), 160.0);
        let residuals = |error: f64, air: f64| {
            let mut residuals = vec![0.0; 2 * LEANS.len() + impact.uplifts.len()];
            residuals[4] = -error * WEIGHT_RESTITUTION / (LEANS.len() as f64).sqrt();
            residuals[7] = ((air - 0.0085) * WEIGHT_AIR).max(0.0);
            residuals
        };
        for (error, air, share, expected) in [
            (0.0, 0.0, 1.0, 0.0),
            (0.0019, 0.0099, 1.0, 0.0),
            (0.0019, 0.0099, 0.9, 0.0019 / 0.0018 - 1.0 + 0.1),
            (0.005, 0.0, 1.0, 1.5),
            (0.0, 0.025, 1.0, 1.5),
            (0.004, 0.02, 1.0, 2.0),
        ] {
            let residuals = residuals(error, air);
            assert!((impact.disorder(&residuals, share) - expected).abs() < 1e-12, "{error} {air} {share}");
            assert_eq!(impact.in_order(&residuals), expected == 0.0 || share < 1.0);
        }
    }
}
