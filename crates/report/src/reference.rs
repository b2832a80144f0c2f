//! What a reader must know before trusting a comparison with Housner's body: how sensitive its
//! history is, and whether rocking holds.

use dynamics::fem::{self, HistoryOutcome};
use parameters::answers::ModelComparison;
use results::{Ending, Finding, FindingModel, findings::HARDLY_ROCKS};
use rocking::{
    conditioning::Conditioning,
    housner::{self, Rocking},
    motion::TimedPeak,
    regime::{self, Regime},
    structure::{Body, Structure},
};
use strong_motion::Record;
use validation::verdict::{Answer, Fate, Verdict};

/// Largest rotation, over alpha, of a body that rocks.
const ROCKS: f64 = 0.02;

/// Conditioning and regime of Housner's history.
#[derive(Clone, Copy, Debug)]
pub struct HousnerReport {
    /// How far changes move it.
    pub conditioning: Conditioning,
    /// Whether it slides, flies or bounces.
    pub regime: Regime,
    /// Whether the record lifts Housner's body: else there is no history to be sensitive.
    pub lifted: bool,
    /// When its pivot left the ground, which ends his solution (s).
    pub left_ground_s: Option<f64>,
    /// Of a history that is ill-conditioned: up to when no change of 0.1 % moves it by a twentieth
    /// of its peak (s), if that is not all of it.
    pub holds_to_s: Option<f64>,
}

impl HousnerReport {
    /// Of a history that `rocking` holds; `friction` is the coefficient that is available.
    pub fn new(
        body: &Body<f64>,
        restitution: f64,
        record: &Record,
        rocking: &Rocking<f64>,
        friction: f64,
    ) -> Self {
        let vertical = record.vertical_accel();
        let options = housner::RockingOptions {
            restitution: Some(restitution),
            vertical,
            ..Default::default()
        };
        let conditioning = Conditioning::new(body, record.dt, &record.accel, &options);
        let lifted = rocking.outcome != housner::RockingOutcome::NeverMoved;
        Self {
            holds_to_s: conditioning.predictable_to().filter(|_| lifted),
            conditioning,
            regime: regime::check(
                body,
                record.dt,
                (&record.accel, record.up()),
                1.0,
                rocking,
                friction,
            ),
            lifted,
            left_ground_s: rocking.left_ground(),
        }
    }

    /// Friction coefficient needed.
    pub(crate) fn friction_needed(&self) -> f64 {
        friction_needed(&self.regime, self.lifted)
    }

    /// Where pure rocking does not hold.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        let r = &self.regime;
        let available = r.friction;
        let mut all = Vec::new();
        if let Some(time_s) = self.left_ground_s {
            all.push(Finding::PivotLeavesGround { time_s });
        }
        if r.friction_needed.value > available {
            all.push(Finding::Sliding {
                needed: r.friction_needed.value,
                time_s: Some(r.friction_needed.time),
                available,
                press_over_weight: None,
            });
        } else if self.lifted && r.landing_friction > available {
            all.push(Finding::Sliding {
                needed: r.landing_friction,
                time_s: None,
                available,
                press_over_weight: None,
            });
        }
        if let Some(flight) = r.free_flight {
            all.push(Finding::FreeFlight { time_s: flight.time, lowest_over_weight: flight.value });
        }
        if let Some(stocky) = r.too_stocky {
            let regime::Stocky { restitution, friction_needed } = stocky;
            all.push(Finding::TooStocky { restitution, friction_needed, available });
        }
        all
    }
}

/// Friction coefficient needed: at rest, rocking, and in a landing of a body that lifted.
pub(crate) fn friction_needed(of: &Regime, lifted: bool) -> f64 {
    of.friction_needed.value.max(if lifted { of.landing_friction } else { 0.0 })
}

/// All findings on histories of given springs.
pub fn all(
    structure: &Structure,
    record: &Record,
    both: &ModelComparison,
    report: &HousnerReport,
    of: &Verdict,
) -> Vec<Finding> {
    let mut all = verdict(structure, record, both, of);
    all.extend(ill_conditioned(report, of, false));
    all.extend(report.findings());
    all.extend(histories(both));
    all
}

/// What the body does in both models, and what the comparison is worth.
pub(crate) fn verdict(
    structure: &Structure,
    record: &Record,
    both: &ModelComparison,
    verdict: &Verdict,
) -> Vec<Finding> {
    let Verdict { housner, finite_elements, .. } = verdict;
    let mut all = vec![match (housner.fate, finite_elements.fate) {
        (Fate::NeverLifted, _) => {
            let uplift_g = structure.width_m / (2.0 * structure.height_m);
            Finding::NeverLifts { pga_g: record.pga_g(), uplift_g }
        }
        (_, Fate::Overturned) => Finding::Overturns {
            time_s: finite_elements.overturned_s.unwrap_or(verdict.compared_s),
            reference_s: housner.overturned_s,
        },
        (_, Fate::Failed) => {
            Finding::NoAnswer { model: FindingModel::Springs, time_s: verdict.compared_s }
        }
        _ => Finding::Stands {
            share_of_overturning: finite_elements.peak_ratio,
            reference_share: (housner.fate == Fate::Rocked).then_some(housner.peak_ratio),
            over_s: verdict.compared_s,
            largest_at_s: TimedPeak::of(record.dt, &both.fem.motion.theta).map(|peak| peak.time),
            if_feet_hold: false,
            of_columns: false,
        },
    }];
    all.extend(verdict.housner_without_vertical.map(|level| Finding::WithoutVertical {
        does: does(&level),
        share_of_overturning: match level.fate {
            Fate::Overturned => 1.0,
            _ => level.peak_ratio,
        },
    }));
    if !verdict.agrees() {
        all.push(Finding::ModelsDisagree {
            reference: does(housner),
            springs: does(finite_elements),
        });
    }
    all
}

/// That a lifted body's history cannot be compared one to one.
pub(crate) fn ill_conditioned(
    report: &HousnerReport,
    verdict: &Verdict,
    springs_judged: bool,
) -> Option<Finding> {
    let changes = &report.conditioning.changes;
    // a solution that ends before anything rocks is of no history
    let ends_at_once = report.left_ground_s.is_some() && verdict.housner.peak_ratio < ROCKS;
    let hardly = verdict.finite_elements.peak_ratio < HARDLY_ROCKS;
    (report.lifted && !verdict.well_conditioned && !ends_at_once && !hardly).then(|| {
        Finding::IllConditioned {
            moved_by_width: changes.width[0],
            moved_by_scale: changes.scale[0],
            moved_by_restitution: Some(changes.restitution[0]),
            holds_to_s: report.holds_to_s,
            springs_judged,
        }
    })
}

fn does(answer: &Answer) -> String {
    match (answer.fate, answer.overturned_s) {
        (Fate::NeverLifted, _) => "never lifts".into(),
        (Fate::Rocked, _) => "rocks and stands".into(),
        (Fate::Overturned, Some(time)) => format!("overturns at t = {time:.2} s"),
        (Fate::Overturned, None) => "overturns".into(),
        (Fate::LeftGround, _) => "leaves the ground".into(),
        (Fate::Failed, _) => "has no answer".into(),
    }
}

/// Histories that ended before the record did, or took steps that broke their bounds.
pub fn histories(both: &ModelComparison) -> Vec<Finding> {
    let with = both.with.as_ref().map(|with| (FindingModel::Members, &with.history));
    let mut all = Vec::new();
    for (model, history) in [(FindingModel::Springs, &both.fem)].into_iter().chain(with) {
        all.extend(ended(model, history));
        if history.work.smallest > 0 {
            all.push(Finding::SmallestSteps { model, steps: history.work.smallest });
        }
    }
    all
}

fn ended(model: FindingModel, history: &fem::History) -> Option<Finding> {
    let (time_s, ending) = match history.outcome {
        HistoryOutcome::WorkBound { time } => (time, Ending::WorkBound),
        HistoryOutcome::Unstable { time } => (time, Ending::Unstable),
        _ => return None,
    };
    Some(Finding::HistoryEndsEarly { model, time_s, ending })
}
