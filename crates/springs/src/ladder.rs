//! The softest rung of a ladder of stiffnesses that holds, in few judgements: the errors of springs
//! fall with their stiffness, but for bumps.

use std::collections::BTreeMap;

use dynamics::effort::Effort;

/// Rungs of the ladder to a factor of ten.
pub(super) const DECADE: f64 = 10.0;
/// Steps of a search before it takes what it has found.
const MOST_STEPS: usize = 12;

/// Progress of a ladder search: rungs judged, least error so far (over what is allowed).
pub(super) type RungProgress<'a> = &'a dyn Fn(usize, f64);

/// The ladder of springs that may be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ladder {
    /// Softest and stiffest.
    pub ends: (i64, i64),
    /// Where the search begins.
    pub guess: i64,
}

/// Every rung that was judged, with what was found of it, and the one that is taken, unless a
/// judgement was missing.
pub(super) type Searched<T> = (BTreeMap<i64, T>, Option<i64>);

impl Ladder {
    /// The rung to take, within an effort. `judge` looks at a rung, beside those seen; `over` is
    /// its error over what is allowed; `progress` is told the rungs judged and the least of these.
    pub(super) fn search<T>(
        self,
        mut judge: impl FnMut(i64, &BTreeMap<i64, T>) -> Option<T>,
        over: impl Fn(&T) -> Option<f64>,
        effort: &Effort,
        progress: RungProgress,
    ) -> Searched<T> {
        let mut seen = BTreeMap::new();
        let found = seek(self, &mut |i| {
            if let Some(rung) = seen.get(&i) {
                return over(rung);
            }
            // the first rung is judged whatever it costs: its histories have bounds of their own
            if effort.stopped() || !seen.is_empty() && effort.stops() {
                return None;
            }
            let rung = judge(i, &seen)?;
            // a rung half judged is none
            if effort.stopped() {
                return None;
            }
            let error = over(&rung);
            seen.insert(i, rung);
            error?;
            progress(seen.len(), seen.values().filter_map(&over).fold(f64::INFINITY, f64::min));
            error
        });
        (seen, found)
    }
}

/// The best rung of those seen.
pub(super) fn best<T>(seen: &BTreeMap<i64, T>, over: impl Fn(&T) -> Option<f64>) -> Option<i64> {
    let errors = seen.iter().map(|(i, rung)| (*i, over(rung).unwrap_or(f64::INFINITY)));
    errors.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
}

/// The softest rung that holds with the next above it; else the best one seen. `judge` gives the
/// error of a rung over what is allowed: it holds up to 1.
fn seek(ladder: Ladder, judge: &mut dyn FnMut(i64) -> Option<f64>) -> Option<i64> {
    let Ladder { ends: (first, last), guess } = ladder;
    // everything up to `fails` counts as failing, `holds` holds
    let (mut fails, mut holds): (i64, Option<i64>) = (first - 1, None);
    let mut best: Option<(f64, i64)> = None;
    // the step at least doubles while no rung holds: the error may fall only far up the ladder
    let mut stride = 1;
    let mut next = guess;
    for _ in 0..MOST_STEPS {
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
                None => {
                    let step = rungs.max(stride);
                    stride *= 2;
                    (next + step).min(last)
                }
            };
        } else {
            let h = holds.map_or(next, |h: i64| h.min(next));
            holds = Some(h);
            // the rung above the softest that holds must hold, too
            if h - 1 == fails {
                if h == last || judge(h + 1)? <= 1.0 {
                    return Some(h);
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
    // the steps ran out above a rung that does not hold
    match holds {
        Some(h) if h == last || judge(h + 1)? <= 1.0 => Some(h),
        _ => best.map(|(_, rung)| rung),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(error: impl Fn(i64) -> f64, guess: i64) -> (i64, usize) {
        let ladder = Ladder { ends: (20, 60), guess };
        let judge = |i, _: &BTreeMap<i64, f64>| Some(error(i));
        let (seen, found) =
            ladder.search(judge, |error| Some(*error), &Effort::unbounded(), &|_, _| ());
        (found.unwrap(), seen.len())
    }

    #[test]
    fn the_softest_rung_that_holds_is_found_from_any_guess_in_a_few_rungs() {
        for guess in 20..=60 {
            // 1/Omega_n, 1 at rung 41
            let (rung, count) = found(|i| 10f64.powf((41 - i) as f64 / 10.0), guess);
            assert_eq!(rung, 41, "{guess}");
            assert!(count <= 5, "{guess}: {count}");
        }
    }

    #[test]
    fn a_rung_that_holds_below_one_that_does_not_is_passed_over() {
        let bump = |i: i64| if i == 42 { 1.3 } else { 10f64.powf((41 - i) as f64 / 10.0) };
        for guess in [25, 41, 42, 43, 55] {
            assert_eq!(found(bump, guess).0, 43, "{guess}");
        }
    }

    #[test]
    fn where_none_holds_the_best_is_taken() {
        assert_eq!(found(|i| 10.0 + (54 - i).abs() as f64, 40).0, 54);
        assert_eq!(found(|_| 0.1, 40).0, 20);
    }

    /// Every other rung holds: 12 steps lead from 60 to 38, and 39 does not hold.
    #[test]
    fn a_rung_is_not_taken_when_the_steps_run_out_unless_the_next_above_holds() {
        let other = |i: i64| if i % 2 == 0 { 0.7 } else { 1.3 };
        assert_eq!(found(other, 60).0, 60);
        assert_eq!(found(|i| if i == 39 { 0.9 } else { other(i) }, 60).0, 38);
    }
}
