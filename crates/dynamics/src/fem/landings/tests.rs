use super::*;

const LEFT: usize = 0;
const RIGHT: usize = 1;

/// Events from (time, foot, down), a moment of 0.25 s, both feet pressing at first; 1 J is lost
/// every second.
fn read(changes: &[(f64, usize, bool)], end: f64) -> (Vec<Landing>, f64) {
    at_speeds(changes, |_| 0.0).landings(end, end)
}

/// The same of a body with this speed at a time.
fn at_speeds(changes: &[(f64, usize, bool)], speed: impl Fn(f64) -> f64) -> Events {
    let event = |&(time, foot, down): &(f64, usize, bool)| ContactEvent {
        time,
        foot,
        change: if down { Change::TouchDown } else { Change::LiftOff },
        kinetic: 100.0 - time,
        speed: speed(time),
        lost: time,
    };
    let events = changes.iter().map(event).collect();
    Events { events, pressing: [true; 2], moment: 0.25, slight: 50.0 }
}

fn impacts_of(events: &Events, end: f64) -> Vec<(f64, usize)> {
    events.landings(end, end).0.iter().filter(|l| l.impact).map(|l| (l.time, l.foot)).collect()
}

/// Speed of a body that leans on its left foot to 2.02 s, on the right one to 2.12 s, and then
/// on the left.
fn shaken(time: f64) -> f64 {
    if (1.5..2.06).contains(&time) || time > 2.5 { 1.0 } else { -1.0 }
}

/// A lean of 0.1 s on the right foot between two long ones on the left.
const SHAKEN: [(f64, usize, bool); 6] = [
    (1.0, RIGHT, false),
    (2.0, RIGHT, true),
    (2.02, LEFT, false),
    (2.12, LEFT, true),
    (2.13, RIGHT, false),
    (3.0, RIGHT, true),
];

#[test]
fn a_body_shaken_hard_leans_for_less_than_a_moment() {
    let events = at_speeds(&SHAKEN, shaken);
    assert_eq!(impacts_of(&events, 9.0), [(2.0, RIGHT), (2.12, LEFT), (3.0, RIGHT)]);
    // it has not turned back, or falls slightly: chatter
    assert_eq!(impacts(&SHAKEN, 9.0), [(3.0, RIGHT)]);
    let slight = Events { slight: 99.0, ..events };
    assert_eq!(impacts_of(&slight, 9.0), [(3.0, RIGHT)]);
}

#[test]
fn a_foot_that_stops_a_fall_and_opens_again_has_landed() {
    let changes =
        [(1.0, RIGHT, false), (2.0, RIGHT, true), (2.1, RIGHT, false), (3.0, RIGHT, true)];
    assert_eq!(impacts_of(&at_speeds(&changes, shaken), 9.0), [(2.0, RIGHT), (3.0, RIGHT)]);
    assert_eq!(impacts(&changes, 9.0), [(3.0, RIGHT)]);
}

#[test]
fn the_history_s_end_is_no_impact_of_the_lean_it_cuts_short() {
    let changes = rocking_with(3.., [(2.03, LEFT, true), (2.04, LEFT, false)]);
    assert_eq!(impacts(&changes, 2.1), [(2.0, RIGHT)]);
    assert_eq!(impacts(&changes, 2.5), [(2.0, RIGHT)]);
}

fn impacts(changes: &[(f64, usize, bool)], end: f64) -> Vec<(f64, usize)> {
    impacts_of(&at_speeds(changes, |_| 0.0), end)
}

/// Leans on the left foot from 1 s, lands on the right at 2 s, leans on it from 2.01 s, lands
/// on the left at 3 s.
const ROCKING: [(f64, usize, bool); 4] =
    [(1.0, RIGHT, false), (2.0, RIGHT, true), (2.01, LEFT, false), (3.0, LEFT, true)];
/// Its impacts.
const LANDED: [(f64, usize); 2] = [(2.0, RIGHT), (3.0, LEFT)];

/// The same, with other changes in place of some.
fn rocking_with<const N: usize>(
    place: impl std::ops::RangeBounds<usize>,
    by: [(f64, usize, bool); N],
) -> Vec<(f64, usize, bool)> {
    let mut changes = ROCKING.to_vec();
    changes.splice(place, by);
    changes
}

#[test]
fn every_lean_ends_in_an_impact_even_the_last_before_rest() {
    assert_eq!(impacts(&ROCKING, 9.0), LANDED);
    let (landings, airborne) = read(&ROCKING, 9.0);
    assert_eq!(landings.iter().map(|l| l.lost).collect::<Vec<_>>(), [1.0, 6.0]);
    assert_eq!(landings[0].kinetic, 98.0);
    assert!(landings.iter().all(|l| !l.bounced));
    assert_eq!(airborne, 0.0);
}

#[test]
fn a_foot_that_chatters_a_hundred_thousand_times_is_read_in_a_moment() {
    let mut changes = ROCKING.to_vec();
    let chatter = (0..100_000).flat_map(|i| {
        let time = 2.02 + 1e-6 * f64::from(i);
        [(time, RIGHT, false), (time + 5e-7, RIGHT, true)]
    });
    changes.splice(3..3, chatter);
    assert_eq!(impacts(&changes, 9.0), LANDED);
    assert_eq!(read(&changes, 9.0).0.iter().filter(|l| l.bounced).count(), 100_000);
}

#[test]
fn a_bouncing_foot_lands_once() {
    let changes = rocking_with(
        3..3,
        [(2.02, RIGHT, false), (2.05, RIGHT, true), (2.06, RIGHT, false), (2.07, RIGHT, true)],
    );
    assert_eq!(impacts(&changes, 9.0), LANDED);
    let (landings, airborne) = read(&changes, 9.0);
    assert_eq!(landings.iter().map(|l| l.bounced).collect::<Vec<_>>(), [true, true, false, false]);
    assert!((airborne - 0.04).abs() < 1e-15 && (landings[0].airborne - 0.04).abs() < 1e-15);
}

#[test]
fn a_foot_that_bounces_before_the_other_lifts_landed_at_its_first_touch() {
    let changes = rocking_with(2..2, [(2.002, RIGHT, false), (2.006, RIGHT, true)]);
    assert_eq!(impacts(&changes, 9.0), LANDED);
    assert!(read(&changes, 9.0).0[0].bounced);
}

#[test]
fn the_old_foot_touching_again_is_no_impact_and_no_bounce() {
    let changes = rocking_with(3..3, [(2.03, LEFT, true), (2.05, LEFT, false)]);
    assert_eq!(impacts(&changes, 9.0), LANDED);
    assert!(read(&changes, 9.0).0.iter().all(|l| !l.bounced));
}

#[test]
fn a_body_that_turns_back_within_its_lean_has_no_impact() {
    let changes = rocking_with(1..1, [(1.4, RIGHT, true), (1.43, RIGHT, false)]);
    assert_eq!(impacts(&changes, 9.0), LANDED);
    assert!(!read(&changes, 9.0).0[0].bounced);
}

#[test]
fn a_rest_between_two_leans_on_one_foot_is_an_impact() {
    let changes =
        [(1.0, RIGHT, false), (2.0, RIGHT, true), (4.0, RIGHT, false), (5.0, RIGHT, true)];
    assert_eq!(impacts(&changes, 9.0), [(2.0, RIGHT), (5.0, RIGHT)]);
}

#[test]
fn a_landing_out_of_the_air_is_an_impact() {
    let changes = [(1.0, RIGHT, false), (1.98, LEFT, false), (2.0, RIGHT, true), (3.0, LEFT, true)];
    assert_eq!(impacts(&changes, 9.0), LANDED);
    let (landings, airborne) = read(&changes, 9.0);
    assert!((airborne - 0.02).abs() < 1e-15);
    assert!(landings.iter().all(|l| l.airborne == 0.0), "the flight comes before the first impact");
}

#[test]
fn a_flutter_of_the_standing_body_is_no_impact() {
    let changes =
        [(1.0, RIGHT, false), (1.02, RIGHT, true), (1.5, LEFT, false), (1.53, LEFT, true)];
    assert_eq!(impacts(&changes, 9.0), []);
}
