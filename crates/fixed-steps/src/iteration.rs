//! The iteration at a step's end.
//!
//! ```text
//!   Newton's:            (m M + c C + k K(q)) dq = unbalance(q),    K anew in every iteration
//!   constant stiffness:  the same, K that of the step's begin
//! ```

use crate::{
    kinematics::{Kinematics, MemberDamping, StepKinematics, Trial},
    model::FixedStepModel,
};

/// Newton's iterations at most.
pub const NEWTON: usize = 30;

/// What an iteration has to come below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConvergenceTest {
    /// Euclidean norm of the last change, metres and radians together: OpenSees' `NormDispIncr`.
    Increment(f64),
    /// Euclidean norm of the unbalance of every node, N and N m together
    /// ([`FixedStepModel::unbalance_norm`]): OpenSees' `NormUnbalance`.
    Unbalance(f64),
}

/// How a program iterates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// At most so many with the stiffness of the step's begin, before Newton's (0: none).
    pub constant: usize,
    /// At most so many of Newton's; they begin anew from the step's begin.
    pub newton: usize,
    /// The test that ends it.
    pub test: ConvergenceTest,
}

impl Iteration {
    /// As scripts for OpenSees have it: Newton's, 20 at most, to a change of 1e-8 m.
    pub const SCRIPT: Self =
        Self { constant: 0, newton: 20, test: ConvergenceTest::Increment(1e-8) };
}

/// Which of its iterations: on one matrix, or each on its own.
#[derive(Clone, Copy, PartialEq)]
enum IterationPhase {
    Constant,
    Newton,
}

/// Room for the iteration's vectors, used again in every step.
pub(crate) struct Iterates<M: FixedStepModel> {
    /// From the step's begin (m, rad).
    pub change: M::Vector,
    /// Where its forces are taken.
    pub trial: Trial<M::Vector>,
    /// The feet's places there.
    pub places: M::Places,
    before: (M::Places, M::Vector),
    unbalance: M::Vector,
    increment: M::Vector,
    /// Iterations so far, of all steps.
    pub count: usize,
}

impl<M: FixedStepModel> Iterates<M> {
    pub(crate) fn new(model: &M, like: &M::Vector, damping: MemberDamping) -> Self {
        let change = (damping == MemberDamping::OfChanges).then(|| (like.clone(), 0.0));
        let trial = Trial { q: like.clone(), v: like.clone(), a: like.clone(), change };
        let places = model.places(like);
        Self {
            change: like.clone(),
            trial,
            before: (places.clone(), like.clone()),
            places,
            unbalance: like.clone(),
            increment: like.clone(),
            count: 0,
        }
    }

    /// Iterate to the end of a step; whether it has arrived. `feet` are left as the last trial met
    /// them, `change` is the step's.
    pub(crate) fn arrives(
        &mut self,
        model: &M,
        how: &Iteration,
        from: &Kinematics<M::Vector>,
        step: &StepKinematics<M::Vector>,
        feet: &mut M::Feet,
        ground: [f64; 2],
    ) -> bool {
        self.phase(model, how, IterationPhase::Constant, (from, step), feet, ground)
            || self.phase(model, how, IterationPhase::Newton, (from, step), feet, ground)
    }

    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    fn phase(
        &mut self,
        model: &M,
        how: &Iteration,
        phase: IterationPhase,
        (from, step): (&Kinematics<M::Vector>, &StepKinematics<M::Vector>),
        feet: &mut M::Feet,
        ground: [f64; 2],
    ) -> bool {
        let most = match phase {
            IterationPhase::Constant => how.constant,
            IterationPhase::Newton => how.newton,
        };
        if most == 0 {
            return false;
        }
        let weights = step.weights();
        self.change.as_mut().fill(0.0);
        self.look(model, from, step, feet, ground, true);
        let mut factor = None;
        for _ in 0..most {
            if phase == IterationPhase::Newton || factor.is_none() {
                factor = model.factor((&self.trial, &self.places), feet, &weights);
            }
            let Some(factor) = &factor else { return false };
            self.count += 1;
            self.increment.as_mut().copy_from_slice(self.unbalance.as_ref());
            model.solve(factor, &mut self.increment);
            for (change, by) in self.change.as_mut().iter_mut().zip(self.increment.as_ref()) {
                *change += by;
            }
            self.look(model, from, step, feet, ground, false);
            let norm = |x: &M::Vector| x.as_ref().iter().map(|x| x * x).sum::<f64>().sqrt();
            let (left, below) = match how.test {
                ConvergenceTest::Increment(below) => (norm(&self.increment), below),
                ConvergenceTest::Unbalance(below) => {
                    (model.unbalance_norm(&self.places, &self.unbalance), below)
                }
            };
            if left <= below {
                return true;
            }
            if !left.is_finite() {
                return false;
            }
        }
        false
    }

    /// The trial, its contacts and its unbalance.
    #[inline(always)]
    fn look(
        &mut self,
        model: &M,
        from: &Kinematics<M::Vector>,
        step: &StepKinematics<M::Vector>,
        feet: &mut M::Feet,
        ground: [f64; 2],
        first: bool,
    ) {
        self.before.1.as_mut().copy_from_slice(self.trial.q.as_ref());
        step.trial(from, &self.change, &mut self.trial);
        let q = &self.trial.q;
        std::mem::swap(&mut self.before.0, &mut self.places);
        self.places = model.places(q);
        if !first {
            model.meet_after((&self.before.0, &self.before.1), q, feet);
        } else if step.forces_at() == step.size {
            model.meet(&self.places, q, feet);
        } else {
            // a foot is where the last step left it
            model.meet_end(&self.places, f64::INFINITY, q, feet);
        }
        let trial = (&self.trial, &self.places);
        model.unbalance(trial, feet, ground, &mut self.unbalance);
    }
}
