//! Forces of a rigid body to design with: those of Housner's body, which no spring enters, beside
//! the same on springs.
//!
//! ```text
//!   F, N            horizontal and vertical force of the ground on the body (`regime`), at each corner with its dashpot's
//!   block           column shear F, axial force -N, moment about the middle of the base (N_left - N_right) b
//!   A-frame         of a leg, D from the mass to its foot:  axial (H, N).D/|D|,  moment at the apex H D_z - N D_x,
//!                   shear moment/|D|;  standing, both feet take F/2:  moment W b/2
//! ```
//!
//! An impact's impulse is not among them. On springs alone, near a touch-down, the body bears what
//! equation (1) says of its motion, or what it bears standing. A force holds if, later than 0.1/p
//! after every touch-down, its largest value on the springs is within 5 % of Housner's.

mod ground_row;
mod members;
mod near_landings;

use self::{
    ground_row::{GroundRow, standing_feet},
    members::member_forces,
    near_landings::near_landings,
};
use crate::answers::{MemberHistory, ModelComparison};
use dynamics::compare::Match;
use dynamics::fem::{Demands, History, between_landings, corner_forces};
use frames::design_forces::{ForcesTogether, HeldForce};
use results::{DesignForce, DesignForces};
use rocking::{
    housner::Rocking,
    motion::{TimedPeak, samples_until},
    regime::{self, ground_forces},
    scalar::GRAVITY,
    structure::{Body, Kind},
};
use strong_motion::Record;

/// The forces of a run. Where Housner's body cannot tell them, with members or beyond the end of
/// his solution, they are those of the history on springs, which `softer` follows on springs of a
/// quarter of Omega_n. `foretold_s`: up to when his history can be foretold (s), if that is not its
/// end.
pub fn design_forces(
    kind: Kind,
    body: &Body<f64>,
    record: &Record,
    both: &ModelComparison,
    softer: Option<&MemberHistory>,
    foretold_s: Option<f64>,
) -> DesignForces {
    let dt = record.dt;
    let until =
        |times: [Option<f64>; 2]| samples_until(times.into_iter().flatten().reduce(f64::min), dt);
    let least = ROUNDING * body.mass * GRAVITY * body.radius().min(1.0);
    let (sole, mut rows) = match softer {
        Some(softer) => {
            let peaks = |matched: &Match, history: &History, demands: &Demands| {
                let samples = until([matched.overturned_fem_s, None]).min(history.motion.len());
                let kept = all_between(body, dt, history, samples);
                let mut peaks = on_springs(kind, body, dt, demands, &kept);
                let with = both.with.as_ref().map(|with| &with.members);
                let near = near_landings((kind, body), record, (history, demands), &kept, with);
                let near = near.iter().filter(|(i, _)| *i < samples);
                near.for_each(|(i, row)| row.raise(*i as f64 * dt, &mut peaks));
                peaks
            };
            let own = match &both.with {
                Some(with) => peaks(&with.matched, &with.history, &with.demands),
                None => peaks(&both.matched, &both.fem, &both.demands),
            };
            let ends = [both.answer(), &softer.history].map(|of| of.outcome.ends_early());
            let other = peaks(&softer.matched, &softer.history, &softer.demands);
            let force = |k: usize| {
                let change =
                    relative(own[k].value, other[k].value, least).filter(|_| ends == [None; 2]);
                with_together((own[k], change), (kind, body), dt, both, k)
            };
            (force(0), [1, 2, 3].map(force))
        }
        None => {
            let samples = until([both.matched.overturned_housner_s, both.matched.overturned_fem_s]);
            let housner = of_housner(kind, body, record, &both.rocking, samples);
            let kept = all_between(body, dt, &both.fem, samples.min(housner.len()));
            let springs = on_springs(kind, body, dt, &both.demands, &kept);
            let force = |k: usize| {
                let series: Vec<f64> = housner.iter().map(|row| row.largest(k)).collect();
                let all = TimedPeak::of(dt, &series).unwrap_or_default();
                let same = kept.iter().map(|&i| series[i].abs()).fold(0.0, f64::max);
                let change = relative(same, springs[k].value, least);
                let row = housner.get((all.time / dt).round() as usize);
                let together = row.map(|row| row.together(kind, k));
                let found = DesignForce::measured(all.value, all.time, change);
                let held = foretold_s.filter(|until| found.holds && all.time > *until);
                let held = held.and_then(|over_s| {
                    let part = &series[..samples_until(Some(over_s), dt).min(series.len())];
                    Some(HeldForce { value: TimedPeak::of(dt, part)?.value, over_s })
                });
                // no thrust between feet: a leg's shear and moment are those of its own weight,
                // which a vertical motion makes more
                let own = kind == Kind::AFrame
                    && row.is_some_and(|row| row.stands)
                    && [1, 2].contains(&k);
                let at_rest = Some(all.value).filter(|_| own);
                DesignForce { together, held, at_rest, rigid: Some(all.value), ..found }
            };
            (force(0), [1, 2, 3].map(force))
        }
    };
    let at_rest = GroundRow::new(kind, body, 0.0, [[0.0, 0.5 * body.mass * GRAVITY]; 2]);
    if kind == Kind::AFrame {
        for (force, k) in rows.iter_mut().zip(1..) {
            force.at_rest = force.at_rest.or(Some(at_rest.largest(k)));
        }
    }
    let [shear, moment, axial] = rows.map(Some);
    let of_members = member_forces(kind, both, softer, (dt, least));
    let all = DesignForces { column_shear_n: shear, axial_n: axial, ..of_members };
    match kind {
        Kind::Block => DesignForces { column_base_moment_nm: moment, ..all },
        Kind::AFrame => DesignForces { apex_moment_nm: moment, sole_shear_n: Some(sole), ..all },
    }
}

/// Force k, as [`DesignForce::measured`]; if it holds, with what acts together with it.
fn with_together(
    (peak, change): (TimedPeak, Option<f64>),
    of: (Kind, &Body<f64>),
    dt: f64,
    both: &ModelComparison,
    k: usize,
) -> DesignForce {
    let found = DesignForce::measured(peak.value, peak.time, change);
    let together = together_at(of, dt, both, (k, found.time_s)).filter(|_| found.holds);
    DesignForce { together, ..found }
}

/// What acts together with force k, at a time (s) at which the history that answers presses with
/// one foot alone, and springs add nothing.
fn together_at(
    (kind, body): (Kind, &Body<f64>),
    dt: f64,
    both: &ModelComparison,
    (k, time): (usize, f64),
) -> Option<ForcesTogether> {
    let (history, demands) = match &both.with {
        Some(with) => (&with.history, &with.demands),
        None => (&both.fem, &both.demands),
    };
    let i = (time / dt).round() as usize;
    let alone = demands.feet.get(i)?.iter().any(|[_, press]| *press <= 0.0);
    let theta = *history.motion.theta.get(i)?;
    let kept = all_between(body, dt, history, demands.feet.len());
    (alone && kept.binary_search(&i).is_ok())
        .then(|| GroundRow::new(kind, body, theta, corner_forces(demands, i)).together(kind, k))
}

/// A share of the weight below which a force is rounding.
const ROUNDING: f64 = 1e-9;

/// How far two magnitudes are from each other; none where there is nothing to compare. `least` is
/// rounding.
fn relative(value: f64, other: f64, least: f64) -> Option<f64> {
    if value.abs().max(other.abs()) < least {
        return Some(0.0);
    }
    (value != 0.0)
        .then(|| (other.abs() / value.abs() - 1.0).abs())
        .filter(|change| change.is_finite())
}

/// Samples that no landing on springs is near to.
fn all_between(body: &Body<f64>, dt: f64, history: &History, samples: usize) -> Vec<usize> {
    between_landings(body, dt, &history.landings, samples.min(history.motion.len())).collect()
}

/// Forces, sample by sample, of Housner's body.
fn of_housner(
    kind: Kind,
    body: &Body<f64>,
    record: &Record,
    rocking: &Rocking<f64>,
    samples: usize,
) -> Vec<GroundRow> {
    let forces = ground_forces(body, (&record.accel, record.up()), rocking);
    let row = |(i, (f, n)): (usize, (f64, f64))| {
        let (theta, rate) = (rocking.theta[i], rocking.rate[i]);
        let at = |record: &[f64]| record.get(i).copied().unwrap_or(0.0) / GRAVITY;
        let ground = (at(&record.accel), 1.0 + at(record.up()));
        let rests = theta == 0.0 && rate == 0.0;
        let stands = rests && regime::stands(body, ground);
        // forces of the left foot and of the right one
        let feet = if stands {
            standing_feet(body, body.mass * GRAVITY, ground)
        } else if theta > 0.0 || (theta == 0.0 && rate > 0.0) || (rests && ground.0 < 0.0) {
            [[0.0; 2], [f, n]]
        } else {
            [[f, n], [0.0; 2]]
        };
        GroundRow { stands, ..GroundRow::new(kind, body, theta, feet) }
    };
    forces.into_iter().enumerate().take(samples).map(row).collect()
}

/// Largest shear at the sole, column shear, moment and axial force of a history on springs, at
/// these samples: between them springs ring after a foot stops or slips, by as much whatever their
/// stiffness.
fn on_springs(
    kind: Kind,
    body: &Body<f64>,
    dt: f64,
    demands: &Demands,
    kept: &[usize],
) -> [TimedPeak; 4] {
    let mut peaks = [TimedPeak::default(); 4];
    for &i in kept {
        let row = &demands.at[i];
        let stands = demands.feet[i].iter().all(|foot| foot[1] > 0.0);
        let [[left_h, left], [right_h, right]] = corner_forces(demands, i);
        // pressing with both feet it does not turn, and what its springs swing by is not its own
        let moment = match stands {
            true => (left_h + right_h) * body.height,
            false => (left - right) * body.half_width,
        };
        // each is that of one instant
        let all = match kind {
            Kind::AFrame => [2, 3, 1]
                .map(|k| if row[k].abs() >= row[k + 3].abs() { row[k] } else { row[k + 3] }),
            Kind::Block => [row[0], moment, -(left + right)],
        };
        for (peak, value) in peaks.iter_mut().zip([row[0], all[0], all[1], all[2]]) {
            if value.abs() > peak.value.abs() {
                *peak = TimedPeak { value, time: i as f64 * dt };
            }
        }
    }
    peaks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::{both, with_members};
    use dynamics::spring::{Design, Springs};
    use rocking::{
        members::{Damper, Members},
        structure::Structure,
    };

    /// The moment among the forces.
    const MOMENT: usize = 2;

    fn forces(structure: &Structure, hz: f64, accel: Vec<f64>) -> DesignForces {
        let record = Record::new("made up", 0.01, accel).unwrap();
        let design = Design::from_kc(0.3, 0.1, 0.75, hz);
        let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
        let body = structure.body();
        let both = both(&body, body.restitution(), &springs, &Members::default(), &record);
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
        assert!(
            (with.column_shear_n * length / apex.value.unwrap() - 1.0).abs() < 1e-9,
            "{with:?}"
        );
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
            let both = both(&body, e, &springs, &members, &record);
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
        assert!(pull > 3e5 && all.damper_n.unwrap().value.unwrap().abs() > pull);
        let block = Structure::block(18.0, 2.2, 110e3).unwrap();
        let (all, both) = with(&block, 3e5);
        let with = both.with.as_ref().unwrap();
        let (body, demands) = (block.body::<f64>(), &with.demands);
        let kept = all_between(&body, 0.01, &with.history, demands.feet.len());
        let peaks = on_springs(Kind::Block, &body, 0.01, demands, &kept);
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
        let together = together_at((Kind::Block, &body), 0.01, &both, (MOMENT, time)).unwrap();
        assert!((together.axial_n / -axial - 1.0).abs() < 1e-9, "{together:?} {axial}");
        // near landings, too: (N + d) b of Housner's body with dampers
        let rocking = with.rocking.as_ref().unwrap();
        let moment = |i: usize| {
            let (theta, rate, side) =
                (rocking.theta[i], rocking.rate[i], rocking.theta[i].signum());
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
}
