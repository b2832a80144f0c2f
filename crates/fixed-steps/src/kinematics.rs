//! A motion at the end of a step, and a trial of the next one.

use crate::integrator::{Integrator, StepFormula};

/// What multiplies M, -dF/dv and -dF/dq in the matrix of the iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentWeights {
    /// Of M [1/s2].
    pub mass: f64,
    /// Of the damping matrix [1/s].
    pub damping: f64,
    /// Of the stiffness matrix.
    pub stiffness: f64,
}

/// What dashpots of members resist in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberDamping {
    /// The rate of strain by the integrator's velocities.
    OfVelocities,
    /// The change of strain from where the step before took its forces, over a step: OpenSees'
    /// damping objects (its source SecStifDamping.cpp). Under HHT they divide by 1 + alpha of a
    /// step: the factor is not in here, decks take it off the objects.
    OfChanges,
}

/// Where a trial of a step takes its forces: place, velocity and acceleration there.
#[derive(Clone, Debug)]
pub struct Trial<V> {
    /// Place (m, rad).
    pub q: V,
    /// Velocity (m/s, rad/s).
    pub v: V,
    /// Acceleration (m/s2, rad/s2).
    pub a: V,
    /// Where the step before took its forces, and the size of this one (s), if dashpots of members
    /// resist the change from there.
    pub change: Option<(V, f64)>,
}

/// The motion so far: its last two steps.
#[derive(Clone, Debug)]
pub struct Kinematics<V> {
    /// Place at the last step's end.
    pub q: V,
    /// Velocity there.
    pub v: V,
    /// Acceleration there.
    pub a: V,
    before: [V; 2],
    /// Where the last step took its forces.
    forced: V,
    equal: usize,
    last: f64,
}

/// A motion that has died away is over: processors take ten times as long with the smallest
/// numbers that there are, which a damped mode comes to within a thousand steps.
#[inline(always)]
fn flushed(x: f64) -> f64 {
    if x.abs() < 1e-150 { 0.0 } else { x }
}

/// One step: how v and a follow from q.
#[derive(Clone, Debug)]
pub(crate) struct StepKinematics<V> {
    /// v and a at the end if q did not change.
    v: V,
    a: V,
    /// dv/dq and da/dq.
    rates: [f64; 2],
    forces_at: f64,
    inertia_at: f64,
    pub size: f64,
}

impl<V: Clone + AsRef<[f64]> + AsMut<[f64]>> Kinematics<V> {
    /// At rest at q. A program starts without acceleration, whatever the first load.
    pub fn at_rest(q: V) -> Self {
        let mut still = q.clone();
        still.as_mut().fill(0.0);
        let before = [q.clone(), still.clone()];
        Self { forced: q.clone(), q, v: still.clone(), a: still, before, equal: 0, last: 0.0 }
    }

    /// With a velocity and an acceleration.
    pub fn moving(q: V, v: V, a: V) -> Self {
        let (before, forced) = ([q.clone(), v.clone()], q.clone());
        Self { before, forced, q, v, a, equal: 0, last: 0.0 }
    }

    /// The next step. One of another size than the last begins a multi-step formula anew.
    #[inline]
    pub(crate) fn step(&self, integrator: &Integrator, size: f64) -> StepKinematics<V> {
        let equal = if size == self.last { self.equal } else { 0 };
        let (mut v, mut a) = (self.v.clone(), self.a.clone());
        match integrator.formula(equal) {
            StepFormula::Newmark { gamma, beta, forces_at, inertia_at } => {
                let ratio = gamma / beta;
                let (of_v, of_a) = (1.0 - ratio, size * (1.0 - 0.5 * ratio));
                let (a_of_v, a_of_a) = (-1.0 / (beta * size), 1.0 - 0.5 / beta);
                for (v, a) in v.as_mut().iter_mut().zip(a.as_mut()) {
                    (*v, *a) = (of_v * *v + of_a * *a, a_of_v * *v + a_of_a * *a);
                }
                let rates = [ratio / size, 1.0 / (beta * size * size)];
                StepKinematics { v, a, rates, forces_at, inertia_at, size }
            }
            StepFormula::Bdf2 => {
                let half = 0.5 / size;
                let [q_before, v_before] = self.before.each_ref().map(AsRef::as_ref);
                let now = self.q.as_ref();
                for (i, (v, a)) in v.as_mut().iter_mut().zip(a.as_mut()).enumerate() {
                    let v_now = *v;
                    *v = half * (q_before[i] - now[i]);
                    *a = half * v_before[i] - 4.0 * half * v_now + 3.0 * half * *v;
                }
                let rates = [3.0 * half, 9.0 * half * half];
                StepKinematics { v, a, rates, forces_at: 1.0, inertia_at: 1.0, size }
            }
        }
    }

    /// Take the step that ends `change` from here.
    #[inline]
    pub(crate) fn advance(&mut self, step: &StepKinematics<V>, change: &V) {
        self.equal = if step.size == self.last { self.equal + 1 } else { 1 };
        self.last = step.size;
        std::mem::swap(&mut self.before[0], &mut self.q);
        std::mem::swap(&mut self.before[1], &mut self.v);
        let [of_v, of_a] = step.rates;
        let (change, forced) = (change.as_ref(), self.forced.as_mut());
        let (q, v, a) = (self.q.as_mut(), self.v.as_mut(), self.a.as_mut());
        for (i, &d) in change.iter().enumerate() {
            let from = self.before[0].as_ref()[i];
            forced[i] = from + step.forces_at * d;
            q[i] = flushed(from + d);
            v[i] = flushed(step.v.as_ref()[i] + of_v * d);
            a[i] = flushed(step.a.as_ref()[i] + of_a * d);
        }
    }

    /// A step failed: what follows begins a multi-step formula anew.
    pub(crate) fn begin_anew(&mut self) {
        self.equal = 0;
        self.last = 0.0;
    }
}

impl<V: Clone + AsRef<[f64]> + AsMut<[f64]>> StepKinematics<V> {
    /// Time at which the forces count, of the step's.
    pub(crate) fn forces_at(&self) -> f64 {
        self.forces_at * self.size
    }

    #[inline]
    pub(crate) fn weights(&self) -> TangentWeights {
        let [of_v, of_a] = self.rates;
        TangentWeights {
            mass: self.inertia_at * of_a,
            damping: self.forces_at * of_v,
            stiffness: self.forces_at,
        }
    }

    /// Where the forces of the trial that ends `change` from `from` are taken.
    #[inline]
    pub(crate) fn trial(&self, from: &Kinematics<V>, change: &V, out: &mut Trial<V>) {
        let ([of_v, of_a], w, m) = (self.rates, self.forces_at, self.inertia_at);
        let (change, v, a) = (change.as_ref(), self.v.as_ref(), self.a.as_ref());
        let (q0, v0, a0) = (from.q.as_ref(), from.v.as_ref(), from.a.as_ref());
        let (q_out, v_out, a_out) = (out.q.as_mut(), out.v.as_mut(), out.a.as_mut());
        for (i, &d) in change.iter().enumerate() {
            q_out[i] = q0[i] + w * d;
            v_out[i] = (1.0 - w) * v0[i] + w * (v[i] + of_v * d);
            a_out[i] = (1.0 - m) * a0[i] + m * (a[i] + of_a * d);
        }
        if let Some((forced, size)) = &mut out.change {
            forced.as_mut().copy_from_slice(from.forced.as_ref());
            *size = self.size;
        }
    }
}
