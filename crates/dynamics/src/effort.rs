//! How much work a search may do: a bound that counts work, so that the same inputs give the same
//! bytes on any machine and any number of threads; and what stops it from outside.
//!
//! ```text
//!   unit     a step tried of a rigid body's history; steps of elastic structures cost units by
//!            their number of coordinates
//!   spent    sum of all histories so far, each of which has a bound of its own
//!   asked    only between whole candidates, one after the other: where the search stops does not
//!            depend on thread timing
//! ```
//!
//! A time limit and ^C set the same stop. What they cut depends on the machine, and is marked.

use std::{
    sync::{
        OnceLock,
        atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering},
    },
    time::Instant,
};

use serde::{Deserialize, Serialize};

/// What ended a search before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CutBy {
    /// The bound on work.
    Work,
    /// The time limit that was asked for.
    TimeLimit,
    /// ^C.
    Interrupt,
}

/// What stops a search from outside.
#[derive(Clone, Copy, Debug, Default)]
pub struct StopSignal {
    /// When the time limit is over, if there is one.
    pub until: Option<Instant>,
    /// Set by ^C.
    pub interrupted: Option<&'static AtomicBool>,
}

impl StopSignal {
    fn now(&self) -> Option<CutBy> {
        if self.interrupted.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Some(CutBy::Interrupt);
        }
        self.until.filter(|until| Instant::now() >= *until).map(|_| CutBy::TimeLimit)
    }
}

/// A budget of work, and what was spent of it.
#[derive(Debug)]
pub struct Effort {
    /// Units that may be spent.
    most: u64,
    signal: StopSignal,
    spent: AtomicU64,
    /// Histories that met a bound of their own.
    unfinished: AtomicUsize,
    cut: OnceLock<CutBy>,
}

impl Effort {
    /// So many units.
    pub fn of(most: u64, signal: StopSignal) -> Self {
        let (spent, unfinished) = (AtomicU64::new(0), AtomicUsize::new(0));
        Self { most, signal, spent, unfinished, cut: OnceLock::new() }
    }

    /// No bound at all.
    pub fn unbounded() -> Self {
        Self::of(u64::MAX, StopSignal::default())
    }

    /// Count the units of a history.
    pub fn spend(&self, units: u64) {
        self.spent.fetch_add(units, Ordering::Relaxed);
    }

    /// Count a history that springs are judged by, if it met a bound of its own.
    pub fn judged(&self, met_its_bound: bool) {
        self.unfinished.fetch_add(usize::from(met_its_bound), Ordering::Relaxed);
    }

    /// Units spent so far.
    pub(crate) fn spent(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }

    /// Histories that met a bound of their own.
    pub fn unfinished(&self) -> usize {
        self.unfinished.load(Ordering::Relaxed)
    }

    /// Whether to leave out what comes next; it is then noted that something was. To be asked where
    /// nothing else is under way.
    pub fn stops(&self) -> bool {
        if self.spent() >= self.most {
            self.cut.get_or_init(|| CutBy::Work);
        }
        self.stopped()
    }

    /// The same of the time limit and ^C alone, anywhere; of the bound on work only once it was
    /// noted.
    pub fn stopped(&self) -> bool {
        if self.cut.get().is_none()
            && let Some(by) = self.signal.now()
        {
            self.cut.get_or_init(|| by);
        }
        self.cut.get().is_some()
    }

    /// Whether the time limit or ^C has stopped it: what follows a search is then left out, too.
    pub fn stopped_from_outside(&self) -> bool {
        matches!(self.cut(), Some(CutBy::TimeLimit | CutBy::Interrupt))
    }

    /// What cut the search, if anything was left out.
    pub fn cut(&self) -> Option<CutBy> {
        self.cut.get().copied()
    }

    /// One in so many of all units, spent or not: the bound of a history.
    pub fn part(&self, parts: u64) -> u64 {
        self.most / parts
    }

    /// One of so many equal shares of what is left, for searches side by side.
    pub fn share(&self, parts: u64) -> Self {
        Self::of(self.most.saturating_sub(self.spent()) / parts.max(1), self.signal)
    }

    /// Count what a share was used for.
    pub fn join(&self, share: &Self) {
        self.spent.fetch_add(share.spent(), Ordering::Relaxed);
        self.unfinished.fetch_add(share.unfinished(), Ordering::Relaxed);
        if let Some(by) = share.cut() {
            self.cut.get_or_init(|| by);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_beyond_the_bound_stops_what_comes_next_and_is_noted_only_then() {
        let effort = Effort::of(10, StopSignal::default());
        effort.spend(9);
        assert!(!effort.stops() && effort.cut().is_none());
        effort.spend(9);
        effort.judged(true);
        effort.judged(false);
        assert!(effort.cut().is_none() && !effort.stopped());
        assert!(effort.stops() && effort.stopped());
        assert_eq!((effort.cut(), effort.spent(), effort.unfinished()), (Some(CutBy::Work), 18, 1));
    }

    #[test]
    fn shares_are_of_what_is_left_and_count_when_they_are_joined() {
        let effort = Effort::of(100, StopSignal::default());
        effort.spend(20);
        let shares = [effort.share(4), effort.share(4)];
        shares[0].spend(20);
        shares[0].judged(true);
        assert!(shares[0].stops() && !shares[1].stops());
        shares.iter().for_each(|share| effort.join(share));
        assert_eq!((effort.cut(), effort.spent(), effort.unfinished()), (Some(CutBy::Work), 40, 1));
    }

    #[test]
    fn a_time_limit_and_an_interrupt_stop_whatever_was_spent() {
        static PRESSED: AtomicBool = AtomicBool::new(true);
        let over = StopSignal { until: Some(Instant::now()), interrupted: None };
        let effort = Effort::of(10, over);
        assert!(effort.stopped());
        assert_eq!(effort.cut(), Some(CutBy::TimeLimit));
        let effort = Effort::of(10, StopSignal { interrupted: Some(&PRESSED), ..over });
        assert!(effort.share(2).stopped() && effort.stops());
        assert_eq!(effort.cut(), Some(CutBy::Interrupt));
        assert!(!Effort::unbounded().stops());
    }
}
