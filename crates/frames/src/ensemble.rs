//! What is compared where no model foretells a history: peaks over motions that differ from the
//! record by less than a hundredth.
//!
//! ```text
//!   ground:   (1 + x) times the record, x in even steps from -1 % to 1 %: on rigid ground with plastic landings, and on springs
//!   compared: median and 90 % of the largest rotation and of the largest drift, and the distance of Kolmogorov and Smirnov
//! ```
//!
//! Histories that part from each other are still drawn from one distribution, if the springs are
//! right: engineers design for that one. Of two samples of 24 motions each from the same, one in
//! twenty is further apart than 0.39 (Smirnov 1939).

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::{
    assembled::{Assembled, Sway},
    fem::ElasticAnalysis,
    reference::{GroundAcceleration, ReferenceOptions, ReferenceOutcome, RestError, Stop, rock},
};
use dynamics::{
    fem::{Control, HistoryOutcome},
    spring::{Chain, Springs},
};
use rocking::{
    motion::peak,
    statistics::{ks_distance, quantile},
};
use strong_motion::Record;

/// Motions.
const MOTIONS: usize = 24;
/// The largest change of the ground's motion.
const CHANGE: f64 = 0.01;

/// Largest rotation (rad) and drift (m) of a history; infinite if it overturns.
type Largest = [f64; 2];

/// What one quantity comes to over all motions: that on rigid ground, and that on springs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Median on rigid ground and on springs; none if half of the histories overturn.
    pub median: [Option<f64>; 2],
    /// 90 % are below it; none if a tenth of the histories overturn.
    pub p90: [Option<f64>; 2],
    /// Distance of Kolmogorov and Smirnov.
    pub ks_distance: f64,
}

impl Spread {
    fn new(reference: &[f64], fem: &[f64]) -> Self {
        let sorted = [reference, fem].map(|all| {
            let mut all = all.to_vec();
            all.sort_by(f64::total_cmp);
            all
        });
        let at = |q: f64| [0, 1].map(|k| quantile(&sorted[k], q).filter(|x| x.is_finite()));
        Self { median: at(0.5), p90: at(0.9), ks_distance: ks_distance(reference, fem) }
    }
}

/// Peaks over motions near a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ensemble {
    /// Motions that both models could be followed through.
    pub motions: usize,
    /// The largest change of the ground's motion.
    pub change: f64,
    /// Largest rotation (rad).
    pub rotation_rad: Spread,
    /// Largest drift (m).
    pub drift_m: Spread,
    /// Histories that overturn: on rigid ground, on springs.
    pub overturned: [usize; 2],
}

impl Ensemble {
    /// Of a structure through motions near a record, from rest; on rigid ground by so many units of
    /// work each. Beside it, how many motions are left out since a history met its bound.
    ///
    /// # Errors
    /// The structure does not stand.
    pub(crate) fn new(
        assembled: &Assembled,
        springs: &[Springs<Chain>],
        record: &Record,
        most_work: u64,
    ) -> Result<(Option<Self>, usize), RestError> {
        let q = assembled.upright()?;
        let scale = |i: usize| 1.0 + CHANGE * (2.0 * i as f64 / (MOTIONS - 1) as f64 - 1.0);
        let both = |i: usize| {
            let (reference, fem) = parallel::join(
                || on_rigid_ground(assembled, &q, record, (scale(i), most_work)),
                || on_springs(assembled, springs, record, scale(i)),
            );
            [reference, fem]
        };
        // where the outermost two are out of work, those between are not tried
        let (first, last) = parallel::join(|| both(0), || both(MOTIONS - 1));
        let out_of_work =
            |pair: &[Near; 2]| pair.iter().any(|near| matches!(near, Near::OutOfWork));
        if out_of_work(&first) && out_of_work(&last) {
            return Ok((None, MOTIONS));
        }
        let mut all = vec![first];
        all.extend(parallel::map_range(1..MOTIONS - 1, both));
        all.push(last);
        let followed = |pair: &[Near; 2]| match pair {
            [Near::Peaks(reference), Near::Peaks(fem)] => Some([*reference, *fem]),
            _ => None,
        };
        let pairs: Vec<[Largest; 2]> = all.iter().filter_map(followed).collect();
        let left_out = all.iter().filter(|&pair| out_of_work(pair)).count();
        Ok((Self::of(&pairs), left_out))
    }

    /// Of the peaks on rigid ground and on springs; none if there are none.
    fn of(pairs: &[[Largest; 2]]) -> Option<Self> {
        let all = |model: usize, what: usize| {
            pairs.iter().map(|pair| pair[model][what]).collect::<Vec<_>>()
        };
        let spread = |what: usize| Spread::new(&all(0, what), &all(1, what));
        let overturned =
            [0, 1].map(|model| all(model, 0).iter().filter(|peak| peak.is_infinite()).count());
        (!pairs.is_empty()).then(|| Self {
            motions: pairs.len(),
            change: CHANGE,
            rotation_rad: spread(0),
            drift_m: spread(1),
            overturned,
        })
    }
}

fn largest(sways: &[Sway]) -> Largest {
    let of = |pick: fn(&Sway) -> &[f64]| {
        sways.iter().map(|sway| peak(pick(sway)).abs()).fold(0.0, f64::max)
    };
    [of(|sway| &sway.rotation), of(|sway| &sway.drift)]
}

/// What a history comes to.
enum Near {
    Peaks(Largest),
    OutOfWork,
    /// It cannot be followed.
    Lost,
}

fn on_rigid_ground(
    assembled: &Assembled,
    q: &DVector<f64>,
    record: &Record,
    (scale, most_work): (f64, u64),
) -> Near {
    let ground = GroundAcceleration::of(record);
    let options = ReferenceOptions { scale, most_work, ..ReferenceOptions::default() };
    let history = rock(&assembled.frame, ground, (q, &DVector::zeros(q.len())), &options);
    match history.outcome {
        ReferenceOutcome::Completed => {
            Near::Peaks(largest(&assembled.sways(history.q.iter().map(|q| q.as_slice()))))
        }
        ReferenceOutcome::Overturned { .. } => Near::Peaks([f64::INFINITY; 2]),
        ReferenceOutcome::Stopped { why: Stop::Work | Stop::Events, .. } => Near::OutOfWork,
        ReferenceOutcome::Stopped { .. } => Near::Lost,
    }
}

fn on_springs(
    assembled: &Assembled,
    springs: &[Springs<Chain>],
    record: &Record,
    scale: f64,
) -> Near {
    let whole = ElasticAnalysis::on_record(&assembled.frame, springs, record);
    let case = ElasticAnalysis { scale, control: Control::search(), forces: false, ..whole };
    let Ok(history) = case.simulate() else { return Near::Lost };
    match history.outcome {
        HistoryOutcome::Completed => {
            Near::Peaks(largest(&assembled.sways(history.q.iter().map(Vec::as_slice))))
        }
        HistoryOutcome::Overturned { .. } => Near::Peaks([f64::INFINITY; 2]),
        HistoryOutcome::WorkBound { .. } => Near::OutOfWork,
        _ => Near::Lost,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_distances_are_those_worked_by_hand() {
        let of = |pairs: &[[f64; 2]]| {
            let pairs: Vec<[Largest; 2]> =
                pairs.iter().map(|[a, b]| [[*a, 2.0 * a], [*b, 2.0 * b]]).collect();
            Ensemble::of(&pairs)
        };
        let ensemble = of(&[[0.3, 0.1], [0.1, 0.2], [0.2, 0.4], [f64::INFINITY, 0.5]]).unwrap();
        assert_eq!((ensemble.motions, ensemble.overturned), (4, [1, 0]));
        let Spread { median, p90, ks_distance } = ensemble.rotation_rad;
        assert!(
            (median[0].unwrap() - 0.25).abs() < 1e-15 && (median[1].unwrap() - 0.3).abs() < 1e-15
        );
        // a tenth of the histories on rigid ground overturn
        assert!(p90[0].is_none() && (p90[1].unwrap() - 0.47).abs() < 1e-15);
        // at 0.3: three of four against two of four
        assert_eq!(ks_distance, 0.25);
        assert!((ensemble.drift_m.median[1].unwrap() - 0.6).abs() < 1e-15);
        assert_eq!(of(&[]), None);
    }
}
