//! The energy account: what came in, what is stored, what was lost, and what is left unexplained.

/// Energy account since the start (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Stored at the start.
    pub initial: f64,
    /// Kinetic, gravitational and elastic energy now.
    pub stored: f64,
    /// Work of the base excitation.
    pub input: f64,
    /// Taken by the dashpots.
    pub dissipated: f64,
    /// The part of it that members take.
    pub by_members: f64,
    /// Elastic energy of horizontal springs let go when their foot left the ground.
    pub released: f64,
}

impl Energy {
    /// The account of a run that begins with this much stored (J).
    pub fn new(stored: f64) -> Self {
        Self { initial: stored, stored, ..Self::default() }
    }

    /// Book a step.
    #[inline]
    pub fn book(&mut self, stored: f64, input: f64, dissipated: f64) {
        self.stored = stored;
        self.input += input;
        self.dissipated += dissipated;
    }

    /// The larger of the largest energy so far and that of now (J).
    #[inline]
    pub fn largest(&self, so_far: f64) -> f64 {
        so_far.max(self.input.abs()).max((self.stored - self.initial).abs())
    }

    /// Taken by the springs, in landings (J).
    pub(crate) fn by_springs(&self) -> f64 {
        self.dissipated - self.by_members + self.released
    }

    /// What the account leaves unexplained: stored - initial - input + dissipated + released (J).
    pub fn residual(&self) -> f64 {
        self.stored - self.initial - self.input + self.dissipated + self.released
    }
}
