//! Largest displacements of a rigid body, as an engineer quotes them.

use dynamics::{compare::impacts_above_threshold, fem::History};
use parameters::answers::ModelComparison;
use results::{PeakPair, Peaks};
use rocking::{
    motion::samples_until,
    structure::{Body, Kind},
};

/// Largest displacements of both models, up to the first of their overturnings, and of the body
/// with its members, up to its own; `dt` is that of the record (s).
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
    let of = |fell: Option<f64>, theta: &[f64], u: Option<&[f64]>, impacts: usize| {
        let n = samples_until(fell, dt).min(samples_until(until, dt)).min(theta.len());
        Peaks::of_rigid((kind, body), dt, &theta[..n], u.map(|u| &u[..n]), impacts)
    };
    let ends = both.rocking.left_ground();
    let springs = |firm: usize, fell: Option<f64>, history: &History| {
        // beyond the end of Housner's solution there is no energy threshold to count by
        let impacts = ends.map_or(firm, |_| history.impacts());
        of(fell, &history.motion.theta, Some(&history.motion.u), impacts)
    };
    let m = &both.matched;
    let fell = [m.overturned_housner_s, m.overturned_fem_s].into_iter().flatten().reduce(f64::min);
    let members = both.with.as_ref();
    PeakPair {
        reference: of(
            fell,
            &both.rocking.theta,
            None,
            firm(m.impacts_housner_firm, m.impacts_housner),
        ),
        reference_ends_s: ends,
        springs: springs(firm(m.impacts_fem_firm, m.impacts_fem), fell, &both.fem),
        springs_end_s: None,
        with_members: members.map(|with| {
            let fell = with.matched.overturned_fem_s;
            let firm = impacts_above_threshold(body, &with.history, fell.unwrap_or(f64::INFINITY));
            springs(firm, fell, &with.history)
        }),
        with_members_end_s: members.and_then(|with| with.history.outcome.ends_early()),
        foretold: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::{Design, Springs};
    use parameters::answers::compare_models;
    use rocking::{
        members::{Damper, Members},
        structure::Structure,
    };
    use strong_motion::Record;

    /// On a motion that topples Housner's body, a body that a damper keeps standing is moved most
    /// after that.
    #[test]
    fn members_count_beyond_the_overturning_of_the_body_without_them() {
        let structure = Structure::a_frame(9.0, 1.8, 450e3).unwrap();
        let body = structure.body::<f64>();
        // a pulse that topples it, and a stronger one later
        let pulse = |t: f64, from: f64| match (0.0..0.9).contains(&(t - from)) {
            true => (std::f64::consts::TAU * (t - from) / 0.9).sin(),
            false => 0.0,
        };
        let at = |i: usize| 5.0 * pulse(0.01 * i as f64, 0.5) + 6.5 * pulse(0.01 * i as f64, 9.0);
        let record = Record::new("two pulses", 0.01, (0..1500).map(at).collect()).unwrap();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
        let damper = Some(Damper { c: 3e6 });
        let members = Members { damper, ..Members::default() };
        let both = compare_models(&body, body.restitution(), &springs, &members, &record);
        let with = both.with.as_ref().unwrap();
        let toppled = both.matched.overturned_housner_s.unwrap();
        assert!(toppled < 9.0 && with.matched.overturned_fem_s.is_none(), "{toppled}");
        let i = rocking::motion::peak_index(&with.history.motion.u);
        assert!(i as f64 * record.dt > toppled);
        let found = peaks(structure.kind, &body, record.dt, &both).with_members.unwrap();
        let by_hand = rocking::motion::peak(&with.history.motion.u);
        assert!((found.top_displacement_m / by_hand - 1.0).abs() < 1e-12);
    }

    /// The paper's frame is moved most by El Centro after 10 s, and by less in the first 5 s.
    #[test]
    fn peaks_up_to_a_time_are_those_of_that_part() {
        let structure = Structure::paper();
        let body = structure.body::<f64>();
        let record = Record::el_centro();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
        let both =
            compare_models(&body, body.restitution(), &springs, &Members::default(), &record);
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
