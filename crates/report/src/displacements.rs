//! The table of largest displacements: the reference beside the structure on its springs.

use super::{FiledParameters, Run, Table};
use files::message::{percent, quantity, significant};
use results::{PeakPair, PeakTimes, Peaks};

/// A row's name, its quantity, its words, and when it is largest (s).
type PeakRow =
    (&'static str, fn(&Peaks) -> Option<f64>, fn(f64) -> String, fn(&PeakTimes) -> Option<f64>);

/// The row of the largest displacement.
const TOP: &str = "top displacement";
/// The row of the friction needed.
pub(crate) const FRICTION: &str = "friction needed";
/// The row of how far from where they stood feet have landed, when the top's displacement is
/// largest.
const MOVED: &str = "  of it by moved feet";
/// What rows of parts that are largest at times of their own begin with.
pub(crate) const LARGEST: &str = "largest by";
/// What rows of parts of the top's displacement begin with.
pub(crate) const PART: &str = "  of it";
/// The top's displacement over its height.
pub(crate) const DRIFT_RATIO: &str = "  drift ratio";
/// The same where springs move the top by more than its rotation does.
const OF_ROCKING: &str = "  drift ratio (rocking)";
/// The same of an elastic structure, whose drift is by bending alone.
const OF_BOTH: &str = "  drift ratio (rocking + bending)";
/// Share of the top's displacement by which its part by rotation differs, from which it is said
/// that the drift ratio is of that alone.
const DIFFERS: f64 = 1e-4;
/// Share of the top displacement below which the row is left out.
const NOT_SAID: f64 = 0.005;

const ROWS: [PeakRow; 10] = [
    (TOP, |p| Some(p.top_displacement_m), meters, at_top),
    ("  of it by rocking", |p| Some(p.then?.rocking_m), meters, at_top),
    ("  of it by bending", |p| Some(p.then?.bending_m), meters, at_top),
    (MOVED, |p| Some(p.then?.feet_moved_m), meters, at_top),
    (DRIFT_RATIO, |p| Some(p.drift_ratio).filter(|_| p.bending_m.is_none()), percents, at_drift),
    (OF_BOTH, |p| p.bending_m.map(|_| p.drift_ratio), percents, at_drift),
    ("largest by rocking", |p| p.bending_m.map(|_| p.rocking_m), meters, |t| Some(t.rocking_s)),
    ("largest by bending", |p| p.bending_m, meters, |t| t.bending_s),
    ("uplift", |p| Some(p.uplift_m), meters, |t| Some(t.uplift_s)),
    ("impacts", |p| Some(p.impacts as f64), |x| format!("{x:.0}"), to_the_end),
];

/// Impacts are counted over all of the history.
fn to_the_end(_: &PeakTimes) -> Option<f64> {
    Some(f64::INFINITY)
}

fn at_top(times: &PeakTimes) -> Option<f64> {
    Some(times.top_displacement_s)
}

fn at_drift(times: &PeakTimes) -> Option<f64> {
    times.drift_ratio_s.or(Some(times.rocking_s))
}

/// Below this a displacement is rounding (m).
const ROUNDING_M: f64 = 1e-9;
/// Below this part of the top's displacement, too: what a part of it is told to at most.
const ROUNDING: f64 = 1e-5;

/// Drift ratio of a structure that hardly moves: models are not compared there.
pub(crate) const LEAST_DRIFT: f64 = 1e-6;

/// Without rounding.
pub(crate) fn exact(x: f64) -> f64 {
    if x.abs() < ROUNDING_M { 0.0 } else { x }
}

fn meters(x: f64) -> String {
    quantity(exact(x), "m")
}

fn percents(x: f64) -> String {
    format!("{} %", significant(1e2 * exact(x), 3))
}

/// The name of the drift ratio, which says what it is of where springs move the top of a rigid body
/// by other than its rotation.
fn drift_named(pair: &PeakPair) -> &'static str {
    let sways = |peaks: &Peaks| {
        let apart = (peaks.top_displacement_m - peaks.rocking_m).abs();
        peaks.bending_m.is_none() && apart > DIFFERS * peaks.top_displacement_m
    };
    let any = [Some(&pair.springs), pair.with_members.as_ref()].into_iter().flatten().any(sways);
    if any { OF_ROCKING } else { DRIFT_RATIO }
}

/// Of which column a displacement of the top and its parts are, and when it is largest; nothing of
/// a structure without several columns. Where models differ, of both.
fn column_named(pair: &PeakPair) -> String {
    let of = |peaks: &Peaks| Some((peaks.then?.column?, peaks.times?.top_displacement_s));
    let at = |s: f64| format!("{} s", significant(s, 4));
    match (of(&pair.reference), of(&pair.springs)) {
        (Some((one, s)), Some((other, t))) if one != other => {
            format!(" (column {one} at {}, {other} at {})", at(s), at(t))
        }
        (_, Some((column, t))) => format!(" (column {column} at {})", at(t)),
        _ => String::new(),
    }
}

/// The name of a row, with what it is of.
fn named(name: &str, pair: &PeakPair) -> String {
    match name {
        TOP => format!("{TOP}{}", column_named(pair)),
        DRIFT_RATIO => drift_named(pair).into(),
        _ => name.into(),
    }
}

/// The table; none of springs without a record.
pub fn peak_table(run: &Run) -> Option<Table> {
    let pair = run.peaks.as_ref()?;
    let with = pair.with_members.as_ref();
    let reference = match pair.reference_ends_s {
        Some(end) => format!("{} to {} s", run.reference, significant(end, 3)),
        None => run.reference.to_string(),
    };
    // what is largest after the motion can be foretold is marked
    let until = run.predictable_to();
    let without = if with.is_some() { run.without_to() } else { until };
    let late = |when: fn(&PeakTimes) -> Option<f64>, peaks: &Peaks, until: Option<f64>| {
        let times = peaks.times.as_ref().zip(until);
        times.is_some_and(|(times, until)| when(times) > Some(until))
    };
    let any = |peaks: &Peaks, until: Option<f64>| ROWS.iter().any(|row| late(row.3, peaks, until));
    let largest = match any(&pair.reference, without)
        || any(&pair.springs, without)
        || with.is_some_and(|with| any(with, until))
    {
        true => "largest (* not predictable)",
        false => "largest",
    };
    let on_springs = match (pair.reference_ends_s, pair.springs_end_s) {
        (Some(_), _) => "on springs, to the end".into(),
        (None, Some(end)) => format!("on springs to {} s", significant(end, 3)),
        (None, None) => "on springs".to_string(),
    };
    let mut head = vec![largest.to_string(), reference, on_springs, "difference".into()];
    head.extend(with.map(|_| match pair.with_members_end_s {
        Some(end) => format!("{}, ONLY to {} s", run.members_words(), significant(end, 3)),
        None => run.members_words().into(),
    }));
    let row = |(name, of, words, when): PeakRow| {
        let part = |peaks: &Peaks| {
            let rounding = |x: &f64| x.abs() < ROUNDING * peaks.top_displacement_m;
            of(peaks).map(|x| if name.starts_with(PART) && rounding(&x) { 0.0 } else { x })
        };
        let (a, b) = (part(&pair.reference)?, part(&pair.springs)?);
        // feet that land where they stood move by the height of the lift times the rotation alone
        let little = NOT_SAID * pair.reference.top_displacement_m;
        if name == MOVED && a.abs().max(b.abs()) < little {
            return None;
        }
        let difference = match name {
            "impacts" => String::new(),
            _ if pair.reference_ends_s.or(pair.springs_end_s).is_some() => "-".into(),
            _ if a.abs() > ROUNDING_M && pair.reference.drift_ratio > LEAST_DRIFT => {
                percent(b / a - 1.0)
            }
            _ => "-".into(),
        };
        // a rigid body's are those of some strength
        let counted = if name == "impacts" && pair.reference.bending_m.is_none() {
            counted_impacts(pair.with_members.as_ref())
        } else if name == "impacts" {
            " (0.1/p apart)"
        } else {
            ""
        };
        let cell = |value: f64, peaks: &Peaks, until: Option<f64>| {
            format!("{}{}", words(value), if late(when, peaks, until) { "*" } else { "" })
        };
        let mut row = vec![
            format!("{}{counted}", named(name, pair)),
            cell(a, &pair.reference, without),
            cell(b, &pair.springs, without),
            difference,
        ];
        row.extend(with.and_then(|with| Some(cell(of(with)?, with, until))));
        Some(row)
    };
    let mut table = Table::new(head).with(ROWS.into_iter().filter_map(row));
    if let Some(needed) = run.friction_needed {
        let at = if run.friction_in_landings { " (impacts)" } else { "" };
        let mut row = vec![FRICTION.to_string(), significant(needed, 3) + at];
        row.resize(table.head.len(), String::new());
        table.rows.push(row);
    }
    Some(table)
}

/// A row of `summary.csv`: its name, its quantity, its unit, and when it is largest (s).
type SummaryRow =
    (&'static str, fn(&Peaks) -> Option<f64>, &'static str, fn(&PeakTimes) -> Option<f64>);

const SUMMARY: [SummaryRow; 7] = [
    (TOP, |p| Some(p.top_displacement_m), "m", at_top),
    ("largest by rocking", |p| p.bending_m.map(|_| p.rocking_m), "m", |t| Some(t.rocking_s)),
    ("largest by bending", |p| p.bending_m, "m", |t| t.bending_s),
    ("largest feet moved", |p| p.feet_moved_m, "m", |t| t.feet_moved_s),
    ("drift ratio", |p| Some(p.drift_ratio), "1", at_drift),
    ("uplift", |p| Some(p.uplift_m), "m", |t| Some(t.uplift_s)),
    ("impacts", |p| Some(p.impacts as f64), "1", to_the_end),
];

/// `summary.csv`: largest displacements and design forces as plain numbers, SI units. Empty: what
/// is withheld; on springs, forces that are the reference's.
///
/// `with_members`: of a rigid body with members, of which its forces are; `holds_to_s`: up to when
/// a number counts, if that is not all of the record; `time_s`: when it is, with members, or on
/// springs; `predictable`: whether the motion is, up to then.
pub fn summary(run: &Run) -> Table {
    let head =
        ["quantity", "unit", "reference", "on_springs", "with_members", "holds_to_s", "time_s"];
    let mut table = Table::new(head.into_iter().chain(["predictable"]));
    let mut row = |name: &str, unit: &str, numbers: [Option<f64>; 5], sure: Option<bool>| {
        let cell = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.6e}"));
        let sure = sure.map_or(String::new(), |sure| sure.to_string());
        let cells = numbers.map(cell).into_iter().chain([sure]);
        table.rows.push([name.to_string(), unit.to_string()].into_iter().chain(cells).collect());
    };
    let until = run.predictable_to();
    if let Some(pair) = &run.peaks {
        let springs = pair.with_members.unwrap_or(pair.springs);
        let ends = pair.with_members_end_s;
        for (name, of, unit, when) in SUMMARY {
            let [a, b] = [&pair.reference, &pair.springs].map(|peaks| of(peaks).map(exact));
            let with = pair.with_members.and_then(|with| of(&with).map(exact));
            // of a history that ends early no largest value is known
            let b = b.filter(|_| pair.springs_end_s.is_none());
            let timed = if pair.springs_end_s.is_some() { &pair.reference } else { &springs };
            let time = timed.times.as_ref().and_then(when);
            let sure = time.map(|time| until.is_none_or(|until| time <= until));
            let time = time.filter(|time| time.is_finite());
            if a.or(b).is_some() {
                row(name, unit, [a, b, with, ends, time], sure);
            }
        }
    }
    let words = run.force_words();
    for (name, force) in run.design_forces.iter().flat_map(|forces| forces.all()) {
        // an elastic structure's reference has no largest force of its own
        let reference =
            force.rigid.filter(|_| !matches!(run.parameters, FiledParameters::Elastic(_)));
        let time = Some(force.time_s).filter(|_| force.holds);
        // the springs of a rigid body check its forces; these are Housner's
        let on_springs = force.value.filter(|_| force.value != reference);
        let [springs, with] =
            if run.has_members() { [None, force.value] } else { [on_springs, None] };
        let numbers = [reference, springs, with, force.over_s, time];
        row(words(name), name.unit(), numbers, force.predictable.filter(|_| force.holds));
    }
    table
}

/// Which impacts of a rigid body are counted: where members hold it all may be gentler.
fn counted_impacts(with_members: Option<&Peaks>) -> &'static str {
    let none = |peaks: &Peaks| peaks.impacts == 0 && peaks.drift_ratio > LEAST_DRIFT;
    match with_members.is_some_and(none) {
        true => " (above 0.02 alpha; gentler not counted)",
        false => " (above 0.02 alpha)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use results::PartsOfTop;
    use rocking::structure::Structure;

    /// A block that turns to 0.001 alpha and back lands more gently than from 0.02 alpha.
    #[test]
    fn a_body_that_hardly_turns_says_why_no_impact_counts() {
        let block = Structure::block(2.4, 1.2, 1000.0).unwrap();
        let body = block.body::<f64>();
        let of = |lean: f64, impacts: usize| {
            let theta = [0.0, lean * body.alpha(), 0.0];
            Peaks::of_rigid((block.kind, &body), 0.01, &theta, None, impacts)
        };
        assert!(counted_impacts(Some(&of(1e-3, 0))).contains("gentler not counted"));
        for other in [None, Some(&of(1e-3, 2)), Some(&of(0.0, 0))] {
            assert_eq!(counted_impacts(other), " (above 0.02 alpha)");
        }
    }

    /// Parts of a top's displacement are of one column at one time; of a pier there is one alone.
    #[test]
    fn a_displacement_of_a_frame_says_of_which_column_it_is() {
        let block = Structure::block(2.4, 1.2, 1000.0).unwrap();
        let of = |column: Option<usize>, top_displacement_s: f64| {
            let theta = [0.0, 0.01, 0.0];
            let peaks = Peaks::of_rigid((block.kind, &block.body()), 0.01, &theta, None, 0);
            let then = Some(PartsOfTop { column, ..PartsOfTop::default() });
            Peaks {
                then,
                times: Some(PeakTimes { top_displacement_s, ..PeakTimes::default() }),
                ..peaks
            }
        };
        let told = |reference, springs| {
            column_named(&PeakPair { reference, springs, ..PeakPair::default() })
        };
        assert_eq!(told(of(Some(1), 4.82), of(Some(1), 4.83)), " (column 1 at 4.83 s)");
        assert_eq!(
            told(of(Some(2), 4.82), of(Some(1), 16.224)),
            " (column 2 at 4.82 s, 1 at 16.22 s)"
        );
        assert_eq!(told(of(None, 4.82), of(None, 4.83)), "");
    }
}
