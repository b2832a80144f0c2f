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
//! Springs pass if no landing misses e by more than 0.2 % or takes longer than t_a in the
//! air, and if the vertical force has come to rest before the next impact: an absorber that swings
//! on spoils landings that follow each other.
//!
//! E is the energy above that of the body balanced on one foot at theta = 0. An elastic stance
//! sways before it lifts, and this head start (the uplift error) and the error of restitution are
//! all that sets the two models apart to first order. It is counted by the growing part of what it
//! becomes, for the body on one foot is an inverted pendulum: u' + p u. Both are in units of the
//! error of a history (a share 1e-3 of e is worth 1 to 2 %, and more the more impacts).
//!
//! **Another restitution than equation 2's.** While a foot lands fast, all forces pass through it,
//! so that the body keeps its angular momentum about that foot whatever the springs: that is
//! equation 2, and why springs that do not bounce have it. To have another they must bounce: what
//! they give back adds to the body's energy, and what the horizontal springs hold when a foot lifts
//! is lost each time. Landings with Housner's e times 0.9 to 1.02 can be had so, the less exactly
//! the further from 1, at the price of up to 0.5 s in the air a landing. Forces on such springs err
//! by tens of per cent, so that equation 2's springs are mostly the better ones (`job`).

mod landing;
pub mod report;
mod uplift;

use dynamics::compare::LEAST_LEAN;
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Design, Springs},
};
use landing::{Left, Release};
use rocking::structure::Body;
use uplift::UpliftRamp;

/// Leans from which landings are judged and reported, shares of alpha.
pub const LEANS: [f64; 8] = [0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05, LEAST_LEAN];
/// History error per relative error of restitution.
const WEIGHT_RESTITUTION: f64 = 15.0;
/// The same where another restitution than equation 2's is asked for: then that goes first, and the
/// feet may bounce for it.
const WEIGHT_ASKED: f64 = 400.0;
/// Relative difference from equation 2 that counts as another.
const ANOTHER: f64 = 1e-3;
/// Shares of equation 2's restitution between which springs were measured (docs/method.md).
pub const MEASURED_SHARES: (f64, f64) = (0.9, 1.02);
/// History error per second in the air beyond what is allowed.
const WEIGHT_AIR: f64 = 15.0;
/// The same where another restitution is asked for.
const WEIGHT_AIR_ASKED: f64 = 0.5;
/// Time in the air that a landing may take (s), or in periods of the stiffest spring allowed,
/// whichever is longer: a softer spring cannot stop a landing sooner.
const AIR_S: f64 = 0.010;
const AIR_PERIODS: f64 = 1.0;
/// The share of it from which on it counts.
const AIR_FREE: f64 = 0.85;

/// Whether this velocity restitution is another than equation 2's.
pub fn differs_from_housner(body: &Body<f64>, restitution: f64) -> bool {
    (restitution / body.restitution() - 1.0).abs() > ANOTHER
}

/// What is asked of a landing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Criterion {
    /// The energy that it leaves.
    Energy,
    /// The growing part of the distance from Housner's motion that it leaves.
    GrowingPart,
}

/// All scenarios of a structure.
#[derive(Clone, Debug)]
pub(crate) struct WholeModel {
    criterion: Criterion,
    body: Body<f64>,
    restitution: f64,
    /// History error per relative error of restitution, and per second in the air.
    weight: f64,
    weight_air: f64,
    /// Time in the air that a landing may take (s).
    air_s: f64,
    releases: Vec<Release>,
    uplifts: Vec<UpliftRamp>,
}

impl WholeModel {
    /// Scenarios of a body that is to land with velocity restitution `restitution` on springs of
    /// Omega_n up to `max_hz` (Hz).
    pub(crate) fn new(
        body: &Body<f64>,
        restitution: f64,
        max_hz: f64,
        criterion: Criterion,
    ) -> Self {
        let another = differs_from_housner(body, restitution);
        Self {
            criterion,
            body: *body,
            restitution,
            air_s: AIR_S.max(AIR_PERIODS / max_hz),
            weight: if another { WEIGHT_ASKED } else { WEIGHT_RESTITUTION },
            weight_air: if another { WEIGHT_AIR_ASKED } else { WEIGHT_AIR },
            releases: LEANS.iter().map(|&phi| Release::new(body, restitution, phi)).collect(),
            uplifts: uplift::all(body),
        }
    }

    /// All residuals, in a fixed order; infinite where a run did not finish.
    pub(crate) fn residuals(
        &self,
        springs: &Springs<Design<f64>>,
        control: Control,
        effort: &Effort,
    ) -> Vec<f64> {
        let body = &self.body;
        let chains = springs.chains(body.mass);
        let n = self.releases.len();
        let (w_e, w_l) = (self.weight_restitution(), (self.uplifts.len() as f64).sqrt().recip());
        let each: Vec<Vec<f64>> =
            parallel::map_range(0..n + self.uplifts.len(), |i| match self.releases.get(i) {
                Some(release) => match release.run(body, &chains, (control, effort)) {
                    Some(Left { kept, growing, air }) => {
                        let e = if kept > 0.0 { kept.sqrt() / self.restitution } else { 0.0 };
                        let missed = match self.criterion {
                            Criterion::Energy => e - 1.0,
                            Criterion::GrowingPart => growing,
                        };
                        let air = air - AIR_FREE * self.air_s;
                        vec![missed * w_e, if air > 0.0 { air * self.weight_air } else { 0.0 }]
                    }
                    None => vec![f64::INFINITY, 0.0],
                },
                None => {
                    vec![self.uplifts[i - n].uplift_error(body, &chains, (control, effort)) * w_l]
                }
            });
        each.into_iter().flatten().collect()
    }

    /// Weight of a landing's relative error of restitution.
    fn weight_restitution(&self) -> f64 {
        self.weight / (self.releases.len() as f64).sqrt()
    }
}
