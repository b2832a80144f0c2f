//! The paper's procedure: families of the inner fit, and the outer loop over Omega_n on the record.

use std::f64::consts::TAU;

use super::{CEILING_HZ, JobError, evaluate};
use crate::{
    SearchProgress,
    paper_procedure::outer::{self, Benchmark, Bracket, Refinement},
    stiffness_search::{self, Tuned},
    suite::Suites,
};
use cases::Case;
use frequency_response::inner::{Fit, FitError, fit};

/// The paper's procedure on one record.
pub(super) struct Procedure<'a> {
    pub case: &'a Case,
    pub benchmark: &'a Benchmark<'a>,
    pub vertical: Vec<Fit>,
    pub horizontal: Vec<Fit>,
}

/// What a search found, and the Omega_n (Hz) that it went up to.
pub(crate) type SearchUpTo = (outer::OmegaSearch, f64);

impl<'a> Procedure<'a> {
    pub(crate) fn new(case: &'a Case, benchmark: &'a Benchmark<'a>) -> Result<Self, JobError> {
        let fits = |mus: &[f64]| -> Result<Vec<Fit>, FitError> {
            let found = parallel::map(mus, |&mu| fit(mu, &case.target, &case.bounds));
            found.into_iter().collect()
        };
        let vertical = fits(&case.tuning.mass_ratios_vertical)?;
        let horizontal = fits(&case.tuning.mass_ratios_horizontal)?;
        Ok(Self { case, benchmark, vertical, horizontal })
    }

    /// Springs up to this Omega_n (Hz), whatever they settle.
    pub(crate) fn at(&self, max_hz: f64, progress: SearchProgress) -> Option<outer::OmegaSearch> {
        let samples = self.case.tuning.candidates;
        let sampled = self.sampled(max_hz, (samples, &Refinement::SOUGHT), progress)?;
        sampled.refined(self.benchmark, &Refinement::SOUGHT, progress)
    }

    /// The same to compare with, at the Omega_n (Hz) of stiff springs: sampled at each pair's
    /// stiffest only, and to be refined by `refined_beside`.
    pub(crate) fn sampled_beside(
        &self,
        max_hz: f64,
        progress: SearchProgress,
    ) -> Option<outer::Sampled> {
        self.sampled(max_hz, (0, &Refinement::COMPARED), progress)
    }

    /// The best of these, refined: one history after the other, so that another core is free.
    pub(crate) fn refined_beside(
        &self,
        sampled: outer::Sampled,
        progress: SearchProgress,
    ) -> Option<outer::OmegaSearch> {
        sampled.refined(self.benchmark, &Refinement::COMPARED, progress)
    }

    fn sampled(
        &self,
        max_hz: f64,
        (samples, refinement): (usize, &Refinement),
        progress: SearchProgress,
    ) -> Option<outer::Sampled> {
        let bracket = Bracket { max_hz, max_settlement: self.case.tuning.max_settlement_m };
        let least = self.least_settlement(&bracket);
        let bracket = Bracket { max_settlement: bracket.max_settlement.max(least), ..bracket };
        let pairs = outer::pairs(&self.vertical, &self.horizontal, bracket);
        outer::Sampled::of(self.benchmark, &pairs, samples, refinement, progress)
    }

    fn least_settlement(&self, bracket: &Bracket) -> f64 {
        self.vertical
            .iter()
            .map(|fit| bracket.least_settlement(fit.k))
            .fold(f64::INFINITY, f64::min)
    }

    /// Within the case's cap as the paper has it; without one, Omega_n by the accuracy asked for.
    pub(crate) fn tune(
        &self,
        suites: &Suites,
        progress: SearchProgress,
    ) -> Result<(Tuned, bool, Option<SearchUpTo>), JobError> {
        let (tuning, body, effort) =
            (&self.case.tuning, &self.benchmark.body, self.benchmark.effort);
        let asked = tuning.asked();
        if let Some(max_hz) = tuning.max_omega_hz {
            let bracket = Bracket { max_hz, max_settlement: tuning.max_settlement_m };
            let least_m = self.least_settlement(&bracket);
            if least_m > bracket.max_settlement {
                return Err(JobError::Settlement {
                    asked_m: bracket.max_settlement,
                    max_hz,
                    least_m,
                });
            }
            let found = self.at(max_hz, progress).ok_or(JobError::NoCandidate)?;
            return Ok((
                evaluate(suites, body, asked, found.best.springs, effort),
                true,
                Some((found, max_hz)),
            ));
        }
        let p = body.p();
        let begin = stiffness_search::begin(asked) * p / TAU;
        let found = self.at(begin, progress).ok_or(JobError::NoCandidate)?;
        let springs = |stiffness: f64| {
            let bracket = Bracket { max_hz: stiffness * p / TAU, max_settlement: f64::INFINITY };
            let families = [self.vertical.as_slice(), self.horizontal.as_slice()];
            let (found, to) = ((&found, begin), &Refinement::FOLLOWING);
            let near = outer::follow(self.benchmark, families, &[bracket], found, to);
            near.into_iter().flatten().next().map(|candidate| candidate.springs)
        };
        let said = |rungs: usize, over: f64| {
            progress(rungs, 0, over * stiffness_search::MARGIN * asked.error)
        };
        let tuned = stiffness_search::tune(
            suites,
            body.mass,
            asked,
            ((stiffness_search::SOFTEST, TAU * CEILING_HZ / p), effort),
            &springs,
            &said,
        );
        Ok((tuned.ok_or(JobError::NoCandidate)?, false, Some((found, begin))))
    }
}
