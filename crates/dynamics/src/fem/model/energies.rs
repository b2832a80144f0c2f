//! What energy the model holds, and what its motion takes and gives.

use super::{Contact, Foot, FootForce, Model, Pose, State, TH, Vector, X, Z, ax, az};
use crate::spring::Springs;
use rocking::scalar::GRAVITY;

impl Model {
    /// Kinetic energy of the body (J).
    #[inline(always)]
    pub(crate) fn body_kinetic(&self, state: &State) -> f64 {
        let v = &state.v;
        (self.translation * (v[X] * v[X] + v[Z] * v[Z]) + self.rotation * v[TH] * v[TH]) * 0.5
    }

    /// Kinetic, gravitational and elastic energy (J), gravity from the unstressed position.
    pub(crate) fn energy(&self, state: &State, feet: &[Foot; 2]) -> f64 {
        self.energy_at(&Pose::of(&state.q), state, feet)
    }

    /// The same where the rotation's sine and cosine are known.
    #[inline(always)]
    pub(crate) fn energy_at(&self, pose: &Pose, state: &State, feet: &[Foot; 2]) -> f64 {
        let Springs { vertical, horizontal } = &self.springs;
        let (q, v) = (&state.q, &state.v);
        let contact = self.contact_at(pose, q, feet);
        let share = |i: usize| {
            let mut twice = horizontal.m2 * v[ax(i)] * v[ax(i)] + vertical.m2 * v[az(i)] * v[az(i)];
            twice += horizontal.k2 * q[ax(i)] * q[ax(i)] + vertical.k2 * q[az(i)] * q[az(i)];
            if feet[i].closed() {
                let FootForce { horizontal: h, vertical: n, .. } = contact[i];
                twice += h * h / horizontal.k1 + n * n / vertical.k1;
            }
            twice
        };
        let twice = self.body_kinetic(state) * 2.0
            + self.body.mass * q[Z] * (2.0 * GRAVITY)
            + (share(0) + share(1));
        self.elements.add_energy(twice * 0.5, q)
    }

    /// Power of the base excitation in the moving frame, -a_g (m X' + sum m2_h a_x') - a_v (m Z'
    /// + sum m2_v a_z') (W).
    #[inline(always)]
    pub(crate) fn input_power(&self, v: &Vector, [ground, up]: [f64; 2]) -> f64 {
        let Springs { vertical, horizontal } = &self.springs;
        -(self.body.mass * v[X] + horizontal.m2 * (v[ax(0)] + v[ax(1)])) * ground
            - (self.body.mass * v[Z] + vertical.m2 * (v[az(0)] + v[az(1)])) * up
    }

    /// Power that the dashpots take, and friction (W).
    #[inline(always)]
    pub(crate) fn dissipation(&self, q: &Vector, v: &Vector, feet: &[Foot; 2]) -> f64 {
        let Springs { vertical, horizontal } = &self.springs;
        let springs = horizontal.c * (v[ax(0)] * v[ax(0)] + v[ax(1)] * v[ax(1)])
            + vertical.c * (v[az(0)] * v[az(0)] + v[az(1)] * v[az(1)]);
        let taken =
            if self.law.slips() { springs + self.friction_loss(q, v, feet) } else { springs };
        if self.elements.is_empty() {
            return taken;
        }
        self.elements_under(feet).add_dissipation(taken, q, v)
    }

    /// Power that friction takes (W).
    fn friction_loss(&self, q: &Vector, v: &Vector, feet: &[Foot; 2]) -> f64 {
        let contact = self.contact(q, feet);
        let loss = |i: usize| match feet[i].contact {
            Contact::Slip(side) => -contact[i].horizontal * self.slip_rate(i, q, v, side),
            _ => 0.0,
        };
        loss(0) + loss(1)
    }
}
