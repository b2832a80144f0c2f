//! What is said of springs alone: of an elastic structure without a record.

use super::super::{
    AccuracyOn, AccuracyReport, FiledParameters, ProgramReport, Run, STEADY, Taken, Unit,
    accuracy::THIS_RECORD, doubts, filed_of_elastic as filed,
};
use super::title;
use cases::{ElasticCase, Yardstick};
use files::message::{percent, quantity, significant};
use frames::peaks::StructurePeakErrors;
use parameters::{
    corner::CornerRow,
    elastic::{ElasticAssessment, ElasticParameters, OnRecord},
};
use results::Finding;
use rocking::members::Tendon;
use springs::{
    elastic::suite::{ElasticErrors, ElasticPeaks},
    suite::LOOSER,
};

pub(super) fn springs_findings(parameters: &ElasticParameters) -> Option<Finding> {
    let a = parameters.assessment.as_ref().filter(|a| !a.reached)?;
    Some(match a.measured.nothing() {
        // of a search that was cut before it measured anything its own finding tells
        true if parameters
            .findings
            .iter()
            .any(|f| matches!(f.finding, Finding::SearchCut { .. })) =>
        {
            return None;
        }
        true => Finding::AccuracyNotMeasured,
        false if a.judged_by == Yardstick::Peaks => {
            Finding::PeaksMissed { asked: a.accuracy, capped: false, another_restitution: false }
        }
        false => {
            Finding::AccuracyMissed { asked: a.accuracy, capped: false, another_restitution: false }
        }
    })
}

fn accuracy(a: &ElasticAssessment, on_record: Option<&OnRecord>) -> AccuracyReport {
    let m = &a.measured;
    let asked = |by: Yardstick| Some(a.accuracy).filter(|_| a.judged_by == by);
    let (of_history, of_peaks) = (asked(Yardstick::Histories), asked(Yardstick::Peaks));
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    let on = |on: &str, errors: Option<ElasticErrors>| {
        let e = errors?;
        Some(AccuracyOn {
            on: if e.count == 1 { on.to_string() } else { format!("{} {on} (median)", e.count) },
            count: e.count,
            history: finite(e.median[0]),
            peaks: e.peaks.and_then(|peaks| finite(peaks.largest[0])),
            worst: e.peaks.map(|peaks| worst(&peaks.median)),
            history_allowed: of_history,
            peaks_allowed: of_peaks,
            missed: of_history.and_then(|asked| missed(&e, asked)).or(of_peaks
                .zip(e.peaks)
                .and_then(|(asked, peaks)| missed_peaks(&peaks, e.count, asked))),
        })
    };
    let part = on_record.filter(|on| !on.whole).map(|on| {
        let rocks = on.lifts_s.map_or(String::new(), |lifts| {
            format!(", {} s of rocking", significant((on.compared_s - lifts).max(0.0), 2))
        });
        format!("{THIS_RECORD} to {} s{rocks}", significant(on.compared_s, 3))
    });
    let this = part.unwrap_or_else(|| THIS_RECORD.to_string());
    let all = [on(&this, m.record), on("synthetic motions", m.motions), on("releases", m.releases)];
    AccuracyReport {
        history_asked: of_history,
        peaks_asked: of_peaks,
        reached: a.reached,
        measured: all.into_iter().flatten().collect(),
    }
}

/// What of the histories is further above what is allowed of it than the median of rotations is:
/// that of bending, or the worst tenth.
fn missed(errors: &ElasticErrors, asked: f64) -> Option<String> {
    let [[rotation, bending], [rotation_p90, bending_p90]] = [errors.median, errors.p90];
    let besides = [
        ("bending: NRMSE", bending, LOOSER * asked),
        ("90 %: NRMSE", rotation_p90, LOOSER * asked),
        ("90 %, bending: NRMSE", bending_p90, LOOSER * LOOSER * asked),
    ];
    let (what, found, allowed) =
        besides.into_iter().max_by(|a, b| (a.1 / a.2).total_cmp(&(b.1 / b.2)))?;
    if found.is_infinite() {
        return Some(ends_early(errors.count));
    }
    (found > allowed && found / allowed > rotation / asked)
        .then(|| format!("{what} {}, allowed {}", significant(found, 2), significant(allowed, 2)))
}

/// What is said of an infinite error over so many histories.
fn ends_early(count: usize) -> String {
    match count {
        1 => "the history on springs ends early".into(),
        _ => "at least one in ten histories on springs ends early".into(),
    }
}

/// The worst tenth of the peaks, where it is further above what is allowed of it than the median.
fn missed_peaks(peaks: &ElasticPeaks, count: usize, asked: f64) -> Option<String> {
    let ([median, found], allowed) = (peaks.largest, LOOSER * asked);
    if found.is_infinite() {
        return Some(ends_early(count));
    }
    (found > allowed && found / allowed > median / asked)
        .then(|| format!("90 %: peaks within {}, allowed {}", percent(found), percent(allowed)))
}

/// Which peak errs most, and whether forces are among them.
fn worst(of: &StructurePeakErrors) -> &'static str {
    match (of.worst(), of.design_forces) {
        ("displacement", None) => "displacement, forces aside",
        ("bending", None) => "bending, forces aside",
        ("uplift", None) => "uplift, forces aside",
        (worst, _) => worst,
    }
}

/// Springs of a case without a record.
pub fn of_case(case: &ElasticCase, mut parameters: ElasticParameters) -> Run {
    // what of the search was cut is there already
    let search = parameters.findings.iter().map(|filed| filed.finding.clone());
    let found =
        search.chain(doubts(case.doubts_of_structure())).chain(springs_findings(&parameters));
    parameters.findings = filed(found);
    alone(parameters)
}

/// Springs without a record.
pub(super) fn alone(parameters: ElasticParameters) -> Run {
    let program = ProgramReport::of_elastic(&parameters);
    let findings = match parameters.findings.is_empty() {
        true => filed(springs_findings(&parameters)),
        false => parameters.findings.clone(),
    };
    Run {
        taken: taken(&parameters),
        reference: "rigid ground",
        peaks: parameters.peaks,
        friction_needed: None,
        friction_in_landings: false,
        design_forces: parameters.design_forces,
        springs_at: "each corner",
        springs: corner_units(&parameters.springs),
        program: program.clone(),
        accuracy: parameters
            .assessment
            .as_ref()
            .map(|a| accuracy(a, parameters.on_record.as_ref())),
        findings,
        sap2000: false,
        sections: program
            .iter()
            .flat_map(|program| [program.section(), program.springs()])
            .collect(),
        parameters: FiledParameters::Elastic(Box::new(parameters)),
    }
}

/// The units under corners: once where all have the same.
pub(crate) fn corner_units(corners: &[CornerRow]) -> Vec<Unit> {
    let first = corners.first().copied();
    let same = corners.iter().all(|row| {
        first.is_some_and(|first| {
            (row.vertical, row.horizontal) == (first.vertical, first.horizontal)
        })
    });
    let rows = if same { &corners[..corners.len().min(1)] } else { corners };
    let springs = rows.iter().enumerate().flat_map(|(i, row)| {
        let name = |way: &str| match same {
            true => way.to_string(),
            false => format!("{way}, corner {} at {} m", i + 1, significant(row.x_m, 4)),
        };
        [("vertical", row.vertical), ("horizontal", row.horizontal)]
            .map(|(way, row)| Unit { name: name(way), row })
    });
    springs.collect()
}

fn taken(parameters: &ElasticParameters) -> Taken {
    let structure = &parameters.structure;
    let body = structure.body();
    let given = serde_json::to_value(structure).unwrap_or_default();
    let mut facts: Vec<(String, String)> = given
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(key, value)| *key != "kind" && !value.is_null())
        .map(|(key, value)| {
            (key.clone(), value.as_f64().map_or(value.to_string(), |x| significant(x, 4)))
        })
        .collect();
    let mut fact = |name: &str, value: String| facts.push((name.to_string(), value));
    if let Some(damper) = parameters.damper {
        fact("damper at each corner", format!("{} N s/m", significant(damper.c, 4)));
    }
    if let Some(Tendon { stiffness, pretension }) = parameters.tendon {
        fact(
            "tendon",
            format!("{} N/m, stressed to {}", significant(stiffness, 4), quantity(pretension, "N")),
        );
    }
    fact("slenderness alpha of the rigid body", format!("{} rad", significant(body.alpha(), 4)));
    fact("frequency p of the rigid body", format!("{} 1/s", significant(body.p(), 4)));
    fact("restitution e of the rigid body, equation 2", significant(body.restitution(), 4));
    fact(
        "frequency fixed to the ground",
        format!("{} Hz", significant(structure.fixed_base_frequency_hz(), 4)),
    );
    fact(
        "its weight shortens the columns by",
        format!("{} of their length", significant(structure.shortening(), 2)),
    );
    let lifts = parameters.assembled().ok().and_then(|assembled| assembled.uplift_g());
    if let Some(lifts) = lifts {
        fact(STEADY, format!("{} g", significant(lifts, 4)));
    }
    // a tendon holds it down, too
    if parameters.tendon.is_none() {
        fact(
            "lifts as a rigid body at g tan alpha",
            format!("{} g", significant(body.alpha().tan(), 4)),
        );
    }
    let mass = quantity(structure.mass(), "kg");
    let text = format!(
        "{}, {mass}, {} Hz if fixed",
        title(structure),
        significant(structure.fixed_base_frequency_hz(), 3)
    );
    Taken::new(text, facts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_misses_besides_the_rotations_is_told() {
        let errors = |median: [f64; 2], p90: [f64; 2]| ElasticErrors {
            median,
            p90,
            count: 8,
            touches: 1.0,
            peaks: None,
        };
        let told = |median, p90| missed(&errors(median, p90), 0.002);
        assert_eq!(told([1e-3, 9e-3], [1e-3, 9e-3]), None);
        let bending = told([1e-3, 0.048], [1e-3, 0.048]);
        assert_eq!(bending.as_deref(), Some("bending: NRMSE 0.048, allowed 0.01"));
        let tenth = told([1e-3, 9e-3], [0.03, 9e-3]);
        assert_eq!(tenth.as_deref(), Some("90 %: NRMSE 0.03, allowed 0.01"));
        let early = told([1e-3, 9e-3], [f64::INFINITY, f64::INFINITY]);
        assert_eq!(early.as_deref(), Some("at least one in ten histories on springs ends early"));
        let none = StructurePeakErrors::default();
        let peaks = |largest| missed_peaks(&ElasticPeaks { largest, median: none }, 8, 0.02);
        assert_eq!(peaks([0.01, 0.09]), None);
        let tenth = peaks([0.01, 0.2]);
        assert_eq!(tenth.as_deref(), Some("90 %: peaks within 20.0 %, allowed 10.0 %"));
        // the rotations themselves miss by more
        assert_eq!(told([0.1, 0.048], [0.1, 0.048]), None);
    }
}
