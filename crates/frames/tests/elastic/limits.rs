//! Limits in closed form: the rigid body, the impact of theory.md, mirror images, rest.

use frames::{
    Mechanics, Pier,
    reference::{
        Configuration, CornerContact, CornerSet, PerturbedPair, ReferenceOptions, at_rest, growth,
        rock,
    },
};
use nalgebra::DVector;

use crate::piers::{free_rocking, ground_at_rest, heavy, light, shaken, tight};
use crate::portal::Portal;
use crate::random::Random;

/// No hops: the Lagrangian model.
fn held_down() -> ReferenceOptions {
    ReferenceOptions { hop: false, ..tight() }
}

/// sqrt of the ratio of the potential energies of the rigid body at the second and the first of its
/// turning points.
fn restitution(pier: &Pier, theta: f64, seconds: f64, options: &ReferenceOptions) -> f64 {
    let history = free_rocking(pier, theta, seconds, options);
    let [first, second] = {
        let landings: Vec<f64> = history.landings().map(|event| event.time).collect();
        // a landing at the other side of zero follows the peak
        let crossing =
            landings.iter().find(|&&time| time > landings[0] + 0.5).expect("a second landing");
        [landings[0], *crossing]
    };
    let between = |(i, _): &(usize, &DVector<f64>)| (first..second).contains(&(0.01 * *i as f64));
    let samples: Vec<_> =
        history.q.iter().enumerate().filter(between).map(|(_, q)| q[2].abs()).collect();
    // the peak between samples, by a parabola
    let i =
        (1..samples.len() - 1).max_by(|&a, &b| samples[a].total_cmp(&samples[b])).expect("samples");
    let (a, b, c) = (samples[i - 1], samples[i], samples[i + 1]);
    let peak = b - (c - a).powi(2) / (8.0 * (a - 2.0 * b + c));
    let potential = |theta: f64| {
        let (moment, first) = (
            pier.mass * pier.height + pier.footing_mass * pier.footing_height,
            pier.mass + pier.footing_mass,
        );
        first * pier.half_width * theta.sin() + moment * (theta.cos() - 1.0)
    };
    (potential(peak) / potential(theta)).sqrt()
}

/// m h^2 and the like of a pier: (I + sum m (h^2 - b^2), I + sum m (h^2 + b^2)).
fn inertias(pier: &Pier) -> [f64; 2] {
    let sum = |sign: f64| {
        let about = |m: f64, h: f64| m * (h * h + sign * pier.half_width * pier.half_width);
        pier.footing_inertia
            + about(pier.mass, pier.height)
            + about(pier.footing_mass, pier.footing_height)
    };
    [sum(-1.0), sum(1.0)]
}

/// A stiffer column of the same damping ratio.
fn at_hertz(pier: &Pier, hz: f64) -> Pier {
    let Pier { mass, height, half_width, footing_mass, footing_height, .. } = *pier;
    Pier::new([mass, height, half_width], [hz, 0.02], [footing_mass, footing_height])
}

#[test]
fn a_stiff_pier_that_lands_on_one_corner_has_housners_restitution() {
    let [after, before] = inertias(&heavy());
    let housner = after / before;
    assert!((housner - 0.85965).abs() < 5e-6, "{housner}");
    let errors = [80.0, 320.0]
        .map(|hz| restitution(&at_hertz(&heavy(), hz), 0.15, 4.0, &held_down()) / housner - 1.0);
    println!("Housner's e {housner}, relative errors at 80 and 320 Hz {errors:?}");
    assert!(errors[1].abs() < 1e-3 && errors[1].abs() < 0.5 * errors[0].abs(), "{errors:?}");
    // reported, not bounded
    let hopping = restitution(&at_hertz(&heavy(), 320.0), 0.15, 4.0, &tight());
    let axial = at_hertz(&heavy(), 80.0).with_axial(4e12, 0.02);
    println!(
        "with hops {hopping}; with k_a = 4e12 N/m {}",
        restitution(&axial, 0.15, 4.0, &tight())
    );
}

/// e = m h^2/(m R^2 + I_b0) where both corners stop.
#[test]
fn a_stiff_pier_that_lands_on_both_corners_has_the_two_corner_restitution() {
    let pier = light();
    let expected = pier.mass * pier.height.powi(2) / inertias(&pier)[1];
    let errors = [80.0, 320.0]
        .map(|hz| restitution(&at_hertz(&pier, hz), 0.0975, 6.0, &held_down()) / expected - 1.0);
    println!("two-corner e {expected}, relative errors at 80 and 320 Hz {errors:?}");
    assert!(errors[1].abs() < 1e-3 && errors[1].abs() < 0.5 * errors[0].abs(), "{errors:?}");
}

/// r of theory.md, section 9, for any pier, u and velocities; and which of the two impacts happens.
#[test]
fn impacts_follow_the_formula() {
    let mut random = Random::new(3);
    let mut both = 0;
    for _ in 0..200 {
        let pier = Pier { axial: None, ..random.pier() };
        let footing_mass = pier.mass * random.within(0.1, 6.0);
        let footing_inertia = footing_mass * pier.half_width.powi(2) * random.within(0.3, 2.0);
        let pier = Pier { footing_mass, footing_inertia, ..pier };
        let (m, m_b, b, h) = (pier.mass, pier.footing_mass, pier.half_width, pier.height);
        let side = if random.happens(0.5) { 1.0 } else { -1.0 };
        let u = random.within(-0.3, 0.3) * b;
        let rate = -side * random.within(0.05, 0.5);
        // about to land: on the corner of this side, leaning to it by next to nothing
        let mut q = pier.leaning(side * 1e-9);
        q[3] = u;
        let du = random.within(-0.5, 0.5);
        let (sin, cos) = q[2].sin_cos();
        let v = DVector::from_vec(vec![side * b * sin * rate, side * b * cos * rate, rate, du]);
        let options = ReferenceOptions { duration: Some(0.01), max_events: 1, ..held_down() };
        let history = rock(&pier, ground_at_rest(0.01), (&q, &v), &options);
        let landing = &history.events[0];
        let [before, after] = &landing.velocity;
        let u = landing.q[3];
        let arm = b + side * u;
        let above = pier.footing_inertia + m_b * (pier.footing_height.powi(2) - b * b)
            - m * (b * b - u * u);
        let below =
            pier.footing_inertia + m_b * (b * b + pier.footing_height.powi(2)) + m * arm * arm;
        let r = (above / below).max(0.0);
        assert!((after[2] - r * before[2]).abs() < 1e-8 * before[2].abs(), "{r} {before} {after}");
        let sway = before[3] + h * (before[2] - after[2]);
        assert!((after[3] - sway).abs() < 1e-8 * (sway.abs() + h * before[2].abs()));
        both += usize::from(above <= 0.0);
        assert!(landing.loss() > 0.0);
    }
    assert!((20..180).contains(&both), "{both}");
}

#[test]
fn a_mirror_image_rocks_as_the_image_of_what_it_mirrors() {
    let mut random = Random::new(11);
    let accel = random.motion(600, 4.0);
    let mirrored: Vec<f64> = accel.iter().map(|a| -a).collect();
    let pier = light().with_axial(2e9, 0.02);
    let [one, other] =
        [&accel, &mirrored].map(|accel| shaken(&pier, accel, 5.99, &ReferenceOptions::default()));
    assert!(one.events.len() > 10 && one.events.len() == other.events.len());
    for (a, b) in one.q.iter().zip(&other.q) {
        for (i, sign) in [-1.0, 1.0, -1.0, -1.0, 1.0].into_iter().enumerate() {
            assert!((a[i] - sign * b[i]).abs() < 1e-9, "{a} {b}");
        }
    }
}

/// Rest: a column shortened by its load, a pier held leaning, a portal without force in its spring.
#[test]
fn structures_rest_under_their_weight() {
    let (pier, both) = (light().with_axial(4e9, 0.02), CornerSet::from_iter([0, 1]));
    let q = at_rest(&pier, &DVector::zeros(5), both, &[]).unwrap();
    assert!((&q - pier.leaning(0.0)).amax() < 1e-15, "{q}");
    let lean = pier.leaning(0.08);
    let found = at_rest(&pier, &lean, CornerSet::from_iter([1]), &[2]).unwrap();
    assert!((&found - &lean).amax() < 1e-14);
    let chord = pier.with_chord(12.0);
    let found = at_rest(&chord, &lean, CornerSet::from_iter([1]), &[2]).unwrap();
    let force = chord.force(&found, &DVector::zeros(5), [0.0; 2]);
    assert!(force.rows(3, 2).amax() < 1e-8 * force.amax(), "{force}");
    assert!((1e-6..1e-1).contains(&(found[3] / lean[3] - 1.0).abs()), "{found} {lean}");
    let portal = Portal::default();
    let four = (0..4).collect();
    assert!(at_rest(&portal, &DVector::zeros(6), four, &[]).unwrap().amax() < 1e-15);
    assert!(at_rest(&portal, &DVector::zeros(6), CornerSet::from_iter([1]), &[]).is_err());
}

/// Held corners carry the weight; one that is not held carries nothing.
#[test]
fn a_standing_structure_presses_with_its_weight() {
    let (pier, v) = (light(), DVector::zeros(4));
    let q = DVector::zeros(4);
    let at = Configuration::new(&pier, &q, &v).unwrap();
    let held =
        at.accelerations([0.0; 2], CornerContact::held(CornerSet::from_iter([0, 1]))).unwrap();
    let mass = pier.mass + pier.footing_mass;
    let weight = 9.81 * mass;
    // in whatever configuration
    for q in [q.clone(), pier.leaning(0.3)] {
        assert!((pier.whole_mass(&q) / mass - 1.0).abs() < 1e-12, "{}", pier.whole_mass(&q));
    }
    for i in 0..2 {
        assert!(
            (held.force(i)[1] / (0.5 * weight) - 1.0).abs() < 1e-12
                && held.force(i)[0].abs() < 1e-9 * weight
        );
    }
    let free = at.accelerations([0.0; 2], CornerContact::default()).unwrap();
    assert!((free.motion[1] + 9.81).abs() < 1e-12 && free.force(0) == [0.0; 2]);
}

/// A well-behaved history grows little, whatever the size of the perturbation; the growth is that
/// of the perturbed pair.
#[test]
fn growth_is_a_property_of_the_history() {
    let pier = heavy();
    let (q, v) = (pier.leaning(0.15), DVector::zeros(4));
    let options = ReferenceOptions { duration: Some(4.0), ..tight() };
    let ground = ground_at_rest(0.01);
    let history = rock(&pier, ground, (&q, &v), &options);
    let at = |d: f64| {
        growth(
            &pier,
            ground,
            (&q, &v),
            &options,
            (
                &history,
                &PerturbedPair { coordinates: &[2, 3], perturbation: d, limit: f64::INFINITY },
            ),
        )
    };
    let (fine, finer) = (at(1e-5), at(1e-6));
    assert!((fine.last() / finer.last() - 1.0).abs() < 1e-3, "{} {}", fine.last(), finer.last());
    assert!((1.0..200.0).contains(&fine.last()));
    // nothing is perturbed before the first landing
    assert_eq!(fine.samples_below(1e-9), 120);
    assert!((fine.predictable(f64::INFINITY) - 4.0).abs() < 1e-9);
}

/// A footing that flies in sideways on one corner. Of a free footing on an axially elastic column
/// W_xx = 1/m_b + h_b^2/I, W_xz = h_b b'/I, where b' is the corner's distance from the centre:
/// coming with v_x > -v_z W_xx/W_zx it would have to be pulled to stop. It slides on instead, v_z =
/// 0 by J_x = -v_z/W_zx alone; slower, it stops.
#[test]
fn a_corner_that_lands_flat_slides_on() {
    let pier = light().with_axial(4e9, 0.02);
    let lean = 0.05_f64;
    for (share, slides) in [(0.9, false), (1.1, true)] {
        let mut q = pier.leaning(lean);
        let still = DVector::zeros(q.len());
        // leaning clockwise it is lowest on its right
        q[1] += 1e-9 - pier.corner(1, &q, &still).place[1];
        let (sin, cos) = lean.sin_cos();
        // from the footing's centre to the corner
        let arm = [
            pier.half_width * cos - pier.footing_height * sin,
            -pier.half_width * sin - pier.footing_height * cos,
        ];
        let (m, inertia) = (pier.footing_mass, pier.footing_inertia);
        let (w_xx, w_xz) = (1.0 / m + arm[1] * arm[1] / inertia, -arm[0] * arm[1] / inertia);
        let down = -0.5;
        // the direction in which the ground's brake throws the corner up
        let across = -down * w_xx / w_xz * share;
        let mut v = still.clone();
        (v[0], v[1]) = (-across, down);
        let history = rock(
            &pier,
            ground_at_rest(1e-3),
            (&q, &v),
            &ReferenceOptions { duration: Some(1e-3), ..tight() },
        );
        let landing = history.landings().next().expect("it lands");
        let corner = pier.corner(1, &landing.q, &landing.velocity[1]);
        let [x, z] = corner.jacobian.each_ref().map(|row| row.dot(&landing.velocity[1]));
        let expected = if slides { -across - w_xx * down / w_xz } else { 0.0 };
        assert!(
            z.abs() < 1e-9 && (x - expected).abs() < 1e-5 * across.abs(),
            "{share}: {x} {z}, {expected}"
        );
        assert_eq!(history.first_sliding_landing_s.is_some(), slides);
        assert_eq!(landing.held.contains(1), !slides);
        assert!(landing.loss() > 0.0);
    }
}
