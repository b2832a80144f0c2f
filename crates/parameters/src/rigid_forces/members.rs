//! Forces of a rigid body's tendon and dampers, and the tension of a leg whose damper holds its
//! foot down: the largest on the springs of a run, and by how much they change on springs of a
//! quarter of Omega_n.
//!
//! Landings count: the body's motion stretches a tendon and moves a damper, not the springs. A
//! force that does change with them is withheld, as every other one.

use super::relative;
use crate::answers::{MemberHistory, ModelComparison};
use dynamics::fem::{DAMPERS, Demands};
use results::{DamperMotion, DesignForce, DesignForces, TendonMotion};
use rocking::{
    motion::{TimedPeak, samples_until},
    structure::{Body, Kind},
};

/// The tendon's column of a row of [`Demands`].
const TENDON: usize = 7;
/// The column of what the ground and the tendon's anchor give across.
const SHEAR: usize = 0;
/// The columns of the legs' axial forces.
const AXIAL: [usize; 2] = [1, 4];

/// Those of a run, in an otherwise empty set; samples are `dt` (s) apart. `softer`: on springs of a
/// quarter of Omega_n; forces below `least` (N) are none.
pub(super) fn member_forces(
    (kind, body): (Kind, &Body<f64>),
    both: &ModelComparison,
    softer: Option<&MemberHistory>,
    (dt, least): (f64, f64),
) -> DesignForces {
    let (Some(own), Some(softer)) = (&both.with, softer) else { return DesignForces::default() };
    let ended = [own, softer].iter().any(|of| of.history.outcome.ends_early().is_some());
    type ForceSeries = fn(&Demands, usize, usize) -> Vec<f64>;
    let largest = |of: &MemberHistory, columns: &[usize], column_of: ForceSeries| {
        let samples = samples_until(of.matched.overturned_fem_s, dt);
        columns
            .iter()
            .filter_map(|&column| {
                let found = TimedPeak::of(dt, &column_of(&of.demands, column, samples))?;
                // of its step, not of the sample after it, where no fall cuts the history
                let all = of.demands.peaks[column];
                Some(if all.value == found.value { all } else { found })
            })
            .reduce(TimedPeak::larger)
            .unwrap_or_default()
    };
    let force = |columns: &[usize], of: ForceSeries| {
        let (found, other) = (largest(own, columns, of), largest(softer, columns, of));
        let change = relative(found.value, other.value, least).filter(|_| !ended);
        let force = DesignForce::measured(found.value, found.time, change);
        (found.value.abs() > least).then_some(force)
    };
    let damper = own.members.damper;
    let legs = damper.filter(|_| kind == Kind::AFrame);
    let tendon_n = own.members.tendon.and_then(|_| force(&[TENDON], column_of));
    let damper_n = damper.and_then(|_| force(&DAMPERS, column_of));
    let held = |force: Option<DesignForce>| {
        let force = force?;
        Some(TimedPeak { value: force.value?, time: force.time_s })
    };
    let rises = || {
        let samples = samples_until(own.matched.overturned_fem_s, dt);
        let rise = |theta: &f64| 2.0 * body.half_width * theta.sin().abs();
        let rises: Vec<f64> = own.history.motion.theta.iter().take(samples).map(rise).collect();
        TimedPeak::of(dt, &rises)
    };
    DesignForces {
        tendon_n,
        damper_n,
        tendon_motion: own
            .members
            .tendon
            .filter(|tendon| tendon.stiffness > 0.0)
            .and_then(|tendon| Some(TendonMotion::new(tendon, body.height, held(tendon_n)?))),
        damper_motion: damper
            .and_then(|damper| Some(DamperMotion::new(damper, held(damper_n)?, rises()?))),
        anchor_horizontal_n: own.members.tendon.and_then(|_| force(&[SHEAR], at_the_anchor)),
        axial_tension_n: legs.and_then(|_| force(&AXIAL, tension_in_the_air)),
        ..DesignForces::default()
    }
}

/// A force over the first samples: the largest magnitude since the sample before.
fn column_of(demands: &Demands, column: usize, samples: usize) -> Vec<f64> {
    demands.rows.iter().take(samples).map(|row| row[column]).collect()
}

/// The tension of a leg at the first samples while its foot alone is in the air: it hangs on its
/// damper then, and the springs do not enter.
fn tension_in_the_air(demands: &Demands, column: usize, samples: usize) -> Vec<f64> {
    let leg = usize::from(column == AXIAL[1]);
    let hangs = |feet: &[[f64; 2]; 2]| feet[leg][1] <= 0.0 && feet[1 - leg][1] > 0.0;
    let all = demands.at.iter().zip(&demands.feet).take(samples);
    all.map(|(row, feet)| if hangs(feet) { row[column].max(0.0) } else { 0.0 }).collect()
}

/// The horizontal force of the tendon on the body at the first samples: what of a row's shear the
/// soles do not give.
fn at_the_anchor(demands: &Demands, column: usize, samples: usize) -> Vec<f64> {
    let all = demands.at.iter().zip(&demands.feet).take(samples);
    all.map(|(row, [left, right])| row[column] - left[0] - right[0]).collect()
}
