//! What springs err in a program with fixed time steps, in a line and in a table.

use crate::Table;
use files::message::{percent, signed_percent, significant};
use parameters::program::{ProgramErrors, ProgramOnRecord, ProgramRow};

/// How much is told of errors.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ErrorWords {
    /// All.
    All,
    /// How many motions are lost in all, not of each set.
    Short,
    /// Nor on which motions.
    Fewest,
}

/// What errors are of.
#[derive(Clone, Copy)]
pub(super) struct ErrorsOf {
    /// What is measured.
    pub peaks: &'static str,
    /// On which motions.
    pub motions: &'static str,
    /// Whether the structure is elastic.
    pub elastic: bool,
    /// By how much a change of 0.1 % moves the motion on the record, where that is too much to tell
    /// what springs err there (NRMSE).
    pub moved: Option<f64>,
    /// Up to when it can be, if not to its end (s).
    pub until: Option<f64>,
}

/// What goes wrong, if something does; then the errors, largest displacement first: median and what
/// 90 % are below.
pub(super) fn errors<U>(
    row: &ProgramRow<U>,
    ErrorsOf { peaks, motions, moved, until, .. }: ErrorsOf,
    words: ErrorWords,
) -> String {
    if let Some(why) = row.not_to_be_used() {
        return why.to_string();
    }
    let nothing = String::new;
    let suites =
        [(motions, row.expected.synthetic), ("earthquake-like motions", row.expected.earthquakes)];
    let suites = suites.into_iter().filter_map(|(name, errors)| Some((name, errors?)));
    let suites: Vec<(&str, ProgramErrors)> = suites.collect();
    let median = |errors: &ProgramErrors| errors.peak[0].unwrap_or(f64::INFINITY);
    // of the suite where they err most
    let worst = suites
        .iter()
        .copied()
        .reduce(|one, other| if median(&other.1) > median(&one.1) { other } else { one });
    let Some((name, errors)) = worst else {
        return "errors not measured".into();
    };
    let cells =
        |of: [Option<f64>; 2], words: fn(f64) -> String| of.map(|x| x.map_or("lost".into(), words));
    let [median, ninety] = cells(errors.peak, percent);
    let history = errors.history[0].map_or(nothing(), |_| {
        let [median, ninety] = cells(errors.history, |x| significant(x, 2));
        format!("; NRMSE {median} (median), {ninety} (90 %)")
    });
    let [lost, all] = row.expected.lost();
    let each = |(name, e): &(&str, ProgramErrors)| format!("{} of {} {name}", e.lost, e.histories);
    let fails = match (lost, words) {
        (0, _) => nothing(),
        (_, ErrorWords::All) => {
            format!("fails on {}; ", suites.iter().map(each).collect::<Vec<_>>().join(", "))
        }
        _ => format!("fails on {lost} of {all}; "),
    };
    let [ends, top, nrmse] =
        row.on_record.map_or([None; 3], |on| [on.gives_up_s, on.top, on.nrmse]);
    let ends = ends.map_or(nothing(), |s| {
        let then = match until.filter(|until| *until <= s) {
            Some(_) => "after what can be predicted",
            None => "try another --step",
        };
        format!("this record: gives up at {} s, {then}; ", significant(s, 3))
    });
    let top = top.filter(|_| ends.is_empty());
    let falls = row.on_record.and_then(|on| on.falls_s).map_or(nothing(), |s| {
        let beyond = until.is_some_and(|until| until <= s);
        let doubt = if beyond { ", after what can be predicted" } else { "" };
        format!("it overturns in these steps at {} s{doubt}; ", significant(s, 3))
    });
    let fewest = words == ErrorWords::Fewest;
    let here = top.map_or(nothing(), |top| here((top, nrmse), (moved, until)));
    if fewest {
        let peaks = if name.starts_with("earthquake") {
            format!("on earthquakes {peaks}")
        } else {
            peaks.to_string()
        };
        let told = match errors.peak[0] {
            Some(_) => format!("{peaks} median {median}, 90 %: {ninety}"),
            None => format!("most {name} are lost"),
        };
        return format!("{ends}{fails}{here}{falls}{told}");
    }
    // how many there are is said with those that fail
    let told = lost > 0 && suites.len() == 1;
    let on = if told { nothing() } else { format!(" on {} {name}", errors.histories) };
    let within = match errors.peak[0] {
        Some(_) => {
            format!("{peaks} within {median} (median), {ninety} (90 %){on}{history}")
        }
        None => format!("most {name} are lost"),
    };
    format!("{ends}{fails}{here}{falls}{within}")
}

/// That errors on the record tell little of the springs: by how much it is moved by a small change,
/// in the words of the finding.
fn doubt(moved: f64) -> String {
    let by = match moved {
        x if x < 10.0 => format!("{} %", significant(100.0 * x, 2)),
        x => percent(x),
    };
    format!(" (a change of 0.1 % moves it by {by})")
}

/// What the largest displacement on the record and its history err by, up to when it can be
/// predicted (s).
fn here((top, nrmse): (f64, Option<f64>), (moved, until): (Option<f64>, Option<f64>)) -> String {
    let nrmse = nrmse.map_or(String::new(), |x| format!(", NRMSE {}", significant(x, 2)));
    let to = until.map_or(String::new(), |until| format!(" to {} s", significant(until, 3)));
    let doubt = moved.map_or(String::new(), doubt);
    format!("this record{to}: top {}{nrmse}{doubt}; ", signed_percent(top))
}

pub(super) fn table<U>(row: &ProgramRow<U>, of: &ErrorsOf) -> Table {
    let &ErrorsOf { motions, elastic, .. } = of;
    let expected = &row.expected;
    let number = |x: f64| significant(x, 2);
    let cell = |x: Option<f64>| x.map_or("lost".into(), number);
    let parts = [
        (
            match elastic {
                true => "of a rigid body of its size by the step alone, 13 p dt (median)",
                false => "by the step alone, 13 p dt (median)",
            },
            Some(expected.floor),
        ),
        ("by the sway before uplift", expected.stance),
        ("by what a landing gives back", expected.rebound),
    ];
    let empty = String::new;
    let part = |(name, value): (&str, Option<f64>)| {
        Some(vec![format!("expected {name}"), number(value?), empty(), empty(), empty(), empty()])
    };
    let parts = parts.into_iter().filter_map(part);
    let measured = |name: &str, errors: Option<ProgramErrors>| {
        errors.map(|e| {
            let percent = |x: Option<f64>| x.map_or("lost".into(), percent);
            vec![
                format!("measured on {} {name}", e.histories),
                cell(e.history[0]),
                cell(e.history[1]),
                percent(e.peak[0]),
                percent(e.peak[1]),
                e.lost.to_string(),
            ]
        })
    };
    let measured = [
        measured(motions, expected.synthetic),
        measured("earthquake-like motions", expected.earthquakes),
        row.on_record.and_then(|on| on_record(on, of)),
    ];
    Table::new([
        "error",
        "history, NRMSE, median",
        "90 %",
        "largest displacement, median",
        "90 %",
        "lost",
    ])
    .with(parts.chain(measured.into_iter().flatten()))
}

/// A row of what is measured on the record of the run, up to when it can be predicted.
fn on_record(on: ProgramOnRecord, of: &ErrorsOf) -> Option<Vec<String>> {
    let to = of.until.map_or(String::new(), |until| format!(" to {} s", significant(until, 3)));
    let doubt = of.moved.map_or(String::new(), doubt);
    let nrmse = on.nrmse.map_or("-".into(), |x| significant(x, 2));
    let none = || "-".to_string();
    let top = format!("top {}", signed_percent(on.top?));
    Some(vec![format!("measured on this record{to}{doubt}"), nrmse, none(), top, none(), none()])
}
