//! A massless elastic leg: a corotational beam, clamped to the body, hinged at the foot.
//!
//! ```text
//!   U = EA/(2 L0) (l - L0)^2 + 3 EI/(2 L0) psi^2
//!
//!   l, psi  length of the chord, and its turn against the body, from the foot's displacement e = (e_t, e_m) [m] in the
//!           axes of the body: t along the unstressed leg, from the mass to the foot, m across it,
//!           l cos psi = L0 + e_t,  l sin psi = e_m
//! ```
//!
//! So the axial force is EA (l - L0)/L0 (tension), the moment at the clamped end 3 EI psi/L0 and the shear force that
//! over l: OpenSees' elasticBeamColumn under the Corotational transformation, its hinged end condensed out.

use crate::scalar::Scalar;

/// A leg's stiffnesses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg<S> {
    /// L0 [m].
    pub length: S,
    /// EA/L0 [N/m].
    pub axial: S,
    /// 3 EI/L0 [N m].
    pub bending: S,
}

/// Energy, its slope and its curvature at a displacement of the foot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Law<S> {
    /// U [J].
    pub energy: S,
    /// dU/de_t, dU/de_m: the force that the foot takes [N].
    pub force: [S; 2],
    /// tt, tm, mm of the curvature [N/m].
    pub stiffness: [S; 3],
}

impl<S: Scalar> Leg<S> {
    /// The leg's law at the foot's displacement e.
    #[inline(always)]
    pub fn law(&self, e: [S; 2]) -> Law<S> {
        let Self { length, axial, bending } = *self;
        let (a, b) = (length + e[0], e[1]);
        let l = (a * a + b * b).sqrt();
        // l - L0 without cancellation
        let stretch = (e[0] * (length * 2.0 + e[0]) + b * b) / (l + length);
        let psi = b.atan2(a);
        let (tension, moment) = (axial * stretch, bending * psi);
        let (cos, sin) = (a / l, b / l);
        let shear = moment / l;
        // across the chord: the turning force, and the bending
        let across = tension / l + bending / (l * l);
        let mixed = shear / l;
        Law {
            energy: (tension * stretch + moment * psi) * 0.5,
            force: [tension * cos - shear * sin, tension * sin + shear * cos],
            // along r = (cos, sin): axial; along s = (-sin, cos): across; between them: -mixed
            stiffness: [
                axial * cos * cos + across * sin * sin + mixed * cos * sin * 2.0,
                (axial - across) * cos * sin - mixed * (cos * cos - sin * sin),
                axial * sin * sin + across * cos * cos - mixed * cos * sin * 2.0,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::HyperDual64;

    use super::*;

    fn leg<S: Scalar>() -> Leg<S> {
        Leg { length: S::from(7.0), axial: S::from(3e6), bending: S::from(2e5) }
    }

    #[test]
    fn force_and_stiffness_are_the_slopes_of_the_energy() {
        let e = [0.3, -0.8];
        let law = leg::<f64>().law(e);
        let seeded = |i: usize, j: usize| {
            let component =
                |k: usize| HyperDual64::new(e[k], f64::from(u8::from(k == i)), f64::from(u8::from(k == j)), 0.0);
            leg::<HyperDual64>().law([component(0), component(1)]).energy
        };
        let scale = 3e6;
        for (k, (i, j)) in [(0, 0), (0, 1), (1, 1)].into_iter().enumerate() {
            let energy = seeded(i, j);
            assert!((energy.eps1 - law.force[i]).abs() < 1e-12 * scale);
            assert!((energy.eps2 - law.force[j]).abs() < 1e-12 * scale);
            assert!((energy.eps1eps2 - law.stiffness[k]).abs() < 1e-12 * scale, "{i} {j}");
        }
    }

    #[test]
    fn a_small_push_meets_the_beam_s_stiffness() {
        // EA/L0 along, 3 EI/L0^3 across
        let law = leg::<f64>().law([0.0; 2]);
        assert_eq!(law.stiffness, [3e6, 0.0, 2e5 / 49.0]);
        assert_eq!(law.force, [0.0; 2]);
    }

    #[test]
    fn a_leg_turned_without_stretching_bears_only_moment_and_shear() {
        let psi: f64 = 0.4;
        let law = leg::<f64>().law([7.0 * (psi.cos() - 1.0), 7.0 * psi.sin()]);
        let shear = 2e5 * psi / 7.0;
        assert!((law.force[0] + shear * psi.sin()).abs() < 1e-9 && (law.force[1] - shear * psi.cos()).abs() < 1e-9);
        assert!((law.energy - 0.5 * 2e5 * psi * psi).abs() < 1e-9);
    }
}
