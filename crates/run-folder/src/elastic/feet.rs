//! Where feet are: legs that scissor, and columns that bend, land elsewhere than they stood.

use super::ElasticRun;
use frames::answer::ElasticHistories;

/// How far every foot has moved across, by the mean of its corners (m), on rigid ground and on
/// springs.
pub(super) fn moved(run: &ElasticRun) -> Vec<[Vec<f64>; 2]> {
    let ElasticHistories { reference, fem, .. } = &run.answer.histories;
    let feet = run.assembled.frame.places().chunk_by(|a, b| a.shares_node(b));
    feet.map(|corners| {
        let now = |q: &[f64]| {
            let all = corners.iter().map(|corner| corner.reach(q).place[0]);
            all.sum::<f64>() / corners.len() as f64
        };
        let reference = reference.history.q.iter().map(|q| now(q.as_slice())).collect();
        [reference, fem.q.iter().map(|q| now(q)).collect()]
    })
    .collect()
}
