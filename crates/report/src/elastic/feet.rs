//! Where an elastic structure's feet end: legs that scissor, and columns that bend, land elsewhere
//! than they stood, and friction keeps them there.

use super::ElasticParts;
use frames::{assembled::Assembled, reference::ReferenceOutcome};
use results::Finding;

/// Share of the feet's distance above which it is said that it has changed.
const LEAST_APART: f64 = 1e-3;

/// Share of it above which it is said that the structure no longer stands where it stood.
const LEAST_ASIDE: f64 = 1e-2;

impl ElasticParts<'_> {
    /// Where the feet of the reference stand when all of them last press, if that is not where they
    /// stood at first; `until` is up to when the motion can be foretold (s), if not to its end.
    pub(super) fn feet_moved(&self, until: Option<f64>) -> Option<Finding> {
        let history = &self.answer.histories.reference.history;
        if history.outcome != ReferenceOutcome::Completed {
            return None;
        }
        let last = last_pressed(self.assembled, &history.forces)?;
        let time = last as f64 * history.dt;
        let [first, then] = [0, last].map(|i| history.q.get(i).map(|q| q.as_slice()));
        let [aside, apart] = moved(self.assembled, first?, then?);
        let width = 2.0 * self.assembled.structure.body().half_width;
        let aside_m = Some(aside).filter(|x| x.abs() > LEAST_ASIDE * width);
        let apart_m = Some(apart).filter(|x| x.abs() > LEAST_APART * width);
        (aside_m.or(apart_m).is_some()).then(|| Finding::FeetMoved {
            aside_m,
            apart_m,
            rocks_on_from_s: (last + 1 < history.q.len()).then_some(time),
            predictable: until.is_none_or(|until| time <= until),
        })
    }
}

/// The last sample at which the ground presses every footing, by the forces on corners (N).
fn last_pressed(assembled: &Assembled, forces: &[Vec<[f64; 2]>]) -> Option<usize> {
    let all_press = |corners: &Vec<[f64; 2]>| {
        let mut rest = corners.as_slice();
        assembled.frame.places().chunk_by(|a, b| a.shares_node(b)).all(|footing| {
            let (own, others) = rest.split_at(footing.len().min(rest.len()));
            rest = others;
            own.iter().any(|force| force[1] > 0.0)
        })
    };
    forces.iter().rposition(all_press)
}

/// How far the feet have moved, by their mean, and how much further apart the outer ones are (m).
fn moved(assembled: &Assembled, first: &[f64], then: &[f64]) -> [f64; 2] {
    let frame = &assembled.frame;
    let aside = |q: &[f64]| {
        // of two columns the mean
        let all = assembled.watched.iter().map(|watched| watched.base.feet_moved(frame, q));
        all.sum::<f64>() / assembled.watched.len().max(1) as f64
    };
    let apart = |q: &[f64]| {
        let ends = [frame.places().first(), frame.places().last()];
        let [left, right] = ends.map(|end| end.map_or(0.0, |end| end.reach(q).place[0]));
        right - left
    };
    [aside(then) - aside(first), apart(then) - apart(first)]
}

#[cfg(test)]
mod tests {
    use super::{super::tests::a_frame, *};

    /// An A-frame whose left foot has moved by 0.9 m, and the right one by 0.8 m.
    #[test]
    fn feet_that_walk_stand_beside_their_place_and_those_in_the_air_are_not_asked() {
        let assembled = a_frame();
        let frame = &assembled.frame;
        let size = (0..frame.nodes()).flat_map(|node| frame.coordinates(node)).flatten().count();
        let first = vec![0.0; size];
        let mut then = first.clone();
        for (node, by) in frame.footing_nodes().iter().zip([0.9, 0.8]) {
            then[frame.coordinates(*node)[0].unwrap()] += by;
        }
        let [aside, apart] = moved(&assembled, &first, &then);
        assert!((aside - 0.85).abs() < 1e-12 && (apart + 0.1).abs() < 1e-12, "{aside} {apart}");
        let forces = |right: f64| vec![[0.0, 1e6], [0.0, right]];
        let all = [forces(1e6), forces(2.0), forces(0.0)];
        assert_eq!(last_pressed(&assembled, &all), Some(1));
        assert_eq!(last_pressed(&assembled, &all[2..]), None);
    }
}
