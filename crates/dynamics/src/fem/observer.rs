//! What a run shows while it goes, and to whom.

use std::ops::ControlFlow;

use super::{
    energy::Energy,
    model::{Foot, Model, State, TH, X, Z},
};
use rocking::scalar::Scalar;

/// A foot's change of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// A foot touches the ground.
    TouchDown,
    /// A foot leaves it.
    LiftOff,
}

/// What a run shows while it goes.
pub struct View<'a, S> {
    /// Time (s).
    pub time: S,
    pub(crate) model: &'a Model<S>,
    pub(crate) state: &'a State<S>,
    pub(crate) feet: &'a [Foot<S>; 2],
    /// Energy account so far.
    pub energy: &'a Energy<S>,
}

impl<S: Scalar> View<'_, S> {
    /// Horizontal displacement of the centre of mass (m).
    pub fn x(&self) -> S {
        self.state.q[X]
    }

    /// Horizontal velocity of the centre of mass (m/s).
    pub fn speed(&self) -> S {
        self.state.v[X]
    }

    /// Vertical velocity of the centre of mass, positive upwards (m/s).
    pub fn climb(&self) -> S {
        self.state.v[Z]
    }

    /// Vertical displacement of the centre of mass from the unstressed position (m).
    pub fn z(&self) -> S {
        self.state.q[Z]
    }

    /// Rotation (rad).
    pub fn theta(&self) -> S {
        self.state.q[TH]
    }

    /// Rotation rate (rad/s).
    pub fn theta_rate(&self) -> S {
        self.state.v[TH]
    }

    /// Whether foot i (0 left, 1 right) presses on the ground.
    pub fn presses(&self, i: usize) -> bool {
        self.feet[i].presses()
    }

    /// Vertical force on foot i, positive while it presses (N).
    pub fn vertical_force(&self, i: usize) -> S {
        self.model.contact(&self.state.q, self.feet)[i].vertical
    }

    /// Upward velocity of foot i (m/s).
    pub fn foot_speed(&self, i: usize) -> S {
        self.model.foot_rate(i, self.state)
    }

    /// Kinetic energy of the body (J).
    pub(crate) fn body_kinetic(&self) -> S {
        self.model.body_kinetic(self.state)
    }
}

/// Receives a run's samples and events; may stop it.
pub trait Observer<S: Scalar> {
    /// Called at every sample, the first at t = 0.
    fn sample(&mut self, index: usize, view: &View<S>) -> ControlFlow<()>;
    /// Called at the end of every accepted step, before an event that ends there changes the
    /// contact.
    fn step(&mut self, _view: &View<S>) {}
    /// Called right after foot `foot` (0 left, 1 right) changed its contact.
    fn event(&mut self, _foot: usize, _change: Change, _view: &View<S>) {}
}

/// Lets a closure serve as an observer of samples.
impl<S: Scalar, F: FnMut(usize, &View<S>) -> ControlFlow<()>> Observer<S> for F {
    fn sample(&mut self, index: usize, view: &View<S>) -> ControlFlow<()> {
        self(index, view)
    }
}
