//! Energy, momentum and symmetry over whole histories.

use dynamics::fem::HistoryOutcome;
use frames::{
    Mechanics,
    beam::BeamSection,
    fem::{ElasticAnalysis, ElasticHistory, ElasticStart},
    frame::{
        Base, Footing, Frame, FrameLayout, FrameTendon, LeggedFrame, NodePoint, Portal,
        StraightMember,
    },
};
use rocking::{motion::largest_magnitude, scalar::GRAVITY};

use crate::common::{MODERATE, Numbers, el_centro, pier, springs};

fn portal() -> FrameLayout {
    let section = BeamSection { line_mass: 4e3, ..pier(&MODERATE).column.section };
    let footing = Footing::block(3.0, 1e5, 0.6, 1.2);
    let column = StraightMember { section, elements: 2 };
    Portal { span: 8.0, height: 9.0, mass: 3e5, inertia: 1e5, footing, column, girder: column }
        .layout()
}

fn legged() -> FrameLayout {
    let section = pier(&MODERATE).column.section;
    let leg = StraightMember { section, elements: 1 };
    LeggedFrame { mass: 6e5, inertia: 1e6, height: 12.0, width: 4.0, foot_mass: 2e4, leg }.layout()
}

/// Several elements with their own mass, dampers at the corners, and a tendon.
fn tied() -> FrameLayout {
    let mut pier = pier(&MODERATE);
    (pier.inertia, pier.column.elements, pier.column.section.line_mass) = (Some(2e6), 4, 8e3);
    let mut layout = pier.layout();
    let at = NodePoint { node: 1, place: [0.0, 12.0] };
    layout.tendons.push(FrameTendon { at, anchor: [0.0; 2], stiffness: 2e7, pretension: 5e5 });
    for at in layout.corners.clone() {
        layout.dampers.push(frames::frame::FrameDamper { at, c: [1e5, 2e5] });
    }
    layout
}

fn history(frame: &Frame, accel: &[f64], vertical: &[f64]) -> ElasticHistory {
    let springs = springs(frame, 2e3, 4.0);
    let history = ElasticAnalysis {
        vertical,
        ..ElasticAnalysis::new(frame, &springs, ElasticStart::Standing, 0.01, accel)
    }
    .simulate()
    .unwrap();
    assert_eq!(history.outcome, HistoryOutcome::Completed);
    history
}

/// The energy account closes to 1e-6 of the history's largest energy, both components of the ground
/// at work; and what rocks takes energy in.
#[test]
fn the_energy_account_closes_whatever_the_frame() {
    let accel = el_centro(1001);
    let vertical: Vec<f64> = accel.iter().skip(100).map(|a| 0.6 * a).collect();
    let light = pier(&Numbers { footing: 6e4, hz: 1.5, ..MODERATE }).layout();
    for layout in [light, tied(), portal(), legged()] {
        let frame = layout.frame().unwrap();
        let history = history(&frame, &accel, &vertical);
        assert!(history.energy_residual < 1e-6, "{} {:e}", frame.size(), history.energy_residual);
        assert!(history.work.events > 4 && history.work.smallest == 0, "{:?}", history.work);
        let lost = &history.account.dissipated;
        assert!(lost.windows(2).all(|pair| pair[1] >= pair[0] - 1e-6 * history.energy_scale));
    }
}

/// What the corners give in impulse, means between samples, is the weight's and the ground's, and
/// the change of the momentum, in both directions.
#[test]
fn the_mean_forces_of_the_corners_balance_the_momentum() {
    let accel = el_centro(801);
    let vertical: Vec<f64> = accel.iter().map(|a| -0.5 * a).collect();
    for layout in [portal(), legged()] {
        let frame = layout.frame().unwrap();
        let history = history(&frame, &accel, &vertical);
        let total = frame.total_mass();
        let momentum = |i: usize, k: usize| -> f64 {
            let coordinates = (0..frame.nodes()).filter_map(|node| frame.coordinates(node)[k]);
            coordinates.map(|at| frame.mass_matrix()[(at, at)] * history.v[i][at]).sum()
        };
        for i in 1..history.q.len() {
            for (k, ground) in [(0, &accel), (1, &vertical)] {
                let pull = 0.5 * (ground[i - 1] + ground[i]) + if k == 1 { GRAVITY } else { 0.0 };
                let given: f64 = history.forces.iter().map(|corner| corner.mean[i][k]).sum();
                let gained = (momentum(i, k) - momentum(i - 1, k)) / 0.01;
                assert!(
                    (given - total * pull - gained).abs() < 1e-6 * total * GRAVITY,
                    "{i} {k} {}",
                    frame.size()
                );
            }
        }
    }
}

#[test]
fn a_mirrored_motion_gives_the_mirrored_history() {
    let accel = el_centro(401);
    let mirrored: Vec<f64> = accel.iter().map(|a| -a).collect();
    let frame = pier(&MODERATE).layout().frame().unwrap();
    let (one, other) = (history(&frame, &accel, &[]), history(&frame, &mirrored, &[]));
    let [th, mirror] = [&one, &other].map(|history| history.rotation(&frame, Base::Footing(0)));
    let peak = largest_magnitude(&th);
    assert!(peak > 1e-3);
    assert!(th.iter().zip(&mirror).all(|(a, b)| (a + b).abs() < 1e-6 * peak));
    assert_eq!(one.touches(0), other.touches(1));
}

/// Free flight of nothing: a frame on still ground stays where it settled, its corners bearing its
/// weight.
#[test]
fn a_standing_frame_stands_still() {
    for layout in [tied(), portal(), legged()] {
        let frame = layout.frame().unwrap();
        let history = history(&frame, &[0.0; 101], &[]);
        let moved =
            history.q.iter().flat_map(|q| q.iter().zip(&history.q[0]).map(|(a, b)| (a - b).abs()));
        assert!(moved.fold(0.0, f64::max) < 1e-9);
        let tension: f64 = frame.tensions(&history.q[0]).iter().sum();
        let borne: f64 = history.forces.iter().map(|corner| corner.at[100][1]).sum();
        assert!(
            (borne / (frame.total_mass() * GRAVITY + tension) - 1.0).abs() < 1e-6,
            "{}",
            frame.size()
        );
    }
}

/// A lean of less than the settlement leaves both corners pressing; springs that are not one a
/// corner are refused.
#[test]
fn a_small_lean_stands_on_both_corners_and_a_spring_too_few_is_refused() {
    let frame = pier(&MODERATE).layout().frame().unwrap();
    let springs = springs(&frame, 50.0, 4.0);
    let accel = [0.0; 201];
    let history = ElasticAnalysis::new(&frame, &springs, ElasticStart::Leaning(1e-6), 0.01, &accel)
        .simulate()
        .unwrap();
    assert!(history.energy_residual < 1e-6, "{:e}", history.energy_residual);
    assert!(history.forces.iter().all(|corner| corner.at[0][1] > 0.0));
    let refused = ElasticAnalysis::new(&frame, &springs[..1], ElasticStart::Standing, 0.01, &accel)
        .simulate()
        .unwrap_err();
    assert_eq!(refused.to_string(), "frame: 1 springs given, but it has 2");
}
