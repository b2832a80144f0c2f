//! Dampers and a tendon through El Centro.

use dynamics::{
    fem::{Analysis, Demands, History, Start, corner_forces},
    spring::{Chain, Springs},
};
use rocking::{
    members::{Damper, Members, Tendon},
    motion::{Motion, largest_magnitude},
    scalar::GRAVITY,
    structure::Structure,
};
use strong_motion::Record;

use crate::common::{assert_sound, el_centro, free, lively, paper, plastic, settled};

fn run(
    structure: &Structure,
    springs: Springs<Chain>,
    record: &Record,
    members: &Members,
) -> (History, Demands) {
    Analysis::new(structure.body(), springs, record.dt, &record.accel).simulate_with(members)
}

/// Members worth trying together and alone.
fn kinds() -> Vec<Members> {
    let damper = Some(Damper { c: 1e6 });
    let tendon = Some(Tendon { stiffness: 2e6, pretension: 5e5 });
    vec![
        Members { damper, ..Members::default() },
        Members { tendon, ..Members::default() },
        Members { damper, tendon, friction: None },
    ]
}

#[test]
fn without_members_the_history_is_the_rigid_body_s_to_the_last_bit() {
    let (structure, record) = (paper(1e-5), el_centro());
    let springs = plastic(80.0, structure.mass_kg);
    let rigid = settled(&structure, springs, &record);
    let (history, demands) = run(&structure, springs, &record, &Members::default());
    assert_eq!(history.motion, rigid.motion);
    assert_eq!(demands.rows.len(), record.accel.len());
}

#[test]
fn the_energy_account_closes_with_every_member() {
    let record = el_centro();
    for share in [1e-5, 1e-2] {
        let structure = paper(share);
        for members in kinds() {
            let mass = structure.mass_kg;
            for springs in [plastic(40.0, mass), plastic(160.0, mass), lively(80.0, mass)] {
                let (history, _) = run(&structure, springs, &record, &members);
                assert_eq!(
                    history.motion.len(),
                    record.accel.len(),
                    "{members:?} {:?}",
                    history.outcome
                );
                assert!(
                    history.energy_residual < 1e-6,
                    "{members:?} {:e}",
                    history.energy_residual
                );
                // energy is only lost
                let lost = &history.account.dissipated;
                let scale = lost[lost.len() - 1];
                assert!(
                    lost.windows(2).all(|w| w[1] - w[0] > -1e-9 * scale),
                    "{share} {members:?}"
                );
            }
        }
    }
}

#[test]
fn the_mirrored_record_gives_the_mirrored_history() {
    let mut record = el_centro();
    record.accel.truncate(1200);
    let mirrored = Record { accel: record.accel.iter().map(|a| -a).collect(), ..record.clone() };
    let structure = paper(1e-5);
    let springs = plastic(80.0, structure.mass_kg);
    for members in kinds() {
        let (one, forces) = run(&structure, springs, &record, &members);
        let (other, mirrored) = run(&structure, springs, &mirrored, &members);
        assert!(one.motion.u.iter().zip(&other.motion.u).all(|(a, b)| *a == -b), "{members:?}");
        assert!(one.motion.v.iter().zip(&other.motion.v).all(|(a, b)| a == b), "{members:?}");
        // axial force of the left leg is that of the right one
        assert_eq!(forces.peaks[1].value, mirrored.peaks[4].value);
        assert_eq!(forces.peaks[0].value, -mirrored.peaks[0].value);
    }
}

#[test]
fn dampers_take_energy_out_of_free_rocking() {
    let structure = paper(1e-5);
    let springs = plastic(80.0, structure.mass_kg);
    let lean = 0.5 * structure.body::<f64>().alpha();
    let still = vec![0.0; 1500];
    let case = Analysis {
        start: Start::Leaning(lean),
        ..Analysis::new(structure.body(), springs, 0.01, &still)
    };
    let members = Members { damper: Some(Damper { c: 1e6 }), ..Members::default() };
    let (damped, demands) = case.simulate_with(&members);
    let rigid = free(&structure, springs, lean, 0.01, 1500);
    let late = |h: &History| largest_magnitude(&h.motion.u[700..]);
    assert!(late(&damped) < 0.75 * late(&rigid), "{} {}", late(&damped), late(&rigid));
    assert!(damped.energy_residual < 1e-6);
    // the corner in the air does the damper's work, up and down
    assert!(demands.peaks[8].value != 0.0 && demands.peaks[9].value != 0.0);
}

#[test]
fn base_shear_is_mass_times_absolute_acceleration_and_legs_carry_the_weight_at_rest() {
    let structure = paper(1e-5);
    let springs = plastic(80.0, structure.mass_kg);
    let still = Record { accel: vec![0.0; 3], ..el_centro() };
    let (_, demands) = run(&structure, springs, &still, &Members::default());
    let weight = structure.mass_kg * GRAVITY;
    let alpha = structure.body::<f64>().alpha();
    // each foot takes half the weight and no thrust
    let [shear, axial, _, _, other, ..] = demands.rows[2];
    assert!(shear.abs() < 1e-9 * weight && axial == other);
    assert!((axial * 2.0 / alpha.cos() / weight + 1.0).abs() < 1e-6, "{axial}");
    // a rigid body on one foot under steady ground acceleration, before it moves: H = m a_g
    let push = 0.05 * GRAVITY;
    let steady = Record { accel: vec![0.0, push, push, push], dt: 1.0, ..el_centro() };
    let (_, demands) = run(&structure, springs, &steady, &Members::default());
    let late = demands.rows[3][0];
    assert!((late / (structure.mass_kg * push) - 1.0).abs() < 0.2, "{late}");
}

/// Housner's equation with a dashpot under the corner in the air, whose upright rate is 2 b cos
/// theta theta', so that it turns the body back by c (2 b cos theta)^2 theta':
///
/// ```text
///   I0 theta'' = -m g R sin(alpha s - theta) - m a_g R cos(alpha s - theta) - c (2 b cos theta)^2 theta'
/// ```
///
/// by Runge and Kutta's steps of `dt / parts`; at an impact the rate is multiplied by e.
fn rigid_with_dampers(structure: &Structure, record: &Record, c: f64, parts: usize) -> Vec<f64> {
    let body = structure.body::<f64>();
    let (m, radius, alpha) = (body.mass, body.radius(), body.alpha());
    let inertia = body.inertia + m * radius * radius;
    let (h, e) = (record.dt / parts as f64, body.restitution());
    let turning = |s: f64, ug: f64, [theta, rate]: [f64; 2]| {
        let arm = 2.0 * body.half_width * theta.cos();
        let lean = alpha * s - theta;
        -(m * GRAVITY * radius * lean.sin() + m * ug * radius * lean.cos() + c * arm * arm * rate)
            / inertia
    };
    let (mut now, mut side, mut all) = ([0.0_f64; 2], 0.0_f64, vec![0.0]);
    for pair in record.accel.windows(2) {
        for k in 0..parts {
            let ground = |x: f64| pair[0] + (pair[1] - pair[0]) * (k as f64 + x) / parts as f64;
            if side == 0.0 {
                let lifts = ground(0.0).abs() > GRAVITY * alpha.tan();
                side = if lifts { -ground(0.0).signum() } else { continue };
            }
            let f = |x: f64, y: [f64; 2]| [y[1], turning(side, ground(x), y)];
            let on = |y: [f64; 2], d: [f64; 2], by: f64| [y[0] + by * d[0], y[1] + by * d[1]];
            let k1 = f(0.0, now);
            let k2 = f(0.5, on(now, k1, 0.5 * h));
            let k3 = f(0.5, on(now, k2, 0.5 * h));
            let k4 = f(1.0, on(now, k3, h));
            let next: [f64; 2] = std::array::from_fn(|i| {
                now[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
            });
            now = next;
            if now[0] * side < 0.0 {
                // within a step of h the rate is all but constant
                (now, side) = ([0.0, now[1] * e], -side);
                if now[1].abs() < 1e-7 {
                    (now, side) = ([0.0; 2], 0.0);
                }
            }
        }
        all.push(now[0]);
    }
    all
}

/// A frame whose legs have no inertia follows the equation of the rigid body with its dampers, weak
/// or strong, and its feet do not slide: the top moves as the rotation about a foot moves it. The
/// strongest are compared for 5 s: later shorter steps of the equation move it by a tenth.
#[test]
fn a_frame_follows_the_rigid_body_with_its_dampers_and_does_not_slide() {
    let record = el_centro();
    let structure = Structure::a_frame(28.0, 6.0, 18e6 / GRAVITY).unwrap();
    let body = structure.body::<f64>();
    let (radius, alpha) = (body.radius(), body.alpha());
    for (c, samples) in [(1e3, 2001), (1e5, 2001), (1e6, 2001), (1e7, 501)] {
        let theirs = rigid_with_dampers(&structure, &record, c, 400);
        let largest = largest_magnitude(&theirs);
        let members = Members { damper: Some(Damper { c }), ..Members::default() };
        let (history, _) = run(&structure, plastic(5120.0, structure.mass_kg), &record, &members);
        assert_sound(&history, record.accel.len());
        let (theta, u) = (&history.motion.theta, &history.motion.u);
        for i in 0..samples {
            let apart = (theta[i] - theirs[i]).abs() / largest;
            assert!(apart < 0.01, "{c} {i}: {} {}", theta[i], theirs[i]);
            let turned = radius * (alpha.sin() - (alpha - theta[i].abs()).sin());
            let slid = (u[i].abs() - turned).abs() / (radius * largest);
            assert!(slid < 0.01, "{c} {i}: {} {turned}", u[i]);
        }
    }
}

/// A landing on soft springs of a frame with strong dampers does not chatter on.
#[test]
fn dampers_do_not_let_a_foot_chatter_on_soft_springs() {
    let record = el_centro();
    let structure = Structure::a_frame(28.0, 6.0, 18e6 / GRAVITY).unwrap();
    for c in [1e5, 3e6, 1e7] {
        let members = Members { damper: Some(Damper { c }), ..Members::default() };
        for hz in [160.0, 640.0] {
            let (history, _) = run(&structure, plastic(hz, structure.mass_kg), &record, &members);
            assert_sound(&history, record.accel.len());
        }
    }
}

/// Dashpots hold the corners of the body, a tendon its mass: by Newton's laws, from the motion
/// alone,
///
/// ```text
///   upwards        m (z'' + g + a_v) = sum of both corners - T (h + z)/l,    l = hypot(u, h + z)
///   about the mass sum of the legs' moments = I_cg theta''
///   in the air     the leg bears its dashpot alone: d = -c w,  w = -+2 b cos theta theta', the other corner at rest:
///                  tension -d cos,  moment |d| times the foot's distance from the mass, horizontally
/// ```
#[test]
fn what_the_legs_and_corners_bear_balances_the_motion() {
    let frame = Structure {
        rotational_inertia_kgm2: 2.5e6,
        ..Structure::a_frame(35.0, 7.0, 500e3).unwrap()
    };
    balances(&frame, 2e6, Tendon { stiffness: 2e6, pretension: 3e5 });
    let block = Structure::block(18.0, 2.2, 110e3).unwrap();
    balances(&block, 3e5, Tendon { stiffness: 2e6, pretension: 1e5 });
}

fn balances(structure: &Structure, c: f64, tendon: Tendon) {
    let horizontal = el_centro();
    let up: Vec<f64> = (0..horizontal.accel.len()).map(|i| (0.05 * i as f64).sin()).collect();
    let body = structure.body::<f64>();
    let (dt, weight) = (horizontal.dt, body.mass * GRAVITY);
    let members = Members { damper: Some(Damper { c }), tendon: Some(tendon), friction: None };
    let analysis = Analysis {
        vertical: &up,
        ..Analysis::new(body, plastic(640.0, body.mass), dt, &horizontal.accel)
    };
    let (history, demands) = analysis.simulate_with(&members);
    let Motion { u, v, theta } = &history.motion;
    let (mut largest, mut seen) = (0.0_f64, 0);
    for i in 2..u.len() - 2 {
        let near = |time: f64| (-0.15..0.03).contains(&(time - i as f64 * dt));
        let pressed = |i: usize, foot: usize| demands.feet[i][foot][1] > 0.0;
        let alone =
            |foot: usize| (i - 2..=i + 2).all(|i| pressed(i, foot) && !pressed(i, 1 - foot));
        let Some(foot) = [0, 1].into_iter().find(|&foot| alone(foot)) else { continue };
        if history.landings.iter().any(|landing| near(landing.time)) {
            continue;
        }
        seen += 1;
        let second = |x: &[f64]| (x[i + 1] - 2.0 * x[i] + x[i - 1]) / (dt * dt);
        let rate = (theta[i + 1] - theta[i - 1]) / (2.0 * dt);
        // the ground's acceleration is linear between samples: second differences are its means
        let mean = |of: &dyn Fn(usize) -> f64| (of(i - 1) + 4.0 * of(i) + of(i + 1)) / 6.0;
        let found = mean(&|i| {
            let rise = body.height + v[i] + history.initial_z;
            let [left, right] = corner_forces(&demands, i);
            left[1] + right[1] - demands.at[i][7] * rise / u[i].hypot(rise)
        });
        let due = body.mass * (second(v) + GRAVITY + mean(&|i| up[i]));
        assert!((found - due).abs() < 1e-3 * weight, "{i}: {found} {due}");
        let found = mean(&|i| demands.at[i][3] + demands.at[i][6]);
        let due = body.inertia * second(theta);
        let apart = 1e-3 * (weight * body.half_width + body.inertia);
        assert!((found - due).abs() < apart, "{i}: {found} {due}");
        // the other leg hangs on its dashpot
        let other = 1 - foot;
        let side = if other == 0 { -1.0 } else { 1.0 };
        let d = c * side * 2.0 * body.half_width * theta[i].cos() * rate;
        let row = &demands.at[i][1 + 3 * other..][..3];
        let (sin, cos) = theta[i].sin_cos();
        let x = side * body.half_width * cos - body.height * sin;
        let z = -body.height * cos - side * body.half_width * sin;
        // differences over samples miss the rate by a sixth of what the ground's acceleration
        // changes the turning by in one of them
        let apart = c * 2.0 * body.half_width * 3e-4;
        let arms = [z / body.radius(), -x / body.radius(), -x];
        for (found, arm) in row.iter().zip(arms) {
            assert!((found - d * arm).abs() < apart * arm.abs() + 1.0, "{i}: {row:?} {d} {arms:?}");
        }
        largest = largest.max(row[0]);
    }
    assert!(seen > 300 && largest > 0.02 * weight, "{seen} {largest}");
}
