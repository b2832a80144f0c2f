//! What a run says of its springs, all of it measured in that run: for the file and in plain lines.

use dynamics::compare::LEAST_LEAN;
use serde::{Deserialize, Serialize};

use super::{
    job::{Job, RestitutionChoice},
    landing_simulation::differs_from_housner,
    stiffness_search,
    suite::{Accuracy, JudgedOn, MeasuredErrors, PeakAccuracy},
};
use cases::{Objective, Tuning, Yardstick};
use landing::{corners::CornerDynamics, design::Geometry, plane::land, weight};
use validation::PREDICTABLE;

/// The landing of the springs in the stiff limit, where they follow from the geometry.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitRow {
    /// Slenderness (rad), m R^2/I0 and Omega_n/p: all that the design depends on, rounded to nine
    /// digits.
    pub alpha: f64,
    pub mass_share: f64,
    pub omega_n_over_p: f64,
    /// Omega_h/Omega_v.
    pub frequency_ratio: f64,
    /// Error of the angular momentum about the new foot.
    pub momentum_error: f64,
    /// Impulse through the old foot [m v_n].
    pub old_impulse: f64,
    /// Fastest speed with which the new foot leaves the ground (v_n).
    pub rebound: f64,
    /// Time with both feet in the air, without gravity to end it, of 30 [1/Omega_n].
    pub air: f64,
    /// Touches and lifts of the new foot and of the old foot.
    pub contact_changes: [usize; 2],
    /// Whether Omega_n v_n/g is so large that landings are those of the stiff limit.
    pub in_stiff_limit: bool,
}

/// The springs' accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// What the springs follow from.
    pub objective: Objective,
    /// What the error that was asked for is one of.
    #[serde(default, skip_serializing_if = "Yardstick::is_histories")]
    pub judged_by: Yardstick,
    /// Error asked for: NRMSE of histories, or of peaks.
    pub accuracy: f64,
    /// Whether what was measured is within it.
    pub reached: bool,
    /// Whether a cap on Omega_n decided.
    pub capped: bool,
    /// What was measured of histories.
    pub measured: Accuracy,
    /// What was measured of peaks; none in older files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_peaks: Option<PeakAccuracy>,
    /// The landing in the stiff limit, where the springs follow from the geometry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub landing: Option<LimitRow>,
    /// Which springs were chosen for another restitution than equation 2's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_choice: Option<RestitutionChoice>,
}

impl Assessment {
    /// Of a job's springs, tuned so for a body with this restitution. Public for the crate that
    /// keeps parameters.
    #[doc(hidden)]
    pub fn new(job: &Job, tuning: &Tuning, restitution: f64) -> Self {
        let (objective, asked) = (tuning.objective, tuning.asked());
        let errors = job.tuned.best.errors;
        let by_landing = objective == Objective::Landing
            && !job.capped
            && !differs_from_housner(&job.body, restitution);
        let landing = by_landing.then(|| limit(job)).flatten();
        let MeasuredErrors { histories, peaks } = errors;
        Self {
            objective,
            judged_by: asked.by,
            accuracy: asked.error,
            // of a search that was cut before anything was measured nothing is known
            reached: errors.reaches(asked) && (job.cut.is_none() || errors.measured(asked.by)),
            capped: job.capped,
            measured: histories,
            measured_peaks: Some(peaks),
            landing,
            restitution_choice: job.restitution_choice,
        }
    }

    /// Error of peaks of springs that miss what was asked for: on the record, or the median over
    /// synthetic motions where it does not judge them.
    pub fn missed_peaks(&self) -> Option<f64> {
        let of = self.measured_peaks.filter(|_| !self.reached)?.largest;
        of.record.or(of.synthetic_median.map(|of| of.value))
    }

    /// What was measured by the yardstick of what was asked for.
    #[doc(hidden)]
    pub fn judged(&self) -> &Accuracy {
        match (self.judged_by, &self.measured_peaks) {
            (Yardstick::Peaks, Some(peaks)) => &peaks.largest,
            _ => &self.measured,
        }
    }

    /// The landing that the springs follow from, and what decided on Omega_n; none of springs that
    /// a search found.
    #[doc(hidden)]
    pub fn design(&self) -> Option<[String; 2]> {
        let l = self.landing.as_ref()?;
        let landing = format!(
            "The springs follow from the landing of a body of alpha {:.5} and m R^2/I0 {:.5} at \
             Omega_n/p {:.0}: error of the \
             momentum {:.0e}, rebound {:.3} of the landing speed, {} touches and lifts of the \
             landing foot.",
            l.alpha,
            l.mass_share,
            l.omega_n_over_p,
            l.momentum_error,
            l.rebound,
            l.contact_changes[0]
        );
        Some([landing, format!("Omega_n is {}.", self.decided_by(l))])
    }

    /// What springs a rung softer would not hold: that of which the springs taken use most.
    fn decided_by(&self, l: &LimitRow) -> String {
        let aimed = stiffness_search::MARGIN * self.accuracy;
        let error = weight::restitution_error(l.alpha, l.mass_share, l.omega_n_over_p, LEAST_LEAN);
        let landings = format!(
            "at which the weight on the old foot causes an error of at most {error:.0e} in \
             landings from {LEAST_LEAN} alpha on (theory): such an error moves a history of \
             sensitivity {PREDICTABLE} by at most {} of the accuracy",
            stiffness_search::MARGIN
        );
        let on = |suite, name: &str| {
            let share = self.judged().over_on(suite, aimed).unwrap_or(0.0);
            (
                share,
                format!(
                    "whose error on {name} is within {} of what is allowed",
                    stiffness_search::MARGIN
                ),
            )
        };
        let all = [
            (error * PREDICTABLE / aimed, landings),
            on(JudgedOn::Record, "the record"),
            on(JudgedOn::Synthetic, "synthetic motions"),
            on(JudgedOn::Earthquakes, "earthquake-like motions, with three standard errors,"),
        ];
        match all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((share, decides)) if share <= 1.0 => {
                format!("the softest rung of the stiffness ladder {decides}")
            }
            _ => format!(
                "the best of those tried: none keeps every error, including that of gentle \
                 landings, within {} of what is allowed",
                stiffness_search::MARGIN
            ),
        }
    }
}

fn limit(job: &Job) -> Option<LimitRow> {
    let springs = &job.springs;
    let geometry = Geometry::of(&job.body, job.tuned.best.stiffness).ok()?;
    let landing = land(&CornerDynamics::rigid(geometry.alpha(), geometry.mass_share()), springs);
    Some(LimitRow {
        alpha: geometry.alpha(),
        mass_share: geometry.mass_share(),
        omega_n_over_p: geometry.stiffness(),
        frequency_ratio: springs.horizontal.omega_n_hz / springs.vertical.omega_n_hz,
        momentum_error: landing.momentum - 1.0,
        old_impulse: landing.old_impulse,
        rebound: landing.rebound,
        air: landing.air,
        contact_changes: landing.changes,
        in_stiff_limit: geometry.in_stiff_limit(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::Statistic;

    #[test]
    fn what_decided_on_omega_n_is_what_is_nearest_to_its_limit() {
        let landing = LimitRow {
            alpha: 0.1,
            mass_share: 1.0,
            omega_n_over_p: 1e6,
            frequency_ratio: 4.0,
            momentum_error: 0.0,
            old_impulse: 0.0,
            rebound: 0.0,
            air: 0.0,
            contact_changes: [1, 1],
            in_stiff_limit: true,
        };
        let said = |record: f64, omega_n_over_p: f64| {
            let measured = Accuracy { record: Some(record), ..Accuracy::default() };
            let landing = LimitRow { omega_n_over_p, ..landing };
            let objective = Objective::Landing;
            Assessment {
                objective,
                judged_by: Yardstick::Histories,
                accuracy: 2e-3,
                reached: true,
                capped: false,
                measured,
                measured_peaks: None,
                landing: Some(landing),
                restitution_choice: None,
            }
            .decided_by(&landing)
        };
        assert!(said(1.3e-3, 1e6).contains("on the record is within"));
        // landings of alpha 0.1 hold from an Omega_n/p of 1.7e5 on
        assert!(said(1e-5, 1.8e5).contains("landings from 0.02 alpha"));
        assert!(said(1e-5, 1.6e5).starts_with("the best of those tried"));
        assert!(said(1.5e-3, 1e6).starts_with("the best of those tried"));
    }

    /// Of springs that are good enough nothing; of others the record's error counts, for it is the
    /// record's forces that they are to check.
    #[test]
    fn peaks_are_missed_by_springs_that_miss_what_was_asked() {
        let median = Statistic { value: 1.08, count: 24 };
        let of = |reached: bool, record: Option<f64>| {
            let largest =
                Accuracy { record, synthetic_median: Some(median), ..Accuracy::default() };
            let peaks = PeakAccuracy {
                largest,
                record: None,
                synthetic_median: None,
                earthquakes_mean: None,
            };
            let assessment = Assessment {
                objective: Objective::Landing,
                judged_by: Yardstick::Histories,
                accuracy: 2e-3,
                reached,
                capped: false,
                measured: Accuracy::default(),
                measured_peaks: Some(peaks),
                landing: None,
                restitution_choice: None,
            };
            assessment.missed_peaks()
        };
        assert_eq!(of(false, None), Some(1.08));
        assert_eq!(of(false, Some(0.03)), Some(0.03));
        assert_eq!(of(true, Some(0.2)), None);
    }
}
