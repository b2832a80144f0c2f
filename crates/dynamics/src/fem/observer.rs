//! What a run shows while it goes, and to whom.

use std::ops::ControlFlow;

use super::{
    energy::Energy,
    model::{Foot, Model, State, TH, X, Z},
};

/// A foot's change of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// A foot touches the ground.
    TouchDown,
    /// A foot leaves it.
    LiftOff,
}

/// What a run shows while it goes.
pub struct View<'a> {
    /// Time (s).
    pub time: f64,
    pub(crate) model: &'a Model,
    pub(crate) state: &'a State,
    pub(crate) feet: &'a [Foot; 2],
    /// Energy account so far.
    pub energy: &'a Energy,
}

impl View<'_> {
    /// Horizontal displacement of the centre of mass (m).
    pub fn x(&self) -> f64 {
        self.state.q[X]
    }

    /// Horizontal velocity of the centre of mass (m/s).
    pub fn speed(&self) -> f64 {
        self.state.v[X]
    }

    /// Vertical velocity of the centre of mass, positive upwards (m/s).
    pub fn climb(&self) -> f64 {
        self.state.v[Z]
    }

    /// Vertical displacement of the centre of mass from the unstressed position (m).
    pub fn z(&self) -> f64 {
        self.state.q[Z]
    }

    /// Rotation (rad).
    pub fn theta(&self) -> f64 {
        self.state.q[TH]
    }

    /// Rotation rate (rad/s).
    pub fn theta_rate(&self) -> f64 {
        self.state.v[TH]
    }

    /// Whether foot i (0 left, 1 right) presses on the ground.
    pub fn presses(&self, i: usize) -> bool {
        self.feet[i].presses()
    }

    /// Vertical force on foot i, positive while it presses (N).
    pub fn vertical_force(&self, i: usize) -> f64 {
        self.model.contact(&self.state.q, self.feet)[i].vertical
    }

    /// Upward velocity of foot i (m/s).
    pub fn foot_speed(&self, i: usize) -> f64 {
        self.model.foot_rate(i, self.state)
    }

    /// Kinetic energy of the body (J).
    pub(crate) fn body_kinetic(&self) -> f64 {
        self.model.body_kinetic(self.state)
    }
}

/// Receives a run's samples and events; may stop it.
pub trait Observer {
    /// Called at every sample, the first at t = 0.
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()>;
    /// Called at the end of every accepted step, before an event that ends there changes the
    /// contact.
    fn step(&mut self, _view: &View) {}
    /// Called right after foot `foot` (0 left, 1 right) changed its contact.
    fn event(&mut self, _foot: usize, _change: Change, _view: &View) {}
}

/// Lets a closure serve as an observer of samples.
impl<F: FnMut(usize, &View) -> ControlFlow<()>> Observer for F {
    fn sample(&mut self, index: usize, view: &View) -> ControlFlow<()> {
        self(index, view)
    }
}
