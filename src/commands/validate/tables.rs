//! `validate.md`, `validate.csv` and the summary on the terminal.

use std::fmt::Write;

use comfy_table::{Table, presets};

use super::CommandError;
use crate::{
    conditioning::ILL_CONDITIONED,
    validate::{Outcome, Quantiles, Row, Validation},
};

/// What the records say together: name, value.
fn summary(v: &Validation) -> Vec<[String; 2]> {
    let c = &v.overturning;
    let number = |x: Option<f64>| x.map_or("-".to_string(), |x| format!("{x:.4}"));
    let quantiles = |q: &Quantiles| format!("{} / {}", number(q.median), number(q.p90));
    let row = |name: &str, value: String| [name.to_string(), value];
    vec![
        row("records", v.records.len().to_string()),
        row("KS distance of the peak rotations", format!("{:.4}", v.ks_distance)),
        row("agreement on overturning", format!("{:.2} %", 100.0 * v.overturning_agreement)),
        row(
            "overturned in both / Housner only / finite elements only / neither",
            format!("{} / {} / {} / {}", c.both, c.housner_only, c.fem_only, c.neither),
        ),
        row("well-conditioned histories compared", v.nrmse_well_conditioned.count.to_string()),
        row("NRMSE horizontal: median / 90 %", quantiles(&v.nrmse_well_conditioned)),
        row("NRMSE vertical: median / 90 %", quantiles(&v.nrmse_vertical_well_conditioned)),
        row(&format!("not compared: toppled, or sensitivity {ILL_CONDITIONED} and more"), v.not_comparable.to_string()),
        row("never lifted", v.never_lifted.to_string()),
        row("failed", v.failed.len().to_string()),
        row("largest energy residual", format!("{:.1e}", v.energy_residual_max)),
    ]
}

const HEAD: [&str; 10] = [
    "record",
    "PGA [g]",
    "sensitivity",
    "NRMSE u",
    "NRMSE v",
    "peak |theta|/alpha, Housner",
    "finite elements",
    "toppled, Housner",
    "finite elements",
    "impacts",
];

fn cells(row: &Row) -> [String; 10] {
    let number = |x: Option<f64>, none: &str| x.map_or(none.to_string(), |x| format!("{x:.4}"));
    let yes = |x: bool| if x { "yes" } else { "no" }.to_string();
    let missing = match row.outcome {
        Outcome::Rocked => "-",
        Outcome::NeverLifted => "never lifted",
        Outcome::HousnerFailed => "Housner failed",
        Outcome::FemFailed => "failed",
    };
    [
        // the name comes from a file: it must not end the cell
        row.name.replace('|', "\\|"),
        format!("{:.4}", row.pga_g),
        if row.sensitivity < 1e4 { format!("{:.2}", row.sensitivity) } else { format!("{:.1e}", row.sensitivity) },
        number(row.nrmse_horizontal, missing),
        number(row.nrmse_vertical, missing),
        number(Some(row.peak_ratio_housner), missing),
        number(row.peak_ratio_fem, missing),
        yes(row.overturned_housner),
        row.overturned_fem.map_or(missing.to_string(), yes),
        row.impacts.to_string(),
    ]
}

/// `validate.md`: the summary, then a row a record.
pub fn markdown(v: &Validation) -> String {
    let mut out = String::from("Finite elements on ground springs against Housner.\n\n| all records | |\n|---|---|\n");
    for [name, value] in summary(v) {
        // writing to a String cannot fail
        let _ = writeln!(out, "| {name} | {value} |");
    }
    let _ = write!(out, "\n| {} |\n{}|\n", HEAD.map(|h| h.replace('|', "\\|")).join(" | "), "|---".repeat(HEAD.len()));
    for row in &v.records {
        let _ = writeln!(out, "| {} |", cells(row).join(" | "));
    }
    out
}

/// `validate.csv`: a row a record, the columns of `validate.json`; empty where that has null.
pub fn csv(v: &Validation) -> Result<Vec<u8>, CommandError> {
    let wrap = |e: String| CommandError::Result(format!("validate.csv: {e}; please report this"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in &v.records {
        writer.serialize(row).map_err(|e| wrap(e.to_string()))?;
    }
    writer.into_inner().map_err(|e| wrap(e.to_string()))
}

/// The summary for a terminal.
pub fn terminal(v: &Validation) -> String {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(["all records", ""]);
    table.add_rows(summary(v));
    table.to_string()
}
