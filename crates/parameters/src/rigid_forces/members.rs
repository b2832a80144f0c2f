//! Forces of a rigid body's tendon and dampers: the largest on the springs of a run, and by how
//! much they change on springs of a quarter of Omega_n.
//!
//! Landings count: the body's motion stretches a tendon and moves a damper, not the springs. A
//! force that does change with them is withheld, as every other one.

use super::relative;
use crate::answers::{MemberHistory, ModelComparison};
use dynamics::fem::Demands;
use results::{DesignForce, DesignForces};
use rocking::motion::{TimedPeak, samples_until};

/// The tendon's column of a row of [`Demands`].
const TENDON: usize = 7;
/// The dampers' columns.
const DAMPERS: [usize; 2] = [8, 9];

/// Those of a run, in an otherwise empty set; samples are `dt` (s) apart. `softer`: on springs of a
/// quarter of Omega_n; forces below `least` (N) are none.
pub(super) fn member_forces(
    both: &ModelComparison,
    softer: Option<&MemberHistory>,
    (dt, least): (f64, f64),
) -> DesignForces {
    let (Some(own), Some(softer)) = (&both.with, softer) else { return DesignForces::default() };
    let ended = [own, softer].iter().any(|of| of.history.outcome.ends_early().is_some());
    let largest = |of: &MemberHistory, columns: &[usize]| {
        let samples = samples_until(of.matched.overturned_fem_s, dt);
        columns
            .iter()
            .filter_map(|&column| TimedPeak::of(dt, &column_of(&of.demands, column, samples)))
            .reduce(TimedPeak::larger)
            .unwrap_or_default()
    };
    let force = |columns: &[usize]| {
        let (found, other) = (largest(own, columns), largest(softer, columns));
        let change = relative(found.value, other.value, least).filter(|_| !ended);
        let force = DesignForce::measured(found.value, found.time, change);
        (found.value.abs() > least).then_some(force)
    };
    DesignForces {
        tendon_n: own.members.tendon.and_then(|_| force(&[TENDON])),
        damper_n: own.members.damper.and_then(|_| force(&DAMPERS)),
        ..DesignForces::default()
    }
}

/// A force over the first samples: the largest magnitude since the sample before.
fn column_of(demands: &Demands, column: usize, samples: usize) -> Vec<f64> {
    demands.rows.iter().take(samples).map(|row| row[column]).collect()
}
