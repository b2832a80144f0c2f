//! What a history is designed by, beside Housner's: the largest displacement, uplift and forces of
//! the ground between landings.
//!
//! ```text
//!   displacement   max |u|
//!   uplift         max 2b sin |theta| of a foot, while one is off the ground
//!   base shear     max |F|,   F = m ( (u'_i - u'_(i-1))/dt + mean a_g )          mean over the interval between two samples
//!   axial force    max |N|,   N = m ( (v'_i - v'_(i-1))/dt + g + mean a_v )
//!   error          | peak - peak of Housner | / peak of Housner
//! ```
//!
//! F and N are the momentum that the ground gives the body in an interval, the feet's forces
//! together: on one foot N b is the moment at the base. They need no spring's force, which a step
//! of a stiff spring knows less well than velocities, and are the same formula in both models.
//! **Between landings**: no interval counts in which a foot of one of the models has landed, or
//! that begins less than 0.1/p after it. A landing is an impulse in Housner's theory, and on
//! springs as large a force as they are stiff. A body that overturns is compared up to then.

use serde::{Deserialize, Serialize};

use dynamics::fem::MOMENT;
use rocking::{
    housner::Rocking, json::null_as_infinite, scalar::GRAVITY, statistics::largest, structure::Body,
};

/// Relative errors of a history's peaks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeakErrors {
    /// Of the largest |u|.
    #[serde(deserialize_with = "null_as_infinite")]
    pub displacement: f64,
    /// Of the largest uplift of a foot.
    #[serde(deserialize_with = "null_as_infinite")]
    pub uplift: f64,
    /// Of the largest horizontal force of the ground between landings.
    #[serde(deserialize_with = "null_as_infinite")]
    pub base_shear: f64,
    /// Of the largest vertical force of the ground between landings.
    #[serde(deserialize_with = "null_as_infinite")]
    pub axial: f64,
}

impl PeakErrors {
    /// Of a history that says nothing.
    pub const LOST: Self = Self::of([f64::INFINITY; 4]);

    /// In the order of the fields.
    pub const fn of([displacement, uplift, base_shear, axial]: [f64; 4]) -> Self {
        Self { displacement, uplift, base_shear, axial }
    }

    /// In the order of the fields.
    pub fn all(&self) -> [f64; 4] {
        [self.displacement, self.uplift, self.base_shear, self.axial]
    }

    /// Which of the four is the largest, in words.
    pub fn worst(&self) -> &'static str {
        let names = ["displacement", "uplift", "base shear", "axial force"];
        let all = names.into_iter().zip(self.all());
        all.max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or("", |(name, _)| name)
    }

    /// The largest of the four. The moment at the base goes with the axial force: it is N b on one
    /// foot.
    pub fn largest(&self) -> f64 {
        largest(self.all())
    }
}

/// Mean forces of the ground over an interval, over the mass (m/s2), horizontal and vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MeanForces {
    housner: [f64; 2],
    /// Mean ground acceleration, and g with the vertical one: what a body at rest needs.
    still: [f64; 2],
}

/// Housner's forces, interval by interval.
#[derive(Clone, Debug, Default)]
pub struct HousnerForces {
    dt: f64,
    /// How long after a landing forces do not count (s).
    rest: f64,
    /// Of the interval that ends at a sample; none where he lands in it, or has landed less than
    /// that before it.
    rows: Vec<Option<MeanForces>>,
}

impl HousnerForces {
    /// Of his motion through a record of samples dt apart, horizontal and vertical, zero beyond the
    /// latter's end (m/s2).
    pub fn new(
        body: &Body<f64>,
        dt: f64,
        (accel, up): (&[f64], &[f64]),
        rocking: &Rocking<f64>,
    ) -> Self {
        let rest = MOMENT / body.p();
        let velocity = |i: usize| {
            let (theta, rate) = (rocking.theta[i], rocking.rate[i]);
            let side = if theta == 0.0 { rate.signum() } else { theta.signum() };
            let (sin, cos) = theta.sin_cos();
            let across = body.half_width * side;
            // du/dtheta, dv/dtheta
            [(across * sin + body.height * cos) * rate, (across * cos - body.height * sin) * rate]
        };
        let up = |i: usize| up.get(i).copied().unwrap_or(0.0);
        let n = rocking.theta.len().min(rocking.rate.len()).min(accel.len());
        let mut rows = vec![None; n.min(1)];
        let mut before = if n > 0 { velocity(0) } else { [0.0; 2] };
        for i in 1..n {
            let (now, time) = (velocity(i), i as f64 * dt);
            let first = rocking.impacts.partition_point(|impact| impact.time < time - dt - rest);
            let landed = rocking.impacts.get(first).is_some_and(|impact| impact.time <= time);
            let still = [0.5 * (accel[i - 1] + accel[i]), GRAVITY + 0.5 * (up(i - 1) + up(i))];
            let housner = [0, 1].map(|k| (now[k] - before[k]) / dt + still[k]);
            rows.push((!landed).then_some(MeanForces { housner, still }));
            before = now;
        }
        Self { dt, rest, rows }
    }
}

/// Peaks of the finite elements' history and of Housner's, over the samples compared so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PeakPairs {
    /// |u| (m).
    displacement: [f64; 2],
    /// |theta| while a foot is off the ground (rad).
    lean: [f64; 2],
    /// Forces over the mass (m/s2), horizontal and vertical.
    forces: [[f64; 2]; 2],
}

fn raise(pair: &mut [f64; 2], values: [f64; 2]) {
    for (largest, value) in pair.iter_mut().zip(values) {
        *largest = largest.max(value.abs());
    }
}

impl PeakPairs {
    /// Take note of u (m) and theta (rad), the latter of a body with a foot off the ground, of both
    /// models at a sample.
    pub(crate) fn motion(&mut self, u: [f64; 2], theta: [f64; 2]) {
        raise(&mut self.displacement, u);
        raise(&mut self.lean, theta);
    }

    /// Take note of the forces in the interval that ends at a sample, where they count: a foot on
    /// springs touched the ground last at `touched` (s), and the centre of mass had these
    /// velocities before it and has them at its end (m/s).
    pub(crate) fn interval(
        &mut self,
        forces: &HousnerForces,
        index: usize,
        touched: f64,
        velocities: [[f64; 2]; 2],
    ) {
        let Some(Some(row)) = forces.rows.get(index) else { return };
        let begin = index.saturating_sub(1) as f64 * forces.dt;
        if touched >= begin - forces.rest {
            return;
        }
        let [before, now] = velocities;
        for (k, pair) in self.forces.iter_mut().enumerate() {
            raise(pair, [(now[k] - before[k]) / forces.dt + row.still[k], row.housner[k]]);
        }
    }

    /// The errors; that of forces nothing where none could be compared.
    pub fn errors(&self) -> PeakErrors {
        let relative = |[fem, housner]: [f64; 2]| {
            if fem == housner { 0.0 } else { (fem / housner - 1.0).abs() }
        };
        let uplift = self.lean.map(|theta| theta.min(std::f64::consts::FRAC_PI_2).sin());
        PeakErrors::of([self.displacement, uplift, self.forces[0], self.forces[1]].map(relative))
    }
}
