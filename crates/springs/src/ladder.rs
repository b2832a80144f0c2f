//! The softest rung of a ladder of stiffnesses that holds, in few judgements: the errors of springs
//! fall with their stiffness, but for bumps.

/// Rungs of the ladder to a factor of ten.
pub(super) const DECADE: f64 = 10.0;
/// Rungs judged before the stiffest good one is taken as it is.
const MOST_RUNGS: usize = 12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FoundRung {
    /// Its number.
    pub rung: i64,
    /// Whether it holds.
    pub holds: bool,
}

/// The softest rung between first and last that holds with the next above it, from a guess; else
/// the best one seen. `judge` gives the error of a rung over what is allowed.
pub(super) fn seek(
    first: i64,
    last: i64,
    guess: i64,
    judge: &mut dyn FnMut(i64) -> Option<f64>,
) -> Option<FoundRung> {
    // everything up to `fails` counts as failing, `holds` holds
    let (mut fails, mut holds): (i64, Option<i64>) = (first - 1, None);
    let mut best: Option<(f64, i64)> = None;
    // an error that hardly falls, or not yet, is left behind in strides
    let mut stride = 1;
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
                    return Some(FoundRung { rung: h, holds: true });
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
        Some(rung) => Some(FoundRung { rung, holds: true }),
        None => best.map(|(over, rung)| FoundRung { rung, holds: over <= 1.0 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(error: impl Fn(i64) -> f64, guess: i64) -> (Option<FoundRung>, usize) {
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
            assert_eq!(rung, Some(FoundRung { rung: 41, holds: true }), "{guess}");
            assert!(count <= 5, "{guess}: {count}");
        }
    }

    #[test]
    fn a_rung_that_holds_below_one_that_does_not_is_passed_over() {
        let bump = |i: i64| if i == 42 { 1.3 } else { 10f64.powf((41 - i) as f64 / 10.0) };
        for guess in [25, 41, 42, 43, 55] {
            assert_eq!(found(bump, guess).0, Some(FoundRung { rung: 43, holds: true }), "{guess}");
        }
    }

    #[test]
    fn where_none_holds_the_best_is_taken_and_it_is_said() {
        assert_eq!(found(|i| 10.0 + (50 - i).abs() as f64, 40).0.map(|f| f.holds), Some(false));
        assert_eq!(found(|_| 0.1, 40).0, Some(FoundRung { rung: 20, holds: true }));
    }
}
