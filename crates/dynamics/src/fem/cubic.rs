//! The cubic through a step's values at its start and stages: what a foot's gap does between them.
//!
//! The collocation polynomial is a cubic, too, so that this one leaves out no more than what sine
//! and cosine bend within a step.

use super::radau::C;

/// Where a step's values are known: its start and its stages.
pub const NODES: [f64; 4] = [0.0, C[0], C[1], C[2]];

/// Coefficients by ascending powers of tau, from tau on, for each unit by which a stage's value
/// differs from the start's.
const WEIGHTS: [[f64; 3]; 3] = {
    let mut weights = [[0.0; 3]; 3];
    let mut k = 0;
    while k < 3 {
        // tau (tau - a) (tau - b), one at c
        let (a, b, c) = (C[(k + 1) % 3], C[(k + 2) % 3], C[k]);
        let whole = c * (c - a) * (c - b);
        weights[0][k] = a * b / whole;
        weights[1][k] = -(a + b) / whole;
        weights[2][k] = 1.0 / whole;
        k += 1;
    }
    weights
};

/// Weights at tau in 0..1 of the stages' values less the start's: value = start + sum w_j (V_j -
/// start).
#[inline(always)]
pub(crate) fn weights(tau: f64) -> [f64; 3] {
    let [first, second, third] = WEIGHTS;
    std::array::from_fn(|j| tau * (first[j] + tau * (second[j] + tau * third[j])))
}

/// Where `value` falls through zero between two points at which it is known, the first inside and
/// the second not (Illinois): a value below `edge` counts as none.
pub(crate) fn falls_through_zero(
    mut low: (f64, f64),
    mut high: (f64, f64),
    edge: f64,
    value: impl Fn(f64) -> f64,
) -> f64 {
    let mut side = 0;
    for _ in 0..60 {
        let at = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if !(at > low.0 && at < high.0) || high.0 - low.0 < 1e-12 {
            break;
        }
        let d = value(at);
        if d.abs() < edge {
            return at;
        }
        if d > 0.0 {
            low = (at, d);
            if side == 1 {
                high.1 *= 0.5;
            }
            side = 1;
        } else {
            high = (at, d);
            if side == -1 {
                low.1 *= 0.5;
            }
            side = -1;
        }
    }
    low.0
}

/// Halvings in the search for a place where a gap is clear of the edge.
const MOST_HALVED: i32 = 30;

/// A cubic in tau, 0 to 1 over the step, by ascending powers.
#[derive(Clone, Copy, Debug)]
pub struct Cubic([f64; 4]);

impl Cubic {
    /// Through values at the nodes.
    #[inline(always)]
    pub fn through(values: &[f64; 4]) -> Self {
        let start = values[0];
        let (a, b, c) = (values[1] - start, values[2] - start, values[3] - start);
        let power = |[x, y, z]: [f64; 3]| a * x + b * y + c * z;
        Self([start, power(WEIGHTS[0]), power(WEIGHTS[1]), power(WEIGHTS[2])])
    }

    /// Value at a share tau of the step.
    #[inline(always)]
    pub fn at(&self, tau: f64) -> f64 {
        let [p0, p1, p2, p3] = self.0;
        p0 + tau * (p1 + tau * (p2 + tau * p3))
    }

    /// Where it falls through zero between two points, the first inside or at the edge and the
    /// second not. What is at the edge and comes in first must come back before it falls: `None` if
    /// it falls at once.
    #[inline]
    pub fn falls(&self, mut low: (f64, f64), high: (f64, f64), edge: f64) -> Option<f64> {
        if low.1 <= edge {
            let nearer = (1..MOST_HALVED).map(|k| low.0 + (high.0 - low.0) * 0.5_f64.powi(k));
            let inside = nearer.into_iter().find(|&tau| self.at(tau) > edge)?;
            low = (inside, self.at(inside));
        }
        Some(falls_through_zero(low, high, edge, |tau| self.at(tau)))
    }

    /// Where it is least, beyond the step or NaN where it has no such place within.
    #[inline(always)]
    pub fn least(&self) -> f64 {
        let [_, first, second, third] = self.0;
        let root = (second * second - 3.0 * first * third).sqrt();
        // the slope first + 2 second tau + 3 third tau^2 grows through zero there
        if second >= 0.0 { -first / (second + root) } else { (root - second) / (3.0 * third) }
    }
}

/// Whether a foot whose gap takes these values at the nodes, positive inside its limit, stays
/// within it all along.
#[inline(always)]
pub(crate) fn stays_inside(values: &[f64; 4], tolerance: f64) -> bool {
    let cubic = Cubic::through(values);
    let tau = cubic.least();
    let dips = (tau > 0.0) & (tau < 1.0) & (cubic.at(tau) < -tolerance);
    (values[1] >= -tolerance) & (values[2] >= -tolerance) & (values[3] >= -tolerance) & !dips
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: [[f64; 4]; 5] = [
        [1.0, -0.3, 0.4, 2.0],
        [0.0, 0.0, 0.0, 1.0],
        [0.3, -2.0, 5.0, 0.1],
        [1.0, 0.2, 0.9, 0.5],
        [0.5, 0.01, 0.3, 0.9],
    ];

    #[test]
    fn it_passes_through_its_values() {
        for values in SAMPLES {
            let cubic = Cubic::through(&values);
            for (node, value) in NODES.into_iter().zip(values) {
                // the weights reach 12
                assert!(
                    (cubic.at(node) - value).abs() < 1e-14 * 10.0,
                    "{} {value}",
                    cubic.at(node)
                );
            }
        }
    }

    /// Against a fine grid.
    #[test]
    fn its_least_place_and_whether_it_stays_inside_are_those_of_a_grid() {
        for values in SAMPLES {
            let cubic = Cubic::through(&values);
            let grid = || (1..100_000).map(|i| f64::from(i) * 1e-5);
            let (lowest, at) =
                grid().map(|tau| (cubic.at(tau), tau)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            let tau = cubic.least();
            if (1e-4..1.0 - 1e-4).contains(&at) {
                assert!((tau - at).abs() < 1e-4, "{tau} {at}");
            }
            for shift in [0.0, lowest - 1e-6, lowest + 1e-6] {
                let shifted = values.map(|value| value - shift);
                let inside = grid().all(|tau| cubic.at(tau) - shift >= 0.0) && shifted[3] >= 0.0;
                assert_eq!(stays_inside(&shifted, 0.0), inside, "{values:?} {shift}");
            }
        }
    }
}
