//! Dampers and tendon beside the rigid body: their history, their forces, as tables.

use std::fmt::Write;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::{common::csv_row, table::FORCES};
use crate::{
    answers::WithMembers,
    compare::Match,
    fem::{Demands, QUANTITIES},
    members::Members,
    motion::{TimedPeak, shown},
};

/// `members.csv`: forces at the record's samples, each the largest since the sample before.
pub fn csv(dt: f64, demands: &Demands) -> String {
    let mut out = format!("t,{}\n", QUANTITIES.join(","));
    for (i, row) in demands.rows.iter().enumerate() {
        let mut all = [0.0; QUANTITIES.len() + 1];
        all[0] = i as f64 * dt;
        all[1..].copy_from_slice(row);
        csv_row(&mut out, &all);
    }
    out
}

/// Largest forces and their times, as JSON.
fn forces(peaks: &[TimedPeak; QUANTITIES.len()]) -> Value {
    let peak = |k: usize| json!({ "value": peaks[k].value, "time_s": peaks[k].time });
    Value::Object(QUANTITIES.iter().enumerate().map(|(k, name)| (name.to_string(), peak(k))).collect::<Map<_, _>>())
}

/// The match and the largest forces of the rigid body, and of the one with members.
#[derive(Serialize)]
pub struct MembersReport<'a> {
    #[serde(flatten)]
    matched: &'a Match,
    /// Over all steps: in landings, forces of the springs.
    forces: Value,
    forces_between_landings: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    with_members: Option<With<'a>>,
}

#[derive(Serialize)]
struct With<'a> {
    #[serde(rename = "match")]
    matched: &'a Match,
    forces: Value,
    forces_between_landings: Value,
}

impl<'a> MembersReport<'a> {
    /// Of a rigid body's history, and of one with members if there is one.
    pub fn new(matched: &'a Match, demands: &Demands, with: Option<&'a WithMembers>) -> Self {
        let with = with.map(|with| With {
            matched: &with.matched,
            forces: forces(&with.demands.peaks),
            forces_between_landings: forces(&with.demands.between),
        });
        let (all, between) = (forces(&demands.peaks), forces(&demands.between));
        Self { matched, forces: all, forces_between_landings: between, with_members: with }
    }
}

/// What the members are, in words.
pub(super) fn names(members: &Members<f64>) -> String {
    let mut out = Vec::new();
    if let Some(d) = members.damper {
        out.push(format!("dampers of {:.4e} N s/m at each foot", d.c));
    }
    if let Some(t) = members.tendon {
        out.push(format!("a tendon of {:.4e} N/m, stressed to {:.4e} N", t.stiffness, t.pretension));
    }
    if let Some(f) = members.friction {
        out.push(format!("a friction coefficient of {} at the feet", f.coefficient));
    }
    out.join(", ")
}

/// Largest forces, Markdown.
pub fn markdown(rigid: &Demands, with: Option<&WithMembers>) -> String {
    let mut out = String::new();
    if let Some(w) = with {
        let m = &w.matched;
        // writing to a String cannot fail
        let _ = writeln!(
            out,
            "\nWith {} (springs as tuned for the rigid body): NRMSE against Housner {} horizontal, {} vertical, peaks \
             {:.2} mm and {:.2} mm, {} impacts, {} bounces, settlement {:.3} mm.",
            names(&w.members),
            shown(m.nrmse_horizontal),
            shown(m.nrmse_vertical),
            m.peak_horizontal_fem_m * 1e3,
            m.peak_vertical_fem_m * 1e3,
            m.impacts_fem,
            m.bounces,
            m.settlement_m * 1e3
        );
    }
    // writing to a String cannot fail
    let _ = write!(out, "\n{ABOUT} {FORCES}\n\n");
    let columns = columns(rigid, with);
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let _ = writeln!(out, "| largest force | {} |\n|---|{}", names.join(" | "), "---|".repeat(names.len()));
    for (k, name) in QUANTITIES.iter().enumerate() {
        if columns.iter().any(|(_, peaks)| peaks[k].value != 0.0) {
            let cell = |peak: TimedPeak| match peak.value {
                0.0 => "-".to_string(),
                value => format!("{value:.4e} at {:.3} s", peak.time),
            };
            let cells: Vec<String> = columns.iter().map(|(_, peaks)| cell(peaks[k])).collect();
            let _ = writeln!(out, "| {name} | {} |", cells.join(" | "));
        }
    }
    out
}

/// What the table of forces holds.
pub(super) const ABOUT: &str = "Largest forces between landings, later than 0.1/p after the last touch-down of a foot, are those of a \
                                rocking structure; those in landings are the springs'. Axial force is positive in tension, the \
                                moment is that at the mass.";

/// The largest forces of each history, between landings and in them.
pub(super) fn columns<'a>(
    rigid: &'a Demands,
    with: Option<&'a WithMembers>,
) -> Vec<(&'static str, &'a [TimedPeak; QUANTITIES.len()])> {
    let mut columns = vec![("between landings", &rigid.between), ("in landings", &rigid.peaks)];
    if let Some(with) = with {
        columns.extend([
            ("with members, between landings", &with.demands.between),
            ("with members, in landings", &with.demands.peaks),
        ]);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_stand_in_named_columns_with_their_times() {
        let mut demands = Demands::default();
        demands.rows = vec![[0.0; QUANTITIES.len()]; 2];
        demands.rows[1][0] = -2.5;
        demands.peaks[0] = TimedPeak { value: -2.5, time: 0.013 };
        let text = csv(0.02, &demands);
        assert!(text.starts_with("t,base_shear_n,axial_left_n,"));
        assert!(text.lines().nth(2).unwrap().starts_with("0.0200000000000,-2.50000000000,0,"));
        assert_eq!(forces(&demands.peaks)["base_shear_n"]["time_s"], 0.013);
        let table = markdown(&demands, None);
        assert!(table.contains("| base_shear_n | - | -2.5000e0 at 0.013 s |\n"), "{table}");
        assert!(!table.contains("tendon_n"));
    }
}
