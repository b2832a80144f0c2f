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
mod sliding;
mod together;

use self::{
    ground_row::{FORCES, GroundRow, standing_feet},
    members::member_forces,
    near_landings::near_landings,
    sliding::upright,
    together::{ForceInstants, FoundForces},
};
use crate::answers::{MemberHistory, ModelComparison};
use dynamics::compare::Match;
use dynamics::fem::{Demands, History, between_landings, corner_forces};
use frames::design_forces::HeldForce;
use results::{DesignForce, DesignForces};
use rocking::{
    housner::Rocking,
    members::Friction,
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
    let least = ROUNDING * body.mass * GRAVITY * body.radius().min(1.0);
    let of = (kind, body);
    let [sole, shear, moment, axial, vertical, horizontal] = match softer {
        Some(softer) => of_springs(of, record, both, softer, least),
        None => beside_springs(of, record, both, foretold_s, least),
    };
    let mut rows = [shear, moment, axial];
    // a tendon presses on the mass as weight does
    let held = both.with.as_ref().and_then(|with| with.members.tendon);
    let pressed = body.mass * GRAVITY + held.map_or(0.0, |tendon| tendon.pretension);
    let at_rest = GroundRow::new(kind, body, 0.0, [[0.0, 0.5 * pressed]; 2]);
    if kind == Kind::AFrame {
        for (force, k) in rows.iter_mut().zip(1..) {
            force.at_rest = force.at_rest.or(Some(at_rest.largest(k)));
        }
    }
    let [shear, moment, axial] = rows.map(Some);
    let of_members = member_forces(of, both, softer, (dt, least));
    let all = DesignForces {
        column_shear_n: shear,
        axial_n: axial,
        corner_vertical_n: Some(vertical),
        corner_horizontal_n: Some(horizontal),
        ..of_members
    };
    match kind {
        Kind::Block => DesignForces { column_base_moment_nm: moment, ..all },
        Kind::AFrame => DesignForces { apex_moment_nm: moment, sole_shear_n: Some(sole), ..all },
    }
}

/// Those of the history on springs that answers, in the order of [`GroundRow::largest`]; `softer`:
/// on springs of a quarter of Omega_n; forces below `least` (N) are none.
fn of_springs(
    (kind, body): (Kind, &Body<f64>),
    record: &Record,
    both: &ModelComparison,
    softer: &MemberHistory,
    least: f64,
) -> [DesignForce; FORCES] {
    let dt = record.dt;
    let peaks = |matched: &Match, history: &History, demands: &Demands| {
        let samples = samples_until(matched.overturned_fem_s, dt).min(history.motion.len());
        let kept = all_between(body, dt, history, samples);
        let with = both.with.as_ref().map(|with| &with.members);
        let friction = with.and_then(|with| with.friction);
        let mut peaks = on_springs((kind, body), dt, demands, &kept, friction);
        let near = near_landings((kind, body), record, (history, demands), &kept, with);
        let counted = near.iter().filter(|(i, _)| *i < samples);
        counted.for_each(|(i, row)| row.raise(*i as f64 * dt, &mut peaks));
        FoundForces { peaks, near }
    };
    let own = match &both.with {
        Some(with) => peaks(&with.matched, &with.history, &with.demands),
        None => peaks(&both.matched, &both.fem, &both.demands),
    };
    let ends = [both.answer(), &softer.history].map(|of| of.outcome.ends_early());
    let other = peaks(&softer.matched, &softer.history, &softer.demands);
    let instants = ForceInstants::new((kind, body), record, both, &own.near);
    let force = |k: usize| {
        let [own, other] = [own.peaks[k], other.peaks[k]];
        let change = relative(own.value, other.value, least);
        instants.force(k, own, change.filter(|_| ends == [None; 2]))
    };
    std::array::from_fn(force)
}

/// Those of Housner's body, beside the same on springs.
fn beside_springs(
    (kind, body): (Kind, &Body<f64>),
    record: &Record,
    both: &ModelComparison,
    foretold_s: Option<f64>,
    least: f64,
) -> [DesignForce; FORCES] {
    let dt = record.dt;
    let fell = [both.matched.overturned_housner_s, both.matched.overturned_fem_s];
    let samples = samples_until(fell.into_iter().flatten().reduce(f64::min), dt);
    let housner = of_housner(kind, body, record, &both.rocking, samples);
    let kept = all_between(body, dt, &both.fem, samples.min(housner.len()));
    let springs = on_springs((kind, body), dt, &both.demands, &kept, None);
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
        let own = kind == Kind::AFrame && row.is_some_and(|row| row.stands) && [1, 2].contains(&k);
        let at_rest = Some(all.value).filter(|_| own);
        let corner = row.and_then(|row| row.corner(k));
        DesignForce { together, corner, held, at_rest, rigid: Some(all.value), ..found }
    };
    std::array::from_fn(force)
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

/// Largest shear at the sole, column shear, moment and axial force, and forces at one corner, of a
/// history on springs, at these samples: between them springs ring after a foot stops or slips, by
/// as much whatever their stiffness.
fn on_springs(
    (kind, body): (Kind, &Body<f64>),
    dt: f64,
    demands: &Demands,
    kept: &[usize],
    friction: Option<Friction>,
) -> [TimedPeak; FORCES] {
    let mut peaks = [TimedPeak::default(); FORCES];
    for &i in kept {
        let slid = friction.and_then(|friction| upright(kind, body, friction, demands.feet[i]));
        if let Some(row) = slid {
            row.raise(i as f64 * dt, &mut peaks);
            continue;
        }
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
            Kind::Block => [left_h + right_h, moment, -(left + right)],
        };
        let corners = GroundRow::new(kind, body, 0.0, demands.feet[i]);
        let [vertical, horizontal] = [4, 5].map(|k| corners.largest(k));
        let shear = left_h + right_h;
        for (peak, value) in
            peaks.iter_mut().zip([shear, all[0], all[1], all[2], vertical, horizontal])
        {
            if value.abs() > peak.value.abs() {
                *peak = TimedPeak { value, time: i as f64 * dt };
            }
        }
    }
    peaks
}

#[cfg(test)]
mod tests;
