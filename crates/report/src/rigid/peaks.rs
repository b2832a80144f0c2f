//! Largest displacements of a rigid body, as an engineer quotes them.

use dynamics::{compare::Match, fem::History};
use parameters::answers::ModelComparison;
use results::{PeakPair, Peaks};
use rocking::{
    motion::samples_until,
    structure::{Body, Kind},
};

/// Largest displacements of both models, up to an overturning; `dt` is that of the record (s).
pub(super) fn peaks(kind: Kind, body: &Body<f64>, dt: f64, both: &ModelComparison) -> PeakPair {
    peaks_to(None, kind, body, dt, both)
}

/// The same up to `until` (s), if it is given; impacts are those of all of it.
pub(super) fn peaks_to(
    until: Option<f64>,
    kind: Kind,
    body: &Body<f64>,
    dt: f64,
    both: &ModelComparison,
) -> PeakPair {
    let firm = |firm: Option<usize>, all: usize| firm.unwrap_or(all);
    let of = |matched: &Match, theta: &[f64], u: Option<&[f64]>, impacts: usize| {
        let fell = [matched.overturned_housner_s, matched.overturned_fem_s]
            .into_iter()
            .flatten()
            .reduce(f64::min);
        let n = samples_until(fell, dt).min(samples_until(until, dt)).min(theta.len());
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
        springs_end_s: None,
        with_members: both.with.as_ref().map(|with| springs(&with.matched, &with.history)),
        with_members_end_s: both.with.as_ref().and_then(|with| with.history.outcome.ends_early()),
        foretold: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::{Design, Springs};
    use parameters::answers::both;
    use rocking::{members::Members, structure::Structure};
    use strong_motion::Record;

    /// The paper's frame is moved most by El Centro after 10 s, and by less in the first 5 s.
    #[test]
    fn peaks_up_to_a_time_are_those_of_that_part() {
        let structure = Structure::paper();
        let body = structure.body::<f64>();
        let record = Record::el_centro();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
        let both = both(&body, body.restitution(), &springs, &Members::default(), &record);
        let all = peaks(structure.kind, &body, record.dt, &both);
        let part = peaks_to(Some(5.0), structure.kind, &body, record.dt, &both);
        let samples = samples_until(Some(5.0), record.dt);
        let by_hand = rocking::motion::largest_magnitude(&both.housner.u[..samples]);
        assert!((part.reference.top_displacement_m / by_hand - 1.0).abs() < 1e-12);
        assert!(part.reference.times.unwrap().top_displacement_s <= 5.0);
        assert!(part.reference.top_displacement_m < all.reference.top_displacement_m);
        let told = all.foretold(5.0, &part).foretold.unwrap();
        let tops = [part.reference, part.springs].map(|peaks| peaks.top_displacement_m);
        assert_eq!((told.until_s, told.top_displacement_m), (5.0, tops));
    }
}
