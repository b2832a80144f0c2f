//! Tables of what the structure bears.

use std::fmt::Write;

use super::{
    ElasticRun,
    bearing::{ForceQuantities, ForceQuantity},
};
use crate::{
    commands::common::csv_row,
    figures::{prefix, short},
    motion::{TimedPeak, peak},
};

/// Rows of the table: quantity, rocking, fixed, rigid, and what rocking buys.
pub(super) fn rows(run: &ElasticRun) -> Vec<[String; 5]> {
    let dt = run.record.dt;
    let row = |quantity: &ForceQuantity| {
        let peaks = [0, 1, 2].map(|k| TimedPeak::of(dt, &quantity.series[k]));
        let cell = |peak: Option<TimedPeak>| {
            peak.map_or("-".to_string(), |TimedPeak { value, time }| {
                let (unit, letter) = prefix(value.abs());
                format!("{} {letter}{} at {time:.2} s", short(value.abs() / unit, 4), quantity.unit)
            })
        };
        let share = match (peaks[0], peaks[1]) {
            (Some(rocking), Some(fixed)) if fixed.value != 0.0 => format!("{:.2}", (rocking.value / fixed.value).abs()),
            _ => "-".into(),
        };
        [quantity.name.to_string(), cell(peaks[0]), cell(peaks[1]), cell(peaks[2]), share]
    };
    run.bearing.quantities.iter().map(row).collect()
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
    format!(
        "Members' forces are the structure's own, between samples too; those of the rigid body are between impacts. The ground's vertical force \
         on all corners together reaches {} times the weight{landing}; {filtered}.",
        share(ground)
    )
}

/// `members.csv`: at every sample the largest magnitudes since the sample before; axial forces are positive in tension, as in `BeamForces`.
pub(super) fn csv(run: &ElasticRun) -> String {
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
    for (i, demand) in fem.worst.iter().enumerate() {
        let mut row = vec![i as f64 * run.record.dt];
        row.extend(demand.values());
        row.extend(fem.forces.iter().flat_map(|corner| corner.peak[i]));
        row.extend([run.bearing.ground[i], run.bearing.filtered[i]]);
        csv_row(&mut out, &row);
    }
    out
}
