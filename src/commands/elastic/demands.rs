//! Tables of what the structure bears.

use std::fmt::Write;

use super::{
    ElasticRun,
    bearing::{DRIFT, ForceQuantities, ForceQuantity},
};
use crate::{
    commands::common::csv_row,
    elastic::{
        design_forces::{DesignForce, ForcePeak},
        fem::GroundForces,
    },
    figures::{prefix, short},
    motion::{TimedPeak, peak},
};

/// Rows of the table: quantity, rocking, fixed, rigid, and what rocking buys.
pub(super) fn rows(run: &ElasticRun) -> Vec<[String; 5]> {
    let amount = |value: f64, time: f64, unit: &str| {
        let (scale, letter) = prefix(value.abs());
        format!("{} {letter}{unit} at {time:.2} s", short(value.abs() / scale, 4))
    };
    let buys = |rocking: Option<f64>, fixed: Option<f64>| match (rocking, fixed) {
        (Some(rocking), Some(fixed)) if fixed != 0.0 => format!("{:.2}", (rocking / fixed).abs()),
        _ => "-".into(),
    };
    let force = |force: &DesignForce| {
        let unit = force.kind.unit();
        let beside = |peak: Option<ForcePeak>| peak.map_or("-".into(), |peak| amount(peak.value, peak.time_s, unit));
        let rocking = match force.value {
            Some(value) => amount(value, force.time_s, unit),
            None => format!("withheld: changes by {} %", short(100.0 * force.change(), 2)),
        };
        let share = buys(force.value, force.fixed.map(|peak| peak.value));
        [force.kind.name().to_string(), rocking, beside(force.fixed), beside(force.rigid), share]
    };
    let mut rows: Vec<_> = run.answer.design.forces.iter().map(force).collect();
    let drift = run.bearing.quantities.iter().find(|quantity| quantity.name == DRIFT);
    if let Some(ForceQuantity { name, unit, series }) = drift {
        let peaks = [0, 1, 2].map(|k| TimedPeak::of(run.record.dt, &series[k]));
        let [rocking, fixed, rigid] =
            peaks.map(|peak| peak.map_or("-".to_string(), |peak| amount(peak.value, peak.time, unit)));
        let share = buys(peaks[0].map(|peak| peak.value), peaks[1].map(|peak| peak.value));
        rows.push([(*name).to_string(), rocking, fixed, rigid, share]);
    }
    rows
}

/// Head of the table.
pub(super) const HEAD: [&str; 5] =
    ["largest", "rocking, elastic", "fixed to the ground", "rocking, rigid (Housner)", "rocking over fixed"];

/// The table, Markdown.
pub(super) fn markdown(run: &ElasticRun) -> String {
    let mut out = format!("| {} |\n|---|---|---|---|---|\n", HEAD.join(" | "));
    for row in rows(run) {
        // writing to a String cannot fail
        let _ = writeln!(out, "| {} |", row.join(" | "));
    }
    out + &format!("\n{}\n", about(run))
}

/// What the numbers are.
pub(super) fn about(run: &ElasticRun) -> String {
    let ForceQuantities { ground, filtered, below_hz, weight, .. } = &run.bearing;
    let share = |series: &[f64]| short(peak(series).abs() / weight, 3);
    let filtered = match below_hz {
        Some(hz) => format!(
            "without what is faster than {hz} Hz (Butterworth, order 4, forwards and backwards) {} times",
            share(filtered)
        ),
        None => format!("its mean between samples {} s apart {} times", run.record.dt, share(filtered)),
    };
    let lands = run.answer.histories.fem.contacts.iter().any(|contact| contact.touches);
    let landing = if lands { " in a landing, which is the springs' and grows with Omega_n" } else { "" };
    let below = run.answer.design.cutoff.as_ref().map_or(String::new(), |cutoff| {
        format!(
            "Forces are those below {} Hz, which keeps {} bending modes of the column (up to {} Hz). ",
            short(cutoff.cutoff_hz, 3),
            cutoff.modes_hz.len(),
            short(cutoff.modes_hz.last().copied().unwrap_or(0.0), 3)
        )
    });
    format!(
        "{below}Forces change by less than 5 % when the elements are doubled and Omega_n is divided or multiplied by 4; those that change more \
         are withheld. Those of the rigid body are between impacts. The ground's vertical force on all corners together reaches {} times the \
         weight{landing}; {filtered}.",
        share(ground)
    )
}

/// What a file of forces holds of every instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instants {
    /// All of them at the same instants: the record's samples.
    Samples,
    /// Of each value, the largest magnitude since the sample before.
    Envelopes,
}

/// `members.csv` or `members_envelopes.csv`; axial forces are positive in tension, as in `BeamForces`.
pub(super) fn csv(run: &ElasticRun, instants: Instants) -> String {
    let fem = &run.answer.histories.fem;
    let mut head = vec!["t".to_string(), "base_shear_n".into()];
    for i in 1..=run.assembled.frame.beams() {
        let names = ["axial", "shear", "moment_start", "moment_end"];
        let units = ["n", "n", "nm", "nm"];
        head.extend(names.iter().zip(units).map(|(name, unit)| format!("beam_{i}_{name}_{unit}")));
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
    let of = |forces: &GroundForces, i: usize| if at_samples { forces.at[i] } else { forces.peak[i] };
    for (i, demand) in demands.iter().enumerate() {
        let mut row = vec![i as f64 * run.record.dt];
        row.extend(demand.values());
        row.extend(fem.forces.iter().flat_map(|corner| of(corner, i)));
        row.extend([of(&fem.ground, i)[1], run.bearing.filtered[i]]);
        csv_row(&mut out, &row);
    }
    out
}
