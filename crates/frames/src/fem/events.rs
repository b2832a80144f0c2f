//! Touches and lifts: met on the cubic through a step's values, located by repeating the step.

use super::{model::CornerState, run::SpringsRun, step::ElasticStages};
use dynamics::fem::{
    AT_ONCE, MOST_LOCATED,
    cubic::{Cubic, NODES},
};

/// What a step meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ElasticEvent {
    Nothing,
    /// This corner's contact ends at tau in 0..1 of the step, roughly.
    Crossing {
        corner: usize,
        limit: ContactLimit,
        tau: f64,
    },
    /// This corner has passed it at the start.
    AtOnce {
        corner: usize,
        limit: ContactLimit,
    },
    /// The step is too long to tell.
    Unresolved,
}

/// What ends a corner's contact, or its flight: something that falls through zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContactLimit {
    /// Its compression, or in the air its height, vanishes.
    Gap,
    /// It slides no more.
    Stop,
}

/// Where the cubic through values at the nodes first falls below -tolerance, at the zero before
/// that; `None` if it does not.
fn first_zero(values: &[f64; 4], tolerance: f64) -> Option<f64> {
    let cubic = Cubic::through(values);
    let at = |t: f64| cubic.at(t);
    let mut start = 0.0;
    for end in [cubic.least(), 1.0].into_iter().filter(|end| *end > 0.0 && *end <= 1.0) {
        if at(end) < -tolerance {
            return Some(
                cubic.falls((start, at(start)), (end, at(end)), 0.1 * tolerance).unwrap_or(start),
            );
        }
        start = end;
    }
    None
}

impl SpringsRun<'_> {
    /// Below this a gap counts as zero (m).
    fn gap_tolerance(&self) -> f64 {
        (1e-9 * self.compression).max(4.0 * f64::EPSILON * self.scales.span)
    }

    /// What may end this corner's contact.
    fn limits(&self, corner: usize) -> &'static [ContactLimit] {
        let CornerState { closed, holds, drag, .. } = self.feet[corner];
        if closed && !holds && drag != 0.0 {
            &[ContactLimit::Gap, ContactLimit::Stop]
        } else {
            &[ContactLimit::Gap]
        }
    }

    /// What is positive while the contact lasts: a length (m), of a velocity that in which it goes
    /// in 1/Omega_n.
    fn left(&self, corner: usize, limit: ContactLimit, q: &[f64], v: &[f64]) -> f64 {
        let foot = &self.feet[corner];
        match limit {
            ContactLimit::Gap if foot.closed => self.model.compression(corner, q),
            ContactLimit::Gap => -self.model.compression(corner, q),
            // the force opposes the motion
            ContactLimit::Stop => -foot.drag * self.model.sliding(corner, q, v) * self.settling,
        }
    }

    /// Its rate, of a gap; other limits are searched without.
    fn left_rate(&self, corner: usize, limit: ContactLimit, q: &[f64], v: &[f64]) -> Option<f64> {
        let sign = if self.feet[corner].closed { 1.0 } else { -1.0 };
        (limit == ContactLimit::Gap).then(|| sign * self.model.compression_rate(corner, q, v))
    }

    /// What the step just taken meets first.
    pub(crate) fn met(&self, s: &ElasticStages) -> ElasticEvent {
        let (mut first, mut earliest) = (ElasticEvent::Nothing, f64::INFINITY);
        let tolerance = self.gap_tolerance();
        for corner in 0..self.feet.len() {
            for &limit in self.limits(corner) {
                let at = |q: &[f64], v: &[f64]| self.left(corner, limit, q, v);
                let inside = [
                    at(&self.q, &self.v),
                    at(&s.q[0], &s.v[0]),
                    at(&s.q[1], &s.v[1]),
                    at(&s.q[2], &s.v[2]),
                ];
                let Some(tau) = first_zero(&inside, tolerance) else { continue };
                let start = inside[0];
                if start <= tolerance && tau < 1e-6 {
                    // on the edge: the corner itself knows where it goes, the polynomial may not
                    let rate =
                        self.left_rate(corner, limit, &self.q, &self.v).unwrap_or(-f64::INFINITY);
                    if start > -tolerance && rate * s.h * NODES[1] > tolerance {
                        return ElasticEvent::Unresolved;
                    }
                    if start < -tolerance || rate < 0.0 {
                        return ElasticEvent::AtOnce { corner, limit };
                    }
                }
                if tau < earliest {
                    (earliest, first) =
                        (tau, ElasticEvent::Crossing { corner, limit, tau: tau.max(1e-9) });
                }
            }
        }
        first
    }

    /// Repeat the step so that it ends where the contact does: whether it does; `None` if no step
    /// converges there.
    pub(crate) fn locate(
        &mut self,
        (corner, limit): (usize, ContactLimit),
        whole: f64,
        tau: f64,
        s: &mut ElasticStages,
    ) -> Option<bool> {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut h = whole * tau;
        for _ in 0..MOST_LOCATED {
            self.work.located += 1;
            if !self.attempt(h, s) {
                return None;
            }
            let gap = self.left(corner, limit, &s.q[2], &s.v[2]);
            if gap.abs() <= self.gap_tolerance() || h <= 1e-9 * self.settling {
                return Some(true);
            }
            // without a rate: to the other side, then by halves
            let correction = match self.left_rate(corner, limit, &s.q[2], &s.v[2]) {
                Some(rate) => gap / rate,
                None if gap > 0.0 && high.is_infinite() => -1e-3 * h,
                None => f64::INFINITY,
            };
            if gap > 0.0 {
                low = h;
            } else {
                high = h;
            }
            // what comes after the step is none of its events
            let next = (h - correction).min(whole);
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
    pub(crate) fn changed(&mut self, corner: usize, limit: ContactLimit) -> CornerState {
        let foot = self.feet[corner];
        let here = CornerState {
            anchor: self.model.anchor_here(corner, &self.q),
            ..CornerState::STANDING
        };
        if foot.closed && limit == ContactLimit::Stop {
            return here;
        }
        if foot.closed {
            self.opened[corner] = self.time;
            return CornerState { anchor: foot.anchor, ..CornerState::OPEN };
        }
        if let Some(drag) = self.model.lands_flat(corner, &self.feet, &self.q, &self.v) {
            return CornerState { holds: false, drag, ..here };
        }
        // where its spring was let go of
        let pulled = foot.anchor - here.anchor;
        let sliding = pulled * self.model.sliding(corner, &self.q, &self.v) < 0.0;
        if sliding && self.time - self.opened[corner] < AT_ONCE * self.settling {
            return CornerState { holds: false, drag: pulled.signum(), ..here };
        }
        here
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
