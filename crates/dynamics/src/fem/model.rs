//! The discrete model: a plane rigid body on two feet, each foot on a vertical and a horizontal
//! chain.
//!
//! ```text
//!   q = [ X, Z, theta,  ax_L, az_L,  ax_R, az_R ]      body (3), absorber masses of the left and right foot (2 each)
//!
//!   foot of side s (-1 left, +1 right), large rotation:
//!     p_x = X + s b (cos theta - 1) - h sin theta           p_z = Z - s b sin theta + h (1 - cos theta)
//!   gap, closed while it presses:   N =  k1_v (a_z - p_z)            (> 0: the ground pushes the foot up)
//!                                   H = -k1_h (p_x - a_x - anchor)   (only while N acts)
//!   m  X''     = -m a_g + sum H                 m2_h a_x'' = -m2_h a_g - H - k2_h a_x - c_h a_x'
//!   m  Z''     = -m (g + a_v) + sum N           m2_v a_z'' = -m2_v a_v - N - k2_v a_z - c_v a_z'
//!   I  theta'' = sum ( H dp_x/dtheta + N dp_z/dtheta )
//! ```
//!
//! Displacements are relative to the ground, whose acceleration is (a_g, a_v), a_v upwards;
//! gravity acts on the body only, so an open absorber rests at zero, as in the engineer's deck,
//! where the weight is a load on the mass.

mod energies;

pub(crate) use super::contact::{Contact, ContactLaw, Foot, FootForce};
use super::element::{Dampers, Elements, TendonElement};
use crate::spring::{Chain, Springs};
use rocking::{
    members::{self, Members},
    scalar::{GRAVITY, sin_cos},
    structure::Body,
};

/// Number of coordinates.
pub(crate) const N: usize = 7;
/// Sides of the two feet: left, right.
pub(crate) const SIDE: [f64; 2] = [-1.0, 1.0];
/// Index of the body's horizontal displacement X.
pub(crate) const X: usize = 0;
/// Index of the body's vertical displacement Z.
pub(crate) const Z: usize = 1;
/// Index of the rotation theta.
pub(crate) const TH: usize = 2;

/// Index of foot i's horizontal absorber displacement.
#[inline(always)]
pub(crate) const fn ax(i: usize) -> usize {
    3 + 2 * i
}

/// Index of foot i's vertical absorber displacement.
#[inline(always)]
pub(crate) const fn az(i: usize) -> usize {
    4 + 2 * i
}

/// A vector of the seven coordinates.
pub(crate) type Vector = [f64; N];

/// Positions and velocities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub q: Vector,
    pub v: Vector,
}

/// Sine and cosine of the rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub sin: f64,
    pub cos: f64,
}

impl Pose {
    /// Of the rotation in these coordinates.
    #[inline(always)]
    pub(crate) fn of(q: &Vector) -> Self {
        let (sin, cos) = sin_cos(q[TH]);
        Self { sin, cos }
    }
}

/// I_cg / (m R^2) below which the rotation counts as massless.
///
/// A little rotational inertia on stiff springs makes an undamped oscillator of several kHz
/// (Omega_n R sqrt(m/I_cg)) that no landing in reality shows: followed exactly it chatters, spins
/// the body and topples it, and every program in use damps it by the error of its integrator. Its
/// limit is well behaved: the rotation follows the contact forces at once. The inertia that rocking
/// feels is kept, m R^2 + I_cg, by moving I_cg/R^2 into the inertia of the translation; what is
/// lost is the share 2 sin^2(alpha) I_cg/(m R^2) of the restitution, less than 1e-3 for any slender
/// body.
pub const MASSLESS_ROTATION: f64 = 2e-3;

/// Share of 1/Omega_n below which the time by which dampers delay a massless rotation is none.
const LEAST_DELAY: f64 = 1e-2;

/// Body and springs, ready to compute with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    pub body: Body<f64>,
    pub springs: Springs<Chain>,
    /// Inertia of the translation (kg): the mass, and I_cg/R^2 when the rotation is massless.
    pub translation: f64,
    /// Inertia of the rotation (kg m2); zero when massless.
    pub rotation: f64,
    /// What a pressing foot can take along the ground.
    pub law: ContactLaw,
    /// Dampers, tendon; none of a body on its springs alone.
    pub elements: Elements,
    /// Solve nothing for an open foot's contact (`Control::skip_open`).
    pub skip_open: bool,
}

impl Model {
    pub(crate) fn new(body: &Body<f64>, springs: &Springs<Chain>) -> Self {
        let r = body.radius();
        let added = body.inertia / (r * r);
        let (translation, rotation) = if added < MASSLESS_ROTATION * body.mass {
            (body.mass + added, 0.0)
        } else {
            (body.mass, body.inertia)
        };
        let (law, elements) = (ContactLaw::Sticking, Elements::NONE);
        Self {
            body: *body,
            springs: *springs,
            translation,
            rotation,
            law,
            elements,
            skip_open: true,
        }
    }

    /// A body with members on its springs. The tendon is stressed so that its tension in the
    /// settled structure is its pretension.
    pub(crate) fn with_members(
        body: &Body<f64>,
        springs: &Springs<Chain>,
        members: &Members,
    ) -> Self {
        let mut model = Self::new(body, springs);
        if let Some(friction) = members.friction {
            // while feet slip, nothing but its own inertia holds the rotation
            (model.translation, model.rotation) = (body.mass, body.inertia);
            model.law = ContactLaw::Coulomb { coefficient: friction.coefficient };
            return model;
        }
        if let Some(damper) = members.damper.filter(|damper| damper.c > 0.0) {
            model.elements.dampers = Some(Dampers::new(damper.c, body));
        }
        if let Some(members::Tendon { stiffness, pretension }) = members.tendon {
            let (state, _) = model.stand(body.mass * GRAVITY + pretension);
            let (elongation, settled) = (pretension / stiffness, state.q[Z]);
            let height = body.height;
            model.elements.tendon =
                Some(TendonElement { stiffness, elongation, settled, height, pretension });
        }
        model
    }

    /// Whether this is the rigid body on feet that hold at any force.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        self.elements.is_empty() && !self.law.slips()
    }

    /// Whether the rotation follows the contact forces without inertia.
    pub(super) fn massless(&self) -> bool {
        self.rotation == 0.0
    }

    /// Whether such a rotation jumps to its balance: against dampers it takes c/k1, which is
    /// nothing beside a landing's 1/Omega_n unless the springs are soft. A tendon turns nothing.
    pub(super) fn jumps(&self) -> bool {
        let spring = &self.springs.vertical;
        let settling = (self.body.mass / spring.k1).sqrt();
        let slow = |dampers: &Dampers| dampers.c() > LEAST_DELAY * spring.k1 * settling;
        self.massless() && !self.law.slips() && !self.elements.dampers.as_ref().is_some_and(slow)
    }

    /// What stands between body and ground. While both feet of a body without rotational inertia
    /// are in the air its dampers do not turn it: see `rotational_inertia`.
    #[inline(always)]
    pub(crate) fn elements_under(&self, feet: &[Foot; 2]) -> Elements {
        let mut all = self.elements;
        if self.massless() && !feet[0].closed() && !feet[1].closed() {
            all.dampers = all.dampers.map(Dampers::aloft);
        }
        all
    }

    /// Position of foot i relative to where it stood, with the derivatives by theta: (p_x, p_z,
    /// dp_x, dp_z).
    #[inline(always)]
    pub(crate) fn foot(&self, i: usize, q: &Vector, sin: f64, cos: f64) -> (f64, f64, f64, f64) {
        let sb = self.body.half_width * SIDE[i];
        let h = self.body.height;
        let one_minus_cos = sin * sin / (cos + 1.0);
        let px = q[X] - sb * one_minus_cos - h * sin;
        let pz = q[Z] - sb * sin + h * one_minus_cos;
        (px, pz, -(sb * sin + h * cos), h * sin - sb * cos)
    }

    /// Compression of foot i's gap, a_z - p_z: positive when the foot presses (m).
    pub(crate) fn compression(&self, i: usize, q: &Vector) -> f64 {
        self.compression_at(&Pose::of(q), i, q)
    }

    /// The same where the rotation's sine and cosine are known.
    #[inline(always)]
    pub(crate) fn compression_at(&self, pose: &Pose, i: usize, q: &Vector) -> f64 {
        q[az(i)] - self.foot(i, q, pose.sin, pose.cos).1
    }

    /// The compression (m) and its derivative by theta (m).
    pub(crate) fn compression_and_slope(&self, i: usize, q: &Vector) -> (f64, f64) {
        let Pose { sin, cos } = Pose::of(q);
        let (_, pz, _, pz_th) = self.foot(i, q, sin, cos);
        (q[az(i)] - pz, -pz_th)
    }

    /// Rate of the compression (m/s).
    pub(crate) fn compression_rate(&self, i: usize, state: &State) -> f64 {
        let Pose { sin, cos } = Pose::of(&state.q);
        let pz_th = self.foot(i, &state.q, sin, cos).3;
        state.v[az(i)] - state.v[Z] - pz_th * state.v[TH]
    }

    /// Upward velocity of foot i (m/s).
    pub(crate) fn foot_rate(&self, i: usize, state: &State) -> f64 {
        let Pose { sin, cos } = Pose::of(&state.q);
        let pz_th = self.foot(i, &state.q, sin, cos).3;
        state.v[Z] + pz_th * state.v[TH]
    }

    /// Velocity at which foot i slips over the ground while it does so to this side (m/s).
    pub(crate) fn slip_rate(&self, i: usize, q: &Vector, v: &Vector, side: f64) -> f64 {
        let Pose { sin, cos } = Pose::of(q);
        let (_, _, px_th, pz_th) = self.foot(i, q, sin, cos);
        let Springs { vertical, horizontal } = &self.springs;
        let compression_rate = v[az(i)] - v[Z] - pz_th * v[TH];
        let stretch_rate =
            compression_rate * self.law.coefficient() * vertical.k1 / horizontal.k1 * side;
        v[X] + px_th * v[TH] - v[ax(i)] - stretch_rate
    }

    /// The anchor that leaves foot i's horizontal spring without force where it stands now (m).
    pub(crate) fn anchor_here(&self, i: usize, q: &Vector) -> f64 {
        let Pose { sin, cos } = Pose::of(q);
        self.foot(i, q, sin, cos).0 - q[ax(i)]
    }

    /// Contact forces and kinematics of both feet.
    #[inline(always)]
    pub(crate) fn contact(&self, q: &Vector, feet: &[Foot; 2]) -> [FootForce; 2] {
        self.contact_at(&Pose::of(q), q, feet)
    }

    /// The same where the rotation's sine and cosine are known.
    #[inline(always)]
    pub(crate) fn contact_at(&self, pose: &Pose, q: &Vector, feet: &[Foot; 2]) -> [FootForce; 2] {
        [self.foot_force(pose, 0, q, &feet[0]), self.foot_force(pose, 1, q, &feet[1])]
    }

    #[inline(always)]
    fn foot_force(&self, pose: &Pose, i: usize, q: &Vector, foot: &Foot) -> FootForce {
        let (px, pz, px_th, pz_th) = self.foot(i, q, pose.sin, pose.cos);
        let press = || (q[az(i)] - pz) * self.springs.vertical.k1;
        let vertical = if foot.closed() { press() } else { 0.0 };
        // the law first: where no foot can slip, lanes of histories must not branch on how one does
        let held = || (q[ax(i)] + foot.anchor - px) * self.springs.horizontal.k1;
        let horizontal = match &self.law {
            ContactLaw::Sticking if foot.holds() => held(),
            ContactLaw::Sticking => 0.0,
            ContactLaw::Coulomb { .. } => match foot.contact {
                Contact::Slip(side) => self.law.slipping(press(), side),
                Contact::Stick => held(),
                Contact::Open | Contact::Slide | Contact::Trail => 0.0,
            },
        };
        FootForce { px_th, pz_th, horizontal, vertical }
    }

    /// Forces on the seven coordinates at ground acceleration (a_g, a_v) (m/s2).
    #[inline(always)]
    pub(crate) fn forces(
        &self,
        q: &Vector,
        v: &Vector,
        feet: &[Foot; 2],
        ground: [f64; 2],
    ) -> Vector {
        self.forces_at(&Pose::of(q), q, v, feet, ground)
    }

    /// The same where the rotation's sine and cosine are known.
    #[inline(always)]
    pub(crate) fn forces_at(
        &self,
        pose: &Pose,
        q: &Vector,
        v: &Vector,
        feet: &[Foot; 2],
        [ground, up]: [f64; 2],
    ) -> Vector {
        let Springs { vertical, horizontal } = &self.springs;
        let contact = self.contact_at(pose, q, feet);
        let [l, r] = &contact;
        let m = self.body.mass;
        let mut f = [0.0; N];
        f[X] = l.horizontal + r.horizontal - m * ground;
        f[Z] = l.vertical + r.vertical - m * (up + GRAVITY);
        // each foot's part by itself, so that a mirrored case gives the mirrored history to the
        // last bit
        f[TH] = (l.horizontal * l.px_th + l.vertical * l.pz_th)
            + (r.horizontal * r.px_th + r.vertical * r.pz_th);
        for (i, foot) in contact.iter().enumerate() {
            f[ax(i)] = -(foot.horizontal
                + horizontal.m2 * ground
                + horizontal.k2 * q[ax(i)]
                + horizontal.c * v[ax(i)]);
            f[az(i)] = -(foot.vertical
                + vertical.m2 * up
                + vertical.k2 * q[az(i)]
                + vertical.c * v[az(i)]);
        }
        if !self.elements.is_empty() {
            self.elements_under(feet).add_forces(q, v, &mut f);
        }
        f
    }

    /// Masses of the seven coordinates [kg; kg m2 for theta].
    pub(crate) fn masses(&self, feet: &[Foot; 2]) -> Vector {
        let (m, h, v) = (self.translation, self.springs.horizontal.m2, self.springs.vertical.m2);
        [m, m, self.rotational_inertia(feet), h, v, h, v]
    }

    /// In free flight a massless rotation keeps its rate, as the limit of a small I_cg does (no
    /// moment acts, so the value does not matter).
    ///
    /// Dampers would stop it within I_cg/(2 c b^2), at once where there is no I_cg: then the feet
    /// would rise with the mass, and the slightest rebound of a landing become a hop in which the
    /// frame moves along without turning. Legs that weigh something go on turning while a foot
    /// rebounds, and Housner's foot does not rebound: so dampers turn the body while a foot is on
    /// the ground, and hold but its mass while none is.
    fn rotational_inertia(&self, feet: &[Foot; 2]) -> f64 {
        if self.massless() && !feet[0].closed() && !feet[1].closed() {
            self.body.mass * self.body.height * self.body.height
        } else {
            self.rotation
        }
    }
}
