//! What the structure bears: on its springs, held to the ground, as a rigid body.

use std::fmt::Write;

use super::{ElasticRun, FILTER_HZ};
use crate::{
    commands::common::csv_row,
    elastic::{fem::History, structure::ElasticStructure},
    figures::{prefix, short},
};

/// A quantity and how it is had from each model, as largest magnitudes since the sample before.
pub(super) struct Quantity {
    pub name: &'static str,
    pub unit: &'static str,
    /// Rocking on springs, fixed to the ground, rigid: empty where a model has none.
    pub series: [Vec<f64>; 3],
}

/// Index of beams that end on a footing, and which end it is, from the left.
fn bases(run: &ElasticRun) -> Vec<(usize, usize)> {
    let (layout, frame) = (&run.assembled.layout, &run.assembled.frame);
    let footing = |node: usize| frame.footing_nodes().contains(&node);
    let of = |(i, member): (usize, &crate::elastic::frame::Member)| {
        member.ends.iter().position(|end| footing(end.node)).map(|end| (i, end))
    };
    layout.members.iter().enumerate().filter_map(of).collect()
}

/// Shear, axial force and moment at the foot of the columns or legs, the largest of them, and the drift.
pub(super) fn quantities(run: &ElasticRun) -> Vec<Quantity> {
    let bases = bases(run);
    let largest = |history: &History, of: &dyn Fn(&crate::elastic::beam::Bearing, usize) -> f64| -> Vec<f64> {
        let at = |demand: &crate::elastic::fem::Demand| {
            let values = bases.iter().map(|&(i, end)| of(&demand.bearings[i], end));
            values.fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most })
        };
        history.worst.iter().map(at).collect()
    };
    let (fem, fixed) = (&run.answer.fem, &run.answer.fixed);
    let rigid = run.answer.rigid.as_ref();
    let shear = |history: &History| history.worst.iter().map(|demand| demand.base_shear).collect();
    let mut all = vec![
        Quantity {
            name: "base shear",
            unit: "N",
            series: [shear(fem), shear(fixed), rigid.map_or(Vec::new(), |rigid| rigid.base_shear.clone())],
        },
        Quantity {
            name: "axial force",
            unit: "N",
            series: [
                largest(fem, &|bearing, _| bearing.axial),
                largest(fixed, &|bearing, _| bearing.axial),
                rigid.map_or(Vec::new(), |rigid| rigid.axial.clone()),
            ],
        },
    ];
    // a leg is hinged at its foot
    if !matches!(run.assembled.structure, ElasticStructure::AFrame(_)) {
        all.push(Quantity {
            name: "moment at the foot",
            unit: "N m",
            series: [
                largest(fem, &|bearing, end| bearing.moments[end]),
                largest(fixed, &|bearing, end| bearing.moments[end]),
                rigid.map_or(Vec::new(), |rigid| rigid.moment.iter().map(|x| -x).collect()),
            ],
        });
    }
    let drift = run.answer.sways.first().map_or(Vec::new(), |pair| pair[1].drift.clone());
    let held = run.assembled.watched.first().map_or(Vec::new(), |watched| {
        let Ok(frame) = run.assembled.layout.fixed().frame() else { return Vec::new() };
        fixed.q.iter().map(|q| frame.displacement(watched.top, q)[0]).collect()
    });
    all.push(Quantity { name: "drift", unit: "m", series: [drift, held, Vec::new()] });
    all
}

fn most(series: &[f64], dt: f64) -> Option<(f64, f64)> {
    let (i, value) = series.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some((*value, i as f64 * dt))
}

/// Rows of the table: quantity, rocking, fixed, rigid, and what rocking buys.
pub(super) fn rows(run: &ElasticRun) -> Vec<[String; 5]> {
    let dt = run.record.dt;
    let row = |quantity: &Quantity| {
        let peaks = [0, 1, 2].map(|k| most(&quantity.series[k], dt));
        let cell = |peak: Option<(f64, f64)>| {
            peak.map_or("-".to_string(), |(value, time)| {
                let (unit, letter) = prefix(value.abs());
                format!("{} {letter}{} at {time:.2} s", short(value.abs() / unit, 4), quantity.unit)
            })
        };
        let share = match (peaks[0], peaks[1]) {
            (Some((rocking, _)), Some((fixed, _))) if fixed != 0.0 => format!("{:.2}", (rocking / fixed).abs()),
            _ => "-".into(),
        };
        [quantity.name.to_string(), cell(peaks[0]), cell(peaks[1]), cell(peaks[2]), share]
    };
    quantities(run).iter().map(row).collect()
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
    let dt = run.record.dt;
    let [peaks, filtered] = run.ground_forces();
    let weight = run.assembled.frame.total_mass() * crate::scalar::GRAVITY;
    let share = |series: &[f64]| most(series, dt).map_or(0.0, |(value, _)| value / weight);
    format!(
        "Members' forces are the structure's own, between samples too; those of the rigid body are between impacts. The ground's vertical force \
         reaches {} times the weight in a landing, which is the springs' and grows with Omega_n; without what is faster than {FILTER_HZ} Hz \
         (Butterworth, order 4, forwards and backwards) {} times.",
        short(share(&peaks), 3),
        short(share(&filtered), 3)
    )
}

/// `members.csv`: at every sample the largest magnitudes since the sample before.
pub(super) fn csv(run: &ElasticRun) -> String {
    let fem = &run.answer.fem;
    let mut head = vec!["t".to_string(), "base_shear_n".into()];
    for i in 1..=run.assembled.frame.beams() {
        let names = ["axial", "shear", "moment_start", "moment_end"];
        let units = ["n", "n", "nm", "nm"];
        head.extend(names.iter().zip(units).map(|(name, unit)| format!("beam_{i}_{name}_{unit}")));
    }
    for i in 1..=fem.forces.len() {
        head.extend([format!("corner_{i}_horizontal_n"), format!("corner_{i}_vertical_n")]);
    }
    head.push(format!("ground_vertical_below_{FILTER_HZ}_hz_n"));
    let [_, filtered] = run.ground_forces();
    let mut out = head.join(",") + "\n";
    for (i, demand) in fem.worst.iter().enumerate() {
        let mut row = vec![i as f64 * run.record.dt];
        row.extend(demand.values());
        row.extend(fem.forces.iter().flat_map(|corner| corner.peak[i]));
        row.push(filtered[i]);
        csv_row(&mut out, &row);
    }
    out
}
