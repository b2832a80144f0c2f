//! The last word is that of histories: of the springs that are good for any motion, those that follow best.
//!
//! The impact objective calls springs of quite different make equally good. Which of them follow a history better is for the
//! history to say, and more of it comes together there than in single landings and uplifts: on blocks a landing that keeps
//! a thousandth too much makes good for the elastic stance that lifts late. Where Housner's answer to the record at hand is
//! well conditioned, that record decides, and else synthetic motions made for the structure, on which it is. They decide among
//! springs with landings in order, and among nothing else; and they look at springs that are a little off, too.

use rayon::prelude::*;

use super::{
    impact::is_another,
    impulse::{Found, in_order_first},
    off,
    outer::Benchmark,
};
use crate::{
    conditioning::sensitivity,
    fem::Control,
    housner::{self, Options, Outcome},
    motion::Motion,
    record::Record,
    spring::{Design, Springs},
    structure::Body,
    synthetic,
};

/// Synthetic motions that decide, and the suite in which those that are well conditioned are looked for.
const MOTIONS: usize = 30;
const SUITE: usize = 150;
const SEED: u64 = 1940;

/// Errors less apart than by this factor are chance: thirty motions tell little more, and one record less.
const CLEARLY: f64 = 0.95;

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
    trials: Vec<Trial>,
}

impl Trial {
    /// `None` where Housner's answer cannot be compared with another one to one.
    fn new(body: &Body<f64>, record: &Record) -> Option<Self> {
        let (dt, accel) = (record.dt, record.accel.clone());
        let rocking = housner::solve(body, dt, &accel, &Options::default());
        let follows = rocking.outcome == Outcome::Rocked
            && !rocking.impacts.is_empty()
            && sensitivity(body, dt, &accel, &Options::default()).well_conditioned();
        follows.then(|| Self { dt, accel, housner: rocking.motion(body) })
    }

    /// ln of the error of the history on these springs. Springs that lose the motion altogether are not worse than standing
    /// still, lest one motion that none follows decide for all.
    fn error(&self, body: &Body<f64>, springs: &Springs<Design<f64>>) -> f64 {
        let benchmark = Benchmark { body: *body, dt: self.dt, accel: &self.accel, housner: &self.housner };
        benchmark.error(springs, f64::INFINITY, Control::search()).0.min(1.0).ln()
    }
}

impl Choice {
    /// Of a body that shall land with velocity restitution `restitution`, on this record. Nobody decides over springs for
    /// another restitution than equation 2's: then that goes first, and the impact objective alone knows.
    pub fn new(body: &Body<f64>, restitution: f64, record: &Record) -> Self {
        if is_another(body, restitution) {
            return Self { body: *body, trials: Vec::new() };
        }
        let trials = match Trial::new(body, record) {
            Some(trial) => vec![trial],
            None => {
                let suite = synthetic::suite(SUITE, SEED, body.p_squared().sqrt(), body.alpha());
                suite.filter_map(|record| Trial::new(body, &record)).take(MOTIONS).collect()
            }
        };
        Self { body: *body, trials }
    }

    /// Whether the record at hand decides, which is one history, or many synthetic ones do.
    pub fn by_record(&self) -> bool {
        self.trials.len() == 1
    }

    /// Of proposals, the best by the impact objective first: the first among those whose landings are in order, unless another
    /// of these follows clearly better.
    pub fn of(&self, proposals: &[Found]) -> Option<Found> {
        let kept: Vec<&Found> = in_order_first(proposals).collect();
        if self.trials.is_empty() {
            return kept.first().map(|&&found| found);
        }
        // the record looks at every variant of the springs, of many motions each at one
        let error = |found: &&Found| -> f64 {
            let variants = off::variants(&found.springs);
            let looks: Vec<(&Trial, &Springs<Design<f64>>)> = match self.trials.as_slice() {
                [record] => variants.iter().map(|variant| (record, variant)).collect(),
                many => many.iter().zip(variants.iter().cycle()).collect(),
            };
            let each: Vec<f64> = looks.par_iter().map(|(trial, springs)| trial.error(&self.body, springs)).collect();
            each.iter().sum::<f64>() / each.len() as f64
        };
        let errors: Vec<f64> = kept.par_iter().map(error).collect();
        let best = (0..kept.len()).min_by(|&a, &b| errors[a].total_cmp(&errors[b]).then(a.cmp(&b)))?;
        let best = if errors[best] < errors[0] + CLEARLY.ln() { best } else { 0 };
        Some(*kept[best])
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
