//! Touches and lifts: met on the cubic through a step's values, located by repeating the step.

use super::{model::CornerState, run::SpringsRun, step::ElasticStages};
use crate::fem::cubic::{Cubic, NODES};

/// Steps that locate one event: Newton's method needs two or three.
const MOST_LOCATED: usize = 40;

/// A corner that closes again this soon after it opened, in units of 1/Omega_n, has hardly left the ground: its horizontal spring does not hold until
/// it carries weight. It would let go of a part of its horizontal force each time, at an accumulating sequence of instants.
const AT_ONCE: f64 = 0.1;

/// Share of the weight that it then carries before it holds.
const HOLDING: f64 = 1e-4;

/// What a step meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ElasticEvent {
    Nothing,
    /// This corner's compression passes a level [m] at tau in 0..1 of the step, roughly.
    Crossing {
        corner: usize,
        level: f64,
        tau: f64,
    },
    /// This corner has passed it at the start.
    AtOnce {
        corner: usize,
    },
    /// The step is too long to tell.
    Unresolved,
}

/// Where the cubic through values at the nodes first falls below -tolerance, at the zero before that; `None` if it does not.
fn first_zero(values: &[f64; 4], tolerance: f64) -> Option<f64> {
    let cubic = Cubic::through(values);
    let at = |t: f64| cubic.at(t);
    let mut start = 0.0;
    for end in [cubic.least(), 1.0].into_iter().filter(|end| *end > 0.0 && *end <= 1.0) {
        if at(end) < -tolerance {
            return Some(cubic.falls((start, at(start)), (end, at(end)), 0.1 * tolerance).unwrap_or(start));
        }
        start = end;
    }
    None
}

impl SpringsRun<'_> {
    /// Below this a gap counts as zero [m].
    fn gap_tolerance(&self) -> f64 {
        (1e-9 * self.compression).max(4.0 * f64::EPSILON * self.scales.span)
    }

    /// Levels of compression that end the contact of this corner, and on which side it then is: the contact lasts while
    /// sign (compression - level) is positive.
    fn limits(&self, corner: usize) -> [Option<(f64, f64)>; 2] {
        match self.feet[corner] {
            CornerState { closed: false, .. } => [Some((-1.0, 0.0)), None],
            CornerState { holds: true, .. } => [Some((1.0, 0.0)), None],
            // sliding
            CornerState { .. } => [Some((1.0, 0.0)), Some((-1.0, HOLDING * self.compression))],
        }
    }

    /// What the step just taken meets first.
    pub fn met(&self, s: &ElasticStages) -> ElasticEvent {
        let (mut first, mut earliest) = (ElasticEvent::Nothing, f64::INFINITY);
        let tolerance = self.gap_tolerance();
        for corner in 0..self.feet.len() {
            let at = |q: &[f64]| self.model.compression(corner, q);
            let values = [at(&self.q), at(&s.q[0]), at(&s.q[1]), at(&s.q[2])];
            for (sign, level) in self.limits(corner).into_iter().flatten() {
                let inside = values.map(|d| sign * (d - level));
                let Some(tau) = first_zero(&inside, tolerance) else { continue };
                let start = inside[0];
                if start <= tolerance && tau < 1e-6 {
                    // on the edge: the corner itself knows where it goes, the polynomial may not
                    let rate = sign * self.model.compression_rate(corner, &self.q, &self.v);
                    if start > -tolerance && rate * s.h * NODES[1] > tolerance {
                        return ElasticEvent::Unresolved;
                    }
                    if start < -tolerance || rate < 0.0 {
                        return ElasticEvent::AtOnce { corner };
                    }
                }
                if tau < earliest {
                    (earliest, first) = (tau, ElasticEvent::Crossing { corner, level, tau: tau.max(1e-9) });
                }
            }
        }
        first
    }

    /// Repeat the step so that it ends where the compression passes the level: whether it does; `None` if no step converges there.
    pub fn locate(&mut self, corner: usize, level: f64, whole: f64, tau: f64, s: &mut ElasticStages) -> Option<bool> {
        let sign = self.limits(corner).into_iter().flatten().find(|l| l.1 == level).map_or(1.0, |l| l.0);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut h = whole * tau;
        for _ in 0..MOST_LOCATED {
            self.work.located += 1;
            if !self.attempt(h, s) {
                return None;
            }
            let gap = self.model.compression(corner, &s.q[2]) - level;
            if gap.abs() <= self.gap_tolerance() || h <= 1e-9 * self.settling {
                return Some(true);
            }
            let correction = gap / self.model.compression_rate(corner, &s.q[2], &s.v[2]);
            if sign * gap > 0.0 {
                low = h;
            } else {
                high = h;
            }
            let next = h - correction;
            let usable = correction.abs() <= 0.5 * h && next > low && next < high;
            h = if usable {
                next
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                // the polynomial saw a graze that the step itself does not make
                return Some(false);
            };
        }
        None
    }

    /// A corner's contact after what it met.
    pub fn changed(&mut self, corner: usize) -> CornerState {
        let foot = self.feet[corner];
        let here = |holds: bool| CornerState { closed: true, holds, anchor: self.model.anchor_here(corner, &self.q) };
        if foot.closed && !foot.holds && self.model.compression(corner, &self.q) > 0.5 * HOLDING * self.compression {
            return here(true);
        }
        if foot.closed {
            self.opened[corner] = self.time;
            return CornerState { anchor: foot.anchor, ..CornerState::OPEN };
        }
        here(self.time - self.opened[corner] >= AT_ONCE * self.settling)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dip_between_two_stages_is_found_and_a_graze_is_not() {
        let values = |f: &dyn Fn(f64) -> f64| NODES.map(f);
        let tau = first_zero(&values(&|t| (t - 0.2) * (t - 0.6)), 1e-12).unwrap();
        assert!((tau - 0.2).abs() < 1e-12, "{tau}");
        assert_eq!(first_zero(&values(&|t| (t - 0.2) * (t - 0.6) + 0.0401), 1e-12), None);
        // from the edge in, and out later
        let tau = first_zero(&values(&|t| t * (0.7 - t)), 1e-12).unwrap();
        assert!((tau - 0.7).abs() < 1e-12, "{tau}");
        assert!(first_zero(&values(&|t| -t), 1e-12).unwrap() < 1e-12);
    }
}
