//! The only foot near the ground of a body without rotational inertia: a massless strut.
//!
//! No moment acts on such a body, so that the force of its only foot passes through the centre of
//! mass: it can but push along the line e from the foot to the mass, as a strut does, and it pushes
//! once the two come nearer to each other than R. A foot that touches the ground while they move
//! apart takes no force: held, it would lift at once; lifted, it would touch at once. In the limit
//! I_cg -> 0 of such chatter neither N nor H is left, and the foot trails: the rotation follows the
//! ground's surface without force,
//!
//! ```text
//!   p_z = a_z      until it presses      e . (v_absorber - v_mass) > 0
//!                  or the ground recedes from a foot that keeps its rotation rate,  p_z'' > a_z'' at theta'' = 0
//! ```
//!
//! A vertical ground acceleration moves mass and absorber alike (but for I_cg/R^2, less than 2e-3
//! of the mass, see `model`).

use super::model::{Model, Pose, State, TH, X, Z, ax, az};
use rocking::scalar::GRAVITY;

/// What ends the trailing of a foot, each once it is positive.
pub(super) struct Strut {
    /// Rate at which mass and absorber come nearer along the strut (m/s).
    pub press: f64,
    /// Acceleration at which the foot would leave the ground (m/s2).
    pub lift: f64,
}

impl Model {
    /// Whether the body on one foot is a strut: no inertia, no member, no slip.
    pub(super) fn is_strut(&self) -> bool {
        self.massless() && self.is_plain()
    }

    /// Foot i as the only one near the ground.
    pub(super) fn strut(&self, i: usize, state: &State) -> Strut {
        let State { q, v } = state;
        let Pose { sin, cos } = Pose::of(q);
        let (_, _, px_th, pz_th) = self.foot(i, q, sin, cos);
        // from the foot to the mass: (dp_z, -dp_x)
        let apart = (v[X] - v[ax(i)]) * pz_th - (v[Z] - v[az(i)]) * px_th;
        let chain = &self.springs.vertical;
        let absorber = -(chain.k2 * q[az(i)] + chain.c * v[az(i)]) / chain.m2;
        let foot = -self.body.mass * GRAVITY / self.translation - px_th * v[TH] * v[TH];
        Strut { press: -apart / self.body.radius(), lift: foot - absorber }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::{Dual64, DualNum};

    use super::*;
    use crate::{
        fem::model::{Contact, Foot},
        spring::{Chain, Springs},
    };
    use rocking::structure::Body;

    fn model() -> Model {
        let chain = |k1: f64| Chain { k1, k2: 0.3 * k1, m2: 40.0, c: 2e3 };
        let body = Body { mass: 100.0, half_width: 1.2, height: 2.5, inertia: 0.0 };
        Model::new(&body, &Springs { vertical: chain(1e6), horizontal: chain(3e6) })
    }

    const Q: [f64; 7] = [0.1, -0.02, 0.03, 0.01, -0.004, 0.002, -0.03];
    const V: [f64; 7] = [0.3, -0.1, 0.2, 0.05, -0.2, 0.07, 0.13];

    /// The distance from the mass to the point under the foot that moves with the absorber, by dual
    /// numbers.
    #[test]
    fn it_presses_as_mass_and_absorber_come_nearer() {
        let model = model();
        for i in 0..2 {
            let (sin, cos) = Q[TH].sin_cos();
            let (_, _, px_th, pz_th) = model.foot(i, &Q, sin, cos);
            let (x, z) =
                (Dual64::new(pz_th, V[X] - V[ax(i)]), Dual64::new(-px_th, V[Z] - V[az(i)]));
            let distance = (x * x + z * z).sqrt();
            assert!((distance.re - model.body.radius()).abs() < 1e-12);
            let press = model.strut(i, &State { q: Q, v: V }).press;
            assert!((press + distance.eps).abs() < 1e-14, "{press} {}", distance.eps);
        }
    }

    /// Foot and absorber in free flight, the rotation rate kept: the gap's second derivative along
    /// their motion.
    #[test]
    fn it_lifts_as_the_foot_in_flight_leaves_the_ground() {
        let model = model();
        let feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
        let (forces, masses) = (model.forces(&Q, &V, &feet, [0.0; 2]), model.masses(&feet));
        for i in 0..feet.len() {
            let moving = |t: f64| {
                let q =
                    std::array::from_fn(|k| Q[k] + V[k] * t + 0.5 * forces[k] / masses[k] * t * t);
                model.compression(i, &q)
            };
            let t = 1e-4;
            let second = (moving(t) - 2.0 * moving(0.0) + moving(-t)) / (t * t);
            let lift = model.strut(i, &State { q: Q, v: V }).lift;
            // rounding of a gap of 0.1 m over t^2: 1e-9; the motion's next terms: t^2
            assert!((lift + second).abs() < 1e-6 * lift.abs().max(1.0), "{lift} {second}");
        }
    }

    /// On one foot without horizontal force the rotation has no balance but N = 0.
    #[test]
    fn a_trailing_foot_takes_no_force() {
        let model = model();
        let mut state = State { q: Q, v: V };
        for i in 0..2 {
            let mut feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
            feet[i].contact = Contact::Trail;
            assert!(model.turn_to_balance(&mut state, &feet));
            let force = model.contact(&state.q, &feet)[i];
            assert!(
                force.horizontal == 0.0 && force.vertical.abs() < 1e-9 * 100.0 * GRAVITY,
                "{force:?}"
            );
            assert!(!feet[i].presses());
            model.rotate_in_balance(&mut state, &feet);
            assert!(model.compression_rate(i, &state).abs() < 1e-14);
        }
    }
}
