//! Progress on stderr: a bar on a terminal, plain lines in a pipe, nothing when quiet.

use std::{
    io::IsTerminal,
    sync::atomic::{AtomicUsize, Ordering},
};

use indicatif::{ProgressBar, ProgressStyle};

use super::terminal;
use cases::doubts::Doubt;
use files::message::percent;

/// Shows how far a piece of work is.
pub struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    what: &'static str,
    tenth: AtomicUsize,
}

impl Progress {
    /// Of `tune run`, whose work is short: on a terminal only.
    pub fn on_terminal(what: &'static str, quiet: bool) -> Self {
        Self { lines: false, ..Self::new(what, quiet) }
    }

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

    /// `done` of `total`, with the status; a total of zero is not known.
    pub fn tell(&self, done: usize, total: usize, status: &str) {
        if let Some(bar) = &self.bar {
            // a total that is not known keeps the bar open
            bar.set_length(if total == 0 { done as u64 + 1 } else { total as u64 });
            bar.set_position(done as u64);
            bar.set_message(status.to_string());
        }
        let tenth = 10 * done / total.max(1);
        if self.lines && self.tenth.swap(tenth, Ordering::Relaxed) != tenth {
            terminal::stderr(line(self.what, done, total, status));
        }
    }

    pub fn done(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Before long work, on a terminal: the ground motion that was taken, and what to look at again.
/// The screen at the end has both, too.
pub fn taken(record: &str, doubts: &[Doubt], quiet: bool) {
    if quiet || !std::io::stderr().is_terminal() {
        return;
    }
    terminal::stderr(record);
    for doubt in doubts {
        terminal::stderr(format_args!("look again: {}; {}", doubt.message(), doubt.remedy()));
    }
}

/// The least error so far, as a status; nothing where no springs have one yet.
pub fn error(least: f64) -> String {
    if least.is_finite() { format!("best error so far {}", percent(least)) } else { String::new() }
}

/// A line for a pipe.
fn line(what: &str, done: usize, total: usize, status: &str) -> String {
    let count = if total == 0 { format!("{done}") } else { format!("{done}/{total}") };
    let comma = if status.is_empty() { "" } else { ", " };
    format!("{what}: {count}{comma}{status}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_total_that_is_not_known_is_not_said() {
        assert_eq!(line("records", 3, 0, "one"), "records: 3, one");
        assert_eq!(line("records", 3, 9, ""), "records: 3/9");
    }

    #[test]
    fn an_error_that_no_springs_have_is_not_said() {
        assert_eq!(error(3.7e-4), "best error so far 0.037 %");
        assert_eq!([error(f64::INFINITY), error(f64::NAN)], ["", ""]);
    }
}
