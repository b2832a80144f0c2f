//! What is said of an elastic structure's springs.

use std::fmt::Write;

use super::ElasticRun;
use crate::{
    elastic::{reference::Outcome, structure::ElasticStructure},
    figures::{brief, short},
    motion::shown,
    parameters::elastic::{ElasticParameters, UnitRow},
};

/// The structure in a few words.
pub fn title(structure: &ElasticStructure) -> String {
    match structure {
        ElasticStructure::Pier(pier) => {
            format!("pier {} m high on a footing of {} m", brief(pier.height_m, 4), brief(pier.width_m, 4))
        }
        ElasticStructure::AFrame(frame) => {
            format!(
                "A-frame with elastic legs {} m high, feet {} m apart",
                brief(frame.height_m, 4),
                brief(frame.width_m, 4)
            )
        }
        ElasticStructure::Frame(frame) => {
            format!("frame {} m high, columns {} m apart", brief(frame.height_m, 4), brief(frame.span_m, 4))
        }
    }
}

/// The springs, Markdown: corners of equal springs in one column.
pub fn markdown(parameters: &ElasticParameters) -> String {
    let mut out = String::from("| under every corner | vertical | horizontal |\n|---|---|---|\n");
    let Some(first) = parameters.springs.first() else { return out };
    type Of = fn(&UnitRow) -> f64;
    let rows: [(&str, Of); 4] = [
        ("k1 [N/m]", |unit| unit.k1_n_per_m),
        ("k2 [N/m]", |unit| unit.k2_n_per_m),
        ("m2 [kg]", |unit| unit.m2_kg),
        ("c [N s/m]", |unit| unit.c_ns_per_m),
    ];
    for (name, of) in rows {
        let cell = |unit: &UnitRow| brief(of(unit), 5);
        // writing to a String cannot fail
        let _ = writeln!(out, "| {name} | {} | {} |", cell(&first.vertical), cell(&first.horizontal));
    }
    let same =
        parameters.springs.iter().all(|row| (row.vertical, row.horizontal) == (first.vertical, first.horizontal));
    if !same {
        out.push_str("\nOther corners have springs of their own: parameters.json.\n");
    }
    let _ = writeln!(
        out,
        "\nm2 is a numerical mass of the unit, not one to be built. Omega_n / 2 pi = {} Hz, of all mass on one vertical k1.",
        brief(parameters.omega_n_hz, 5)
    );
    out
}

/// What was measured without the record.
pub fn assessed(parameters: &ElasticParameters) -> Vec<String> {
    let Some(a) = &parameters.assessment else { return Vec::new() };
    let mut lines = Vec::new();
    if !a.reached {
        lines.push(format!(
            "accuracy: NOT REACHED: {} was asked for; the springs are the best found, allow stiffer ones or ask for less",
            a.accuracy
        ));
    }
    let m = &a.measured;
    for (on, errors) in
        [("releases from leans", m.releases), ("synthetic motions", m.motions), ("the record", m.record)]
    {
        let Some(e) = errors else { continue };
        lines.push(format!(
            "accuracy: on {on} ({}): NRMSE of rotation {} (median) and {} (90 %), of drift {} and {}; {} touches a landing",
            e.count,
            shown(e.median[0]),
            shown(e.p90[0]),
            shown(e.median[1]),
            shown(e.p90[1]),
            short(e.touches, 2)
        ));
    }
    if m.ill_conditioned > 0 {
        lines.push(format!("accuracy: {} motions are left out: no model foretells them", m.ill_conditioned));
    }
    lines
}

/// All that the program says, a line each.
pub fn said(run: &ElasticRun) -> Vec<String> {
    let (missed, assessed): (Vec<String>, Vec<String>) =
        assessed(&run.parameters).into_iter().partition(|line| line.contains("NOT REACHED"));
    let mut lines = missed;
    let structure = &run.assembled.structure;
    if let Some(on) = &run.parameters.on_record {
        let alpha = structure.body().alpha();
        let verdict = match run.answer.reference.outcome {
            Outcome::Overturned { time } => format!("overturns at t = {time:.2} s"),
            Outcome::Stopped { time, .. } => format!("could not be followed beyond t = {time:.2} s"),
            Outcome::Completed if on.landings_reference == 0 => "is not lifted by this record".into(),
            Outcome::Completed => format!(
                "rocks to {} of alpha ({:.4} rad) and stands; {} landings",
                short(on.peak_ratio_reference, 3),
                alpha,
                on.landings_reference
            ),
        };
        lines.push(format!("on rigid ground with plastic landings the structure {verdict}"));
        if on.landings_reference > 0 {
            let over = if on.whole {
                "over all of it".to_string()
            } else {
                format!(
                    "over its first {:.2} s; from then on no model foretells this motion one to one, judge it over many records",
                    on.compared_s
                )
            };
            lines.push(format!(
                "on its springs the rotation is within {} of that, the drift within {} (NRMSE), {over}; {} touches",
                shown(on.nrmse_rotation),
                shown(on.nrmse_drift),
                on.touches_fem
            ));
        }
    }
    lines.extend(assessed);
    lines.push(format!(
        "structure: {} Hz fixed to the ground, across; its weight shortens the columns by {} of their length",
        short(structure.frequency_hz(), 4),
        brief(structure.shortening(), 2)
    ));
    lines
}
