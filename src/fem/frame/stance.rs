//! Where a structure with members stands: settled on both feet, or leaning on one.

use crate::{
    fem::{
        element::{Elements, Tendon},
        model::{Contact, ContactLaw, Foot, Model, N, Pose, State, TH, X, Z, ax, az},
        newton::Newton,
    },
    members::Members,
    scalar::{GRAVITY, Scalar, real},
    spring::{Chain, Springs},
    structure::Body,
};

/// A pseudo time step [s] so long that inertia and dashpots vanish beside the springs.
const FOR_EVER: f64 = 1e6;
/// Newton steps after which there is no stance (NaN: its run is unstable from the start); a handful is needed.
const MOST_ITERATIONS: usize = 60;

/// Where a structure stands that finds no stance.
fn nowhere<S: Scalar>() -> State<S> {
    State { q: [real(f64::NAN); N], v: [S::zero(); N] }
}

impl<S: Scalar> Model<S> {
    /// A body with members on its springs. The tendon is stressed so that its tension in the settled structure is its
    /// pretension.
    pub fn with_members(body: &Body<S>, springs: &Springs<Chain<S>>, members: &Members<S>) -> Self {
        let mut model = Self::new(body, springs);
        if members.is_none() {
            return model;
        }
        if let Some(friction) = members.friction {
            // while feet slip, nothing but its own inertia holds the rotation
            (model.translation, model.rotation) = (body.mass, body.inertia);
            model.law = ContactLaw::Coulomb { coefficient: friction.coefficient };
            return model;
        }
        model.elements = Elements::new(members, body);
        if model.elements.dampers.is_some() && body.inertia.re() > 0.0 {
            // dampers let a rotation without inertia neither follow the contact forces at once nor keep its rate
            (model.translation, model.rotation) = (body.mass, body.inertia);
        }
        if let Some(tendon) = members.tendon {
            let (state, _) = model.stand(tendon.pretension);
            let slack = body.height + state.q[Z] - tendon.pretension / tendon.stiffness;
            model.elements.tendon = Some(Tendon { stiffness: tendon.stiffness, slack, height: body.height });
        }
        model
    }

    /// Standing still under the weight and a further load [N] on the mass, downwards.
    pub(in super::super) fn stand(&self, load: S) -> (State<S>, [Foot<S>; 2]) {
        let (mut state, feet) = self.stand_rigid(self.body.mass * GRAVITY + load);
        let s: S = real(FOR_EVER);
        let mut done = 0;
        for _ in 0..MOST_ITERATIONS {
            let mut residual = self.forces(&state.q, &state.v, &feet, [S::zero(); 2]);
            residual[Z] -= load;
            let a = Newton::new(self, &state, &feet, s, |x: S| x).solve(&residual);
            let mut step: f64 = 0.0;
            for (q, a) in state.q.iter_mut().zip(a) {
                let d = a * s * s;
                *q += d;
                step = step.max(d.re().abs());
            }
            // derivatives converge one step later
            done += usize::from(step <= 1e-9 * state.q[Z].re().abs());
            if done == 3 {
                return (state, feet);
            }
        }
        (nowhere(), feet)
    }

    /// At rest leaning by theta on one foot, as `on_one_foot`: on its leg, and pulled by the tendon.
    pub(in super::super) fn lean_with_elements(&self, theta: S) -> (State<S>, [Foot<S>; 2]) {
        let pressing = usize::from(theta.re() > 0.0);
        let Springs { vertical, horizontal } = &self.springs;
        let mut q = [S::zero(); N];
        q[TH] = theta;
        let mut feet = [Foot { contact: Contact::Open, anchor: S::zero() }; 2];
        // on the stiff ground, whose place and force follow one from the other
        for _ in 0..MOST_ITERATIONS {
            let (h, n) = self.falling_back(&q, pressing);
            q[ax(pressing)] = -h / horizontal.k2;
            q[az(pressing)] = -n / vertical.k2;
            feet[pressing] = Foot { contact: Contact::Stick, anchor: h / horizontal.k1 - q[ax(pressing)] };
            let place = self.poised(self.elements.leg.as_ref(), pressing, &q, &feet[pressing]).place;
            let (dx, dz) = (-place[0], q[az(pressing)] - n / vertical.k1 - place[1]);
            q[X] += dx;
            q[Z] += dz;
            if dx.re().hypot(dz.re()) <= 1e-14 * self.body.radius().re() {
                return (State { q, v: [S::zero(); N] }, feet);
            }
        }
        (nowhere(), feet)
    }

    /// Force on the pressing foot, horizontal and vertical, while a rigid body falls back from rest under weight and
    /// tendon [N].
    fn falling_back(&self, q: &[S; N], pressing: usize) -> (S, S) {
        let pull = self.elements.tendon.map_or([S::zero(); 2], |tendon| tendon.force_on_mass(q));
        let (gx, gz) = (pull[0], pull[1] - self.body.mass * GRAVITY);
        let Pose { sin, cos } = Pose::of(q);
        let (_, _, dz, minus_dx) = self.foot(pressing, q, sin, cos);
        let (tx, tz) = (-minus_dx / self.body.radius(), dz / self.body.radius());
        // the part of the load across the leg accelerates the body about its foot
        let across = gz * tx - gx * tz;
        let radius = self.body.radius();
        let swing = self.translation * radius * radius;
        let thrust = across * swing / (self.rotation + swing);
        (-gx - thrust * tz, -gz + thrust * tx)
    }
}
