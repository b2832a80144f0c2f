//! The outer loop: the least Omega_n from which on the error against Housner stays within the
//! accuracy asked for.
//!
//! Stiffness costs next to nothing where time steps follow events, and the error falls with it at
//! first order or better; so Omega_n follows from the accuracy. It is sought on a ladder of
//! Omega_n/p = 10^(i/10), so that the design depends on the structure and on the rung alone. A rung
//! holds if its errors are within `MARGIN` of what is allowed; the one that is taken holds, and so
//! does the next stiffer one, and the next softer does not.

use std::collections::BTreeMap;

use super::{
    ladder::{DECADE, Ladder, RungProgress, best},
    suite::{JudgedOn, MeasuredErrors, Suites},
};
use cases::Asked;
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Design, Springs},
};

/// Share of the accuracy asked for that is aimed at.
pub(crate) const MARGIN: f64 = 0.7;
/// The softest rung tried, Omega_n/p.
pub(crate) const SOFTEST: f64 = 100.0;
/// Omega_n/p times the accuracy asked for where the search begins: errors of synthetic motions fall
/// about as 20/(Omega_n/p), those of earthquake-like ones, with three standard errors, are about
/// five times what is allowed at 250/(Omega_n/p).
const BEGIN: f64 = 250.0;
/// How near an Omega_n/p is to a rung to be it, rungs.
const ROUNDING: f64 = 1e-9;
/// An accuracy for which steps over several samples will do.
const COARSE: f64 = 1e-3;
/// Error of a softer rung on a suite, over what is allowed, below which a stiffer one is not judged
/// on it again: errors fall with stiffness but for bumps of less than a factor of two.
const LITTLE: f64 = 0.3;

/// The inner design at an Omega_n/p, if it has one.
pub(crate) type DesignOf<'a> = &'a dyn Fn(f64) -> Option<Springs<Design<f64>>>;

/// Springs of one Omega_n/p and what was measured of them.
#[derive(Clone, Copy, Debug)]
pub struct Rung {
    /// Omega_n/p of the vertical units.
    pub stiffness: f64,
    pub springs: Springs<Design<f64>>,
    /// What was measured until the rung was refused or held; everything of the one that is taken.
    pub errors: MeasuredErrors,
}

/// What the outer loop found.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// Every rung that was judged, the softest first.
    pub rungs: Vec<Rung>,
    /// The one that was taken.
    pub best: Rung,
    /// Whether it holds.
    pub reached: bool,
}

/// Seek Omega_n in a range of Omega_n/p; `None` if no rung is in it, or none has springs. `springs`
/// gives the inner design at an Omega_n/p; `progress` is told the rungs judged and the least error
/// in units of what is allowed.
pub(crate) fn tune(
    suites: &Suites,
    mass: f64,
    asked: Asked,
    ((softest, stiffest), effort): ((f64, f64), &Effort),
    springs: DesignOf,
    progress: RungProgress,
) -> Option<Tuned> {
    let (first, last) = (rung_from(softest), rung_up_to(stiffest));
    if first > last {
        return None;
    }
    let guess = (rung(begin(asked)).round() as i64).clamp(first, last);
    let allowed = asked.times(MARGIN);
    let over = |rung: &Rung| rung.errors.over(allowed);
    let control = control(asked.error);
    let judge = |i: i64, seen: &BTreeMap<i64, Rung>| {
        let mut rung = Rung::unmeasured(i, springs)?;
        for suite in in_order(seen, i, allowed) {
            let chains = rung.springs.chains(mass);
            suites.measure(suite, &chains, (control, effort), &mut rung.errors);
            if effort.stopped() || !seen.is_empty() && over(&rung) > 1.0 {
                break;
            }
        }
        Some(rung)
    };
    let ladder = Ladder { ends: (first, last), guess };
    let some_over = |rung: &Rung| Some(over(rung));
    let (mut seen, found) = ladder.search(judge, some_over, effort, progress);
    // cut: the best so far; else the one that the search would have begun with
    let cut = effort.cut().is_some();
    let judged = found.or_else(|| best(&seen, some_over).filter(|_| cut));
    let taken = judged.or(cut.then_some(guess))?;
    if judged.is_none() {
        seen.insert(guess, Rung::unmeasured(guess, springs)?);
    }
    let best = seen.get_mut(&taken)?;
    for suite in JudgedOn::ALL {
        if best.errors.over_on(suite, allowed).is_none() && !effort.stopped_from_outside() {
            suites.measure(suite, &best.springs.chains(mass), (control, effort), &mut best.errors);
        }
    }
    let (best, reached) = (*best, judged.is_some() && over(best) <= 1.0);
    Some(Tuned { rungs: seen.into_values().collect(), best, reached })
}

impl Rung {
    fn unmeasured(i: i64, springs: DesignOf) -> Option<Self> {
        let stiffness = stiffness(i);
        let errors = MeasuredErrors::default();
        Some(Self { stiffness, springs: springs(stiffness)?, errors })
    }
}

/// How closely histories are followed to find out whether they are this accurate: steps over
/// several samples, which err by up to 1e-4, only where much more is allowed.
pub(crate) fn control(accuracy: f64) -> Control {
    Control { long_steps: accuracy >= COARSE, ..Control::search() }
}

/// The suites that a rung is to be judged on: what decided at the nearest rung first, for it may
/// refuse this one alone; and none on which a softer rung had so little error that this one will
/// hold.
fn in_order(seen: &BTreeMap<i64, Rung>, i: i64, allowed: Asked) -> Vec<JudgedOn> {
    let share = |rung: &Rung, suite| rung.errors.over_on(suite, allowed);
    let softer = |suite: &JudgedOn| {
        seen.range(..i).any(|(_, rung)| share(rung, *suite).is_some_and(|x| x < LITTLE))
    };
    let mut order: Vec<JudgedOn> =
        JudgedOn::ALL.into_iter().filter(|suite| !softer(suite)).collect();
    if let Some(nearest) = seen.iter().min_by_key(|(j, _)| (*j - i).abs()).map(|(_, rung)| rung) {
        let least = |suite: &JudgedOn| share(nearest, *suite).unwrap_or(0.0);
        order.sort_by(|a, b| least(b).total_cmp(&least(a)));
    }
    order
}

/// The Omega_n/p at which a search for this error begins.
pub fn begin(asked: Asked) -> f64 {
    BEGIN / asked.error
}

/// The stiffest Omega_n/p of the ladder up to this one.
pub(crate) fn last_rung(stiffest: f64) -> f64 {
    stiffness(rung_up_to(stiffest))
}

fn rung_from(softest: f64) -> i64 {
    (rung(softest) - ROUNDING).ceil() as i64
}

fn rung_up_to(stiffest: f64) -> i64 {
    (rung(stiffest) + ROUNDING).floor() as i64
}

/// Omega_n/p of a rung, and the rung of an Omega_n/p.
fn stiffness(i: i64) -> f64 {
    10f64.powf(i as f64 / DECADE)
}

fn rung(stiffness: f64) -> f64 {
    DECADE * stiffness.log10()
}
