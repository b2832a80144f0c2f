//! A structure as the two corners of its base feel it when one lands: W = G M^-1 G', and the
//! plastic landing.
//!
//! ```text
//!   p' = p'_before + W J,   p' = 0 at the new corner: J* = -W_nn^-1 p'_n      unless that pushes the old corner into the ground:
//!                           p' = 0 at both
//! ```
//!
//! Moreau's plastic impact: no corner is pulled. For the first, angular momentum about the new
//! corner is kept: Housner's equation 2. The second is that of wide footings under a column, where
//! equation 2 would have the base turn backwards.

use super::linear::dot;

/// Corner directions: old foot x, z, new foot x, z.
pub(crate) const DIRECTIONS: usize = 4;
/// Least I_cg/(m R^2): the limit of a massless rotation. The smaller it is the faster the body
/// turns on its springs, at Omega_h/sqrt(I_cg/m R^2), without a change of the outcome.
const LEAST_INERTIA: f64 = 1e-3;

/// The structure as its corners feel it.
#[derive(Clone, Copy, Debug)]
pub struct CornerDynamics {
    /// W = G M^-1 G', over 1/m; rows and columns old foot x, z, new foot x, z.
    pub w: [[f64; DIRECTIONS]; DIRECTIONS],
    /// 2b, between the feet (R).
    pub width: f64,
    /// Angular momentum about the new foot before the landing, while the body turns about the old
    /// foot and the new foot comes down with speed 1 [m R v_n].
    pub momentum: f64,
    /// Rate at which the body turns about the new foot after a landing without impulse at the old
    /// one [v_n/R].
    pub rate: f64,
    /// Impulses J* of the plastic landing [m v_n].
    pub plastic: [f64; DIRECTIONS],
}

impl CornerDynamics {
    /// Of a rigid body of slenderness alpha and mass share m R^2/I0; one whose mass is all in one
    /// point, m R^2/I0 = 1, as the limit of little rotational inertia.
    pub fn rigid(alpha: f64, mass_share: f64) -> Self {
        let inertia = mass_share.recip() - 1.0;
        let inertia = if inertia < LEAST_INERTIA { LEAST_INERTIA } else { inertia };
        let (sin, cos) = (alpha.sin(), alpha.cos());
        // G: (u, v, theta) of the centre of mass to x, z of the old foot (-b, -h) and the new one
        // (b, -h)
        let g = [[1.0, 0.0, -cos], [0.0, 1.0, sin], [1.0, 0.0, -cos], [0.0, 1.0, -sin]];
        let w = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                g[i][0] * g[j][0] + g[i][1] * g[j][1] + g[i][2] * g[j][2] / inertia
            })
        });
        let width = sin * 2.0;
        let i0 = inertia + 1.0;
        let momentum = (i0 - sin * sin * 2.0) / width;
        Self { w, width, momentum, rate: momentum / i0, plastic: plastic(&w) }
    }

    /// Of the two corners, `width` apart, of any structure, from W.
    pub fn of(w: [[f64; DIRECTIONS]; DIRECTIONS], width: f64) -> Self {
        // the new corner stops, by itself; the old one goes on at the rate of the body that turns
        // about it
        let alone = stopped(&w, &[2, 3]);
        let rate = velocity(&w, &alone, 1) / width;
        // what a unit force at the old corner does to it while the new one is held
        let held = eliminated(&w);
        let momentum = if held > 0.0 { width * width / held * rate } else { 0.0 };
        Self { w, width, momentum, rate, plastic: plastic(&w) }
    }

    /// Mass that the landing corner feels in its direction x or z while it may not move in the
    /// other: [(W_new)^-1]_zz. Of a rigid body vertically m (1 - (m R^2/I0) sin^2 alpha).
    pub fn effective_mass(&self) -> [f64; 2] {
        let [xx, xz, zz] = [self.w[2][2], self.w[2][3], self.w[3][3]];
        let determinant = xx * zz - xz * xz;
        [zz / determinant, xx / determinant]
    }

    /// Whether a landing brings both corners to rest.
    #[cfg(test)]
    pub(crate) fn stops(&self) -> bool {
        self.plastic[1] > 0.0
    }
}

/// Impulses that bring the corners' `directions` to rest from a landing at speed 1.
fn stopped<const C: usize>(
    w: &[[f64; DIRECTIONS]; DIRECTIONS],
    directions: &[usize; C],
) -> [f64; DIRECTIONS] {
    let matrix = std::array::from_fn(|i| std::array::from_fn(|j| w[directions[i]][directions[j]]));
    let approach = directions.map(|i| if i == 3 { 1.0 } else { 0.0 });
    let mut impulses = [0.0; DIRECTIONS];
    for (direction, impulse) in directions.iter().zip(solved(matrix, approach)) {
        impulses[*direction] = impulse;
    }
    impulses
}

/// Velocity of a corner's direction after impulses.
fn velocity(
    w: &[[f64; DIRECTIONS]; DIRECTIONS],
    impulses: &[f64; DIRECTIONS],
    direction: usize,
) -> f64 {
    let before = if direction == 3 { -1.0 } else { 0.0 };
    before + dot(&w[direction], impulses)
}

/// The plastic landing: of the new corner, or of both where the old one would go into the ground.
/// Corners of one footing move alike horizontally, so that one of them holds both.
fn plastic(w: &[[f64; DIRECTIONS]; DIRECTIONS]) -> [f64; DIRECTIONS] {
    let alone = stopped(w, &[2, 3]);
    if velocity(w, &alone, 1) >= 0.0 { alone } else { stopped(w, &[1, 2, 3]) }
}

/// W of the old corner's vertical motion while the new one is held.
fn eliminated(w: &[[f64; DIRECTIONS]; DIRECTIONS]) -> f64 {
    let at_new = solved([[w[2][2], w[2][3]], [w[3][2], w[3][3]]], [w[2][1], w[3][1]]);
    w[1][1] - w[1][2] * at_new[0] - w[1][3] * at_new[1]
}

/// A x = b for a small positive definite A.
fn solved<const C: usize>(mut a: [[f64; C]; C], mut b: [f64; C]) -> [f64; C] {
    for i in 0..C {
        for j in i + 1..C {
            let factor = a[j][i] / a[i][i];
            let above = a[i];
            a[j].iter_mut().zip(above).skip(i).for_each(|(x, above)| *x -= factor * above);
            let above = b[i];
            b[j] -= factor * above;
        }
    }
    for i in (0..C).rev() {
        for k in i + 1..C {
            let known = a[i][k] * b[k];
            b[i] -= known;
        }
        b[i] /= a[i][i];
    }
    b
}
