//! The last word is that of histories: of the springs that are good for any motion, those that follow best.
//!
//! The impact objective calls springs of quite different make equally good. Which of them follow a history better is for the
//! history to say, and more of it comes together there than in single landings and uplifts: on blocks a landing that keeps
//! a thousandth too much makes good for the elastic stance that lifts late. Where Housner's answer to the record at hand is
//! well conditioned, that record decides, and else synthetic motions made for the structure, on which it is. They decide among
//! springs with landings in order, and among nothing else; and they look at springs that are a little off, too. One record can
//! be followed by luck: its favourite must be good on the synthetic motions, too, or no worse than the impact objective's.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::{
    impact::is_another,
    impulse::{Found, in_order_first},
    off,
    outer::Benchmark,
};
use crate::{
    conditioning::{ILL_CONDITIONED, sensitivity},
    fem::Control,
    housner::{self, Options, Outcome},
    motion::Motion,
    record::Record,
    spring::{Design, Springs},
    structure::Body,
    synthetic::record,
};

/// Synthetic motions that decide, those that look at a record's favourite, and the suite in which well-conditioned ones are
/// looked for, so many at a time.
const MOTIONS: usize = 30;
const OTHERS: usize = 12;
const SUITE: usize = 150;
const AT_A_TIME: usize = 30;
const SEED: u64 = 1940;

/// Errors less apart than by this factor are chance: thirty motions tell little more, and one record less.
const CLEARLY: f64 = 0.95;

/// Error of a history that is good enough: not to ask for stiffer springs, and on synthetic motions for a record's favourite.
pub const GOOD: f64 = 0.03;

/// A motion and Housner's answer.
#[derive(Debug)]
struct Trial {
    dt: f64,
    accel: Vec<f64>,
    housner: Motion,
}

/// Who decides.
#[derive(Debug)]
pub struct Choice {
    body: Body<f64>,
    /// The record, or synthetic motions.
    trials: Vec<Trial>,
    /// Synthetic motions beside the record, made when they are asked.
    others: OnceLock<Vec<Trial>>,
}

impl Trial {
    /// `None` where Housner's answer cannot be compared with another one to one.
    fn new(body: &Body<f64>, record: &Record) -> Option<Self> {
        let (dt, accel) = (record.dt, record.accel.clone());
        let rocking = housner::solve(body, dt, &accel, &Options::default());
        let follows = rocking.outcome == Outcome::Rocked
            && !rocking.impacts.is_empty()
            && sensitivity(body, dt, &accel, &Options::default()).worst() < ILL_CONDITIONED;
        follows.then(|| Self { dt, accel, housner: rocking.motion(body) })
    }

    /// ln of the error of the history on these springs. Springs that lose the motion altogether are not worse than standing
    /// still, lest one motion that none follows decide for all.
    fn error(&self, body: &Body<f64>, springs: &Springs<Design<f64>>) -> f64 {
        let benchmark = Benchmark { body: *body, dt: self.dt, accel: &self.accel, housner: &self.housner };
        benchmark.error(springs, f64::INFINITY, Control::search()).0.min(1.0).ln()
    }
}

/// The first `count` synthetic motions of the suite on which the body is well conditioned; fewer if it has no more.
fn synthetic(body: &Body<f64>, count: usize) -> Vec<Trial> {
    let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
    let mut trials: Vec<Trial> = Vec::new();
    for first in (0..SUITE).step_by(AT_A_TIME) {
        let some = (first..first + AT_A_TIME).into_par_iter();
        trials.par_extend(some.filter_map(|i| Trial::new(body, &record(SEED, i, p, alpha))));
        if trials.len() >= count {
            break;
        }
    }
    trials.truncate(count);
    trials
}

impl Choice {
    /// Of a body that shall land with velocity restitution `restitution`, on this record. Nobody decides over springs for
    /// another restitution than equation 2's: then that goes first, and the impact objective alone knows.
    pub fn new(body: &Body<f64>, restitution: f64, record: &Record) -> Self {
        let trials = if is_another(body, restitution) {
            Vec::new()
        } else {
            Trial::new(body, record).map_or_else(|| synthetic(body, MOTIONS), |trial| vec![trial])
        };
        Self { body: *body, trials, others: OnceLock::new() }
    }

    /// Whether the record at hand decides, which is one history, or many synthetic ones do.
    pub fn by_record(&self) -> bool {
        self.trials.len() == 1
    }

    /// Of proposals, the best by the impact objective first: the first among those whose landings are in order, unless another
    /// of these follows clearly better, and where that is a record's favourite, is good on synthetic motions or no worse than
    /// the first.
    pub fn of(&self, proposals: &[Found]) -> Option<Found> {
        self.first(proposals, |found, first| {
            !self.by_record() || {
                let error = self.elsewhere(&found.springs);
                error <= GOOD.ln() || error <= self.elsewhere(&first.springs)
            }
        })
    }

    /// The same, whatever synthetic motions say of a record's favourite.
    pub fn of_history(&self, proposals: &[Found]) -> Option<Found> {
        self.first(proposals, |_, _| true)
    }

    /// The best follower that stands up beside the first of those in order.
    fn first(&self, proposals: &[Found], stands: impl Fn(&Found, &Found) -> bool) -> Option<Found> {
        let kept: Vec<&Found> = in_order_first(proposals).collect();
        let first = **kept.first()?;
        if self.trials.is_empty() {
            return Some(first);
        }
        // the record looks at every variant of the springs, of many motions each at one
        let error = |found: &&Found| -> f64 {
            let variants = off::variants(&found.springs);
            let looks: Vec<(&Trial, &Springs<Design<f64>>)> = match self.trials.as_slice() {
                [record] => variants.iter().map(|variant| (record, variant)).collect(),
                many => many.iter().zip(variants.iter().cycle()).collect(),
            };
            self.error(&looks)
        };
        let errors: Vec<f64> = kept.par_iter().map(error).collect();
        let mut better: Vec<usize> = (0..kept.len()).filter(|&i| errors[i] < errors[0] + CLEARLY.ln()).collect();
        better.sort_by(|&a, &b| errors[a].total_cmp(&errors[b]).then(a.cmp(&b)));
        Some(better.into_iter().map(|i| *kept[i]).find(|found| stands(found, &first)).unwrap_or(first))
    }

    /// Mean of ln of the errors on synthetic motions.
    fn elsewhere(&self, springs: &Springs<Design<f64>>) -> f64 {
        let others = self.others.get_or_init(|| synthetic(&self.body, OTHERS));
        self.error(&others.iter().map(|other| (other, springs)).collect::<Vec<_>>())
    }

    /// Mean of ln of the errors.
    fn error(&self, looks: &[(&Trial, &Springs<Design<f64>>)]) -> f64 {
        let each: Vec<f64> = looks.par_iter().map(|(trial, springs)| trial.error(&self.body, springs)).collect();
        each.iter().sum::<f64>() / each.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Structure;

    fn found(v: [f64; 4], h: [f64; 4], in_order: bool) -> Found {
        let chain = |[hz, k, c, mu]: [f64; 4]| Design::from_kc(mu, k, c, hz);
        Found { springs: Springs { vertical: chain(v), horizontal: chain(h) }, error: 0.03, in_order }
    }

    /// A soft and a stiff plain chain, and one between that is hardly better than the stiff one.
    fn proposals(in_order: bool) -> [Found; 3] {
        let at = |hz: f64| found([hz, 0.2, 0.92, 0.5], [hz, 20.0, 1.0, 0.05], in_order);
        [at(80.0), at(160.0), at(165.0)]
    }

    fn el_centro() -> Record {
        Record::el_centro().truncated(20.0)
    }

    #[test]
    fn the_record_takes_what_follows_clearly_better_and_nothing_for_less() {
        let body = Structure::paper().body::<f64>();
        let choice = Choice::new(&body, body.restitution(), &el_centro());
        assert!(choice.by_record());
        let [soft, stiff, stiffer] = proposals(true);
        assert_eq!(choice.of(&[soft, stiff]).unwrap().springs, stiff.springs);
        assert_eq!(choice.of(&[stiff, soft]).unwrap().springs, stiff.springs);
        assert_eq!(choice.of(&[stiff, stiffer]).unwrap().springs, stiff.springs);
        assert!(choice.of(&[]).is_none());
    }

    #[test]
    fn landings_in_order_go_before_a_better_history() {
        let body = Structure::paper().body::<f64>();
        let choice = Choice::new(&body, body.restitution(), &el_centro());
        let [soft, ..] = proposals(true);
        let [_, stiff, _] = proposals(false);
        assert_eq!(choice.of(&[stiff, soft]).unwrap().springs, soft.springs);
    }

    /// Soft springs that follow El Centro by luck: their dashpots hardly damp, and on other motions they swing on.
    #[test]
    fn a_records_favourite_must_be_good_on_other_motions_too() {
        let body = Structure::a_frame(20.0, 4.0, 1e5).unwrap().body::<f64>();
        let choice = Choice::new(&body, body.restitution(), &el_centro());
        let plain = found([160.0, 0.6598, 0.718, 2.289], [160.0, 0.02, 0.0127, 0.019], true);
        let lucky = found([160.0, 0.2697, 10.63623, 2.30774], [155.6, 0.00584, 0.00732, 0.00726], true);
        let on_record = |found: Found| choice.error(&[(&choice.trials[0], &found.springs)]).exp();
        let elsewhere = |found: Found| choice.elsewhere(&found.springs).exp();
        assert!(on_record(lucky) < CLEARLY * on_record(plain));
        assert!(elsewhere(lucky) > elsewhere(plain).max(GOOD));
        assert_eq!(choice.of_history(&[plain, lucky]).unwrap().springs, lucky.springs);
        assert_eq!(choice.of(&[plain, lucky]).unwrap().springs, plain.springs);
    }

    #[test]
    fn nobody_decides_over_springs_for_another_restitution() {
        let body = Structure::paper().body::<f64>();
        let choice = Choice::new(&body, 0.95 * body.restitution(), &el_centro());
        let [soft, stiff, _] = proposals(false);
        assert!(!choice.by_record());
        assert_eq!(choice.of(&[soft, stiff]).unwrap().springs, soft.springs);
    }

    #[test]
    fn where_the_record_is_ill_conditioned_synthetic_motions_decide() {
        let body = Structure::a_frame(5.0, 1.5, 1e4).unwrap().body::<f64>();
        let choice = Choice::new(&body, body.restitution(), &el_centro());
        assert!((2..=MOTIONS).contains(&choice.trials.len()), "{}", choice.trials.len());
        let [soft, stiff, _] = proposals(false);
        assert_eq!(choice.of(&[soft, stiff]).unwrap().springs, stiff.springs);
    }
}
