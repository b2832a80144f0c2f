//! Elastic legs, dampers and tendon beside the rigid body: their history, their forces, as tables.

use std::fmt::Write;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::{common::csv_row, table::FORCES};
use crate::{
    answers::WithMembers,
    compare::Match,
    fem::{Demands, QUANTITIES},
    members::Members,
    motion::shown,
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
pub fn forces(demands: &Demands) -> Value {
    let peak = |k: usize| json!({ "value": demands.peaks[k].value, "time_s": demands.peaks[k].time });
    Value::Object(QUANTITIES.iter().enumerate().map(|(k, name)| (name.to_string(), peak(k))).collect::<Map<_, _>>())
}

/// The match and the largest forces of the rigid body, and of the one with members.
#[derive(Serialize)]
pub struct Report<'a> {
    #[serde(flatten)]
    matched: &'a Match,
    forces: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    with_members: Option<With<'a>>,
}

#[derive(Serialize)]
struct With<'a> {
    #[serde(rename = "match")]
    matched: &'a Match,
    forces: Value,
}

impl<'a> Report<'a> {
    /// Of a rigid body's history, and of one with members if there is one.
    pub fn new(matched: &'a Match, demands: &Demands, with: Option<&'a WithMembers>) -> Self {
        let with = with.map(|with| With { matched: &with.matched, forces: forces(&with.demands) });
        Self { matched, forces: forces(demands), with_members: with }
    }
}

/// What the members are, in words.
pub(super) fn names(members: &Members<f64>) -> String {
    let mut out = Vec::new();
    if let Some(l) = members.legs {
        out.push(format!("legs of EA = {:.4e} N, EI = {:.4e} N m2", l.ea, l.ei));
    }
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
    let what = "Largest forces, between samples too; axial force positive in compression, moment at the mass.";
    // writing to a String cannot fail
    let _ = write!(out, "\n{what} {FORCES}\n\n");
    out.push_str(if with.is_some() {
        "| | rigid body | with members |\n|---|---|---|\n"
    } else {
        "| | rigid body |\n|---|---|\n"
    });
    for (k, name) in QUANTITIES.iter().enumerate() {
        let cell = |d: &Demands| format!("{:.4e} at {:.3} s", d.peaks[k].value, d.peaks[k].time);
        let there = |d: &Demands| d.peaks[k].value != 0.0;
        if there(rigid) || with.is_some_and(|w| there(&w.demands)) {
            let _ = match with {
                Some(w) => writeln!(out, "| {name} | {} | {} |", cell(rigid), cell(&w.demands)),
                None => writeln!(out, "| {name} | {} |", cell(rigid)),
            };
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::Peak;

    #[test]
    fn forces_stand_in_named_columns_with_their_times() {
        let mut demands = Demands::default();
        demands.rows = vec![[0.0; QUANTITIES.len()]; 2];
        demands.rows[1][0] = -2.5;
        demands.peaks[0] = Peak { value: -2.5, time: 0.013 };
        let text = csv(0.02, &demands);
        assert!(text.starts_with("t,base_shear_n,axial_left_n,"));
        assert!(text.lines().nth(2).unwrap().starts_with("0.0200000000000,-2.50000000000,0,"));
        assert_eq!(forces(&demands)["base_shear_n"]["time_s"], 0.013);
        let table = markdown(&demands, None);
        assert!(table.contains("| base_shear_n | -2.5000e0 at 0.013 s |\n"), "{table}");
        assert!(!table.contains("tendon_n"));
    }
}
