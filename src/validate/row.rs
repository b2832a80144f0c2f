//! One record under both models.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::{Judge, stream::Stream};
use crate::{
    conditioning::{ILL_CONDITIONED, sensitivity},
    fem,
    housner::{self, Rocking},
    record::Record,
};

/// Whether the two models could be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Housner's body rocked, or toppled.
    Rocked,
    /// The record never lifts Housner's body: there is no history to compare with.
    NeverLifted,
    /// Housner's solution met its bound on work or a number that is not finite.
    HousnerFailed,
    /// The finite element history met its bound on work or a number that is not finite.
    FemFailed,
}

/// What is kept of a record. Options are empty (`null` in JSON) where there is no such number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub name: String,
    pub outcome: Outcome,
    /// Length compared: up to the end of the shorter history [s].
    pub duration_s: f64,
    /// Peak ground acceleration, scaled as compared [g].
    pub pga_g: f64,
    /// Relative change of Housner's u per relative change of width or record scale, whichever is worse.
    pub sensitivity: f64,
    /// sqrt( sum (u - u_H)^2 / sum u_H^2 ); none if the record never lifts the body or a model failed.
    pub nrmse_horizontal: Option<f64>,
    /// The same for v, from the settled position.
    pub nrmse_vertical: Option<f64>,
    /// Peak |theta|/alpha at the samples; pi/2 / alpha if it toppled.
    pub peak_ratio_housner: f64,
    /// The same while a foot is off the ground; none if the history failed.
    pub peak_ratio_fem: Option<f64>,
    pub overturned_housner: bool,
    /// None if the history failed.
    pub overturned_fem: Option<bool>,
    /// Impacts of Housner's body.
    pub impacts: usize,
    /// Largest |residual| of the finite element model's energy account over the largest energy of the history.
    pub energy_residual: f64,
}

impl Row {
    /// Whether one of the models failed.
    pub fn failed(&self) -> bool {
        matches!(self.outcome, Outcome::HousnerFailed | Outcome::FemFailed)
    }

    /// Whether Housner's body rocked without toppling and its history is well conditioned: NRMSE means something.
    pub fn comparable(&self) -> bool {
        matches!(self.outcome, Outcome::Rocked | Outcome::FemFailed)
            && !self.overturned_housner
            && self.sensitivity < ILL_CONDITIONED
    }

    /// Whether both models say the same of overturning.
    pub fn agrees(&self) -> bool {
        !self.failed() && self.overturned_fem == Some(self.overturned_housner)
    }
}

impl Judge {
    /// Run both models over a record.
    pub fn judge(&self, record: &Record) -> Row {
        let body = &self.body;
        // the whole record as it is, without a copy
        let short = self.duration_s.map(|duration| record.truncated(duration));
        let record = short.as_ref().unwrap_or(record);
        let (dt, accel) = (record.dt, &record.accel[..]);
        let options = housner::Options { restitution: Some(self.restitution), ..Default::default() };
        let Rocking { theta, impacts, outcome: end, .. } = housner::solve(body, dt, accel, &options);
        let lifted = end != housner::Outcome::NeverMoved;
        let sensitivity = if lifted { sensitivity(body, dt, accel, &options).worst() } else { 0.0 };

        let case = fem::Case {
            body: *body,
            springs: self.springs,
            start: fem::Start::Settled,
            dt,
            accel,
            scale: 1.0,
            control: self.control,
        };
        let mut stream = Stream::new(body, &theta, accel);
        let finish = case.observe(&mut stream);
        let (horizontal, vertical) = (stream.horizontal.value(), stream.vertical.value());
        let overturned_fem = match finish.outcome {
            fem::Outcome::Overturned { .. } | fem::Outcome::Stopped { .. } => Some(true),
            fem::Outcome::Completed => Some(self.topples(stream.last)),
            fem::Outcome::WorkBound { .. } | fem::Outcome::Unstable { .. } => None,
        };
        let finite = !horizontal.is_nan() && !vertical.is_nan() && stream.peak.is_finite();
        let outcome = match end {
            housner::Outcome::WorkBound { .. } | housner::Outcome::NotFinite { .. } => Outcome::HousnerFailed,
            _ if overturned_fem.is_none() || !finite => Outcome::FemFailed,
            housner::Outcome::NeverMoved => Outcome::NeverLifted,
            _ => Outcome::Rocked,
        };
        let overturned_housner = matches!(end, housner::Outcome::Overturned { .. });
        let overturned_fem = overturned_fem.filter(|_| outcome != Outcome::FemFailed);
        let ratio = |peak: f64, overturned| if overturned { FRAC_PI_2 } else { peak } / body.alpha();
        let error = |x: f64| (outcome == Outcome::Rocked && x.is_finite()).then_some(x);
        Row {
            name: record.name.clone(),
            outcome,
            duration_s: theta.len().min(stream.samples).saturating_sub(1) as f64 * dt,
            pga_g: record.pga_g(),
            sensitivity,
            nrmse_horizontal: error(horizontal),
            nrmse_vertical: error(vertical),
            peak_ratio_housner: ratio(theta.iter().fold(0.0, |peak, x| x.abs().max(peak)), overturned_housner),
            peak_ratio_fem: overturned_fem.map(|overturned| ratio(stream.peak, overturned)),
            overturned_housner,
            overturned_fem,
            impacts: impacts.len(),
            energy_residual: (stream.residual / finish.energy_scale).min(f64::MAX),
        }
    }

    /// Whether a body left alone with this theta [rad] and theta' [rad/s] topples by Housner's equation.
    fn topples(&self, (theta, rate): (f64, f64)) -> bool {
        let options = housner::Options { initial: Some((theta, rate)), ..Default::default() };
        let end = housner::solve(&self.body, 1.0, &[0.0], &options).outcome;
        matches!(end, housner::Outcome::Overturned { .. })
    }
}
