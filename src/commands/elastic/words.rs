//! What is said of an elastic structure's springs.

use std::fmt::Write;

use super::ElasticRun;
use crate::{
    case::Yardstick,
    elastic::{
        answer::{Compared, ComparedEnd},
        ensemble::{Ensemble, Spread},
        reference::ReferenceOutcome,
        structure::ElasticStructure,
    },
    fem::HistoryOutcome,
    figures::{brief, short},
    members::Members,
    motion::{percent, shown},
    parameters::elastic::{ElasticAssessment, ElasticParameters, OnRecord, UnitRow},
    tuning::elastic::suite::Measured,
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

/// Why the accuracy asked for is not reached, if it is not.
fn missed(a: &ElasticAssessment) -> Option<String> {
    let what = match (a.reached, a.measured.nothing()) {
        (true, _) => return None,
        (false, false) => {
            "was asked for and is NOT REACHED: the springs are the best found, allow stiffer ones or ask for less"
        }
        (false, true) => {
            "was asked for and could NOT be MEASURED: no release and no motion of this structure can be compared with rigid ground (it is not lifted, overturns, or no \
             model foretells it); the springs are those that the search begins with"
        }
    };
    Some(match a.judged_by {
        Yardstick::Histories => format!("accuracy: {} {what}", a.accuracy),
        Yardstick::Peaks => format!("accuracy: an error of peaks of {} {what}", percent(a.accuracy)),
    })
}

/// What was measured without the record, a line each.
fn measured(m: &Measured) -> Vec<String> {
    let mut lines = Vec::new();
    for (on, errors) in
        [("releases from leans", m.releases), ("synthetic motions", m.motions), ("the record", m.record)]
    {
        let Some(e) = errors else { continue };
        lines.push(format!(
            "accuracy: on {on} ({}): {}NRMSE of rotation {} (median) and {} (90 %), of drift {} and {}; {} touches a landing",
            e.count,
            e.peaks.map_or(String::new(), |peaks| format!(
                "error of peaks (displacement, drift, uplift) {} (median) and {} (90 %), ",
                percent(peaks.largest[0]),
                percent(peaks.largest[1])
            )),
            shown(e.median[0]),
            shown(e.p90[0]),
            shown(e.median[1]),
            shown(e.p90[1]),
            short(e.touches, 2)
        ));
    }
    if m.ill_conditioned > 0 {
        lines.push(format!(
            "accuracy: left out, since no model foretells them: {} of the releases and motions",
            m.ill_conditioned
        ));
    }
    lines
}

/// What is said of springs without a record.
pub fn assessed(parameters: &ElasticParameters) -> Vec<String> {
    let Some(a) = &parameters.assessment else { return Vec::new() };
    missed(a).into_iter().chain(measured(&a.measured)).collect()
}

/// Over how much of a record something is compared.
pub fn over(compared: &Compared) -> String {
    let seconds = compared.seconds;
    match compared.end {
        ComparedEnd::Record => "over all of it".into(),
        ComparedEnd::History => format!("over its first {seconds:.2} s, where it ends"),
        ComparedEnd::Foretold => format!(
            "over its first {seconds:.2} s; from then on no model foretells this motion one to one: it is to be judged over many"
        ),
        ComparedEnd::Slides => format!(
            "over its first {seconds:.2} s; then a corner lands so flat that it slides on, by an impulse that depends on friction, and these springs do not follow beyond"
        ),
    }
}

/// What the structure does on rigid ground.
fn on_rigid_ground(run: &ElasticRun, on: &OnRecord) -> String {
    let reference = &run.answer.histories.reference.history;
    let did = match reference.outcome {
        ReferenceOutcome::Overturned { time } => format!("overturns at t = {time:.2} s"),
        ReferenceOutcome::Stopped { time, .. } => format!("could not be followed beyond t = {time:.2} s"),
        ReferenceOutcome::Completed if !reference.lifts() => "is not lifted by this record".into(),
        ReferenceOutcome::Completed => format!(
            "rocks to {} of alpha = {:.4} rad and stands; {} landings",
            short(on.peak_ratio_reference, 3),
            run.assembled.structure.body().alpha(),
            on.landings_reference
        ),
    };
    format!("on rigid ground with plastic landings the structure {did}")
}

/// What it does on its springs: how that history ends if it does not get through the record, and how near it is.
fn on_springs(run: &ElasticRun, on: &OnRecord) -> Vec<String> {
    let mut lines = Vec::new();
    match run.answer.histories.fem.outcome {
        HistoryOutcome::Completed => {}
        HistoryOutcome::Overturned { time } => {
            lines.push(format!("on its springs the structure overturns at t = {time:.2} s"));
        }
        HistoryOutcome::Stopped { time } | HistoryOutcome::WorkBound { time } | HistoryOutcome::Unstable { time } => {
            lines.push(format!("on its springs the structure could not be followed beyond t = {time:.2} s"));
        }
    }
    let within = match (on.nrmse_rotation, on.nrmse_drift) {
        (Some(rotation), Some(drift)) => {
            format!("the rotation is within {} of that, the drift within {}", shown(rotation), shown(drift))
        }
        (None, Some(drift)) => format!("the drift is within {} of that", shown(drift)),
        _ => return lines,
    };
    let over = over(&run.answer.compared);
    lines.push(format!("on its springs {within} (NRMSE), {over}; {} touches", on.touches_fem));
    lines.extend(further(on));
    lines.extend(on.near.iter().map(|near| nearby(near, run.assembled.structure.body().alpha())));
    lines
}

/// That springs follow the record beyond what can be foretold, and which ones are enough up to there.
fn further(on: &OnRecord) -> Option<String> {
    let foretold = on.foretold_s.filter(|foretold| on.compared_s > *foretold)?;
    let softer = on.softer_omega_n_hz.map_or(String::new(), |hz| {
        format!(
            "; springs of {hz:.0} Hz are enough up to there, with which OpenSees takes fewer steps: --max-hz {:.0}",
            hz.ceil()
        )
    });
    Some(match on.slides_on_s {
        Some(time) => format!(
            "conditioning: at t = {time:.2} s a corner lands so flat that it slides on, by an impulse that depends on friction{softer}"
        ),
        None => format!(
            "conditioning: from t = {foretold:.2} s on a change of a millionth is more than a thousandth of the peak{softer}"
        ),
    })
}

/// What motions near the record come to.
fn nearby(near: &Ensemble, alpha: f64) -> String {
    let Ensemble { motions, change, rotation_rad, drift_m, overturned } = near;
    let cell = |value: Option<f64>, unit: f64| value.map_or("overturned".to_string(), |value| short(value / unit, 3));
    let both = |spread: &Spread, unit: f64| {
        let [ground, springs] =
            [0, 1].map(|k| format!("{} and {}", cell(spread.median[k], unit), cell(spread.p90[k], unit)));
        format!("{ground} on rigid ground, {springs} on springs")
    };
    let fallen = match overturned {
        [0, 0] => String::new(),
        [reference, fem] => format!("; {reference} overturn on rigid ground, {fem} on springs"),
    };
    format!(
        "over {motions} motions within {} % of the record (median and 90 %): largest rotation over alpha {}; largest drift in mm {}; \
         distances of Kolmogorov and Smirnov {:.2} and {:.2}{fallen}",
        brief(1e2 * change, 2),
        both(rotation_rad, alpha),
        both(drift_m, 1e-3),
        rotation_rad.ks_distance,
        drift_m.ks_distance,
    )
}

/// All that the program says, a line each.
pub fn said(run: &ElasticRun) -> Vec<String> {
    let assessment = run.parameters.assessment.as_ref();
    let mut lines: Vec<String> = assessment.and_then(missed).into_iter().collect();
    if let Some(on) = &run.parameters.on_record {
        lines.push(on_rigid_ground(run, on));
        lines.extend(on_springs(run, on));
    }
    lines.extend(assessment.into_iter().flat_map(|a| measured(&a.measured)));
    if run.assembled.members != Members::default() {
        lines.push(
            "members: springs are tuned for the structure with its dampers and tendons; the frequency below is that without them".into(),
        );
    }
    let structure = &run.assembled.structure;
    lines.push(format!(
        "structure: {} Hz fixed to the ground, across; its weight shortens the columns by {} of their length",
        short(structure.frequency_hz(), 4),
        brief(structure.shortening(), 2)
    ));
    lines
}
