//! The outer loop: the least Omega_n from which on the error against Housner stays within the accuracy asked for.
//!
//! Stiffness costs next to nothing where time steps follow events, and the error falls with it at first order or better; so
//! Omega_n follows from the accuracy. It is sought on a ladder of Omega_n/p = 10^(i/10), so that the design depends on the
//! structure and on the rung alone. A rung holds if its errors are within [`MARGIN`] of what is allowed; the one that is taken
//! holds, and so does the next stiffer one, and the next softer does not.

use std::collections::BTreeMap;

use super::suite::{Accuracy, JudgedOn, Suites};
use crate::{
    fem::Control,
    spring::{Design, Springs},
};

/// Share of the accuracy asked for that is aimed at.
pub const MARGIN: f64 = 0.7;
/// Rungs of the ladder to a factor of ten.
const DECADE: f64 = 10.0;
/// The softest rung tried, Omega_n/p.
pub const SOFTEST: f64 = 100.0;
/// Omega_n/p times the accuracy asked for where the search begins: errors of synthetic motions fall about as 20/(Omega_n/p),
/// those of earthquake-like ones, with their standard error, are about five times what is allowed at 250/(Omega_n/p).
const BEGIN: f64 = 250.0;
/// An accuracy for which steps over several samples will do.
const COARSE: f64 = 1e-3;
/// Rungs judged before the stiffest good one is taken as it is.
const MOST_RUNGS: usize = 12;
/// Error of a softer rung on a suite, over what is allowed, below which a stiffer one is not judged on it again: errors fall with
/// stiffness but for bumps of less than a factor of two.
const LITTLE: f64 = 0.3;

/// Springs of one Omega_n/p and what was measured of them.
#[derive(Clone, Copy, Debug)]
pub struct Rung {
    /// Omega_n/p of the vertical units.
    pub stiffness: f64,
    pub springs: Springs<Design<f64>>,
    /// What was measured until the rung was refused or held; everything of the one that is taken.
    pub accuracy: Accuracy,
}

/// What the outer loop found.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// Every rung that was judged, the softest first.
    #[allow(dead_code)] // tests look at them
    pub rungs: Vec<Rung>,
    /// The one that was taken.
    pub best: Rung,
    /// Whether it holds.
    pub reached: bool,
}

/// Seek Omega_n in a range of Omega_n/p. `springs` gives the inner design at an Omega_n/p; `progress` is told the rungs judged and the least error in
/// units of what is allowed.
pub fn tune(
    suites: &Suites,
    mass: f64,
    accuracy: f64,
    (softest, stiffest): (f64, f64),
    springs: &dyn Fn(f64) -> Option<Springs<Design<f64>>>,
    progress: &dyn Fn(usize, f64),
) -> Option<Tuned> {
    let mut seen: BTreeMap<i64, Rung> = BTreeMap::new();
    let allowed = MARGIN * accuracy;
    let over = |rung: &Rung| rung.accuracy.over(allowed);
    let control = control(accuracy);
    let mut judge = |i: i64| -> Option<f64> {
        if let Some(rung) = seen.get(&i) {
            return Some(over(rung));
        }
        let stiffness = stiffness(i);
        let springs = springs(stiffness)?;
        let mut accuracy = Accuracy::default();
        for suite in in_order(&seen, i, allowed) {
            suites.measure(suite, &springs.chains(mass), control, &mut accuracy);
            if !seen.is_empty() && accuracy.over(allowed) > 1.0 {
                break;
            }
        }
        seen.insert(i, Rung { stiffness, springs, accuracy });
        let least = seen.values().map(&over).fold(f64::INFINITY, f64::min);
        progress(seen.len(), least);
        seen.get(&i).map(&over)
    };
    let (first, last) = (rung(softest).ceil() as i64, rung(stiffest).floor() as i64);
    let last = last.max(first);
    let found = seek(first, last, rung(begin(accuracy)).round() as i64, &mut judge)?;
    let best = seen.get_mut(&found.rung)?;
    for suite in JudgedOn::ALL {
        if best.accuracy.over_on(suite, allowed).is_none() {
            suites.measure(suite, &best.springs.chains(mass), control, &mut best.accuracy);
        }
    }
    let (best, reached) = (*best, found.holds && over(best) <= 1.0);
    Some(Tuned { rungs: seen.into_values().collect(), best, reached })
}

/// How closely histories are followed to find out whether they are this accurate: steps over several samples, which err by up to
/// 1e-4, only where much more is allowed.
pub fn control(accuracy: f64) -> Control {
    Control { long_steps: accuracy >= COARSE, ..Control::search() }
}

/// The suites that a rung is to be judged on: what decided at the nearest rung first, for it may refuse this one alone; and none on
/// which a softer rung had so little error that this one will hold.
fn in_order(seen: &BTreeMap<i64, Rung>, i: i64, allowed: f64) -> Vec<JudgedOn> {
    let share = |rung: &Rung, suite| rung.accuracy.over_on(suite, allowed);
    let softer = |suite: &JudgedOn| seen.range(..i).any(|(_, rung)| share(rung, *suite).is_some_and(|x| x < LITTLE));
    let mut order: Vec<JudgedOn> = JudgedOn::ALL.into_iter().filter(|suite| !softer(suite)).collect();
    if let Some(nearest) = seen.iter().min_by_key(|(j, _)| (*j - i).abs()).map(|(_, rung)| rung) {
        let least = |suite: &JudgedOn| share(nearest, *suite).unwrap_or(0.0);
        order.sort_by(|a, b| least(b).total_cmp(&least(a)));
    }
    order
}

/// The Omega_n/p at which a search for this accuracy begins.
pub fn begin(accuracy: f64) -> f64 {
    BEGIN / accuracy
}

/// Omega_n/p of a rung, and the rung of an Omega_n/p.
fn stiffness(i: i64) -> f64 {
    10f64.powf(i as f64 / DECADE)
}

fn rung(stiffness: f64) -> f64 {
    DECADE * stiffness.log10()
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Found {
    rung: i64,
    holds: bool,
}

/// The softest rung between first and last that holds with the next above it, from a guess; else the best one seen. `judge`
/// gives the error of a rung over what is allowed.
fn seek(first: i64, last: i64, guess: i64, judge: &mut dyn FnMut(i64) -> Option<f64>) -> Option<Found> {
    // everything up to `fails` counts as failing, `holds` holds
    let (mut fails, mut holds): (i64, Option<i64>) = (first - 1, None);
    let mut best: Option<(f64, i64)> = None;
    let mut next = guess.clamp(first, last);
    for _ in 0..MOST_RUNGS {
        let over = judge(next)?;
        if best.is_none_or(|(least, _)| over < least) {
            best = Some((over, next));
        }
        // as many rungs as a first-order error asks for
        let rungs = (DECADE * over.max(1e-6).log10().abs()).round() as i64;
        if over > 1.0 {
            if next == last {
                break;
            }
            (fails, holds) = (next, holds.filter(|&h| h > next));
            next = match holds {
                Some(h) if h > next + 1 => (next + rungs.max(1)).min(h - 1),
                Some(h) => (h + 1).min(last),
                None => (next + rungs.max(1)).min(last),
            };
        } else {
            let h = holds.map_or(next, |h: i64| h.min(next));
            holds = Some(h);
            // the rung above the softest that holds must hold, too
            if h - 1 == fails {
                if h == last || judge(h + 1)? <= 1.0 {
                    return Some(Found { rung: h, holds: true });
                }
                if h + 1 == last {
                    break;
                }
                (fails, holds, next) = (h + 1, None, (h + 2).min(last));
            } else {
                next = (h - rungs.max(1)).max(fails + 1);
            }
        }
    }
    match holds {
        Some(rung) => Some(Found { rung, holds: true }),
        None => best.map(|(over, rung)| Found { rung, holds: over <= 1.0 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(error: impl Fn(i64) -> f64, guess: i64) -> (Option<Found>, usize) {
        let mut seen = std::collections::BTreeSet::new();
        let found = seek(20, 60, guess, &mut |i| {
            seen.insert(i);
            Some(error(i))
        });
        (found, seen.len())
    }

    #[test]
    fn the_softest_rung_that_holds_is_found_from_any_guess_in_a_few_rungs() {
        for guess in 20..=60 {
            // 1/Omega_n, 1 at rung 41
            let (rung, count) = found(|i| 10f64.powf((41 - i) as f64 / 10.0), guess);
            assert_eq!(rung, Some(Found { rung: 41, holds: true }), "{guess}");
            assert!(count <= 5, "{guess}: {count}");
        }
    }

    #[test]
    fn a_rung_that_holds_below_one_that_does_not_is_passed_over() {
        let bump = |i: i64| if i == 42 { 1.3 } else { 10f64.powf((41 - i) as f64 / 10.0) };
        for guess in [25, 41, 42, 43, 55] {
            assert_eq!(found(bump, guess).0, Some(Found { rung: 43, holds: true }), "{guess}");
        }
    }

    #[test]
    fn where_none_holds_the_best_is_taken_and_it_is_said() {
        assert_eq!(found(|i| 10.0 + (50 - i).abs() as f64, 40).0.map(|f| f.holds), Some(false));
        assert_eq!(found(|_| 0.1, 40).0, Some(Found { rung: 20, holds: true }));
    }
}
