//! Elastic legs under the rigid body. They have no mass, so a pressing foot stands where leg and contact are in balance, and both together
//! are one contact law, with the foot's displacement e (axes of the body, `leg`) as its inner unknown:
//!
//! ```text
//!   V(q) = min over e  [ U(e) + k1_v (a_z - p_z)^2 / 2 + k1_h (p_x - a_x - anchor)^2 / 2 ]      p = p_rigid + R(theta) e
//!
//!   U'(e) = R^T F,   F = (H, N) the force of the ground on the foot: 2 x 2 Newton
//!   f_X = H,  f_Z = N,  f_theta = H D_z - N D_x,   D from the mass to the foot
//! ```
//!
//! A foot in the air hangs on its unstressed leg, so it opens and closes where the rigid body's would, at the same N = 0.
//! The forces on the body are those on the foot; only its place differs from the rigid body's.

mod stance;

use super::{
    leg::{Law, Leg},
    model::{Contact, Foot, FootForce, Model, Pose, State, TH, Vector, X, Z, ax, az},
};
use crate::scalar::{Scalar, real};

/// Iterations before a place counts as not found, and is none (NaN: no step with it is accepted); from within some per cent
/// it converges quadratically.
const MOST_ITERATIONS: usize = 40;

/// One foot in balance between its leg and its contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Poised<S> {
    pub force: FootForce<S>,
    /// Place of the foot, relative to where it stood [m].
    pub place: [S; 2],
    /// Unit vectors of the body's axes t and m.
    axes: [[S; 2]; 2],
    law: Option<Law<S>>,
    /// k1 of the contact, horizontal and vertical; zero where it does not act.
    contact: [S; 2],
}

/// How a foot's force changes: dF = -b (dp - da) - c dtheta, with dp the displacement at fixed e.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent<S> {
    /// xx, xz, zz [N/m].
    pub b: [S; 3],
    /// By the leg's turning [N].
    pub c: [S; 2],
    /// The moment's share of dtheta that is not dF's: df_theta = lever dF - c (dp - da) + turning dtheta [N m].
    pub turning: S,
}

impl<S: Scalar> Model<S> {
    /// Foot i in balance in its contact, on its leg if it has one.
    pub(crate) fn poised(&self, leg: Option<&Leg<S>>, i: usize, q: &Vector<S>, foot: &Foot<S>) -> Poised<S> {
        let Pose { sin, cos } = Pose::of(q);
        let (px, pz, px_th, pz_th) = self.foot(i, q, sin, cos);
        let (kh, kv) = match foot.contact {
            Contact::Open => (S::zero(), S::zero()),
            Contact::Slide | Contact::Trail => (S::zero(), self.springs.vertical.k1),
            // friction is not followed on legs (`members`)
            Contact::Stick | Contact::Slip(_) => (self.springs.horizontal.k1, self.springs.vertical.k1),
        };
        let ground = [q[ax(i)] + foot.anchor, q[az(i)]];
        let push = |p: [S; 2]| [(ground[0] - p[0]) * kh, (ground[1] - p[1]) * kv];
        let mut poised = Poised {
            force: FootForce { px_th, pz_th, horizontal: S::zero(), vertical: S::zero() },
            place: [px, pz],
            axes: [[S::zero(); 2]; 2],
            law: None,
            contact: [kh, kv],
        };
        let leg = match leg {
            Some(leg) if foot.closed() => leg,
            _ => {
                [poised.force.horizontal, poised.force.vertical] = push([px, pz]);
                return poised;
            }
        };
        let (tx, tz) = (-pz_th / leg.length, px_th / leg.length);
        let (t, m) = ([tx, tz], [-tz, tx]);
        let local = [kh * tx * tx + kv * tz * tz, (kv - kh) * tx * tz, kh * tz * tz + kv * tx * tx];
        let mut e = [S::zero(); 2];
        let (mut iterations, mut done) = (0, false);
        let (law, place, [h, n]) = loop {
            let law = leg.law(e);
            let away = [t[0] * e[0] + m[0] * e[1], t[1] * e[0] + m[1] * e[1]];
            let place = [px + away[0], pz + away[1]];
            let f = push(place);
            if !done && iterations == MOST_ITERATIONS {
                break (law, [real(f64::NAN); 2], [real(f64::NAN); 2]);
            }
            if done {
                // along and across the leg, the force of the softer of leg and contact: it rounds least
                let of_leg = |k: usize| law.stiffness[2 * k].re() < local[2 * k].re();
                let axes = [t, m];
                let [ft, fm] =
                    [0, 1].map(|k| if of_leg(k) { law.force[k] } else { f[0] * axes[k][0] + f[1] * axes[k][1] });
                let holds = foot.holds();
                let f = [if holds { t[0] * ft + m[0] * fm } else { f[0] }, t[1] * ft + m[1] * fm];
                poised.force.px_th = px_th + away[1];
                poised.force.pz_th = pz_th - away[0];
                break (law, place, f);
            }
            let r = [f[0] * t[0] + f[1] * t[1] - law.force[0], f[0] * m[0] + f[1] * m[1] - law.force[1]];
            let [tt, tm, mm] = inverse([0, 1, 2].map(|k| law.stiffness[k] + local[k]));
            let de = [tt * r[0] + tm * r[1], tm * r[0] + mm * r[1]];
            e = [e[0] + de[0], e[1] + de[1]];
            iterations += 1;
            let (step, size) = (de[0].re().hypot(de[1].re()), e[0].re().hypot(e[1].re()));
            // quadratic: what is missing after this step is of the order of rounding
            done = step <= 1e-7 * size + 1e-13 * leg.length.re();
        };
        poised.force.horizontal = h;
        poised.force.vertical = n;
        Poised { place, axes: [t, m], law: Some(law), ..poised }
    }

    /// Contact forces of both feet on their legs.
    #[inline(never)]
    pub(super) fn contact_on_legs(&self, leg: &Leg<S>, q: &Vector<S>, feet: &[Foot<S>; 2]) -> [FootForce<S>; 2] {
        std::array::from_fn(|i| self.poised(Some(leg), i, q, &feet[i]).force)
    }

    /// Elastic energy of the legs [J].
    #[inline(never)]
    pub(super) fn legs_energy(&self, leg: &Leg<S>, q: &Vector<S>, feet: &[Foot<S>; 2]) -> S {
        let energy = |i: usize| self.poised(Some(leg), i, q, &feet[i]).law.map_or(S::zero(), |law| law.energy);
        energy(0) + energy(1)
    }

    /// `turn_to_balance` with elements. With dampers the rotation cannot jump.
    #[inline(never)]
    #[must_use]
    pub(super) fn turn_with_elements(&self, state: &mut State<S>, feet: &[Foot<S>; 2]) -> bool {
        if self.elements.dampers.is_some() {
            return true;
        }
        let mut done = 0;
        for _ in 0..MOST_ITERATIONS {
            let [left, right] = std::array::from_fn(|i| {
                let poised = self.poised(self.elements.leg.as_ref(), i, &state.q, &feet[i]);
                let f = &poised.force;
                (f.horizontal * f.px_th + f.vertical * f.pz_th, poised.tangent().rotational(f))
            });
            let turn = (left.0 + right.0) / (left.1 + right.1);
            if !turn.re().is_finite() {
                return false;
            }
            state.q[TH] += turn;
            // derivatives converge one step later
            done += usize::from(turn.re().abs() <= 1e-9 * state.q[TH].re().abs() + 1e-15);
            if done == 2 {
                return true;
            }
        }
        false
    }
}

impl<S: Scalar> Poised<S> {
    /// The tangent of leg and contact in series.
    pub fn tangent(&self) -> Tangent<S> {
        let FootForce { px_th, pz_th, horizontal: h, vertical: n } = self.force;
        let [kh, kv] = self.contact;
        // the turning lever: d2p_x = dp_z, d2p_z = -dp_x
        let geometric = h * pz_th - n * px_th;
        let Some(law) = &self.law else {
            return Tangent { b: [kh, S::zero(), kv], c: [S::zero(); 2], turning: geometric };
        };
        let [[tx, tz], [mx, mz]] = self.axes;
        let local = [kh * tx * tx + kv * tz * tz, kh * tx * mx + kv * tz * mz, kh * mx * mx + kv * mz * mz];
        let [tt, tm, mm] = inverse([0, 1, 2].map(|k| law.stiffness[k] + local[k]));
        // A = (K_leg + K_contact)^-1 in the axes of the ground
        let axx = tt * tx * tx + tm * tx * mx * 2.0 + mm * mx * mx;
        let axz = tt * tx * tz + tm * (tx * mz + tz * mx) + mm * mx * mz;
        let azz = tt * tz * tz + tm * tz * mz * 2.0 + mm * mz * mz;
        // A n, with n = (-N, H) the force turned with the body
        let (ux, uz) = (axz * h - axx * n, azz * h - axz * n);
        Tangent {
            b: [kh - kh * axx * kh, -kh * axz * kv, kv - kv * azz * kv],
            c: [kh * ux, kv * uz],
            turning: geometric + (uz * h - ux * n),
        }
    }
}

/// Inverse of a symmetric 2 x 2 matrix, both as tt, tm, mm.
fn inverse<S: Scalar>([a, b, d]: [S; 3]) -> [S; 3] {
    let det = a * d - b * b;
    [d / det, -b / det, a / det]
}

impl<S: Scalar> Tangent<S> {
    /// -df_theta/dtheta of the body held in place [N m].
    pub fn rotational(&self, force: &FootForce<S>) -> S {
        let ([xx, xz, zz], [cx, cz]) = (self.b, self.c);
        let (px, pz) = (force.px_th, force.pz_th);
        xx * px * px + xz * px * pz * 2.0 + zz * pz * pz + (cx * px + cz * pz) * 2.0 - self.turning
    }

    /// dF for a motion of the body and the foot's absorber.
    pub fn change(&self, force: &FootForce<S>, i: usize, d: &Vector<S>) -> [S; 2] {
        let u = [d[X] + force.px_th * d[TH] - d[ax(i)], d[Z] + force.pz_th * d[TH] - d[az(i)]];
        let [xx, xz, zz] = self.b;
        [-(xx * u[0] + xz * u[1]) - self.c[0] * d[TH], -(xz * u[0] + zz * u[1]) - self.c[1] * d[TH]]
    }
}
