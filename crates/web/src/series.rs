//! Histories for drawing.

use serde::Serialize;

use crate::thin::{GroundSeries, Thinning};
use frames::{
    answer::ElasticAnswer,
    assembled::{Assembled, Sway},
    fem::ElasticHistory,
};
use parameters::answers::ModelComparison;
use rocking::{
    motion::Motion,
    structure::{Body, Kind},
};
use strong_motion::Record;

/// A base of the structure, and what stands on it.
#[derive(Serialize)]
pub(crate) struct BaseSeries {
    /// Clockwise (rad).
    rotation: Vec<f32>,
    /// Of its top across the base's axis (m); none of a rigid body.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    drift: Vec<f32>,
}

/// One model's history.
#[derive(Serialize)]
pub(crate) struct ModelSeries {
    bases: Vec<BaseSeries>,
    /// Displacement of the highest point (m).
    top: Vec<f32>,
}

/// Both histories.
#[derive(Serialize)]
pub(crate) struct HistorySeries {
    /// Between the values (s).
    step_s: f64,
    /// Housner's; of an elastic structure on rigid ground, none before the whole run.
    reference: Option<ModelSeries>,
    /// On springs, with members if there are any.
    springs: ModelSeries,
    ground: GroundSeries,
}

impl HistorySeries {
    pub(crate) fn of_rigid(
        kind: Kind,
        body: &Body<f64>,
        both: &ModelComparison,
        record: &Record,
    ) -> Self {
        let fem = both.with.as_ref().map_or(&both.fem, |with| &with.history);
        let thin = Thinning::of(record.len());
        // the top of a block is as far above its centre of mass as that above the ground
        let above = if kind == Kind::Block { body.height } else { 0.0 };
        let of = |motion: &Motion| {
            let top = motion.u.iter().zip(&motion.theta).map(|(u, theta)| u + above * theta.sin());
            let rotation = thin.series(motion.theta.iter().copied());
            ModelSeries {
                bases: vec![BaseSeries { rotation, drift: Vec::new() }],
                top: thin.series(top),
            }
        };
        Self {
            step_s: thin.step(record.dt),
            reference: Some(of(&both.housner)),
            springs: of(&fem.motion),
            ground: Thinning::ground(&record.accel, record.dt),
        }
    }

    /// On springs alone.
    pub(crate) fn on_springs(assembled: &Assembled, fem: &ElasticHistory, record: &Record) -> Self {
        let thin = Thinning::of(record.len());
        let sways = assembled.sways(fem.q.iter().map(Vec::as_slice));
        let springs = model(&sways, tops(assembled, fem.q.iter().map(Vec::as_slice)), thin);
        let ground = Thinning::ground(&record.accel, record.dt);
        Self { step_s: thin.step(record.dt), reference: None, springs, ground }
    }

    pub(crate) fn of_elastic(
        assembled: &Assembled,
        answer: &ElasticAnswer,
        record: &Record,
    ) -> Self {
        let reference = &answer.histories.reference.history.q;
        let thin = Thinning::of(record.len());
        let sways: Vec<Sway> =
            answer.histories.sways.iter().map(|[reference, _]| reference.clone()).collect();
        let reference =
            model(&sways, tops(assembled, reference.iter().map(|q| q.as_slice())), thin);
        Self {
            reference: Some(reference),
            ..Self::on_springs(assembled, &answer.histories.fem, record)
        }
    }
}

fn model(sways: &[Sway], top: impl Iterator<Item = f64>, thin: Thinning) -> ModelSeries {
    let base = |sway: &Sway| BaseSeries {
        rotation: thin.series(sway.rotation.iter().copied()),
        drift: thin.series(sway.drift.iter().copied()),
    };
    ModelSeries { bases: sways.iter().map(base).collect(), top: thin.series(top) }
}

/// Displacement of the first watched top (m).
pub(crate) fn tops<'a>(
    assembled: &'a Assembled,
    all: impl Iterator<Item = &'a [f64]> + 'a,
) -> impl Iterator<Item = f64> + 'a {
    let top = assembled.watched.first().map_or(0, |watched| watched.top);
    all.map(move |q| assembled.frame.displacement(top, q)[0])
}
