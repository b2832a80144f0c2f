//! `members.csv` of an elastic structure.

use super::ElasticRun;
use crate::tables::{Instants, csv_row};
use frames::fem::GroundForces;

/// `members.csv` or `members_envelopes.csv`; axial forces are positive in tension, as in
/// `BeamForces`; the base shear is all that the ground gives across, footings' inertia included, as
/// of a rigid body.
pub(super) fn csv(run: &ElasticRun, instants: Instants) -> String {
    let fem = &run.answer.histories.fem;
    let mut head = vec!["t".to_string(), "base_shear_n".into()];
    for i in 1..=run.assembled.frame.beams() {
        let names = ["axial", "shear", "moment_start", "moment_end"];
        let units = ["n", "n", "nm", "nm"];
        head.extend(names.iter().zip(units).map(|(name, unit)| format!("beam_{i}_{name}_{unit}")));
    }
    let standing = fem.demands.first();
    let members = standing.map_or([0; 2], |demand| [demand.tendons.len(), demand.dampers.len()]);
    for (name, count) in ["tendon", "damper"].into_iter().zip(members) {
        head.extend((1..=count).map(|i| format!("{name}_{i}_n")));
    }
    for i in 1..=fem.forces.len() {
        head.extend([format!("corner_{i}_horizontal_n"), format!("corner_{i}_vertical_n")]);
    }
    head.push("ground_vertical_n".into());
    let filtered = run.bearing.below_hz.map_or("mean".into(), |hz| format!("below_{hz}_hz"));
    head.push(format!("ground_vertical_{filtered}_n"));
    let mut out = head.join(",") + "\n";
    let at_samples = instants == Instants::Samples;
    let demands = if at_samples { &fem.demands } else { &fem.worst };
    let of =
        |forces: &GroundForces, i: usize| if at_samples { forces.at[i] } else { forces.peak[i] };
    for (i, demand) in demands.iter().enumerate() {
        let mut row = vec![i as f64 * run.record.dt];
        row.push(of(&fem.ground, i)[0]);
        // the first is what columns bear at their bases
        row.extend(demand.values().skip(1));
        row.extend(fem.forces.iter().flat_map(|corner| of(corner, i)));
        row.extend([of(&fem.ground, i)[1], run.bearing.filtered[i]]);
        csv_row(&mut out, &row);
    }
    out
}
