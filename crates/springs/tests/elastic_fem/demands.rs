//! What rocking buys, and what foot forces are without the spikes of landings.

use approx::assert_relative_eq;
use frames::{
    fem::{ElasticAnalysis, ElasticStart, GroundForces},
    frame::{Base, Cantilever, StraightMember},
};
use rocking::{motion::peak, scalar::GRAVITY};

use crate::common::{MODERATE, el_centro, pier, springs};

/// A pier of four elements with its mass, on 1.5 times El Centro: fixed at its base, and free to
/// rock. The weight can hold down no more than itself times half the width: the base's moment stays
/// near that, where the fixed base bears several times it.
#[test]
fn rocking_caps_the_moment_at_the_base() {
    let mut whole: Cantilever = pier(&MODERATE);
    whole.column = StraightMember { elements: 4, section: whole.column.section };
    (whole.column.section.line_mass, whole.inertia) = (5e3, Some(1e6));
    let layout = whole.layout();
    let (fixed, free) = (layout.fixed().frame().unwrap(), layout.frame().unwrap());
    let accel: Vec<f64> = el_centro(1001).iter().map(|a| 1.5 * a).collect();
    let springs = springs(&free, 5e3, 4.0);
    let held =
        ElasticAnalysis::new(&fixed, &[], ElasticStart::Standing, 0.01, &accel).simulate().unwrap();
    let rocked = ElasticAnalysis::new(&free, &springs, ElasticStart::Standing, 0.01, &accel)
        .simulate()
        .unwrap();
    let [moment, rocking] = [&held, &rocked].map(|h| {
        peak(&h.demands.iter().map(|d| d.bearings[0].moments[0]).collect::<Vec<_>>()).abs()
    });
    let capacity = free.total_mass() * GRAVITY * 2.0;
    assert!(
        rocking < 2.0 * capacity && moment > 2.0 * rocking,
        "{moment:e} {rocking:e} {capacity:e}"
    );
    // moments of two elements are one at their joint, but for its own rotational inertia
    let last = &held.demands[400];
    for pair in last.bearings.windows(2) {
        assert!((pair[0].moments[1] + pair[1].moments[0]).abs() < 0.02 * moment);
    }
    // worst between samples is at least what samples see
    for (worst, at) in rocked.worst.iter().zip(&rocked.demands) {
        assert!(worst.values().zip(at.values()).all(|(w, a)| w.abs() >= a.abs()));
    }
    assert!(
        rocked
            .uplift(&free, 0)
            .iter()
            .chain(&rocked.uplift(&free, 1))
            .fold(0.0_f64, |m, z| m.max(*z))
            > 0.01
    );
    let rotation = rocked.rotation(&free, Base::Footing(0));
    assert!(rotation.iter().any(|th| th.abs() > 2e-3));
}

/// Landings shed spikes of many times the weight within fractions of a millisecond. Filtered at 20
/// Hz, what is left is of the weight's size, and its mean over the history is the mean of the
/// forces.
#[test]
fn filtered_foot_forces_have_no_spikes_and_the_same_mean() {
    let frame = pier(&MODERATE).layout().frame().unwrap();
    let springs = springs(&frame, 5e3, 4.0);
    let still = vec![0.0; 2001];
    let history =
        ElasticAnalysis::new(&frame, &springs, ElasticStart::Leaning(0.06), 0.0025, &still)
            .simulate()
            .unwrap();
    let weight = frame.total_mass() * GRAVITY;
    let corner = &history.forces[0];
    let spike = corner.peak.iter().fold(0.0_f64, |m, f| m.max(f[1]));
    let filtered = corner.filtered(1, 0.0025, 20.0);
    let most = filtered.iter().fold(0.0_f64, |m, f| m.max(*f));
    assert!(spike > 3.0 * most && most < 3.0 * weight, "{spike:e} {most:e} {weight:e}");
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let means: Vec<f64> = corner.mean.iter().map(|f| f[1]).collect();
    assert!((mean(&filtered) - mean(&means)).abs() < 0.01 * weight);
}

/// Corners have their largest forces at different instants of a landing: what all of them press
/// with at one instant is less than the sum of these, and no less than at the sample. Impulses add
/// up.
#[test]
fn the_ground_s_force_is_that_of_one_instant() {
    let frame = pier(&MODERATE).layout().frame().unwrap();
    let springs = springs(&frame, 5e3, 4.0);
    let still = vec![0.0; 501];
    let case = ElasticAnalysis::new(&frame, &springs, ElasticStart::Leaning(0.06), 0.01, &still);
    let history = case.simulate().unwrap();
    let sum = |of: &dyn Fn(&GroundForces) -> f64| history.forces.iter().map(of).sum::<f64>();
    let mut apart = 0;
    for i in 0..history.q.len() {
        let (apiece, at) = (sum(&|corner| corner.peak[i][1]), sum(&|corner| corner.at[i][1]));
        let largest = history.ground.peak[i][1];
        assert!(
            largest <= apiece * (1.0 + 1e-12) && largest >= at * (1.0 - 1e-12),
            "{i}: {at:e} {largest:e} {apiece:e}"
        );
        assert_relative_eq!(history.ground.at[i][1], at, max_relative = 1e-12);
        assert_relative_eq!(
            history.ground.mean[i][1],
            sum(&|corner| corner.mean[i][1]),
            max_relative = 1e-9,
            epsilon = 1.0
        );
        apart += usize::from(largest < 0.9 * apiece);
    }
    assert!(apart > 0);

    // without forces: the same motion, bit for bit
    let bare = ElasticAnalysis { forces: false, ..case }.simulate().unwrap();
    assert!(bare.q == history.q && bare.v == history.v && bare.contacts == history.contacts);
    assert!(bare.forces.is_empty() && bare.worst.is_empty() && bare.ground.at.is_empty());
}
