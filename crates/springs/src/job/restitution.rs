//! Springs for another restitution than equation 2's: those that the structure has without it, or
//! others that bounce for it, whichever follow Housner's body of this restitution more closely.
//!
//! ```text
//!  chosen   the least of  E = sqrt( histories x peaks )
//!           each the geometric mean of the error on the record and of the median of synthetic motions
//! ```
//!
//! Springs that bounce can have the better history and the worse forces, so neither decides alone.

use serde::{Deserialize, Serialize};

use super::{
    JobError,
    landing_design::{LandingDesign, typical},
};
use crate::{SearchProgress, stiffness_search::Tuned, suite::Suites};
use cases::{Case, Yardstick};

/// Errors of springs against Housner's body of the restitution asked for: medians over synthetic
/// motions, with the record where it can be foretold (`E` above); none where nothing was measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestitutionErrors {
    /// NRMSE of u.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub histories: Option<f64>,
    /// Largest error of displacement, uplift and forces between landings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peaks: Option<f64>,
}

/// Which springs were chosen for another restitution than equation 2's, and what both err.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestitutionChoice {
    /// Whether equation 2's were chosen.
    pub equation_2: bool,
    /// What equation 2's err.
    pub of_equation_2: RestitutionErrors,
    /// What springs that bounce for the restitution err.
    pub of_bouncing: RestitutionErrors,
}

impl RestitutionErrors {
    fn of(tuned: &Tuned) -> Self {
        let by = |yardstick| Some(typical(tuned, yardstick)).filter(|error| error.is_finite());
        Self { histories: by(Yardstick::Histories), peaks: by(Yardstick::Peaks) }
    }

    /// E; infinite where either was not measured.
    fn both(&self) -> f64 {
        self.histories.zip(self.peaks).map_or(f64::INFINITY, |(u, peaks)| (u * peaks).sqrt())
    }
}

impl RestitutionChoice {
    /// Equation 2's where nothing tells them apart: their landings do not bounce.
    fn between(equation_2: &Tuned, bouncing: &Tuned) -> Self {
        let [of_equation_2, of_bouncing] = [equation_2, bouncing].map(RestitutionErrors::of);
        let equation_2 = of_equation_2.both() <= of_bouncing.both();
        Self { equation_2, of_equation_2, of_bouncing }
    }
}

impl LandingDesign<'_> {
    /// Springs of a restitution that is not equation 2's, whether a cap decided, and what was
    /// chosen between; no choice if the search was cut before there was one.
    pub(super) fn with_restitution(
        &self,
        progress: SearchProgress,
    ) -> Result<(Tuned, bool, Option<RestitutionChoice>), JobError> {
        let equation_2 = self.as_of_equation_2(progress);
        if let (Ok((tuned, capped)), true) = (&equation_2, self.effort.stops()) {
            return Ok((tuned.clone(), *capped, None));
        }
        match (equation_2, self.bouncing(progress)) {
            (Ok((own, own_capped)), Ok((other, capped))) => {
                let choice = RestitutionChoice::between(&own, &other);
                let (tuned, capped) =
                    if choice.equation_2 { (own, own_capped) } else { (other, capped) };
                Ok((tuned, capped, Some(choice)))
            }
            (Ok((tuned, capped)), Err(_)) | (Err(_), Ok((tuned, capped))) => {
                Ok((tuned, capped, None))
            }
            (Err(error), Err(_)) => Err(error),
        }
    }

    /// The springs that the case has with equation 2's restitution, judged on the restitution asked
    /// for; whether a cap decided.
    fn as_of_equation_2(&self, progress: SearchProgress) -> Result<(Tuned, bool), JobError> {
        let restitution = self.body.restitution();
        let case = Case { restitution, ..self.case.clone() };
        let record = case.record.truncated(case.duration_s);
        let suites = Suites::within(&self.body, restitution, Some(&record), self.effort);
        let (found, capped, _) =
            LandingDesign { case: &case, suites: &suites, ..*self }.tune(progress)?;
        Ok((self.evaluated(found.best.springs), capped))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        job::Job,
        stiffness_search::Rung,
        suite::{MeasuredErrors, Statistic, Suites},
    };
    use dynamics::{
        effort::Effort,
        fem::Control,
        spring::{Design, Springs},
    };
    use rocking::structure::Structure;

    /// Springs that err so: histories and peaks on synthetic motions, and on the record.
    fn erring([nrmse, peaks]: [f64; 2], record: Option<[f64; 2]>) -> Tuned {
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design };
        let median = |value| Some(Statistic { value, count: 24 });
        let mut errors = MeasuredErrors::default();
        errors.histories.synthetic_median = median(nrmse);
        errors.peaks.largest.synthetic_median = median(peaks);
        errors.histories.record = record.map(|of| of[0]);
        errors.peaks.largest.record = record.map(|of| of[1]);
        let best = Rung { stiffness: 1e4, springs, errors };
        Tuned { rungs: vec![best], best, reached: false }
    }

    #[test]
    fn histories_and_peaks_decide_together() {
        let of = |own: &Tuned, other: &Tuned| RestitutionChoice::between(own, other).equation_2;
        // half the error of histories at 50 times that of peaks
        assert!(of(&erring([0.3, 0.01], None), &erring([0.15, 0.5], None)));
        assert!(!of(&erring([0.76, 0.036], None), &erring([0.058, 0.02], None)));
        // the record counts as much as the synthetic motions
        let own = erring([0.1, 0.1], Some([0.4, 0.4]));
        assert!(!of(&own, &erring([0.19, 0.19], Some([0.19, 0.19]))));
        assert!(of(&own, &erring([0.21, 0.21], Some([0.21, 0.21]))));
        // what is not measured, or lost, is not the better one
        let lost = erring([f64::INFINITY, 1.0], None);
        assert!(of(&erring([0.3, 0.1], None), &lost) && !of(&lost, &erring([0.3, 0.1], None)));
        assert!(of(&lost, &lost));
        let choice = RestitutionChoice::between(&lost, &lost);
        let none = RestitutionErrors { histories: None, peaks: Some(1.0) };
        assert_eq!((choice.of_equation_2, choice.of_bouncing), (none, none));
    }

    /// 0.2 % from equation 2's the springs are those of equation 2, and on motions that chose
    /// nothing their peaks err by less than 2 %.
    #[test]
    fn a_restitution_beside_equation_2s_keeps_its_springs() {
        let structure = Structure::block(2.0, 0.5, 1e3).unwrap();
        let restitution = structure.body::<f64>().restitution();
        let springs = |restitution: f64| {
            let mut case = Case { structure, restitution, ..Case::paper().unwrap() };
            case.record = case.record.truncated(5.0);
            case.duration_s = case.record.duration();
            Job::new(&case, &|_, _, _| {}).unwrap()
        };
        let (own, near) = (springs(restitution), springs(1.002 * restitution));
        assert!(own.restitution_choice.is_none());
        assert!(near.restitution_choice.unwrap().equation_2, "{:?}", near.restitution_choice);
        assert_eq!(near.springs, own.springs);
        // and those of programs with steps of one size
        let of_steps = [&near, &own].map(|job| job.program.as_ref().unwrap());
        let [beside, equal] = of_steps.map(|of| of.springs.body.restitution());
        assert_eq!(beside, equal);
        // whose histories are those of the restitution asked for: their errors differ
        assert_ne!(of_steps[0].synthetic, of_steps[1].synthetic);
        let others = Suites::of_seed(7, &near.body, 1.002 * restitution, None);
        let chains = near.springs.chains(near.body.mass);
        let found = others.accuracy(&chains, (Control::default(), &Effort::unbounded()));
        let median = found.peaks.largest.synthetic_median.unwrap().value;
        assert!(median < 0.02, "{median}");
    }
}
