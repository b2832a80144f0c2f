//! Energy: never made, and accounted for; histories that are hard to follow.

use frames::{
    Mechanics,
    reference::{
        Configuration, CornerContact, CornerSet, ElasticRocking, GroundAcceleration,
        ReferenceEvent, ReferenceOptions, ReferenceOutcome, What, at_rest, rock,
    },
};
use nalgebra::DVector;
use rocking::scalar::GRAVITY;

use crate::portal::Portal;
use crate::random::{Random, slenderness};

fn weight(structure: &impl Mechanics, q: &DVector<f64>) -> f64 {
    GRAVITY * structure.whole_mass(q)
}

/// Closed account; no landing that adds energy; no corner below the ground; nobody pulled.
fn assert_sound(structure: &impl Mechanics, history: &ElasticRocking, name: &str) {
    // of a structure that never moves, what lifting it by a micrometre takes
    let scale = history.ledger.largest.max(1e-6 * weight(structure, &history.q[0]));
    assert!(
        !matches!(history.outcome, ReferenceOutcome::Stopped { .. }),
        "{name}: {:?}",
        history.outcome
    );
    assert!(history.ledger.open < 1e-6 * scale, "{name}: {:?}", history.ledger);
    assert!(
        history.ledger.damped >= 0.0 && history.ledger.slid >= -1e-12 * scale,
        "{name}: {:?}",
        history.ledger
    );
    for event in &history.events {
        assert!(event.loss() >= -1e-12 * scale, "{name}: {event:?}");
    }
    assert!(
        history.pulled <= 1e-6 * weight(structure, &history.q[0]),
        "{name}: {}",
        history.pulled
    );
    for (q, v) in history.q.iter().zip(&history.v) {
        for i in 0..structure.footings().len() {
            assert!(
                structure.corner(i, q, v).place[1] > -1e-9,
                "{name}: corner {i} below the ground"
            );
        }
    }
}

/// The ground only pushes: forces at the samples, and the impulses of a landing.
fn assert_pushed(structure: &impl Mechanics, history: &ElasticRocking, name: &str) {
    let weight = weight(structure, &history.q[0]);
    for force in history.forces.iter().flatten() {
        assert!(force[1] > -1e-8 * weight, "{name}: {force:?}");
    }
    for event in history.landings() {
        assert_plastic(structure, event, name);
    }
}

/// Velocities after a landing: held corners at rest, others not into the ground, corners that
/// stayed pushed; nothing else has acted.
fn assert_plastic(structure: &impl Mechanics, event: &ReferenceEvent, name: &str) {
    let [before, after] = &event.velocity;
    let speed = before.amax();
    let at = Configuration::new(structure, &event.q, before).unwrap();
    let skids = |&i: &usize| {
        let corner = structure.corner(i, &event.q, before);
        !event.held.contains(i) && corner.jacobian[1].dot(after).abs() < 1e-9 * speed
    };
    let sliding: CornerSet = event.corners.iter().filter(skids).collect();
    let impact = if sliding.is_empty() {
        at.impact(CornerContact::held(event.held)).unwrap()
    } else {
        let braked = at.braked(CornerContact { held: event.held, sliding }).unwrap();
        for i in sliding.iter() {
            // the ground brakes it, and would have to pull to stop it
            assert!(
                at.velocity(i, &braked.motion)[0] * braked.force(i)[0] <= 0.0,
                "{name}: {event:?}"
            );
            let stopped = at.impact(CornerContact::held(event.held.with(i))).unwrap();
            assert!(stopped.force(i)[1] < 0.0, "{name}: {event:?}");
        }
        braked
    };
    assert!((&impact.motion - after).amax() < 1e-7 * speed, "{name}: {event:?}");
    let largest = impact
        .forces
        .iter()
        .flat_map(|(_, force)| force)
        .fold(0.0, |most: f64, force| most.max(force.abs()));
    for i in 0..structure.footings().len() {
        let corner = structure.corner(i, &event.q, before);
        if event.held.contains(i) {
            assert!(
                corner.jacobian.iter().all(|row| row.dot(after).abs() < 1e-9 * speed),
                "{name}: {event:?}"
            );
            // where a row of hops is ended, the last one is stopped: what some 1e-5 m/s and rad/s
            // take
            let rounding = 1e-6 * largest + 1e-5 * structure.whole_mass(&event.q);
            assert!(
                event.corners.contains(i) || impact.force(i)[1] > -rounding,
                "{name}: pulled {event:?}"
            );
        } else if corner.place[1].abs() < 1e-12 {
            assert!(corner.jacobian[1].dot(after) > -1e-8 * speed, "{name}: {event:?}");
        }
    }
}

/// Random piers, hops and sliding and all.
#[test]
fn energy_never_grows_in_random_piers() {
    let mut random = Random::new(1);
    let (mut events, mut hops, mut slips) = (0, 0, 0);
    for case in 0..40 {
        let pier = random.pier();
        let [accel, vertical] = random.shake(slenderness(&pier), 601);
        let (q, v) = (
            at_rest(&pier, &DVector::zeros(pier.size()), (0..2).collect(), &[]).unwrap(),
            DVector::zeros(pier.size()),
        );
        let ground = GroundAcceleration { dt: 0.01, accel: &accel, vertical: &vertical };
        let history = rock(&pier, ground, (&q, &v), &ReferenceOptions::default());
        assert_sound(&pier, &history, &format!("case {case}"));
        assert_pushed(&pier, &history, &format!("case {case}"));
        events += history.events.len();
        hops += history
            .events
            .iter()
            .filter(|event| event.what == What::Lift && event.held.is_empty())
            .count();
        slips += history.events.iter().filter(|event| event.what == What::Slip).count();
    }
    println!("{events} events, {hops} hops, {slips} slips");
    assert!(events > 1000 && hops > 50 && slips > 20);
}

/// Four corners on two footings: landings of one while the other stands, rocks or flies.
#[test]
fn energy_never_grows_in_random_portals() {
    let mut random = Random::new(2);
    let mut held: Vec<CornerSet> = Vec::new();
    for case in 0..16 {
        let portal = Portal {
            head: random.within(1e4, 2e5),
            link: random.within(0.0, 3e5),
            footings: [0, 1].map(|_| random.within(1e4, 3e5)),
            height: random.within(3.0, 12.0),
            stiffness: 10_f64.powf(random.within(5.5, 8.0)),
            damping: 10_f64.powf(random.within(4.0, 6.0)),
            ..Portal::default()
        };
        let [accel, vertical] = random.shake(portal.half_width / portal.height, 601);
        let ground = GroundAcceleration { dt: 0.01, accel: &accel, vertical: &vertical };
        let start = DVector::zeros(6);
        let history = rock(&portal, ground, (&start, &start), &ReferenceOptions::default());
        assert_sound(&portal, &history, &format!("case {case}"));
        assert_pushed(&portal, &history, &format!("case {case}"));
        held.extend(history.landings().map(|event| event.held));
    }
    // one footing lands while the other flies, rocks or stands
    for corners in 2..=4 {
        assert!(held.iter().any(|set| set.len() == corners), "never held {corners} corners");
    }
    held.sort_by_key(|set| set.iter().collect::<Vec<_>>());
    held.dedup();
    assert!(held.len() >= 8, "{held:?}");
}

/// Alike legs, alike shaken, with a soft spring: no difference between the footings.
#[test]
fn both_footings_of_a_symmetrical_portal_land_at_once() {
    let portal = Portal::default();
    let mut random = Random::new(5);
    let accel = random.motion(601, 9.0);
    let start = DVector::zeros(6);
    let history = rock(
        &portal,
        GroundAcceleration::horizontal(0.01, &accel),
        (&start, &start),
        &ReferenceOptions::default(),
    );
    assert!(history.landings().count() > 4);
    for q in &history.q {
        for i in 0..3 {
            assert!((q[i] - q[i + 3]).abs() < 1e-7, "{q}");
        }
    }
}

/// Heavy wide footings land many times on the way to rest: a row of hops without end is ended.
#[test]
fn rocking_comes_to_rest() {
    for pier in
        [crate::piers::heavy(), crate::piers::heavy().with_axial(8e9, 0.02), crate::piers::light()]
    {
        let history = crate::piers::free_rocking(&pier, 0.02, 20.0, &ReferenceOptions::default());
        assert_eq!(history.outcome, ReferenceOutcome::Completed);
        assert!(history.events.len() < 2000, "{}", history.events.len());
        assert_eq!(history.events.last().map(|event| event.held.len()), Some(2));
        assert!(history.q.last().is_some_and(|q| q[2].abs() < 1e-12));
    }
}

/// Outcomes are typed.
#[test]
fn a_history_ends_in_one_of_three_ways() {
    let pier = crate::piers::light();
    let hard = vec![6.0; 501];
    let outcome = crate::piers::shaken(&pier, &hard, 5.0, &ReferenceOptions::default()).outcome;
    assert!(matches!(outcome, ReferenceOutcome::Overturned { time } if time > 0.5), "{outcome:?}");
    let few = ReferenceOptions { max_events: 2, ..ReferenceOptions::default() };
    let history = crate::piers::free_rocking(&pier, 0.0975, 5.0, &few);
    assert!(
        matches!(history.outcome, ReferenceOutcome::Stopped { .. }) && history.events.len() == 3
    );
    assert!(history.q.len() < 300);
}
