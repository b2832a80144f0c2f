//! Forces of a rigid body, beside statics and what a dashpot adds.

use super::*;
use crate::answers::{compare_models, with_members};
use dynamics::spring::{Design, Springs};
use rocking::{
    members::{Damper, Members, Tendon},
    structure::Structure,
};

/// The moment among the forces.
const MOMENT: usize = 2;

fn forces(structure: &Structure, hz: f64, accel: Vec<f64>) -> DesignForces {
    let record = Record::new("made up", 0.01, accel).unwrap();
    let design = Design::from_kc(0.3, 0.1, 0.75, hz);
    let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
    let body = structure.body();
    let both = compare_models(&body, body.restitution(), &springs, &Members::default(), &record);
    design_forces(structure.kind, &body, &record, &both, None, None)
}

/// Standing under a_g: shear m a_g, axial W; a leg carries a moment of W b/2 at the apex
/// whatever the ground does.
#[test]
fn a_standing_frame_bears_what_statics_say() {
    let frame = Structure::a_frame(9.0, 2.1, 120e3).unwrap();
    let push = |i: usize| 0.5 * (i as f64 / 200.0).min(1.0);
    let all = forces(&frame, 1280.0, (0..400).map(push).collect());
    let weight = frame.mass_kg * GRAVITY;
    let sole = all.sole_shear_n.unwrap();
    assert!(sole.holds && (sole.value.unwrap().abs() / 60e3 - 1.0).abs() < 1e-6, "{sole:?}");
    let apex = all.apex_moment_nm.unwrap();
    assert!((apex.value.unwrap().abs() / (weight * 1.05 / 2.0) - 1.0).abs() < 1e-9, "{apex:?}");
    assert!(all.column_base_moment_nm.is_none());
    // one leg's: its moment is its shear times its length, and it bears half of the weight and
    // a part of the push
    let with = apex.together.unwrap();
    let length = 9f64.hypot(1.05);
    assert_eq!(with.apex_moment_nm, apex.value);
    assert!((with.column_shear_n * length / apex.value.unwrap() - 1.0).abs() < 1e-9, "{with:?}");
    let axial = all.axial_n.unwrap();
    let with = axial.together.unwrap();
    let by_hand = 0.5 * weight * 9.0 / length
        + 60e3 * (9.0 / 1.05) / 2.0 * 9.0 / length
        + 30e3 * 1.05 / length;
    assert!((with.axial_n / -by_hand - 1.0).abs() < 1e-6, "{with:?} {by_hand}");
    assert_eq!(with.column_base_moment_nm, 0.0);
}

/// A block that stands in a ground motion presses on the ground by its weight, however fast the
/// two feet exchange it.
#[test]
fn a_standing_block_carries_its_weight_whatever_the_ground_does() {
    let block = Structure::block(1.2, 0.6, 300.0).unwrap();
    let shake = |i: usize| 2.2 * (std::f64::consts::TAU * 4.0 * 0.01 * i as f64).sin();
    let all = forces(&block, 10240.0, (0..300).map(shake).collect());
    let axial = all.axial_n.unwrap();
    assert!((axial.value.unwrap() / (-300.0 * GRAVITY) - 1.0).abs() < 1e-9, "{axial:?}");
    assert!(axial.change.unwrap() < 1e-3, "{axial:?}");
}

/// A block's base moment is at most W b, which it reaches when it lifts; its shear then is m g
/// tan(alpha).
#[test]
fn a_block_that_rocks_carries_its_weight_on_one_corner() {
    let block = Structure::block(2.0, 0.5, 1000.0).unwrap();
    let pulse = |i: usize| if i < 45 { 4.0 * (i as f64 / 20.0).min(1.0) } else { 0.0 };
    let all = forces(&block, 10240.0, (0..1000).map(pulse).collect());
    let (weight, b) = (block.mass_kg * GRAVITY, 0.25);
    let moment = all.column_base_moment_nm.unwrap();
    assert!(moment.holds, "{moment:?}");
    // the weight on a corner, less what the body's fall and turning take, at most plus the
    // centrifugal part
    assert!((0.8..1.2).contains(&(moment.value.unwrap().abs() / (weight * b))), "{moment:?}");
    let shear = all.column_shear_n.unwrap();
    assert!(shear.holds && shear.value.unwrap().abs() < 1.5 * 1000.0 * 4.0, "{shear:?}");
    assert!(all.axial_n.unwrap().value.unwrap() < 0.0 && all.apex_moment_nm.is_none());
}

/// A frame's leg in the air hangs on its dashpot: it bears the dashpot's pull d along its axis,
/// d h/R of a leg that hardly leans, and at the apex d b. A block's dashpot pulls its corner
/// down, which its base bears beside the foot that presses: (N + d) b about the middle.
#[test]
fn a_dashpot_pulls_on_the_leg_or_the_base_that_it_holds() {
    let with = |structure: &Structure, c: f64| {
        let record = Record::el_centro();
        let design = Design::from_kc(0.3, 0.1, 0.75, 640.0);
        let springs = Springs { vertical: design, horizontal: design };
        let springs = springs.chains(structure.mass_kg);
        let members = Members { damper: Some(Damper { c }), ..Members::default() };
        let (body, e) = (structure.body(), structure.body::<f64>().restitution());
        let both = compare_models(&body, e, &springs, &members, &record);
        let of = (&both.rocking, &both.housner);
        let softer = with_members(&body, e, &springs, &members, &record, of);
        let all = design_forces(structure.kind, &body, &record, &both, Some(&softer), None);
        (all, both)
    };
    let frame = Structure::a_frame(35.0, 7.0, 500e3).unwrap();
    let (all, frame_both) = with(&frame, 2e6);
    let frame_with = frame_both.with.unwrap();
    let pull = |i: usize| -> f64 {
        let (row, feet) = (&frame_with.demands.at[i], &frame_with.demands.feet[i]);
        let [left, right] = feet.map(|foot| foot[1] > 0.0);
        let pulls = [(left, right, row[8]), (right, left, row[9])];
        let hangs = pulls.into_iter().filter(|(presses, other, _)| !presses && *other);
        hangs.map(|(_, _, d)| -d).fold(0.0, f64::max)
    };
    let pull = (0..frame_with.demands.at.len()).map(pull).fold(0.0, f64::max);
    let tension = all.axial_tension_n.unwrap().value.unwrap();
    let along = 35.0 / 35.0_f64.hypot(3.5);
    // a lean of 0.01 turns the leg by a thousandth
    assert!((tension / (pull * along) - 1.0).abs() < 2e-3, "{tension} {pull}");
    its_damper_moves(&all, &frame_with);
    assert!(pull > 3e5 && all.damper_n.unwrap().value.unwrap().abs() > pull);
    let block = Structure::block(18.0, 2.2, 110e3).unwrap();
    let (all, both) = with(&block, 3e5);
    let with = both.with.as_ref().unwrap();
    let (body, demands) = (block.body::<f64>(), &with.demands);
    let kept = all_between(&body, 0.01, &with.history, demands.feet.len());
    let peaks = on_springs((Kind::Block, &body), 0.01, demands, &kept, None);
    let found = peaks[MOMENT].value.abs();
    let by_hand = |&i: &usize| {
        let [left, right] = demands.feet[i].map(|foot| foot[1]);
        let [dashpot_left, dashpot_right] = [demands.at[i][8], demands.at[i][9]];
        let (n, d) = if left > 0.0 { (left, -dashpot_right) } else { (right, -dashpot_left) };
        if left.min(right) > 0.0 { 0.0 } else { (n + d) * body.half_width }
    };
    let due = kept.iter().map(by_hand).fold(0.0, f64::max);
    // without the dashpot it would be less
    let bare = |&i: &usize| demands.feet[i].map(|foot| foot[1]).into_iter().fold(0.0, f64::max);
    let alone = kept.iter().map(bare).fold(0.0, f64::max) * body.half_width;
    assert!((found / due - 1.0).abs() < 1e-6 && due > 1.02 * alone, "{found} {due} {alone}");
    // at one corner N presses and at the other d pulls: N b + d b beside N - d
    let time = peaks[MOMENT].time;
    let i = (time / 0.01).round() as usize;
    let [left, right] = demands.feet[i].map(|foot| foot[1]);
    let axial = left + right + demands.at[i][8] + demands.at[i][9];
    let record = Record::el_centro();
    let instants = ForceInstants::new((Kind::Block, &body), &record, &both, &[]);
    let together = instants.force(MOMENT, peaks[MOMENT], Some(0.0)).together.unwrap();
    assert!((together.axial_n / -axial - 1.0).abs() < 1e-9, "{together:?} {axial}");
    // near landings, too: (N + d) b of Housner's body with dampers
    let rocking = with.rocking.as_ref().unwrap();
    let moment = |i: usize| {
        let (theta, rate, side) = (rocking.theta[i], rocking.rate[i], rocking.theta[i].signum());
        let ground = (Record::el_centro().accel[i] / GRAVITY, 1.0);
        let n = regime::forces_of_foot(&body, &with.members, side, (theta, rate), ground).1;
        let d = 3e5 * 2.0 * body.half_width * theta.cos() * rate * side;
        (n * body.mass * GRAVITY + d) * body.half_width
    };
    let rocks = (0..rocking.theta.len()).filter(|&i| rocking.theta[i] != 0.0);
    let housner = rocks.map(moment).fold(0.0, f64::max);
    let all = all.column_base_moment_nm.unwrap().value.unwrap().abs();
    // springs of 640 Hz sway by a thousandth
    assert!((all / housner - 1.0).abs() < 2e-3 && all > 1.001 * found, "{all} {housner}");
}

/// Both runs of a body with a tendon on springs of 20480 Hz and of 5120 Hz.
fn tied(structure: &Structure, tendon: Tendon, record: &Record) -> (DesignForces, ModelComparison) {
    let members = Members { tendon: Some(tendon), ..Members::default() };
    let (body, e) = (structure.body(), structure.body::<f64>().restitution());
    let springs = |hz: f64| {
        let design = Design::from_kc(0.3, 0.1, 0.75, hz);
        Springs { vertical: design, horizontal: design }.chains(structure.mass_kg)
    };
    let both = compare_models(&body, e, &springs(20480.0), &members, record);
    let of = (&both.rocking, &both.housner);
    let softer = with_members(&body, e, &springs(5120.0), &members, record, of);
    let all = design_forces(structure.kind, &body, record, &both, Some(&softer), None);
    (all, both)
}

/// A block held down by N_0 under a push a that does not lift it: each corner gets m a/2, one of
/// them (W + N_0)/2 + m a h/(2 b); the base bears W + N_0 and m a h, together. The anchor of a
/// tendon that stands upright gives nothing across. A frame's leg bears (W + N_0) b/2 at rest.
#[test]
fn corners_of_a_standing_body_bear_its_weight_and_its_tendon() {
    let block = Structure::block(2.0, 0.5, 1000.0).unwrap();
    let tendon = Tendon { stiffness: 1e5, pretension: 4e3 };
    let push = |i: usize| 2.0 * (i as f64 / 200.0).min(1.0);
    let record = Record::new("push", 0.01, (0..400).map(push).collect()).unwrap();
    let (all, _) = tied(&block, tendon, &record);
    let (pressed, h, b) = (1000.0 * GRAVITY + 4e3, 1.0, 0.25);
    let near = |found: f64, due: f64| assert!((found / due - 1.0).abs() < 1e-3, "{found} {due}");
    let corner = all.corner_vertical_n.unwrap();
    near(corner.value.unwrap(), 0.5 * pressed + 0.5 * 2000.0 * h / b);
    near(corner.corner.unwrap().horizontal_n.abs(), 1000.0);
    near(all.corner_horizontal_n.unwrap().value.unwrap().abs(), 1000.0);
    near(all.column_shear_n.unwrap().value.unwrap().abs(), 2000.0);
    assert!(all.anchor_horizontal_n.is_none_or(|force| force.time_s > 0.0));
    let together = all.column_base_moment_nm.unwrap().together.unwrap();
    near(together.column_base_moment_nm.abs(), 2000.0 * h);
    near(together.axial_n, -pressed);
    let frame = Structure::a_frame(9.0, 2.1, 120e3).unwrap();
    let (all, _) = tied(&frame, Tendon { stiffness: 4e6, pretension: 2e5 }, &record);
    let due = (120e3 * GRAVITY + 2e5) * 1.05 / 2.0;
    let moment = all.apex_moment_nm.unwrap();
    near(moment.at_rest.unwrap(), due);
    near(
        all.axial_n.unwrap().at_rest.unwrap().abs(),
        due * 2.0 / 1.05 * 9.0 / 9f64.hypot(1.05) / 2.0,
    );
}

/// The soles and the anchor together give what turns and moves the mass; the anchor alone T b'/l of
/// a tendon that leans: b' across from the mass, l long. One foot alone presses with both forces
/// of its corner, and near a landing with what acts together, too.
#[test]
fn soles_bear_what_the_anchor_of_a_leaning_tendon_does_not() {
    let frame = Structure::a_frame(8.9, 2.1, 120e3).unwrap();
    let frame = Structure { rotational_inertia_kgm2: 3e5, ..frame };
    let tendon = Tendon { stiffness: 4e7, pretension: 2e5 };
    let record = Record::el_centro().scaled(1.2).unwrap().truncated(5.0);
    let (all, both) = tied(&frame, tendon, &record);
    let (with, body) = (both.with.as_ref().unwrap(), frame.body::<f64>());
    let [corner, sole, anchor] =
        [all.corner_horizontal_n, all.sole_shear_n, all.anchor_horizontal_n].map(Option::unwrap);
    let at = |force: &DesignForce| (force.time_s / record.dt).round() as usize;
    // one foot presses: all that the soles bear
    assert!((corner.value.unwrap() / sole.value.unwrap() - 1.0).abs() < 1e-9);
    let i = at(&anchor);
    let (theta, row) = (with.history.motion.theta[i], &with.demands.at[i]);
    let (u, up) = (body.u(theta), body.height + body.v(theta));
    let due = row[7] * u.abs() / u.hypot(up);
    let found = anchor.value.unwrap();
    assert!((found.abs() / due - 1.0).abs() < 1e-3 && found * u < 0.0, "{found} {due}");
    let i = at(&sole);
    let both_give = with.demands.at[i][0];
    assert!(sole.value.unwrap().abs() < both_give.abs(), "{both_give}");
    // drawn by how far the mass is from the anchor
    let (tendon, i) = (all.tendon_motion.unwrap(), at(&all.tendon_n.unwrap()));
    let theta = with.history.motion.theta[i];
    let drawn = body.u(theta).hypot(body.height + body.v(theta)) - body.height;
    assert!((tendon.elongation_m / drawn - 1.0).abs() < 2e-3, "{tendon:?} {drawn}");
    assert!(all.axial_n.unwrap().together.is_some() && corner.corner.is_some());
}

/// A damper's largest force has its own time, not the next sample's; its velocity is F/c, and it is
/// drawn by the rise of a corner.
fn its_damper_moves(all: &DesignForces, with: &MemberHistory) {
    let (largest, motion) = (all.damper_n.unwrap(), all.damper_motion.unwrap());
    let own = |k: usize| {
        let peak = with.demands.peaks[k];
        let times = [largest.time_s, motion.velocity_time_s];
        Some(peak.value) == largest.value && times == [peak.time; 2]
    };
    assert!(own(8) || own(9), "{largest:?}");
    let speed = largest.value.unwrap().abs() / 2e6;
    assert!((motion.velocity_m_per_s / speed - 1.0).abs() < 1e-12, "{motion:?}");
    let rise = 7.0 * rocking::motion::peak(&with.history.motion.theta).abs().sin();
    assert!((motion.elongation_m / rise - 1.0).abs() < 1e-12, "{motion:?}");
}
