//! What a reader must know before trusting a comparison with Housner's body: how sensitive its
//! history is, and whether rocking holds.

use dynamics::{
    fem::{self, HistoryOutcome},
    spring::{Chain, Springs},
};
use files::message::percent;
use parameters::{
    answers::{MemberHistory, ModelComparison},
    predictability::MembersConditioning,
};
use results::{Ending, Finding, FindingModel, findings::HARDLY_ROCKS};
use rocking::{
    conditioning::Conditioning,
    housner::{self, Rocking},
    members::{Friction, Members},
    motion::{TimedPeak, largest_magnitude},
    regime::{self, Regime},
    scalar::GRAVITY,
    structure::{Body, Structure},
};
use strong_motion::Record;
use validation::verdict::{Answer, Fate, Verdict};

/// Largest rotation, over alpha, of a body that rocks.
const ROCKS: f64 = 0.02;

/// Vertical force of the ground over the weight below which it is said how near a body is to
/// leaving the ground.
const HARDLY_PRESSES: f64 = 0.1;

/// Share by which two friction coefficients are one.
const SAME: f64 = 1e-6;

/// Slip over the width, and rotation over alpha of a body at rest, below which they are the
/// springs'.
const LEAST_SLIP: f64 = 1e-3;

/// Conditioning and regime of Housner's history.
#[derive(Clone, Copy, Debug)]
pub struct HousnerReport {
    /// How far changes move it.
    pub conditioning: Conditioning,
    /// Whether it slides, flies or bounces.
    pub regime: Regime,
    /// Whether the record lifts Housner's body: else there is no history to be sensitive.
    pub lifted: bool,
    /// Whether the structure lands: with its members, if it has any.
    pub lands: bool,
    /// When its pivot left the ground, which ends his solution (s).
    pub left_ground_s: Option<f64>,
    /// Of a history that is ill-conditioned: up to when no change of 0.1 % moves it by a twentieth
    /// of its largest displacement so far (s), if that is not all of it.
    pub holds_to_s: Option<f64>,
    /// How sensitive the history with members is, if there are any: it is the answer.
    pub of_members: Option<MembersConditioning>,
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
        let options = housner::RockingOptions::on(record, restitution);
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
            lands: lifted,
            left_ground_s: rocking.left_ground(),
            of_members: None,
        }
    }

    /// The same of a structure with a tendon and dampers, by Housner's history with them. Feet that
    /// may slip never need more friction than there is, so for these the friction needed is that of
    /// the body without members.
    #[must_use]
    pub fn with_members(self, body: &Body<f64>, record: &Record, both: &ModelComparison) -> Self {
        let Some(with) = &both.with else { return self };
        let answer = Answer::of_history(body, with.members, record.dt, &with.history);
        let stays = answer.fate == Fate::NeverLifted;
        // how sensitive Housner's history is tells nothing of a body that its members keep down
        let (lifted, holds_to_s) = (self.lifted && !stays, self.holds_to_s.filter(|_| !stays));
        let told = Self { lifted, holds_to_s, ..self };
        let Some(rocking) = &with.rocking else { return told };
        let (ground, friction) = ((&record.accel[..], record.up()), self.regime.friction);
        let members = &with.members;
        let regime = regime::check_with(body, members, (record.dt, 1.0), ground, rocking, friction);
        let lands = !with.history.landings.is_empty();
        Self { regime, lands, left_ground_s: rocking.left_ground(), ..told }
    }

    /// With how sensitive the history with members is, if there are any, on these springs.
    #[must_use]
    pub fn with_conditioning(
        self,
        body: &Body<f64>,
        springs: &Springs<Chain>,
        record: &Record,
        both: &ModelComparison,
    ) -> Self {
        let with = both.with.as_ref();
        let of_members = with.map(|with| MembersConditioning::new(body, springs, record, with));
        Self { of_members, ..self }
    }

    /// Whether the history that is the answer is well-conditioned.
    pub(crate) fn well_conditioned(&self) -> bool {
        match &self.of_members {
            Some(of) => of.well_conditioned(),
            None => self.conditioning.well_conditioned(),
        }
    }

    /// Whether landings ask for more friction than the motion between them.
    pub(crate) fn needs_friction_to_land(&self) -> bool {
        let between = self.regime.friction_needed.value;
        self.lands && self.regime.landing_friction > (1.0 + SAME) * between
    }

    /// Friction coefficient needed.
    pub(crate) fn friction_needed(&self) -> f64 {
        friction_needed(&self.regime, self.lands)
    }

    /// Where pure rocking does not hold, beside both models' answers: feet that are given friction
    /// slide, and that is no doubt.
    pub(crate) fn findings_beside(&self, both: &ModelComparison) -> Vec<Finding> {
        let slide = both.with.as_ref().is_some_and(|with| with.members.friction.is_some());
        let told = |finding: &Finding| !(slide && matches!(finding, Finding::Sliding { .. }));
        self.findings().into_iter().filter(told).collect()
    }

    /// Where pure rocking does not hold.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        let r = &self.regime;
        let available = r.friction;
        let mut all = Vec::new();
        if let Some(time_s) = self.left_ground_s {
            all.push(Finding::PivotLeavesGround { time_s });
        }
        if r.friction_needed.value > available && !self.needs_friction_to_land() {
            all.push(Finding::Sliding {
                needed: r.friction_needed.value,
                time_s: Some(r.friction_needed.time),
                available,
                press_over_weight: None,
            });
        } else if self.lands && r.landing_friction > available {
            all.push(Finding::Sliding {
                needed: r.landing_friction,
                time_s: None,
                available,
                press_over_weight: None,
            });
        }
        if let Some(flight) = r.free_flight {
            all.push(Finding::FreeFlight { time_s: flight.time, lowest_over_weight: flight.value });
        } else if self.lands && self.left_ground_s.is_none() && r.least_press.value < HARDLY_PRESSES
        {
            let TimedPeak { value: press_over_weight, time: time_s } = r.least_press;
            all.push(Finding::HardlyPresses { time_s, press_over_weight });
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
    let mut all = verdict(structure, record, both, (of, report));
    all.extend(ill_conditioned(report, of, false));
    all.extend(report.findings_beside(both));
    all.extend(histories(both));
    all
}

/// What the body does in both models, and what the comparison is worth.
pub(crate) fn verdict(
    structure: &Structure,
    record: &Record,
    both: &ModelComparison,
    (verdict, report): (&Verdict, &HousnerReport),
) -> Vec<Finding> {
    let Verdict { housner, finite_elements, .. } = verdict;
    let without = || match (housner.fate, finite_elements.fate) {
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
            tied: false,
        },
    };
    let with = both.with.as_ref().map(|with| of_members(structure, record, with));
    let mut all = vec![with.unwrap_or_else(without)];
    if matches!(all[0], Finding::Stands { .. }) {
        let with = both.with.as_ref().filter(|with| with.members.friction.is_some());
        all.extend(with.and_then(|with| left_aside(structure, with)));
    }
    all.extend(both.with.as_ref().map(|_| Finding::MembersBeside {
        without: did(housner),
        without_to_s: report.holds_to_s.filter(|_| housner.fate == Fate::Rocked),
    }));
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
            springs: does_on_springs(finite_elements),
        });
    }
    all
}

/// What the structure does with its members.
fn of_members(structure: &Structure, record: &Record, with: &MemberHistory) -> Finding {
    let answer = Answer::of_history(&structure.body(), with.members, record.dt, &with.history);
    let motion = &with.history.motion;
    let followed_s = motion.len().saturating_sub(1) as f64 * record.dt;
    match answer.fate {
        Fate::NeverLifted => {
            let (pga_g, uplift_g) = (record.pga_g(), uplift_g(structure, &with.members));
            let largest_m = largest_magnitude(&motion.u);
            let left_m = motion.u.last().map_or(0.0, |u| u.abs());
            match with.members.friction.filter(|_| largest_m > LEAST_SLIP * structure.width_m) {
                Some(Friction { coefficient: friction }) => {
                    Finding::Slides { friction, uplift_g, largest_m, left_m }
                }
                None => Finding::NeverLifts { pga_g, uplift_g },
            }
        }
        Fate::Overturned => Finding::Overturns {
            time_s: answer.overturned_s.unwrap_or(followed_s),
            reference_s: None,
        },
        Fate::Failed => Finding::NoAnswer {
            model: FindingModel::Members,
            time_s: with.history.outcome.ends_early().unwrap_or(followed_s),
        },
        Fate::Rocked | Fate::LeftGround => Finding::Stands {
            share_of_overturning: answer.peak_ratio,
            reference_share: None,
            over_s: followed_s,
            largest_at_s: TimedPeak::of(record.dt, &motion.theta).map(|peak| peak.time),
            if_feet_hold: false,
            of_columns: false,
            tied: with.members.tendon.is_some(),
        },
    }
}

/// How far from where it stood a body with friction comes to rest, if it does.
fn left_aside(structure: &Structure, with: &MemberHistory) -> Option<Finding> {
    let motion = &with.history.motion;
    let (left_m, theta) = (motion.u.last()?.abs(), motion.theta.last()?.abs());
    let rests = theta < LEAST_SLIP * structure.body::<f64>().alpha();
    (rests && left_m > LEAST_SLIP * structure.width_m).then_some(Finding::LeftAside { left_m })
}

/// Ground acceleration (g) that lifts a body: b/h, and with a tendon of tension T, which the feet
/// bear as they bear the weight W, and which acts where the mass is only by its upright pull,
///
/// ```text
///   m a_g h = (W + T) b
/// ```
pub fn uplift_g(structure: &Structure, members: &Members) -> f64 {
    let pull = members.tendon.map_or(0.0, |tendon| tendon.pretension);
    let weight = structure.mass_kg * GRAVITY;
    structure.width_m / (2.0 * structure.height_m) * (1.0 + pull / weight)
}

/// That a lifted body's history cannot be compared one to one.
pub(crate) fn ill_conditioned(
    report: &HousnerReport,
    verdict: &Verdict,
    springs_judged: bool,
) -> Option<Finding> {
    if let Some(of) = &report.of_members {
        return of.finding().filter(|_| report.lands);
    }
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

/// The same, with how far it rocked.
fn did(answer: &Answer) -> String {
    let far = match answer.fate {
        Fate::Rocked if answer.peak_ratio >= HARDLY_ROCKS => {
            format!(", to {} of overturning", percent(answer.peak_ratio))
        }
        Fate::Overturned => "; its numbers count up to then".into(),
        _ => String::new(),
    };
    does(answer) + &far
}

/// What the body does on springs, on which it sways where it does not lift.
fn does_on_springs(answer: &Answer) -> String {
    match answer.fate {
        Fate::NeverLifted => "sways and never lifts (uplift in the table: rotation x width)".into(),
        _ => does(answer),
    }
}

fn does(answer: &Answer) -> String {
    match (answer.fate, answer.overturned_s) {
        (Fate::NeverLifted, _) => "never lifts".into(),
        (Fate::Rocked, _) if answer.peak_ratio < HARDLY_ROCKS => "hardly lifts".into(),
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
