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

use super::element::Element;
use super::model::{Contact, Foot, Model, N, Pose, State, TH, X, Z, ax, az};
use rocking::scalar::GRAVITY;

/// What ends the trailing of a foot, each once it is positive.
pub(super) struct Strut {
    /// Rate at which mass and absorber come nearer along the strut (m/s).
    pub press: f64,
    /// Acceleration at which the foot would leave the ground (m/s2).
    pub lift: f64,
}

impl Model {
    /// Whether the body on one foot is a strut: no inertia, no slip. A tendon pulls on the mass;
    /// what little moment dampers have, a trailing foot takes up.
    pub(super) fn is_strut(&self) -> bool {
        self.massless() && !self.law.slips()
    }

    /// Force (N, zero or less) below which foot i lifts as the only one on the ground. The moment
    /// of dampers that pull the other foot down is taken up by this one; without rotational inertia
    /// it would let go before its thrust along the strut ends, touch at once, and chatter on so
    /// until the thrust outweighs the dampers. It is held until that thrust ends, as without them.
    pub(super) fn lets_go_at(&self, i: usize, State { q, v }: &State) -> f64 {
        let Some(dampers) = self.elements.dampers.filter(|_| self.jumps()) else { return 0.0 };
        let (_, pz_th) = self.compression_and_slope(i, q);
        (dampers.force(q, v)[TH] / pz_th).min(0.0)
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
        let members = self.elements_under(&[Foot { contact: Contact::Open, anchor: 0.0 }; 2]);
        let mut flying = [0.0; N];
        flying[Z] = -self.body.mass * GRAVITY;
        members.add_forces(q, v, &mut flying);
        let foot = flying[Z] / self.translation - px_th * v[TH] * v[TH];
        Strut { press: -apart / self.body.radius(), lift: foot - absorber }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::{Dual64, DualNum};

    use super::*;
    use crate::spring::{Chain, Springs};
    use rocking::{
        members::{Damper, Members, Tendon},
        structure::Body,
    };

    fn with(members: Members) -> Model {
        let chain = |k1: f64| Chain { k1, k2: 0.3 * k1, m2: 40.0, c: 2e3 };
        let body = Body { mass: 100.0, half_width: 1.2, height: 2.5, inertia: 0.0 };
        let springs = Springs { vertical: chain(1e6), horizontal: chain(3e6) };
        Model::with_members(&body, &springs, &members)
    }

    fn model() -> Model {
        with(Members::default())
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
        let members = Members {
            damper: Some(Damper { c: 30.0 }),
            tendon: Some(Tendon { stiffness: 3e3, pretension: 500.0 }),
            friction: None,
        };
        let feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
        for (model, i) in [model(), with(members)].into_iter().flat_map(|m| [(m, 0), (m, 1)]) {
            let (forces, masses) = (model.forces(&Q, &V, &feet, [0.0; 2]), model.masses(&feet));
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
