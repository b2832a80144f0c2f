//! The energy account: what came in, what is stored, what was lost, and what is left unexplained.

use rocking::scalar::Scalar;

/// Energy account since the start (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy<S> {
    /// Stored at the start.
    pub initial: S,
    /// Kinetic, gravitational and elastic energy now.
    pub stored: S,
    /// Work of the base excitation.
    pub input: S,
    /// Taken by the dashpots.
    pub dissipated: S,
    /// Elastic energy of horizontal springs let go when their foot left the ground.
    pub released: S,
}

impl<S: Scalar> Energy<S> {
    /// The account of a run that begins with this much stored (J).
    pub fn new(stored: S) -> Self {
        let zero = S::zero();
        Self { initial: stored, stored, input: zero, dissipated: zero, released: zero }
    }

    /// Book a step.
    #[inline]
    pub fn book(&mut self, stored: S, input: S, dissipated: S) {
        self.stored = stored;
        self.input += input;
        self.dissipated += dissipated;
    }

    /// The larger of the largest energy so far and that of now (J).
    #[inline]
    pub fn largest(&self, so_far: f64) -> f64 {
        so_far.max(self.input.re().abs()).max((self.stored - self.initial).re().abs())
    }

    /// What the account leaves unexplained: stored - initial - input + dissipated + released (J).
    pub fn residual(&self) -> S {
        self.stored - self.initial - self.input + self.dissipated + self.released
    }
}
