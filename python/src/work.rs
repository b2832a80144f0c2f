//! Long work off Python's thread: the GIL is released, and ^C ends it.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{
        Condvar, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

use pyo3::prelude::*;

/// How often ^C is looked for.
const LOOK: Duration = Duration::from_millis(50);

/// Whether ^C was pressed.
pub struct Stop(AtomicBool);

/// What unwinds a thread whose work is no longer wanted.
struct Stopped;

impl Stop {
    pub fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// End the work here if ^C was pressed: called where the crate reports its progress, which it
    /// cannot be stopped by otherwise. No panic is printed.
    pub fn check(&self) {
        if self.asked() {
            resume_unwind(Box::new(Stopped));
        }
    }
}

/// Do `work` on another thread until it is done or ^C is pressed; `work` should call
/// [`Stop::check`] now and then.
pub fn interruptible<T: Send>(py: Python<'_>, work: impl FnOnce(&Stop) -> T + Send) -> PyResult<T> {
    watched(py, work, |_| Ok(()))
}

/// The same; `look` is called whenever ^C is looked for, and at the end: it may tell how far the
/// work has come, and an error of its own ends the work, too.
pub fn watched<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Stop) -> T + Send,
    mut look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let stop = Stop(AtomicBool::new(false));
    let (slot, ready) = (Mutex::new(None), Condvar::new());
    thread::scope(|scope| {
        scope.spawn(|| {
            let result = catch_unwind(AssertUnwindSafe(|| work(&stop)));
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
            ready.notify_one();
        });
        let mut interrupted = None;
        loop {
            let result = py.detach(|| {
                let guard = slot.lock().unwrap_or_else(PoisonError::into_inner);
                let waited = ready.wait_timeout_while(guard, LOOK, |result| result.is_none());
                waited.unwrap_or_else(PoisonError::into_inner).0.take()
            });
            match (result, interrupted.take()) {
                (Some(_), Some(error)) => return Err(error),
                (Some(Ok(value)), None) => return look(py).map(|()| value),
                (Some(Err(panic)), None) => resume_unwind(panic),
                (None, error) => interrupted = error,
            }
            if interrupted.is_none()
                && let Err(error) = py.check_signals().and_then(|()| look(py))
            {
                stop.0.store(true, Ordering::Relaxed);
                interrupted = Some(error);
            }
        }
    })
}
