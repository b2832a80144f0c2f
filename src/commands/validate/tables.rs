//! `validate.md`, `validate.csv` and the summary on the terminal.

use std::fmt::Write;

use super::{CommandError, terminal};
use files::message::significant;
use report::Table;
use rocking::motion::shown;
use validation::{
    Confusion, GeometricMean, PREDICTABLE, Quantiles, RecordOutcome, Row, Suite, Summary,
    Validation,
};

/// A line of the summary: what it says of each set of records.
type Line<'a> = (String, &'a dyn Fn(&Summary) -> String);

/// What the records say together, and each suite of several: a name and a value for each set.
fn summary(v: &Validation) -> Table {
    let sets = sets(v);
    let number = |x: Option<f64>| x.map_or("-".to_string(), shown);
    // of one record there are no statistics
    let several = |n: usize, text: String| if n == 1 { "-".to_string() } else { text };
    // nor of records none of which lifts the body
    let lifted = |s: &Summary, text: String| {
        if s.never_lifted == s.count { "-".to_string() } else { several(s.count, text) }
    };
    let quantiles =
        |q: &Quantiles| several(q.count, format!("{} / {}", number(q.median), number(q.p90)));
    let part =
        |x: Option<f64>| x.map_or("-".to_string(), |x| format!("{} %", significant(100.0 * x, 2)));
    let percents =
        |q: &Quantiles| several(q.count, format!("{} / {}", part(q.median), part(q.p90)));
    let overturned =
        |c: &Confusion| format!("{} / {} / {} / {}", c.both, c.housner_only, c.fem_only, c.neither);
    let mean = |m: &GeometricMean, text: String| match m.failed {
        0 if m.count < 2 => format!("- of {}", m.count),
        0 => format!("{text} of {}", m.count),
        failed => format!("{text} of {}, {failed} failed", m.count),
    };
    let lines: [Line; 17] = [
        ("records".into(), &|s| s.count.to_string()),
        ("KS distance of the peak rotations".into(), &|s| {
            lifted(s, format!("{:.4}", s.ks_distance))
        }),
        ("the same, Housner from himself with e changed by 1e-5".into(), &|s| {
            lifted(s, format!("{:.4}", s.ks_distance_of_housner_changed))
        }),
        ("agreement on overturning; a failed history does not agree".into(), &|s| {
            lifted(s, format!("{:.2} %", 100.0 * s.overturning_agreement))
        }),
        ("the same, Housner with himself with e changed by 1e-5".into(), &|s| {
            lifted(s, format!("{:.2} %", 100.0 * s.overturning_agreement_of_housner_changed))
        }),
        ("overturned in both / Housner only / finite elements only / neither".into(), &|s| {
            overturned(&s.overturning)
        }),
        ("well-conditioned histories compared".into(), &|s| {
            s.nrmse_well_conditioned.count.to_string()
        }),
        (format!("error of peaks ({}): median / 90 %", peaks(v)), &|s| {
            percents(&s.peaks_well_conditioned)
        }),
        ("NRMSE horizontal: median / 90 %".into(), &|s| quantiles(&s.nrmse_well_conditioned)),
        ("NRMSE vertical: median / 90 %".into(), &|s| {
            quantiles(&s.nrmse_vertical_well_conditioned)
        }),
        (format!("NRMSE horizontal: geometric mean, sensitivity below {PREDICTABLE}"), &|s| {
            mean(&s.nrmse_geometric_mean, number(s.nrmse_geometric_mean.mean))
        }),
        (format!("error of peaks: geometric mean, sensitivity below {PREDICTABLE}"), &|s| {
            mean(&s.peaks_geometric_mean, part(s.peaks_geometric_mean.mean))
        }),
        ("not compared one to one: toppled, ill-conditioned, or in free flight".into(), &|s| {
            s.not_comparable.to_string()
        }),
        ("in free flight: Housner's pivot would have to pull".into(), &|s| {
            s.pivot_pulls.to_string()
        }),
        ("never lifted".into(), &|s| s.never_lifted.to_string()),
        ("failed".into(), &|s| s.failed.len().to_string()),
        ("largest energy residual".into(), &|s| {
            s.energy_residual_max.map_or("-".into(), |x| format!("{x:.1e}"))
        }),
    ];
    let head = [""].into_iter().chain(sets.iter().map(|(name, _)| *name));
    let rows = lines.iter().map(|(name, value)| {
        let values = sets.iter().map(|(_, summary)| value(summary));
        [name.clone()].into_iter().chain(values).collect()
    });
    Table::new(head).with(rows)
}

/// What peaks are compared of: of steps of one size no forces.
fn peaks(v: &Validation) -> &'static str {
    let forces = v.records.iter().any(|row| row.energy_residual.is_some());
    if forces { "displacement, uplift, forces" } else { "displacement, uplift" }
}

/// The records together, and each suite of several, with their names.
fn sets(v: &Validation) -> Vec<(&'static str, &Summary)> {
    if v.suites.len() > 1 {
        let suites = v.suites.iter().map(|(suite, summary)| (name(*suite), summary));
        [("all together", &v.all)].into_iter().chain(suites).collect()
    } else {
        vec![(v.suites.keys().next().map_or("no records", |suite| name(*suite)), &v.all)]
    }
}

fn name(suite: Suite) -> &'static str {
    match suite {
        Suite::Files => "files",
        Suite::Synthetic => "synthetic",
        Suite::Earthquakes => "earthquakes",
    }
}

const HEAD: [&str; 12] = [
    "record",
    "PGA [g]",
    "sensitivity",
    "u moved by 0.1 / 1 %",
    "well conditioned",
    "NRMSE u",
    "NRMSE v",
    "peak |theta|/alpha, Housner",
    "finite elements",
    "toppled, Housner",
    "finite elements",
    "impacts",
];

fn cells(row: &Row) -> Vec<String> {
    let number = |x: Option<f64>, none: &str| x.map_or(none.to_string(), |x| format!("{x:.4}"));
    let yes = |x: bool| if x { "yes" } else { "no" }.to_string();
    let missing = match row.outcome {
        RecordOutcome::Rocked | RecordOutcome::Overturned => "-",
        RecordOutcome::NeverLifted => "never lifted",
        RecordOutcome::HousnerFailed => "Housner failed",
        RecordOutcome::FemFailed => "failed",
    };
    vec![
        // the name comes from a file: it must not end the cell
        row.name.replace('|', "\\|"),
        format!("{:.4}", row.pga_g),
        if row.sensitivity < 1e4 {
            format!("{:.2}", row.sensitivity)
        } else {
            format!("{:.1e}", row.sensitivity)
        },
        format!("{:.4} / {:.4}", row.moved_by_0_1_percent, row.moved_by_1_percent),
        yes(row.well_conditioned),
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
pub fn markdown(v: &Validation, line: &str) -> String {
    let records = Table::new(HEAD.map(|h| h.replace('|', "\\|"))).with(v.records.iter().map(cells));
    format!(
        "Finite elements on ground springs against Housner; {line}.\n\n{}\n{}",
        summary(v).markdown(),
        records.markdown()
    )
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
    let Table { head, rows } = summary(v);
    let mut table = terminal::table(head);
    table.add_rows(rows);
    let mut out = table.to_string();
    for row in v.records.iter().filter(|_| v.records.len() == 1) {
        let cells =
            HEAD.iter().zip(cells(row)).skip(1).map(|(head, cell)| format!("{head} {cell}"));
        // writing to a String cannot fail
        let _ =
            write!(out, "\none record, no statistics: {}", cells.collect::<Vec<_>>().join("; "));
    }
    out
}
