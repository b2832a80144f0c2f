//! Largest displacements of a rigid body, as an engineer quotes them.

use dynamics::{compare::Match, fem::History};
use rocking::{
    overturning::samples_until,
    structure::{Body, Kind},
};
use springs::{
    answers::ModelComparison,
    results::{PeakPair, Peaks},
};

/// Largest displacements of both models, up to an overturning; `dt` is that of the record (s).
pub(super) fn peaks(kind: Kind, body: &Body<f64>, dt: f64, both: &ModelComparison) -> PeakPair {
    let firm = |firm: Option<usize>, all: usize| firm.unwrap_or(all);
    let of = |matched: &Match, theta: &[f64], u: Option<&[f64]>, impacts: usize| {
        let fell = [matched.overturned_housner_s, matched.overturned_fem_s]
            .into_iter()
            .flatten()
            .reduce(f64::min);
        let n = samples_until(fell, dt).min(theta.len());
        Peaks::of_rigid((kind, body), dt, &theta[..n], u.map(|u| &u[..n]), impacts)
    };
    let ends = both.rocking.left_ground();
    let springs = |m: &Match, history: &History| {
        // beyond the end of Housner's solution there is no energy threshold to count by
        let impacts =
            ends.map_or_else(|| firm(m.impacts_fem_firm, m.impacts_fem), |_| history.impacts());
        of(m, &history.motion.theta, Some(&history.motion.u), impacts)
    };
    let m = &both.matched;
    PeakPair {
        reference: of(
            m,
            &both.rocking.theta,
            None,
            firm(m.impacts_housner_firm, m.impacts_housner),
        ),
        reference_ends_s: ends,
        springs: springs(m, &both.fem),
        with_members: both.with.as_ref().map(|with| springs(&with.matched, &with.history)),
    }
}
