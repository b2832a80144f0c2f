//! Progress on stderr: a bar on a terminal, plain lines in a pipe, nothing when quiet.

use std::{
    io::IsTerminal,
    sync::atomic::{AtomicUsize, Ordering},
};

use indicatif::{ProgressBar, ProgressStyle};

/// Shows how far a piece of work is.
pub struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    what: &'static str,
    tenth: AtomicUsize,
}

impl Progress {
    pub fn new(what: &'static str, quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (!quiet && terminal).then(|| {
            let style = ProgressStyle::with_template("{prefix} [{bar:40}] {pos}/{len} {msg}");
            let bar = ProgressBar::new(1).with_prefix(what);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self { bar, lines: !quiet && !terminal, what, tenth: AtomicUsize::new(0) }
    }

    /// `done` of `total`, with the status.
    pub fn tell(&self, done: usize, total: usize, status: &str) {
        if let Some(bar) = &self.bar {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
            bar.set_message(status.to_string());
        }
        let tenth = 10 * done / total.max(1);
        if self.lines && self.tenth.swap(tenth, Ordering::Relaxed) != tenth {
            eprintln!("{}: {done}/{total} {status}", self.what);
        }
    }

    pub fn done(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
