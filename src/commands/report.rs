//! What a reader must know before trusting a comparison: how sensitive Housner's history is, and whether rocking holds.

use clap::Args;

use super::CommandError;
use crate::{
    conditioning::{Changes, Conditioning},
    housner::{self, Rocking},
    message::percent,
    record::Record,
    regime::{self, Regime},
    structure::Body,
};

/// What the ground offers.
#[derive(Clone, Copy, Debug, Args)]
pub struct GroundOptions {
    /// Friction coefficient between foot and ground, for the warning of sliding [default: 0.5]
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    pub friction: Option<f64>,
}

/// Friction coefficient unless one is given.
const USUAL: f64 = 0.5;

impl GroundOptions {
    /// The friction coefficient, checked.
    pub fn friction(&self) -> Result<f64, CommandError> {
        let friction = self.friction.unwrap_or(USUAL);
        if friction.is_finite() && friction >= 0.0 {
            return Ok(friction);
        }
        let remedy = "give a friction coefficient, zero or greater";
        Err(CommandError::Option { option: "friction", value: format!("{friction:?}"), remedy })
    }
}

/// Conditioning and regime of Housner's history.
#[derive(Clone, Copy, Debug)]
pub struct HousnerReport {
    pub conditioning: Conditioning,
    pub regime: Regime,
    /// Whether the record lifts Housner's body: else there is no history to be sensitive.
    pub lifted: bool,
    /// When Housner's body overturned [s].
    pub overturned_s: Option<f64>,
    /// When his pivot left the ground, which ends his solution [s].
    pub left_ground_s: Option<f64>,
}

impl HousnerReport {
    /// Of a history that `rocking` holds.
    pub fn new(body: &Body<f64>, restitution: f64, record: &Record, rocking: &Rocking<f64>, friction: f64) -> Self {
        let vertical = record.vertical_accel();
        let options = housner::RockingOptions { restitution: Some(restitution), vertical, ..Default::default() };
        Self {
            conditioning: Conditioning::new(body, record.dt, &record.accel, &options),
            regime: regime::check(body, record.dt, (&record.accel, record.up()), 1.0, rocking, friction),
            lifted: rocking.outcome != housner::RockingOutcome::NeverMoved,
            overturned_s: rocking.overturned(),
            left_ground_s: rocking.left_ground(),
        }
    }

    /// One line each.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = if self.lifted { self.conditioning_lines() } else { Vec::new() };
        if let Some(time) = self.overturned_s {
            lines.push(format!("regime: Housner's body overturns at t = {time:.3} s; what follows counts up to then"));
        }
        if let Some(time) = self.left_ground_s {
            lines.push(format!(
                "regime: WARNING: the pivot of Housner's body leaves the ground at t = {time:.3} s, where his solution ends; what \
                 follows counts up to then"
            ));
        }
        let warnings = self.regime.warnings();
        if warnings.is_empty() {
            let need = self.regime.friction_needed;
            let landing = if self.lifted {
                format!(" and {:.3} in a landing", self.regime.landing_friction)
            } else {
                String::new()
            };
            lines.push(format!(
                "regime: {}; friction coefficient needed {:.3} at t = {:.3} s{landing}, {:.3} available",
                match (self.lifted, self.left_ground_s) {
                    (true, Some(_)) => "until then pure rocking holds",
                    (true, None) => "pure rocking holds",
                    (false, _) => "the body stands",
                },
                need.value,
                need.time,
                self.regime.friction
            ));
        }
        lines.extend(warnings.into_iter().map(|warning| format!("regime: WARNING: {warning}")));
        lines
    }

    fn conditioning_lines(&self) -> Vec<String> {
        let s = &self.conditioning.sensitivity;
        let mut lines = vec![format!(
            "conditioning: a change of 1 % in width changes Housner's history by {}, in scale by {}",
            percent(0.01 * s.width),
            percent(0.01 * s.scale)
        )];
        lines.push(finite(&self.conditioning.changes));
        if !self.conditioning.well_conditioned() {
            lines.push(
                "conditioning: beyond what can be compared one to one, with any springs: a motion counts as well conditioned that \
                 changes by less than ten times a change of width or scale, by less than 0.1 from 0.1 % of the restitution, and \
                 not in its overturning"
                    .to_string(),
            );
        }
        lines
    }
}

/// What finite changes do to the history.
fn finite(c: &Changes) -> String {
    let pair = |[small, large]: [f64; 2]| format!("{small:.4} / {large:.4}");
    format!(
        "conditioning: changes of 0.1 / 1 % move it by {} (NRMSE of u) in width, {} in scale, {} in restitution; {}",
        pair(c.width),
        pair(c.scale),
        pair(c.restitution),
        if c.overturning { "some of them decide on OVERTURNING" } else { "none of them decides on overturning" }
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conditioning::Sensitivity;
    use crate::structure::Structure;

    fn report(accel: Vec<f64>, friction: f64) -> HousnerReport {
        let body = Structure::paper().body::<f64>();
        let record = Record::new("made-up", 0.01, accel).unwrap();
        let rocking = housner::solve(&body, record.dt, &record.accel, &housner::RockingOptions::default());
        HousnerReport::new(&body, body.restitution(), &record, &rocking, friction)
    }

    #[test]
    fn el_centro_is_reported_as_well_conditioned_and_in_the_regime_of_rocking() {
        let lines = report(Record::el_centro().truncated(20.0).accel, 0.5).lines();
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert!(lines[0].starts_with("conditioning: a change of 1 % in width changes Housner's history by "));
        assert!(lines[1].starts_with("conditioning: changes of 0.1 / 1 % move it by 0.0022 / 0.02"), "{lines:?}");
        assert!(lines[1].ends_with("none of them decides on overturning"), "{lines:?}");
        assert!(lines[2].starts_with("regime: pure rocking holds"), "{lines:?}");
    }

    #[test]
    fn a_history_that_hangs_on_the_least_change_is_said_to_mean_nothing_one_to_one() {
        let mut report = report(vec![0.0; 100], 0.5);
        report.lifted = true;
        report.conditioning.sensitivity = Sensitivity { width: 3.0, scale: 250.0 };
        let lines = report.lines();
        assert_eq!(
            lines[0],
            "conditioning: a change of 1 % in width changes Housner's history by 3.00 %, in scale by 250 %"
        );
        assert!(lines[2].starts_with("conditioning: beyond what can be compared one to one"), "{lines:?}");
        report.conditioning.sensitivity.scale = 2.0;
        assert!(report.lines()[2].starts_with("regime"));
        report.conditioning.changes.overturning = true;
        assert!(report.lines()[1].ends_with("some of them decide on OVERTURNING"));
        assert!(report.lines()[2].starts_with("conditioning: beyond"));
    }

    #[test]
    fn sliding_is_warned_of_with_its_time_and_number() {
        // at rest under 0.08 g the body does not lift, and needs a friction coefficient of 0.08
        let lines = report(vec![0.0, 0.08 * crate::scalar::GRAVITY, 0.0], 0.05).lines();
        assert!(lines.iter().all(|line| line.starts_with("regime: WARNING: ")), "{lines:?}");
        assert!(lines[0].starts_with("regime: WARNING: sliding"), "{lines:?}");
        assert!(lines[0].contains("0.080 is needed at t = 0.010 s, 0.050 is available"), "{lines:?}");
    }
}
