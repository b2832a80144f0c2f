//! The landing of a plane structure on two feet, in the stiff limit.
//!
//! ```text
//!   p'' = W F           p: displacement of the four corner directions (old foot x, z; new foot x, z)
//!   W = G M^-1 G'       what a unit force at one corner does to the others: all of the structure that a landing feels
//!   N = k1 (a_z - p_z),  H = k1_h (a_x - p_x)   while the foot presses, else 0 (a foot that lands again is anchored there)
//!   m2 a'' = -F - k2 a - c a'                   each direction's absorber
//! ```
//!
//! No gravity, no large rotation; mass in units of the structure's, time in 1/Omega_n of the
//! vertical units, the speed at which the new foot comes down is 1. The problem is positively
//! homogeneous: twice the speed, twice the motion, so that its outcome holds for every landing in
//! the limit Omega_n v_n >> g. Between changes of contact it is linear and followed exactly
//! (`linear`); changes are located by Newton's method.
//!
//! The structure is anything with a rigid base on two corners: a rigid body, or the footing of an
//! elastic pier (`corners`). What is right is the plastic landing with impulses J*; how far springs
//! are from it is the energy of the velocities that they add to those after it, (J - J*)' W (J -
//! J*), over what it takes, J*' W J*.
//!
//! Where the new corner alone is stopped, angular momentum about the new foot changes only by the
//! old foot's impulse, H_new = H_before + 2b J_old: equation 2 holds exactly if and only if J_old =
//! 0.

use super::{
    chain::FOLLOWED,
    corners::{CornerDynamics, DIRECTIONS},
    linear::{SquareMatrix, combined, dot, exponential, times, transposed},
};
use dynamics::spring::{Design, Springs};

/// p, a, p', a', and the impulses through the corners.
const N: usize = 5 * DIRECTIONS;
const A: usize = DIRECTIONS;
const RATE: usize = 2 * DIRECTIONS;
const A_RATE: usize = 3 * DIRECTIONS;
const IMPULSE: usize = 4 * DIRECTIONS;

/// Steps over the shortest time scale, 1/sqrt(largest stiffness over mass).
const STEP: f64 = 0.25;
/// Newton steps at an event.
const NEWTON: usize = 8;
/// Changes of contact after which the feet count as chattering without end.
const MOST_CHANGES: usize = 400;
/// A foot that carries less than this is at the edge of lifting, in units of m v_n Omega_n.
const EDGE: f64 = 1e-13;

/// What a landing does.
#[derive(Clone, Copy, Debug)]
pub struct PlaneLanding {
    /// Angular momentum about the new foot over that before: 1 is Housner's, equation 2.
    pub momentum: f64,
    /// Vertical impulse through the old foot, J_old [m v_n]; never negative.
    pub old_impulse: f64,
    /// Energy of the velocities that differ from those after the plastic landing, over the energy
    /// that it takes.
    pub deviation: f64,
    /// Fastest speed with which the new foot leaves the ground (v_n).
    pub rebound: f64,
    /// Time with both feet in the air [1/Omega_n].
    pub air: f64,
    /// Touches and lifts of the new foot and of the old foot.
    pub changes: [usize; 2],
    /// Whether the landing was followed to its stated end: not if the feet chatter.
    #[cfg(test)]
    pub complete: bool,
}

/// Land the structure on units of these designs, whose frequencies count relative to the vertical
/// one's; followed to [`FOLLOWED`].
pub fn land(corners: &CornerDynamics, springs: &Springs<Design<f64>>) -> PlaneLanding {
    let mut run = LandingRun::new(corners, springs);
    while run.time < FOLLOWED && run.changes[0] + run.changes[1] < MOST_CHANGES {
        run.advance();
    }
    run.finish(corners)
}

/// One landing under way.
struct LandingRun {
    w: [[f64; DIRECTIONS]; DIRECTIONS],
    /// k1, k2, m2, c of x and z.
    units: [[f64; 4]; 2],
    y: [f64; N],
    /// Which feet press: old, new.
    closed: [bool; 2],
    time: f64,
    step: f64,
    /// y' = A y of the present contact.
    a: SquareMatrix<f64, N>,
    /// exp(A step), column by column.
    one_step: SquareMatrix<f64, N>,
    rebound: f64,
    air: f64,
    changes: [usize; 2],
}

impl LandingRun {
    fn new(corners: &CornerDynamics, springs: &Springs<Design<f64>>) -> Self {
        let ratio = springs.horizontal.omega_n_hz / springs.vertical.omega_n_hz;
        let unit = |d: &Design<f64>, omega: f64| {
            let k1 = omega * omega;
            [k1, d.k() * k1, d.mu, d.c() * omega]
        };
        let units = [unit(&springs.horizontal, ratio), unit(&springs.vertical, 1.0)];
        let fastest = (0..DIRECTIONS)
            .map(|i| {
                let [k1, k2, m2, c] = units[i % 2];
                let of_absorber = (k1 + k2) / m2 + (c / m2).powi(2);
                (corners.w[i][i] * k1).max(of_absorber)
            })
            .fold(1.0, f64::max);
        let mut y = [0.0; N];
        y[RATE + 3] = -1.0;
        let mut run = Self {
            w: corners.w,
            units,
            y,
            closed: [true; 2],
            time: 0.0,
            step: STEP / fastest.sqrt(),
            a: [[0.0; N]; N],
            one_step: [[0.0; N]; N],
            rebound: 0.0,
            air: 0.0,
            changes: [0, 1],
        };
        run.take_contact();
        run
    }

    /// The motion of the present contact.
    fn take_contact(&mut self) {
        let mut a = [[0.0; N]; N];
        for i in 0..DIRECTIONS {
            let [k1, k2, m2, c] = self.units[i % 2];
            a[i][RATE + i] = 1.0;
            a[A + i][A_RATE + i] = 1.0;
            a[A_RATE + i][A + i] -= k2 / m2;
            a[A_RATE + i][A_RATE + i] -= c / m2;
            if self.closed[i / 2] {
                // F = k1 (a - p)
                a[A_RATE + i][A + i] -= k1 / m2;
                a[A_RATE + i][i] += k1 / m2;
                a[IMPULSE + i][A + i] = k1;
                a[IMPULSE + i][i] = -k1;
                for j in 0..DIRECTIONS {
                    a[RATE + j][A + i] += self.w[j][i] * k1;
                    a[RATE + j][i] -= self.w[j][i] * k1;
                }
            }
        }
        self.a = a;
        self.one_step = transposed(&exponential(&a, self.step));
    }

    /// What must stay positive while a foot's contact lasts: its force, or its distance from the
    /// absorber.
    fn lasts(&self, foot: usize, y: &[f64; N]) -> (f64, f64) {
        let z = 2 * foot + 1;
        let sign = if self.closed[foot] { 1.0 } else { -1.0 };
        ((y[A + z] - y[z]) * sign, (y[A_RATE + z] - y[RATE + z]) * sign)
    }

    /// One step, or up to the next change of contact.
    fn advance(&mut self) {
        let left = FOLLOWED - self.time;
        let whole = left > self.step;
        let next = if whole {
            combined(&self.one_step, &self.y)
        } else {
            times(&exponential(&self.a, left), &self.y)
        };
        let mut first: Option<(f64, [f64; N], usize)> = None;
        for foot in 0..2 {
            if self.lasts(foot, &next).0 >= -EDGE {
                continue;
            }
            let (tau, y) = self.locate(foot, if whole { self.step } else { left });
            if first.as_ref().is_none_or(|(earliest, ..)| tau < *earliest) {
                first = Some((tau, y, foot));
            }
        }
        let (tau, y, changed) = match first {
            Some((tau, y, foot)) => (tau, y, Some(foot)),
            None => (if whole { self.step } else { left }, next, None),
        };
        if !self.closed[0] && !self.closed[1] {
            self.air += tau;
        }
        self.time += tau;
        self.y = y;
        if let Some(foot) = changed {
            self.change(foot);
        }
    }

    /// When within the step the foot's contact changes, and the state there.
    fn locate(&self, foot: usize, step: f64) -> (f64, [f64; N]) {
        // a foot at the edge that goes the wrong way changes at once
        if self.lasts(foot, &self.y).0 <= EDGE {
            return (0.0, self.y);
        }
        let at = |tau: f64| times(&exponential(&self.a, tau), &self.y);
        let (mut low, mut high) = (0.0, step);
        let mut tau = 0.5 * step;
        let mut y = at(tau);
        for _ in 0..NEWTON {
            let (value, rate) = self.lasts(foot, &y);
            if value > 0.0 {
                low = tau;
            } else {
                high = tau;
            }
            let newton = tau - value / rate;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            if next == tau {
                break;
            }
            (tau, y) = (next, at(next));
        }
        (tau, y)
    }

    fn change(&mut self, foot: usize) {
        self.closed[foot] = !self.closed[foot];
        self.changes[1 - foot] += 1;
        let (x, z) = (2 * foot, 2 * foot + 1);
        if self.closed[foot] {
            // anchored where it lands: only differences of x count
            self.y[x] = self.y[A + x];
        } else if foot == 1 && self.y[RATE + z] > self.rebound {
            self.rebound = self.y[RATE + z];
        }
        self.take_contact();
    }

    fn finish(&self, corners: &CornerDynamics) -> PlaneLanding {
        let old_impulse = self.y[IMPULSE + 1];
        let beyond: [f64; DIRECTIONS] =
            std::array::from_fn(|i| self.y[IMPULSE + i] - corners.plastic[i]);
        let energy = |j: &[f64; DIRECTIONS]| dot(j, &times(&corners.w, j));
        PlaneLanding {
            momentum: old_impulse * corners.width / corners.momentum + 1.0,
            old_impulse,
            deviation: energy(&beyond) / energy(&corners.plastic),
            rebound: self.rebound,
            air: self.air,
            changes: [self.changes[0], self.changes[1]],
            #[cfg(test)]
            complete: self.time >= FOLLOWED * (1.0 - 1e-12),
        }
    }
}

#[cfg(test)]
mod tests;
