//! Largest displacements of an elastic structure, as an engineer quotes them.

use super::ElasticParts;
use crate::predictable_to;
use ::results::{FiledFinding, PartsOfTop, PeakPair, PeakTimes, Peaks};
use frames::{
    answer::ElasticHistories,
    assembled::{Assembled, Sway},
    fem::ElasticHistory,
    frame::Frame,
};
use rocking::motion::{TimedPeak, samples_until};

/// Time within which touches are one impact (1/p).
const SAME_IMPACT: f64 = 0.1;

impl ElasticParts<'_> {
    /// Largest displacements of both models, to their ends; up to where the first falls over.
    pub fn peaks(&self) -> PeakPair {
        self.peaks_to(None)
    }

    /// The same, with those up to when the motion can be foretold by what was found.
    pub fn foretold_peaks(&self, findings: &[FiledFinding]) -> PeakPair {
        let all = self.peaks();
        predictable_to(findings)
            .map_or(all, |until| all.foretold(until, &self.peaks_to(Some(until))))
    }

    /// Up to `until` (s), if it is given; impacts are those of all of it.
    fn peaks_to(&self, until: Option<f64>) -> PeakPair {
        let ElasticHistories { reference, fem, sways, .. } = &self.answer.histories;
        let falls = self.answer.histories.falls(self.assembled.structure.body().alpha());
        let most = falls.unwrap_or(usize::MAX).min(samples_until(until, self.record.dt));
        let lengths = [reference.history.q.len(), fem.q.len()].map(|n| n.min(most));
        // one that ends early is shorter than the other, which counts to its own end
        let early = fem.outcome.ends_early().filter(|_| lengths[1] < lengths[0]);
        let both = lengths[0].min(lengths[1]);
        let lengths = if early.is_some() { lengths } else { [both; 2] };
        let sways = |k: usize| sways.iter().map(|pair| &pair[k]).collect::<Vec<_>>();
        let landings = reference.history.landings().map(|event| event.time);
        let of_reference = HistoryParts {
            assembled: self.assembled,
            q: reference.history.q.iter().map(|q| q.as_slice()).take(lengths[0]),
            sways: &sways(0),
            dt: self.record.dt,
        };
        PeakPair {
            reference: of_reference.peaks(landings),
            springs: peaks_on_springs(self.assembled, fem, &sways(1), self.record.dt, lengths[1]),
            springs_end_s: early,
            ..PeakPair::default()
        }
    }
}

/// Largest displacements of a history on springs, of its first `n` samples at `dt` (s); impacts are
/// those of all of it.
pub fn peaks_on_springs(
    assembled: &Assembled,
    fem: &ElasticHistory,
    sways: &[&Sway],
    dt: f64,
    n: usize,
) -> Peaks {
    let q = fem.q.iter().map(Vec::as_slice).take(n);
    let touches = fem.contacts.iter().filter(|contact| contact.touches).map(|c| c.time);
    HistoryParts { assembled, q, sways, dt }.peaks(touches)
}

/// A history: its configurations, at `dt` (s), and how its columns sway.
struct HistoryParts<'a, Q> {
    assembled: &'a Assembled,
    q: Q,
    sways: &'a [&'a Sway],
    dt: f64,
}

impl<'a, Q: Iterator<Item = &'a [f64]>> HistoryParts<'a, Q> {
    /// Largest displacements, with the impacts among these touches (s).
    fn peaks(self, touches: impl Iterator<Item = f64>) -> Peaks {
        let Self { assembled, q, sways, dt } = self;
        let frame = &assembled.frame;
        let [mut top, mut rocking, mut bending] = [TimedPeak::default(); 3];
        let [mut moved, mut lifted, mut distorted] = [TimedPeak::default(); 3];
        let mut then = PartsOfTop::default();
        for (i, q) in q.enumerate() {
            let now = |value: f64| TimedPeak { value, time: i as f64 * dt };
            for (column, (watched, Sway { rotation, drift })) in
                assembled.watched.iter().zip(sways).enumerate()
            {
                let [x, ..] = frame.displacement(watched.top, q);
                let feet = watched.base.feet_moved(frame, q);
                moved = moved.larger(now(feet));
                // across the base's axis, which has turned
                let across = drift[i] * rotation[i].cos();
                if x.abs() > top.value.abs() {
                    let sign = x.signum();
                    then = PartsOfTop {
                        column: (sways.len() > 1).then_some(column + 1),
                        rocking_m: sign * (x - feet - across),
                        bending_m: sign * across,
                        feet_moved_m: sign * feet,
                    };
                }
                top = top.larger(now(x));
                distorted = distorted.larger(now(x - feet));
                rocking = rocking.larger(now(x - feet - across));
                bending = bending.larger(now(drift[i]));
            }
            lifted = lifted.larger(now(uplift(frame, q)));
        }
        let times = PeakTimes {
            top_displacement_s: top.time,
            rocking_s: rocking.time,
            bending_s: Some(bending.time),
            feet_moved_s: Some(moved.time),
            drift_ratio_s: Some(distorted.time),
            uplift_s: lifted.time,
        };
        Peaks {
            top_displacement_m: top.value.abs(),
            rocking_m: rocking.value.abs(),
            bending_m: Some(bending.value.abs()),
            feet_moved_m: Some(moved.value.abs()),
            then: Some(then),
            uplift_m: lifted.value,
            drift_ratio: distorted.value.abs() / assembled.structure.height(),
            impacts: impacts(touches, SAME_IMPACT / assembled.structure.body().p()),
            times: Some(times),
        }
    }
}

/// Impacts among touches of corners (s): one that follows the last within `rest` (s) belongs to the
/// same.
fn impacts(touches: impl Iterator<Item = f64>, rest: f64) -> usize {
    let (mut last, mut count) = (f64::NEG_INFINITY, 0);
    for time in touches {
        count += usize::from(time - last > rest);
        last = time;
    }
    count
}

/// Height of the highest corner above the ground (m).
fn uplift(frame: &Frame, q: &[f64]) -> f64 {
    frame.places().iter().map(|place| place.reach(q).place[1]).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{super::tests::a_frame, *};

    /// A structure that is moved as a whole: its feet move with it, and no corner lifts.
    #[test]
    fn feet_of_a_structure_that_has_moved_are_where_they_landed() {
        let Assembled { frame, watched, .. } = a_frame();
        let feet_moved = |q: &[f64]| watched[0].base.feet_moved(&frame, q);
        let mut q =
            vec![
                0.0;
                (0..frame.nodes()).flat_map(|node| frame.coordinates(node)).flatten().count()
            ];
        assert_eq!([feet_moved(&q), uplift(&frame, &q)], [0.0; 2]);
        for [x, ..] in (0..frame.nodes()).map(|node| frame.coordinates(node)) {
            q[x.unwrap()] += 0.25;
        }
        assert!((feet_moved(&q) - 0.25).abs() < 1e-15);
        assert_eq!(uplift(&frame, &q), 0.0);
    }
}
