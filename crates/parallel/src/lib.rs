//! Work on all cores. rayon does it: its loops take the work as a type parameter, and each use of
//! one compiles some 2,000 lines of its own. Here the work is behind a reference, the loop is
//! compiled once, and a call costs less than a microsecond more.
//!
//! Results stand in the order of the work, whatever the number of threads. A panic goes to the
//! caller.

#![warn(missing_docs)]

use std::{ops::Range, sync::Mutex};

use rayon::prelude::*;

/// `of` of every item.
pub fn map<'a, T: Sync, R: Send>(items: &'a [T], of: impl Fn(&'a T) -> R + Sync) -> Vec<R> {
    map_range(0..items.len(), |i| of(&items[i]))
}

/// `of` of every item, which it keeps.
pub fn map_owned<T: Send, R: Send>(items: Vec<T>, of: impl Fn(T) -> R + Sync) -> Vec<R> {
    let items: Vec<Mutex<Option<T>>> = items.into_iter().map(|x| Mutex::new(Some(x))).collect();
    let take = |item: &Mutex<Option<T>>| item.lock().ok().and_then(|mut item| item.take());
    map(&items, |item| take(item).map(&of)).into_iter().flatten().collect()
}

/// `of` of every number of a range.
pub fn map_range<R: Send>(numbers: Range<usize>, of: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = numbers.clone().map(|_| Mutex::new(None)).collect();
    let first = numbers.start;
    for_each(numbers, &|i| {
        let result = of(i);
        if let Ok(mut place) = results[i - first].lock() {
            *place = Some(result);
        }
    });
    results.into_iter().filter_map(|place| place.into_inner().ok().flatten()).collect()
}

/// Both of two pieces of work.
pub fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    let (mut a, mut b) = (Some(a), Some(b));
    let (mut first, mut second) = (None, None);
    both(&mut || first = a.take().map(|a| a()), &mut || second = b.take().map(|b| b()));
    match (first, second) {
        (Some(first), Some(second)) => (first, second),
        _ => unreachable!("rayon runs both, or passes a panic on"),
    }
}

/// Number of threads that work.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

/// Number of threads that work which begins here may be cut up for: one within work on all cores.
pub fn idle_threads() -> usize {
    if rayon::current_thread_index().is_some() { 1 } else { threads() }
}

fn for_each(numbers: Range<usize>, work: &(dyn Fn(usize) + Sync)) {
    numbers.into_par_iter().with_max_len(1).for_each(work);
}

fn both(a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
    rayon::join(a, b);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_stand_in_the_order_of_the_work() {
        let squares: Vec<usize> = (3..1000).map(|i| i * i).collect();
        assert_eq!(map_range(3..1000, |i| i * i), squares);
        assert_eq!(map(&squares, |x| x + 1), squares.iter().map(|x| x + 1).collect::<Vec<_>>());
        assert_eq!(map_owned(squares.clone(), |x| x + 1), map(&squares, |x| x + 1));
        assert_eq!(map_range(5..5, |i| i), []);
    }

    #[test]
    fn two_pieces_of_work_are_done_within_others() {
        let both = map_range(0..50, |i| join(|| i, || map_range(0..i, |k| k).len()));
        assert_eq!(both, (0..50).map(|i| (i, i)).collect::<Vec<_>>());
    }

    #[test]
    fn work_within_work_is_not_cut_up() {
        assert_eq!(idle_threads(), threads());
        assert_eq!(map_range(0..8, |_| idle_threads()), [1; 8]);
    }

    #[test]
    fn a_panic_goes_to_the_caller() {
        let failed = |i: usize| std::panic::catch_unwind(|| map_range(0..9, |k| assert_ne!(k, i)));
        assert!(failed(4).is_err() && failed(9).is_ok());
        assert!(std::panic::catch_unwind(|| join(|| (), || panic!("the second"))).is_err());
    }
}
