//! Events within a step: where a held corner's vertical force, or a free corner's height, falls to
//! zero.

use super::state::within;
use super::walk::{Moment, ReferenceWalk};
use crate::Mechanics;

/// Where a corner lifts or lands: the time since the step's start (s).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Which.
    pub corner: usize,
    /// (s)
    pub after: f64,
}

/// Interpolations at which a root is given up as found, and the share of the step that is rounding.
const TRIALS: usize = 60;
const ROUNDING: f64 = 1e-15;

/// The first event within a step of length h from `start` to `end`.
pub(crate) fn first<M: Mechanics>(
    walk: &ReferenceWalk<M>,
    start: &Moment,
    end: &Moment,
    h: f64,
) -> Option<Crossing> {
    let ends = [(&start.state, &start.rates), (&end.state, &end.rates)];
    let inside = |share: f64| walk.moment(share * h, within(ends, h, share));
    let middle = inside(0.5)?;
    let mut found: Option<Crossing> = None;
    for corner in walk.watched() {
        let f = |moment: &Moment| walk.margin(corner, moment);
        let bracket = match [f(start), f(&middle), f(end)] {
            [f0, f1, _] if f0 <= 0.0 && f1 < 0.0 => Some(if walk.begins(corner) {
                let begun = |share: &f64| inside(*share).is_some_and(|moment| f(&moment) > 0.0);
                (1..9).map(|k| 0.1_f64.powi(k)).find(begun).map_or([0.0; 2], |share| [share, 0.5])
            } else {
                [0.0; 2]
            }),
            [_, f1, _] if f1 < 0.0 => Some([0.0, 0.5]),
            [_, _, f2] if f2 < 0.0 => Some([0.5, 1.0]),
            [f0, f1, f2] if f0 > 0.0 => dip([f0, f1, f2])
                .filter(|&share| inside(share).is_some_and(|moment| f(&moment) < 0.0))
                .map(|share| [0.0, share]),
            _ => None,
        };
        let Some([low, high]) = bracket.map(|b| b.map(|share| share * h)) else { continue };
        // one that has not crossed at the first crossing so far comes later
        let earlier = |best: &Crossing| {
            high <= best.after
                || walk.advanced(start, best.after).is_some_and(|moment| f(&moment) < 0.0)
        };
        let high = match &found {
            Some(best) if !earlier(best) => continue,
            Some(best) => high.min(best.after),
            None => high,
        };
        if let Some(after) = root(low, high, |s| Some(f(&walk.advanced(start, s)?))) {
            found = Some(Crossing { corner, after });
        }
    }
    found
}

/// Share of the step where the parabola through three values, at 0, 1/2 and 1, has its minimum, if
/// that is near zero or below.
fn dip([f0, f1, f2]: [f64; 3]) -> Option<f64> {
    let (a, b) = (2.0 * f0 - 4.0 * f1 + 2.0 * f2, -3.0 * f0 + 4.0 * f1 - f2);
    let share = -b / (2.0 * a);
    (a > 0.0 && share > 0.0 && share < 1.0 && f0 - b * b / (4.0 * a) <= 0.1 * f0.min(f2))
        .then_some(share)
}

/// Where f falls through zero between low and high, by the Illinois method; None if it does not.
fn root(low: f64, high: f64, mut f: impl FnMut(f64) -> Option<f64>) -> Option<f64> {
    if low == high {
        return Some(low);
    }
    let (mut a, mut b, mut fa, mut fb) = (low, high, f(low)?, f(high)?);
    if fb > 0.0 {
        return None;
    }
    if fa <= 0.0 {
        return Some(a);
    }
    for _ in 0..TRIALS {
        if (b - a).abs() <= ROUNDING * high || fb == 0.0 {
            break;
        }
        let c = (b - fb * (b - a) / (fb - fa)).clamp(a.min(b), a.max(b));
        let fc = f(c)?;
        if fc == 0.0 {
            return Some(c);
        }
        if (fc > 0.0) == (fb > 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_to_rounding_and_only_where_f_falls() {
        let found = root(0.0, 1.0, |x| Some(0.3 - x * x * x)).unwrap();
        assert!((found - 0.3_f64.cbrt()).abs() < 1e-15, "{found}");
        assert_eq!(root(0.0, 1.0, |x| Some(x + 0.1)), None);
        assert_eq!(root(0.5, 1.0, |x| Some(0.25 - x)), Some(0.5));
    }

    #[test]
    fn a_dip_is_suspected_where_the_parabola_comes_near_zero() {
        // (s - 0.25)^2 - 0.01
        let f = |s: f64| (s - 0.25) * (s - 0.25) - 0.01;
        assert!((dip([f(0.0), f(0.5), f(1.0)]).unwrap() - 0.25).abs() < 1e-12);
        assert_eq!(dip([1.0, 0.9, 1.1]), None);
        assert_eq!(dip([1.0, 2.0, 1.0]), None);
    }
}
