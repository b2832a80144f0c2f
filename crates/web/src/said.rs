//! The answer for a case: first on springs from the geometry, later from the whole run.

use serde::Serialize;

use crate::series::HistorySeries;
use frames::assembled::Assembled;
use report::{Run, Taken, Unit};
use results::{FiledFinding, Finding, Peaks, Weight};
use rocking::structure::Body;

/// The numbers behind the answer.
#[derive(Serialize)]
pub(crate) struct Working {
    /// b, h (m), m (kg), I_cg (kg m2), R (m).
    half_width_m: f64,
    height_m: f64,
    mass_kg: f64,
    inertia_kgm2: f64,
    radius_m: f64,
    /// (rad)
    alpha: f64,
    /// m R^2/I0.
    mass_share: f64,
    /// (1/s)
    p: f64,
    restitution: f64,
    /// (g)
    uplift_g: f64,
    /// Fixed to the ground (Hz); none of a rigid body.
    #[serde(skip_serializing_if = "Option::is_none")]
    frequency_hz: Option<f64>,
}

impl Working {
    /// Of a rigid body that this ground acceleration lifts (g).
    pub(crate) fn of(body: &Body<f64>, uplift_g: f64) -> Self {
        Self {
            half_width_m: body.half_width,
            height_m: body.height,
            mass_kg: body.mass,
            inertia_kgm2: body.inertia,
            radius_m: body.radius(),
            alpha: body.alpha(),
            mass_share: body.mass_share(),
            p: body.p(),
            restitution: body.restitution(),
            uplift_g,
            frequency_hz: None,
        }
    }

    /// Of an elastic structure: lifted by another acceleration than its rigid body.
    pub(crate) fn of_elastic(assembled: &Assembled) -> Self {
        let body = assembled.structure.body();
        let uplift_g = assembled.uplift_g().unwrap_or(body.half_width / body.height);
        let frequency_hz = Some(assembled.structure.fixed_base_frequency_hz());
        Self { frequency_hz, ..Self::of(&body, uplift_g) }
    }
}

/// Largest displacements (m), up to an overturning.
#[derive(Serialize)]
pub(crate) struct PeaksFound {
    /// Housner's; on rigid ground. None of an elastic structure before the whole run.
    pub reference: Option<Peaks>,
    /// When its solution ends, if that is before the record does (s).
    pub reference_ends_s: Option<f64>,
    pub springs: Peaks,
    pub with_members: Option<Peaks>,
}

/// What a structure does.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Does {
    Overturns,
    Rocks,
    StaysDown,
    Unknown,
}

/// All that is said of a case.
#[derive(Serialize)]
pub(crate) struct Said {
    /// One sentence.
    pub verdict: String,
    pub does: Does,
    /// Largest |theta|/alpha on springs; none if it overturns or stays down.
    pub share_of_overturning: Option<f64>,
    /// Whether small changes decide on that, see [`Run::by_chance`].
    pub by_chance: bool,
    /// By weight, the answer first.
    pub findings: Vec<FiledFinding>,
    pub taken: Taken,
    pub peaks: Option<PeaksFound>,
    pub friction_needed: Option<f64>,
    pub springs: Vec<Unit>,
    /// "each foot", "each corner".
    pub springs_at: &'static str,
    pub working: Working,
    pub history: HistorySeries,
}

impl Said {
    /// Of a run.
    pub(crate) fn of(run: &Run, working: Working, history: HistorySeries) -> Self {
        let answer = run.findings.iter().find(|filed| filed.weight == Weight::Answer);
        let (does, share_of_overturning) =
            answer.map_or((Does::Unknown, None), |filed| does(&filed.finding));
        let peaks = run.peaks.map(|pair| PeaksFound {
            reference: Some(pair.reference),
            reference_ends_s: pair.reference_ends_s,
            springs: pair.springs,
            with_members: pair.with_members,
        });
        Self {
            verdict: run.verdict(),
            does,
            share_of_overturning,
            by_chance: run.by_chance(),
            findings: run.findings.clone(),
            taken: run.taken.clone(),
            peaks,
            friction_needed: run.friction_needed,
            springs: run.springs.clone(),
            springs_at: run.springs_at,
            working,
            history,
        }
    }
}

pub(crate) fn does(finding: &Finding) -> (Does, Option<f64>) {
    match finding {
        Finding::NeverLifts { .. } | Finding::Slides { .. } => (Does::StaysDown, None),
        Finding::Stands { share_of_overturning, .. } => (Does::Rocks, Some(*share_of_overturning)),
        Finding::Overturns { .. } => (Does::Overturns, None),
        _ => (Does::Unknown, None),
    }
}
