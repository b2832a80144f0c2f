//! The rigid body on two feet, for fixed time steps.
//!
//! ```text
//!   q = [ X, Z, theta,  ax_L, az_L,  ax_R, az_R ]      body (3), absorbers of the left and right foot (2 each)
//!
//!   foot of side s (-1 left, +1 right), large rotation:
//!     p_x = X + s b (cos theta - 1) - h sin theta           p_z = Z - s b sin theta + h (1 - cos theta)
//!   m  X''     = -m a_g + sum H                 m2_h a_x'' = -m2_h a_g - H - k2_h a_x - c_h a_x'
//!   m  Z''     = -m (g + a_v) + sum N           m2_v a_z'' = -m2_v a_v - N - k2_v a_z - c_v a_z'
//!   I  theta'' = sum ( H dp_x/dtheta + N dp_z/dtheta )
//! ```
//!
//! The coordinates, the kinematics and the ground are those of `dynamics::fem` and of our decks,
//! whose legs stand for the rigid body; forces of contact are those of `contact`. The rotation has
//! the inertia it is given, however little.

use dynamics::spring::{Chain, Springs};
use frames::frame::EquilibriumError;
use rocking::{scalar::GRAVITY, structure::Body};

use crate::{
    FALLING,
    contact::{CondensedUnit, FixedFoot},
    kinematics::{TangentWeights, Trial},
    model::FixedStepModel,
};

/// Number of coordinates.
const N: usize = 7;
/// Sides of the feet.
const SIDE: [f64; 2] = [-1.0, 1.0];
const X: usize = 0;
const Z: usize = 1;
const TH: usize = 2;

/// Index of foot i's absorber, horizontally; the vertical one follows.
const fn absorber(i: usize) -> usize {
    3 + 2 * i
}

/// The rigid body on its springs.
#[derive(Clone, Copy, Debug)]
pub struct FixedStepBody {
    body: Body<f64>,
    springs: Springs<Chain>,
}

/// A foot's place, and its derivatives by theta.
#[derive(Clone, Copy, Debug)]
pub struct FootPlace {
    place: [f64; 2],
    slope: [f64; 2],
    curve: [f64; 2],
}

/// The matrix of the iteration, absorbers condensed: an arrow of X, Z and theta.
#[derive(Clone, Copy, Debug)]
pub struct BodyFactor {
    xx: f64,
    zz: f64,
    xt: f64,
    zt: f64,
    /// What is left of theta's diagonal when X and Z are eliminated.
    tt: f64,
    /// Of both feet, horizontal and vertical.
    units: [[CondensedUnit; 2]; 2],
    slopes: [[f64; 2]; 2],
}

impl FixedStepBody {
    /// A body with rotational inertia I > 0 on these units under each foot.
    pub fn new(body: &Body<f64>, springs: &Springs<Chain>) -> Self {
        Self { body: *body, springs: *springs }
    }

    #[inline(always)]
    fn foot(&self, i: usize, q: &[f64; N], (sin, cos): (f64, f64)) -> FootPlace {
        let (sb, h) = (SIDE[i] * self.body.half_width, self.body.height);
        let one_minus_cos = sin * sin / (1.0 + cos);
        FootPlace {
            place: [q[X] - sb * one_minus_cos - h * sin, q[Z] - sb * sin + h * one_minus_cos],
            slope: [-(sb * sin + h * cos), h * sin - sb * cos],
            curve: [h * sin - sb * cos, h * cos + sb * sin],
        }
    }

    /// Displacement of the centre of mass from where it stands under its weight, to the right and
    /// up (m), and theta (rad).
    pub fn displacement(&self, q: &[f64; N]) -> [f64; 3] {
        [q[X], q[Z] - self.settled(), q[TH]]
    }

    /// Z of the body standing on both feet (m).
    pub fn settled(&self) -> f64 {
        -0.5 * self.body.mass * GRAVITY / self.springs.vertical.in_series()
    }
}

impl FixedStepModel for FixedStepBody {
    type Vector = [f64; N];
    type Feet = [FixedFoot; 2];
    type Places = [FootPlace; 2];
    type Factor = BodyFactor;

    fn standing(&self) -> Result<([f64; N], [FixedFoot; 2]), EquilibriumError> {
        let sunk = -0.5 * self.body.mass * GRAVITY / self.springs.vertical.k2;
        let foot = FixedFoot::standing([0.0, self.settled()]);
        Ok(([0.0, self.settled(), 0.0, 0.0, sunk, 0.0, sunk], [foot; 2]))
    }

    #[inline(always)]
    fn places(&self, q: &[f64; N]) -> [FootPlace; 2] {
        let turned = q[TH].sin_cos();
        [self.foot(0, q, turned), self.foot(1, q, turned)]
    }

    #[inline(always)]
    fn meet(&self, places: &[FootPlace; 2], q: &[f64; N], feet: &mut [FixedFoot; 2]) {
        for (i, (foot, FootPlace { place: [x, z], .. })) in feet.iter_mut().zip(places).enumerate()
        {
            let at = absorber(i);
            foot.meet(&self.springs, q[at + 1] - z, x - q[at]);
        }
    }

    #[inline(always)]
    fn meet_after(
        &self,
        (places, before): (&[FootPlace; 2], &[f64; N]),
        q: &[f64; N],
        feet: &mut [FixedFoot; 2],
    ) {
        let [dx, dz, turn] = [q[X] - before[X], q[Z] - before[Z], q[TH] - before[TH]];
        for (i, (foot, at)) in feet.iter_mut().zip(places).enumerate() {
            let FootPlace { place: [x, z], slope, .. } = at;
            let at = absorber(i);
            let [x, z] = [x + dx + slope[0] * turn, z + dz + slope[1] * turn];
            foot.meet(&self.springs, q[at + 1] - z, x - q[at]);
        }
    }

    #[inline(always)]
    fn meet_end(&self, places: &[FootPlace; 2], w: f64, q: &[f64; N], feet: &mut [FixedFoot; 2]) {
        for (i, (foot, place)) in feet.iter_mut().zip(places).enumerate() {
            let [x, z] = foot.goes_on(place.place, w);
            let at = absorber(i);
            foot.meet(&self.springs, q[at + 1] - z, x - q[at]);
        }
    }

    #[inline(always)]
    fn unbalance(
        &self,
        (trial, places): (&Trial<[f64; N]>, &[FootPlace; 2]),
        feet: &[FixedFoot; 2],
        [ground, up]: [f64; 2],
        out: &mut [f64; N],
    ) {
        let Trial { q, v, a, .. } = trial;
        let Springs { vertical, horizontal } = &self.springs;
        let m = self.body.mass;
        out[X] = -m * (ground + a[X]);
        out[Z] = -m * (GRAVITY + up + a[Z]);
        out[TH] = -self.body.inertia * a[TH];
        for (i, (foot, at)) in feet.iter().zip(places).enumerate() {
            let FootPlace { place: [x, z], slope, .. } = at;
            let at = absorber(i);
            let [h, n] = foot.force(&self.springs, q[at + 1] - z, x - q[at]);
            out[X] += h;
            out[Z] += n;
            out[TH] += h * slope[0] + n * slope[1];
            out[at] = -(h
                + horizontal.m2 * (ground + a[at])
                + horizontal.k2 * q[at]
                + horizontal.c * v[at]);
            let at = at + 1;
            out[at] = -(n + vertical.m2 * (up + a[at]) + vertical.k2 * q[at] + vertical.c * v[at]);
        }
    }

    #[inline(always)]
    fn unbalance_norm(&self, places: &[FootPlace; 2], unbalance: &[f64; N]) -> f64 {
        let mut top = [unbalance[X], unbalance[Z], unbalance[TH]];
        let mut squares = 0.0;
        for (i, FootPlace { slope, .. }) in places.iter().enumerate() {
            let [x, z] = [-unbalance[absorber(i)], -unbalance[absorber(i) + 1]];
            top = [top[0] - x, top[1] - z, top[2] - x * slope[0] - z * slope[1]];
            squares += 2.0 * (x * x + z * z);
        }
        (squares + top.iter().map(|f| f * f).sum::<f64>()).sqrt()
    }

    #[inline(always)]
    fn factor(
        &self,
        (trial, places): (&Trial<[f64; N]>, &[FootPlace; 2]),
        feet: &[FixedFoot; 2],
        weights: &TangentWeights,
    ) -> Option<BodyFactor> {
        let q = &trial.q;
        let Springs { vertical, horizontal } = &self.springs;
        let translation = weights.mass * self.body.mass;
        let (mut xx, mut zz, mut tt) = (translation, translation, weights.mass * self.body.inertia);
        let (mut xt, mut zt) = (0.0, 0.0);
        let mut units = [[CondensedUnit::default(); 2]; 2];
        let mut slopes = [[0.0; 2]; 2];
        for (i, (foot, at)) in feet.iter().zip(places).enumerate() {
            let &FootPlace { place: [x, z], slope, curve } = at;
            let at = absorber(i);
            let [h, n] = foot.force(&self.springs, q[at + 1] - z, x - q[at]);
            let both = [
                CondensedUnit::new(horizontal, foot.closed && foot.holds, weights),
                CondensedUnit::new(vertical, foot.closed, weights),
            ];
            let [kx, kz] = [both[0].stiffness, both[1].stiffness];
            xx += kx;
            zz += kz;
            xt += kx * slope[0];
            zt += kz * slope[1];
            tt += kx * slope[0] * slope[0] + kz * slope[1] * slope[1];
            tt -= weights.stiffness * (h * curve[0] + n * curve[1]);
            (units[i], slopes[i]) = (both, slope);
        }
        let tt = tt - xt * xt / xx - zt * zt / zz;
        (tt != 0.0 && tt.is_finite()).then_some(BodyFactor { xx, zz, xt, zt, tt, units, slopes })
    }

    #[inline(always)]
    fn solve(&self, factor: &BodyFactor, r: &mut [f64; N]) {
        let BodyFactor { xx, zz, xt, zt, tt, units, slopes } = factor;
        let (mut rx, mut rz, mut rt) = (r[X], r[Z], r[TH]);
        for (i, ([h, v], slope)) in units.iter().zip(slopes).enumerate() {
            let at = absorber(i);
            let [fx, fz] = [h.share * r[at], v.share * r[at + 1]];
            rx += fx;
            rz += fz;
            rt += fx * slope[0] + fz * slope[1];
        }
        let turn = (rt - xt * rx / xx - zt * rz / zz) / tt;
        let (x, z) = ((rx - xt * turn) / xx, (rz - zt * turn) / zz);
        for (i, ([h, v], slope)) in units.iter().zip(slopes).enumerate() {
            let at = absorber(i);
            r[at] = h.give * r[at] + h.share * (x + slope[0] * turn);
            r[at + 1] = v.give * r[at + 1] + v.share * (z + slope[1] * turn);
        }
        (r[X], r[Z], r[TH]) = (x, z, turn);
    }

    fn gaps(&self, q: &[f64; N], v: &[f64; N], mut each: impl FnMut(f64, f64)) {
        for (i, FootPlace { place, slope, .. }) in self.places(q).into_iter().enumerate() {
            let at = absorber(i) + 1;
            each(q[at] - place[1], v[at] - v[Z] - slope[1] * v[TH]);
        }
    }

    fn has_fallen(&self, q: &[f64; N]) -> bool {
        q[TH].is_nan() || q[TH].abs() >= std::f64::consts::FRAC_PI_2
    }

    fn is_falling(&self, q: &[f64; N]) -> bool {
        q[TH].abs() > FALLING * self.body.alpha()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::Design;
    use rocking::structure::Structure;

    fn model() -> FixedStepBody {
        let body = Structure::block(2.6, 0.7, 1200.0).unwrap().body::<f64>();
        let springs = Springs {
            vertical: Design::from_kc(0.2, 0.25, 0.6, 30.0),
            horizontal: Design::from_kc(0.3, 0.4, 0.8, 50.0),
        };
        FixedStepBody::new(&body, &springs.chains(body.mass))
    }

    /// A trial with the left foot closed, the right one open or closed.
    fn trial(right: f64) -> Trial<[f64; N]> {
        Trial {
            q: [1e-3, -2e-3, 0.03, 2e-4, -1e-4, 3e-4, right],
            v: [0.1, -0.2, 0.05, 0.03, -0.02, 0.01, 0.04],
            a: [1.0, 2.0, -3.0, 0.5, -0.4, 0.3, 0.2],
            change: None,
        }
    }

    #[test]
    fn it_stands_still_under_its_weight() {
        let model = model();
        let (q, mut feet) = model.standing().unwrap();
        let still = Trial { q, v: [0.0; N], a: [0.0; N], change: None };
        let mut out = [0.0; N];
        let places = model.places(&q);
        model.meet(&places, &q, &mut feet);
        model.unbalance((&still, &places), &feet, [0.0; 2], &mut out);
        assert!(out.iter().all(|f| f.abs() < 1e-9 * model.body.mass), "{out:?}");
    }

    /// A foot that lifts drops half the weight: it is missing on the foot's node and on the
    /// absorber's, wherever the mass is.
    #[test]
    fn what_a_foot_drops_is_a_force_on_two_nodes() {
        let model = model();
        let (q, mut feet) = model.standing().unwrap();
        let still = Trial { q, v: [0.0; N], a: [0.0; N], change: None };
        let (places, mut out) = (model.places(&q), [0.0; N]);
        model.meet(&places, &q, &mut feet);
        feet[1].closed = false;
        model.unbalance((&still, &places), &feet, [0.0; 2], &mut out);
        let expected = 0.5 * model.body.mass * GRAVITY * 2f64.sqrt();
        let norm = model.unbalance_norm(&places, &out);
        assert!((norm / expected - 1.0).abs() < 1e-9, "{norm} {expected}");
    }

    /// What a small change of q does to the unbalance is the matrix's answer to it: solve(K dq) =
    /// dq, with M, C and K from differences.
    #[test]
    fn the_matrix_is_the_derivative_of_the_unbalance() {
        let model = model();
        for right in [0.4, -0.4] {
            let at = trial(right);
            let mut feet = [FixedFoot::new(true, 1e-4), FixedFoot::new(true, -2e-4)];
            let places = model.places(&at.q);
            model.meet(&places, &at.q, &mut feet);
            let weights = TangentWeights { mass: 3e4, damping: 200.0, stiffness: 0.7 };
            let factor = model.factor((&at, &places), &feet, &weights).unwrap();
            let unbalance = |trial: &Trial<[f64; N]>| {
                let mut out = [0.0; N];
                model.unbalance((trial, &model.places(&trial.q)), &feet, [1.0, 0.5], &mut out);
                out
            };
            let direction = [0.3, -0.5, 0.2, 0.7, -0.1, 0.4, 0.6];
            let moved = |step: f64| {
                let mut trial = at.clone();
                for (k, d) in direction.iter().enumerate() {
                    trial.q[k] += step * weights.stiffness * d;
                    trial.v[k] += step * weights.damping * d;
                    trial.a[k] += step * weights.mass * d;
                }
                trial
            };
            let step = 1e-6;
            let (high, low) = (unbalance(&moved(step)), unbalance(&moved(-step)));
            let mut right: [f64; N] = std::array::from_fn(|k| -(high[k] - low[k]) / (2.0 * step));
            model.solve(&factor, &mut right);
            for (found, expected) in right.iter().zip(direction) {
                assert!((found - expected).abs() < 1e-7, "{right:?}");
            }
        }
    }

    /// A rotation about the right foot moves the mass as rocking's formulas say.
    #[test]
    fn feet_stay_where_the_body_turns_about_them() {
        let model = model();
        let theta = 0.2_f64;
        let q = [model.body.u(theta), model.body.v(theta), theta, 0.0, 0.0, 0.0, 0.0];
        let pivot = model.foot(1, &q, theta.sin_cos()).place;
        assert!(pivot.iter().all(|x| x.abs() < 1e-15), "{pivot:?}");
        let other = model.foot(0, &q, theta.sin_cos()).place;
        assert!((other[1] - 2.0 * model.body.half_width * theta.sin()).abs() < 1e-12, "{other:?}");
    }
}
