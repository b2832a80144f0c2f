//! How hard a run works, how it ends, and what it cost.

/// How accurately and how long to work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Energy that one step may lose or gain, relative to the largest energy so far. All steps together keep the
    /// account's residual below 500 times this.
    pub tolerance: f64,
    /// Steps per history before it is given up.
    pub most_steps: usize,
    /// Iterations added after convergence (2 for dual numbers).
    pub extra_iterations: usize,
    /// Take no steps while the body rests on still ground.
    pub skip_rest: bool,
    /// Solve nothing for an open foot's contact.
    pub skip_open: bool,
}

impl Control {
    /// For comparing many candidates. Against tolerance 1e-10 on El Centro, springs up to 160 Hz with an error below 0.3: nine
    /// in ten of 153 errors within 3e-6, the worst within 2e-5; in 0.3 to 0.6 of the default's time (`tune bench`).
    pub fn search() -> Self {
        Self { tolerance: 1e-6, most_steps: 200_000, ..Self::default() }
    }
}

impl Default for Control {
    fn default() -> Self {
        Self { tolerance: 1e-9, most_steps: 2_000_000, extra_iterations: 0, skip_rest: true, skip_open: true }
    }
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The record was followed to its end.
    Completed,
    /// The body lay flat (|theta| > pi/2) at this time [s].
    Overturned { time: f64 },
    /// The observer asked to stop at this time [s].
    Stopped { time: f64 },
    /// The bound on steps was reached at this time [s].
    WorkBound { time: f64 },
    /// The rotation of a body without rotational inertia lost its balance at this time [s]: soft springs buckle under the
    /// body, or it leans so far that its foot would have to pull. No motion follows from the model after that.
    Unstable { time: f64 },
}

/// Work done by a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    pub steps: usize,
    pub rejected: usize,
    pub located: usize,
    pub events: usize,
    pub iterations: usize,
}
