//! What a run says of its springs, all of it measured in that run: for the file and in plain lines.

use serde::{Deserialize, Serialize};

use super::{
    job::Job,
    landing::{corners::CornerDynamics, design::Geometry, plane::land, weight},
    omega,
    suite::{Accuracy, JudgedOn, LOOSER, MeasuredErrors, PeakAccuracy},
    whole_model::is_another,
};
use crate::{
    case::{Asked, Objective, Tuning, Yardstick},
    compare::LEAST_LEAN,
    motion::{percent, shown},
    validate::PREDICTABLE,
};

/// The landing of the springs in the stiff limit, where they follow from the geometry.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitRow {
    /// Slenderness (rad), m R^2/I0 and Omega_n/p: all that the design depends on, rounded to nine digits.
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured_peaks: Option<PeakAccuracy>,
    /// The landing in the stiff limit, where the springs follow from the geometry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub landing: Option<LimitRow>,
}

impl Assessment {
    /// Of a job's springs, tuned so for a body with this restitution.
    pub(crate) fn new(job: &Job, tuning: &Tuning, restitution: f64) -> Self {
        let (objective, asked) = (tuning.objective, tuning.asked());
        let errors = job.tuned.best.errors;
        let by_landing = objective == Objective::Landing && !job.capped && !is_another(&job.body, restitution);
        let landing = by_landing.then(|| limit(job)).flatten();
        let MeasuredErrors { histories, peaks } = errors;
        Self {
            objective,
            judged_by: asked.by,
            accuracy: asked.error,
            reached: errors.reaches(asked),
            capped: job.capped,
            measured: histories,
            measured_peaks: Some(peaks),
            landing,
        }
    }

    /// What was asked for.
    pub fn asked(&self) -> Asked {
        Asked { by: self.judged_by, error: self.accuracy }
    }

    /// What was measured by the yardstick of what was asked for.
    pub fn judged(&self) -> &Accuracy {
        match (self.judged_by, &self.measured_peaks) {
            (Yardstick::Peaks, Some(peaks)) => &peaks.largest,
            _ => &self.measured,
        }
    }

    /// That the accuracy was not reached, and what to do: to be said before anything else.
    pub fn warning(&self) -> Option<String> {
        let remedy =
            if self.capped { "raise or drop --max-hz" } else { "ask for less, or judge them by tune validate" };
        let accuracy = self.asked_in_words();
        (!self.reached).then(|| {
            format!("WARNING: the {accuracy} was not reached; these are the best springs found within what was allowed: {remedy}")
        })
    }

    /// What to file: the accuracy measured, on what, with counts and what is allowed; which springs.
    pub fn lines(&self) -> Vec<String> {
        let measured = match self.measured_on() {
            on if on.is_empty() => {
                "nothing to measure it on: no motion rocks this body and can be foretold".to_string()
            }
            on => on.join("; "),
        };
        let mut lines = vec![format!(
            "accuracy: {} was asked for and {}; {}error measured (NRMSE of the displacement against Housner's): {measured}",
            match self.judged_by {
                Yardstick::Histories => self.accuracy.to_string(),
                Yardstick::Peaks => format!("an error of peaks of {}", percent(self.accuracy)),
            },
            if self.reached { "reached" } else { "NOT reached" },
            self.peaks_in_words(),
        )];
        if let Some(l) = &self.landing {
            lines.push(format!(
                "springs: by the landing of a body of alpha {:.5} and m R^2/I0 {:.5} at Omega_n/p {:.0}: error of the momentum {:.0e}, \
                 rebound {:.3} of the landing speed, {} touches and lifts of the landing foot",
                l.alpha, l.mass_share, l.omega_n_over_p, l.momentum_error, l.rebound, l.contact_changes[0]
            ));
            lines.push(format!("Omega_n: {}", self.decided_by(l)));
        }
        lines
    }

    fn asked_in_words(&self) -> String {
        match self.judged_by {
            Yardstick::Histories => format!("accuracy of {}", self.accuracy),
            Yardstick::Peaks => format!("accuracy of peaks of {}", percent(self.accuracy)),
        }
    }

    /// The errors of peaks, with what is allowed if they were asked for.
    fn peaks_in_words(&self) -> String {
        let Some(PeakAccuracy { largest: m, .. }) = &self.measured_peaks else { return String::new() };
        let allowed = |looser: f64| match self.judged_by {
            Yardstick::Peaks => format!(" (allowed {})", percent(looser * self.accuracy)),
            Yardstick::Histories => String::new(),
        };
        let record = m.record.map(|e| format!("{} on the record{}", percent(e), allowed(1.0)));
        let quantile = |e: f64, of: &str, looser| format!("{} {of}{}", percent(e), allowed(looser));
        let median = m.synthetic_median.map(|e| quantile(e.value, "in the median of synthetic motions", 1.0));
        let several = m.synthetic_p90.filter(|e| e.count > 1);
        let p90 = several.map(|e| quantile(e.value, "for 90 % of them", LOOSER));
        let looser = m.looser_on_earthquakes();
        let mean = m.earthquakes_mean.map(|e| quantile(e.value, "in the mean of earthquake-like ones", looser));
        match [record, median, p90, mean].into_iter().flatten().collect::<Vec<_>>() {
            all if all.is_empty() => String::new(),
            all => format!("error of peaks (displacement, uplift, forces between landings): {}; ", all.join(", ")),
        }
    }

    /// What springs a rung softer would not hold: that of which the springs taken use most.
    fn decided_by(&self, l: &LimitRow) -> String {
        let aimed = omega::MARGIN * self.accuracy;
        let error = weight::restitution_error(l.alpha, l.mass_share, l.omega_n_over_p, LEAST_LEAN);
        let landings = format!(
            "on which the weight leaves landings, from {LEAST_LEAN} alpha on, an error of {error:.0e} at most (theory): it moves a history of \
             sensitivity {PREDICTABLE} by no more than {} of the accuracy",
            omega::MARGIN
        );
        let on = |suite, name: &str| {
            let share = self.judged().over_on(suite, aimed).unwrap_or(0.0);
            (share, format!("whose error on {name} is within {} of what is allowed", omega::MARGIN))
        };
        let all = [
            (error * PREDICTABLE / aimed, landings),
            on(JudgedOn::Record, "the record"),
            on(JudgedOn::Synthetic, "synthetic motions"),
            on(JudgedOn::Earthquakes, "earthquake-like motions, with three standard errors,"),
        ];
        match all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((share, decides)) if share <= 1.0 => format!("the softest of the ladder {decides}"),
            _ => format!(
                "the best of those tried: none keeps every error, of gentle landings too, within {} of what is allowed",
                omega::MARGIN
            ),
        }
    }

    /// Each error with the motions that it was measured on, and how much is allowed there. There are no statistics of one motion.
    fn measured_on(&self) -> Vec<String> {
        let m = &self.measured;
        let allowed = |looser: f64| match self.judged_by {
            Yardstick::Histories => format!(" (allowed {})", shown(looser * self.accuracy)),
            Yardstick::Peaks => String::new(),
        };
        let on_earthquakes = allowed(m.looser_on_earthquakes());
        let (allowed, looser) = (allowed(1.0), allowed(LOOSER));
        let record = m.record.map(|e| format!("{} on the record, u or v{allowed}", shown(e)));
        let synthetic = m.synthetic_median.zip(m.synthetic_p90).map(|(median, p90)| match median.count {
            1 => {
                format!("{} on the one synthetic motion that can be foretold{allowed}", shown(median.value))
            }
            n => format!(
                "{} in the median of {n} synthetic motions{allowed}, {} for 90 % of them{looser}",
                shown(median.value),
                shown(p90.value)
            ),
        });
        let earthquakes = m.earthquakes_mean.map(|e| match (e.count, m.earthquakes_upper) {
            (1, _) => {
                format!("{} on the one earthquake-like motion of sensitivity below {PREDICTABLE}", shown(e.value))
            }
            (n, upper) => format!(
                "{} in the geometric mean of {n} earthquake-like motions of sensitivity below {PREDICTABLE}{}{on_earthquakes}{}",
                shown(e.value),
                match m.earthquakes_scaled_down {
                    0 => String::new(),
                    scaled => format!(", {scaled} of them scaled down to what the body stands"),
                },
                upper.map_or(String::new(), |x| format!(", {} with three standard errors", shown(x)))
            ),
        });
        [record, synthetic, earthquakes].into_iter().flatten().collect()
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
            }
            .decided_by(&landing)
        };
        assert!(said(1.3e-3, 1e6).contains("on the record is within"));
        // landings of alpha 0.1 hold from an Omega_n/p of 1.7e5 on
        assert!(said(1e-5, 1.8e5).contains("landings, from 0.02 alpha"));
        assert!(said(1e-5, 1.6e5).starts_with("the best of those tried"));
        assert!(said(1.5e-3, 1e6).starts_with("the best of those tried"));
    }
}
