//! The design from the geometry: its shape by what lands, Omega_n by the accuracy asked for or by
//! a cap.

use std::{cmp::Ordering, f64::consts::TAU};

use super::{CEILING_HZ, JobError, Procedure, RestitutionChoice, evaluate};
use crate::{
    ALIKE, SearchProgress, at_once, capped_springs,
    ladder::RungProgress,
    landing_simulation::differs_from_housner,
    paper_procedure::outer::Bracket,
    stiffness_search::{self, DesignOf, Tuned},
    suite::Suites,
};
use cases::{Case, Yardstick};
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Design, Springs},
};
use landing::design::{Geometry, springs_at_stiffness};
use rocking::structure::Body;

/// Omega_n of springs that are to have another restitution than equation 2's, where no cap is given
/// (Hz): they must bounce, and gravity bring them back.
const BOUNCING_HZ: f64 = 160.0;

/// The design from the geometry, and Omega_n.
pub(super) struct LandingDesign<'a> {
    pub case: &'a Case,
    pub body: Body<f64>,
    pub suites: &'a Suites,
    pub procedure: &'a Procedure<'a>,
    pub effort: &'a Effort,
}

impl LandingDesign<'_> {
    /// The outer loop, whether a cap decided, and which springs were chosen for another restitution
    /// than equation 2's.
    pub(super) fn tune(
        &self,
        progress: SearchProgress,
    ) -> Result<(Tuned, bool, Option<RestitutionChoice>), JobError> {
        match differs_from_housner(&self.body, self.case.restitution) {
            true => self.with_restitution(progress),
            false => self.by_accuracy(progress).map(|(tuned, capped)| (tuned, capped, None)),
        }
    }

    /// The outer loop, and whether a cap decided.
    fn by_accuracy(&self, progress: SearchProgress) -> Result<(Tuned, bool), JobError> {
        let tuning = &self.case.tuning;
        let asked = tuning.asked();
        let p = self.body.p();
        let springs = |stiffness: f64| springs_at_stiffness(&self.body, stiffness);
        let said = |rungs: usize, over: f64| {
            progress(rungs, 0, over * stiffness_search::MARGIN * asked.error)
        };
        let ladder = |stiffest: f64, springs: DesignOf| self.ladder(stiffest, springs, &said);
        let Some(cap) = tuning.max_omega_hz else {
            let stiffest = stiffness_search::last_rung(TAU * CEILING_HZ / p);
            self.settles_at(stiffest)?;
            return ladder(stiffest, &springs)
                .map(|tuned| (tuned, false))
                .ok_or(JobError::NoCandidate);
        };
        // a cap holds for the stiffest of the springs: those beyond it are clipped, or all are as
        // much softer
        let highest = TAU * cap / p;
        let clipped = |stiffness: f64| {
            springs(stiffness).map(|mut springs| {
                springs.horizontal.omega_n_hz = springs.horizontal.omega_n_hz.min(cap);
                springs
            })
        };
        let in_limit = |stiffness| {
            Geometry::of(&self.body, stiffness).is_ok_and(|geometry| geometry.in_stiff_limit())
        };
        let mut found: Vec<Tuned> = ladder(highest, &clipped).into_iter().collect();
        if found.iter().all(|tuned| !tuned.reached) && (found.is_empty() || !self.effort.stops()) {
            let softer = self.within(cap, highest).filter(|stiffness| in_limit(*stiffness));
            found.extend(softer.and_then(|stiffness| ladder(stiffness, &springs)));
        }
        found.retain(|tuned| self.settles(tuned));
        if let Some(tuned) = found.iter().find(|tuned| tuned.reached) {
            return Ok((tuned.clone(), false));
        }
        if found.is_empty() || !in_limit(highest) && !self.effort.stops() {
            found.push(self.followed(cap, progress)?);
        }
        let typical = |tuned: &Tuned| typical(tuned, asked.by);
        let best = found.into_iter().min_by(|a, b| typical(a).total_cmp(&typical(b)));
        Ok((best.ok_or(JobError::NoCandidate)?, true))
    }

    /// Springs that bounce for a restitution that is not equation 2's, within the cap; whether it
    /// was given.
    pub(super) fn bouncing(&self, progress: SearchProgress) -> Result<(Tuned, bool), JobError> {
        let tuning = &self.case.tuning;
        let bracket = self.bracket(tuning.max_omega_hz.unwrap_or(BOUNCING_HZ))?;
        let springs = capped_springs::with_restitution(
            &self.body,
            self.case.restitution,
            bracket,
            self.effort,
            progress,
        );
        let springs = springs.ok_or(JobError::NoCandidate)?;
        Ok((self.evaluated(springs), tuning.max_omega_hz.is_some()))
    }

    /// Springs with their errors on the suites.
    pub(super) fn evaluated(&self, springs: Springs<Design<f64>>) -> Tuned {
        evaluate(self.suites, &self.body, self.case.tuning.asked(), springs, self.effort)
    }

    /// The ladder up to an Omega_n/p, from where landings hold; if none of those rungs does, the
    /// better of that and of the whole ladder. `springs` are those of an Omega_n/p, `said` is told
    /// the rungs judged and how far the least error is over what is asked.
    fn ladder(&self, stiffest: f64, springs: DesignOf, said: RungProgress) -> Option<Tuned> {
        let asked = self.case.tuning.asked();
        let from = |softest: f64| {
            let range = ((softest, stiffest), self.effort);
            stiffness_search::tune(self.suites, self.body.mass, asked, range, springs, said)
        };
        let soft = self.settling(stiffness_search::SOFTEST, stiffest);
        let landings_hold =
            at_once::softest(&self.body, asked, stiffness_search::last_rung(stiffest)).max(soft);
        let tuned = from(landings_hold);
        let done = landings_hold == soft || tuned.as_ref().is_some_and(|tuned| tuned.reached);
        if done || tuned.is_some() && self.effort.stops() {
            return tuned;
        }
        let over = |tuned: &Tuned| (!tuned.reached, tuned.best.errors.over(asked));
        tuned
            .into_iter()
            .chain(from(soft))
            .min_by(|a, b| over(a).partial_cmp(&over(b)).unwrap_or(Ordering::Equal))
    }

    /// The stiffest rung up to `highest` whose horizontal springs are below the cap (Hz), too;
    /// `None` if clipping does nothing, or none is.
    fn within(&self, cap: f64, highest: f64) -> Option<f64> {
        let hz = |stiffness| {
            springs_at_stiffness(&self.body, stiffness).map(|springs| springs.horizontal.omega_n_hz)
        };
        let last = stiffness_search::last_rung(highest);
        let mut stiffness = last;
        while hz(stiffness)? > cap {
            stiffness = stiffness_search::last_rung(0.99 * stiffness);
            if stiffness < stiffness_search::SOFTEST {
                return None;
            }
        }
        (stiffness < last).then_some(stiffness)
    }

    /// The least Omega_n/p from `softest` on at which the body settles by no more than is allowed;
    /// `stiffest` if there is none.
    fn settling(&self, softest: f64, stiffest: f64) -> f64 {
        let mut stiffness = softest;
        while stiffness < stiffest && self.settlement(stiffness) > self.case.tuning.max_settlement_m
        {
            stiffness = (1.1 * stiffness).min(stiffest);
        }
        stiffness
    }

    /// How far the body settles at an Omega_n/p (m).
    fn settlement(&self, stiffness: f64) -> f64 {
        springs_at_stiffness(&self.body, stiffness)
            .map_or(f64::INFINITY, |springs| springs.settlement(self.body.mass))
    }

    /// Whether the stiffest springs settle by no more than is allowed.
    fn settles_at(&self, stiffest: f64) -> Result<(), JobError> {
        let (asked_m, least_m) = (self.case.tuning.max_settlement_m, self.settlement(stiffest));
        if least_m > asked_m {
            Err(JobError::Settlement { asked_m, max_hz: CEILING_HZ, least_m })
        } else {
            Ok(())
        }
    }

    /// The springs within a cap (Hz) that follow best what is judged on, of those followed down
    /// from the stiff limit and those of the paper's procedure: so soft, neither is the better one
    /// for every body.
    fn followed(&self, cap: f64, progress: SearchProgress) -> Result<Tuned, JobError> {
        let mut found = capped_springs::follow(
            &self.body,
            self.case.restitution,
            self.bracket(cap)?,
            self.effort,
        );
        if self.suites.has_whole_record() && (found.is_empty() || !self.effort.stops()) {
            found.extend(self.procedure.at(cap, progress).map(|tuned| tuned.best.springs));
        }
        let asked = self.case.tuning.asked();
        let judged = found.into_iter().map(|springs| self.evaluated(springs));
        let typical = |tuned: &Tuned| typical(tuned, asked.by);
        let mut judged: Vec<Tuned> = judged.filter(|tuned| self.settles(tuned)).collect();
        judged.sort_by(|a, b| typical(a).total_cmp(&typical(b)));
        let best = judged.first().map_or(f64::INFINITY, &typical);
        judged.retain(|tuned| typical(tuned) <= ALIKE * best);
        if judged.len() > 1 && !self.effort.stops() {
            let more = self.suites.more(self.case.restitution, self.effort);
            // no record: what it has to say was counted, and it is one motion
            let median = |tuned: &Tuned| {
                more.error_by(
                    asked.by,
                    &tuned.best.springs.chains(self.body.mass),
                    Control::search(),
                )
            };
            let medians: Vec<f64> =
                judged.iter().map(|tuned| median(tuned).unwrap_or(f64::INFINITY)).collect();
            let least = (0..medians.len()).min_by(|a, b| medians[*a].total_cmp(&medians[*b]));
            judged.swap(0, least.unwrap_or(0));
        }
        judged.into_iter().next().ok_or(JobError::NoCandidate)
    }

    fn settles(&self, tuned: &Tuned) -> bool {
        tuned.best.springs.settlement(self.body.mass)
            <= self.case.tuning.max_settlement_m * (1.0 + 1e-3)
    }

    /// A cap (Hz) and the settlement allowed.
    fn bracket(&self, cap: f64) -> Result<Bracket, JobError> {
        let bracket = Bracket { max_hz: cap, max_settlement: self.case.tuning.max_settlement_m };
        let least_m = bracket.least_settlement(capped_springs::LARGEST_K);
        if least_m > bracket.max_settlement {
            return Err(JobError::Settlement {
                asked_m: bracket.max_settlement,
                max_hz: cap,
                least_m,
            });
        }
        Ok(bracket)
    }
}

/// The typical error of springs: the geometric mean of that on the record and of the median of
/// synthetic motions.
pub(super) fn typical(tuned: &Tuned, yardstick: Yardstick) -> f64 {
    let measured = tuned.best.errors.by(yardstick);
    let median = measured.synthetic_median.map(|median| median.value);
    match (measured.record, median) {
        (Some(record), Some(median)) => (record * median).sqrt(),
        (one, other) => one.or(other).unwrap_or(f64::INFINITY),
    }
}
