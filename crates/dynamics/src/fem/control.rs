//! Accuracy and limits of a run, its outcome, its cost.

/// How accurately and how long to work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Energy that one step may lose or gain, relative to the largest energy so far: all steps
    /// together keep the account's residual below 50 times this. Its power 2/3, times 0.1, is the
    /// local error that a step may have, of the body's place over R alpha and of its momentum over
    /// m p R alpha: this is what the error of the history follows.
    pub tolerance: f64,
    /// Steps per history before it is given up.
    pub most_steps: usize,
    /// Take no steps while the body rests on still ground.
    pub skip_rest: bool,
    /// Solve nothing for an open foot's contact.
    pub skip_open: bool,
    /// Take steps over several samples while the body leans on one foot (`run/span`): for peaks and
    /// comparisons. Forces and energies at samples within such a step are those at its end.
    pub long_steps: bool,
}

impl Control {
    /// For comparing many candidates: a hundred times the default's tolerance.
    pub fn search() -> Self {
        Self { tolerance: 1e-6, most_steps: 200_000, ..Self::default() }
    }
}

impl Default for Control {
    /// 20 s of El Centro, NRMSE of u against a tolerance of 1e-12: 2e-7 at most for the 61 m frame
    /// on springs of 160 Hz to 20 kHz, 5e-6 for a block of alpha 0.24 (`tests/fem/accuracy.rs`).
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            most_steps: 2_000_000,
            skip_rest: true,
            skip_open: true,
            long_steps: false,
        }
    }
}

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HistoryOutcome {
    /// The record was followed to its end.
    Completed,
    /// The body lay flat (|theta| > pi/2) at this time (s).
    Overturned {
        /// When (s).
        time: f64,
    },
    /// The observer asked to stop at this time (s). No history that a user gets ends so.
    #[doc(hidden)]
    Stopped {
        /// When (s).
        time: f64,
    },
    /// The bound on steps was reached at this time (s).
    WorkBound {
        /// When (s).
        time: f64,
    },
    /// No balance was found at this time (s): soft springs buckle under a body without rotational
    /// inertia, or it leans so far that its foot would have to pull. No motion follows from the
    /// model after that.
    Unstable {
        /// When (s).
        time: f64,
    },
}

impl HistoryOutcome {
    /// When it ended before its record though the body had not fallen over (s).
    pub fn ends_early(self) -> Option<f64> {
        match self {
            Self::Completed | Self::Overturned { .. } => None,
            Self::Stopped { time } | Self::WorkBound { time } | Self::Unstable { time } => {
                Some(time)
            }
        }
    }
}

/// Work done by a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Steps accepted.
    pub steps: usize,
    /// Steps taken again, smaller.
    pub rejected: usize,
    /// Steps that ended at an event.
    pub located: usize,
    /// Touches and lifts.
    pub events: usize,
    /// Newton iterations.
    pub iterations: usize,
    /// Steps so small that they were accepted whatever their error: none, unless a force jumps
    /// where no event is.
    pub smallest: usize,
}
