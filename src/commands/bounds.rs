//! How much work a job may do, and what stops it: options, ^C.

use std::{
    path::Path,
    sync::{
        Once,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use clap::Args;

use super::{CommandError, terminal};
use dynamics::effort::{CutBy, Effort, StopSignal};

/// Whether ^C was pressed.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static WATCHED: Once = Once::new();

/// Exit code of what ^C ended: 128 and the signal's number, as shells have it.
pub const INTERRUPTED_CODE: u8 = 130;

/// Bounds on the search for springs.
#[derive(Debug, Args)]
pub struct EffortOptions {
    /// Work that the search for springs may take, as a multiple of the default, which is about a
    /// minute on two cores for a rigid body and two minutes for an elastic structure. Steps are
    /// counted, not seconds: the same inputs give the same results on any machine
    #[arg(long, value_name = "TIMES", default_value_t = 1.0, allow_negative_numbers = true)]
    work: f64,
    /// Stop the search for springs after so many seconds, and keep the best so far; the record is
    /// then followed on them, without the check of forces [default: none]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    time_limit: Option<f64>,
}

impl EffortOptions {
    /// The effort of a job whose default is so many units, watched for ^C from now on.
    pub fn of(&self, units: u64) -> Result<Effort, CommandError> {
        if !(self.work > 0.0 && self.work.is_finite()) {
            return Err(CommandError::option(
                "work",
                self.work,
                "give a number above zero: 1 is the default, 10 ten times as much",
            ));
        }
        let limit = |seconds: f64| match Duration::try_from_secs_f64(seconds) {
            Ok(limit) if seconds > 0.0 => Ok(limit),
            _ => Err(CommandError::option(
                "time-limit",
                seconds,
                "give seconds above zero, or leave it out for none",
            )),
        };
        let limit = self.time_limit.map(limit).transpose()?;
        // a limit beyond what clocks count to is none
        let until = limit.and_then(|limit| Instant::now().checked_add(limit));
        watch();
        let signal = StopSignal { until, interrupted: Some(&INTERRUPTED) };
        Ok(Effort::of((self.work * units as f64) as u64, signal))
    }
}

/// From now on the first ^C stops the search, and the second ends the program at once.
fn watch() {
    WATCHED.call_once(|| {
        let pressed = || {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                std::process::exit(INTERRUPTED_CODE.into());
            }
            terminal::stderr(
                "^C: ending the search and keeping the best springs so far; press again to quit at \
                    once",
            );
        };
        // where it cannot be watched ^C ends the program, as ever
        let _ = ctrlc::set_handler(pressed);
    });
}

/// The end of a job whose results are in a folder: ^C has an exit code of its own.
pub fn ended(effort: &Effort, folder: &Path) -> Result<(), CommandError> {
    match effort.cut() {
        Some(CutBy::Interrupt) => {
            Err(CommandError::Interrupted { folder: terminal::shown(folder) })
        }
        _ => Ok(()),
    }
}
