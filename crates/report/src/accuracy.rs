//! How accurate the springs are, measured in the run, and on what.

use serde::Serialize;

use super::{FiledParameters, Run, Table};
use cases::Yardstick;
use files::message::{percent, significant};
use parameters::Parameters;
use results::{Finding, findings::HARDLY_ROCKS};
use springs::suite::{Accuracy, LOOSER, PeakAccuracy, Statistic};
use validation::PeakErrors;

/// What the record of the run is called.
pub(crate) const THIS_RECORD: &str = "this record";

/// What the synthetic motions are called on a row below that of their median.
const NINE_OF_TEN: &str = "90 % of these";

/// Error of peaks, and NRMSE of histories, beyond which springs are of no use.
const NO_USE: f64 = 1.0;

/// Why springs are not judged on the record of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unjudged {
    /// Its motion cannot be predicted: two models that are equally right part on it.
    TooSensitive,
    /// Nothing rocks on it.
    NothingRocks,
    /// It overturns before an impact, so that no landing judges them.
    NoImpact,
    /// Housner's pivot would have to pull: his equation ends.
    PivotPulls,
    /// None of these.
    NotJudged,
}

impl Unjudged {
    fn words(self) -> &'static str {
        match self {
            Self::TooSensitive => "this record is too sensitive to judge on",
            Self::NothingRocks => "this record: it does not rock",
            Self::NoImpact => "this record: it overturns without an impact",
            Self::PivotPulls => "this record: Housner's body leaves the ground",
            Self::NotJudged => "this record: not judged on",
        }
    }
}

impl Run {
    /// Why springs are not judged on the record, if there is one.
    pub(crate) fn unjudged(&self) -> Option<Unjudged> {
        self.taken.record.as_ref()?;
        let rests = self.findings.iter().any(|filed| match filed.finding {
            Finding::NeverLifts { .. } | Finding::Slides { .. } => true,
            Finding::Stands { share_of_overturning, .. } => share_of_overturning < HARDLY_ROCKS,
            _ => false,
        });
        let any = |of: fn(&Finding) -> bool| self.findings.iter().any(|filed| of(&filed.finding));
        let flies =
            any(|f| matches!(f, Finding::PivotLeavesGround { .. } | Finding::FreeFlight { .. }));
        let sensitive = match &self.parameters {
            FiledParameters::Rigid(of) => {
                of.conditioning.and_then(|row| row.well_conditioned).is_some_and(|well| !well)
            }
            FiledParameters::Elastic(_) => self.predictable_to().is_some(),
        };
        let no_impact = any(|f| matches!(f, Finding::Overturns { .. }))
            && self.peaks.is_some_and(|pair| pair.reference.impacts == 0);
        Some(match () {
            () if rests => Unjudged::NothingRocks,
            () if sensitive => Unjudged::TooSensitive,
            () if flies => Unjudged::PivotPulls,
            () if no_impact => Unjudged::NoImpact,
            () => Unjudged::NotJudged,
        })
    }
}

/// An error measured on a record or on a set of motions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracyOn {
    /// The record, or the set and its statistic.
    pub on: String,
    /// Motions.
    pub count: usize,
    /// NRMSE of the history: of the displacement, or of the rotation of an elastic structure.
    pub history: Option<f64>,
    /// Relative error of the largest displacement, uplift and forces, the largest of them.
    pub peaks: Option<f64>,
    /// Which of them that is; none of a share of motions, each of which has its own.
    pub worst: Option<&'static str>,
    /// NRMSE allowed there.
    pub history_allowed: Option<f64>,
    /// Error of peaks allowed there.
    pub peaks_allowed: Option<f64>,
    /// What misses what was asked there besides these two, and what is allowed of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missed: Option<String>,
}

/// What was asked for and what was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracyReport {
    /// NRMSE asked of histories, if the springs were chosen by it.
    pub history_asked: Option<f64>,
    /// Error asked of peaks, if the springs were chosen by it.
    pub peaks_asked: Option<f64>,
    /// Whether it was reached.
    pub reached: bool,
    /// What was measured.
    pub measured: Vec<AccuracyOn>,
}

impl AccuracyReport {
    /// Of a rigid body's springs, which are judged without its members, if it has any; and on the
    /// run's record with them.
    pub(crate) fn of_rigid(parameters: &Parameters) -> Option<Self> {
        let a = parameters.assessment.as_ref()?;
        let (has_members, with_members) =
            (!parameters.members().is_none(), &parameters.accuracy_with_members);
        let (history, each) = (&a.measured, a.measured_peaks);
        let peaks = each.map(|peaks| peaks.largest);
        let worst = |of: fn(&PeakAccuracy) -> Option<PeakErrors>| {
            each.as_ref().and_then(of).map(|e| e.worst())
        };
        let asked = |by: Yardstick| Some(a.accuracy).filter(|_| a.judged_by == by);
        let (of_history, of_peaks) = (asked(Yardstick::Histories), asked(Yardstick::Peaks));
        let row = |on: String,
                   count: usize,
                   of: &dyn Fn(&Accuracy) -> Option<f64>,
                   looser: f64,
                   worst| AccuracyOn {
            on,
            count,
            history: of(history),
            peaks: peaks.as_ref().and_then(of),
            worst,
            history_allowed: of_history.map(|x| looser * x),
            peaks_allowed: of_peaks.map(|x| looser * x),
            missed: None,
        };
        let statistics = |of: fn(&Accuracy) -> Option<Statistic>,
                          words: fn(usize) -> String,
                          looser: f64,
                          worst| {
            let count = of(history).or(peaks.as_ref().and_then(of))?.count;
            Some(row(words(count), count, &|a| of(a).map(|s| s.value), looser, worst))
        };
        let record = history
            .record
            .map(|_| row(THIS_RECORD.into(), 1, &|a| a.record, 1.0, worst(|p| p.record)));
        let words = |n| format!("{n} synthetic motions (median)");
        let median = statistics(|a| a.synthetic_median, words, 1.0, worst(|p| p.synthetic_median));
        let p90 = statistics(|a| a.synthetic_p90, |_| NINE_OF_TEN.into(), LOOSER, None);
        let looser = a.judged().looser_on_earthquakes();
        let words = |n| format!("{n} earthquake-like ones (mean)");
        let mean = statistics(|a| a.earthquakes_mean, words, looser, worst(|p| p.earthquakes_mean));
        let mut measured: Vec<_> = [record, median, p90, mean].into_iter().flatten().collect();
        if let Some(first) = measured.first_mut().filter(|_| has_members) {
            first.on.push_str(", without members");
        }
        let with_members = with_members.as_ref().map(|of| {
            let to = of.until_s.map_or(String::new(), |s| format!(" to {} s", significant(s, 4)));
            let (peaks, worst) = of.peaks();
            AccuracyOn {
                on: format!("{THIS_RECORD}{to}, with members"),
                count: 1,
                history: Some(of.history),
                peaks: Some(peaks),
                worst: Some(worst),
                history_allowed: of_history,
                peaks_allowed: of_peaks,
                missed: None,
            }
        });
        let within = |found: Option<f64>, allowed: Option<f64>| {
            allowed.is_none_or(|allowed| found.is_none_or(|found| found <= allowed))
        };
        let reached = a.reached
            && with_members.as_ref().is_none_or(|row| {
                within(row.history, row.history_allowed) && within(row.peaks, row.peaks_allowed)
            });
        measured.splice(..0, with_members);
        let (history_asked, peaks_asked) = (of_history, of_peaks);
        Some(Self { history_asked, peaks_asked, reached, measured })
    }

    /// In one sentence, peaks first.
    pub fn sentence(&self) -> String {
        let on = |row: &AccuracyOn| {
            let peaks = row.peaks.map(|peaks| format!("peaks within {}", within(peaks, row.worst)));
            let history = row.history.map(|nrmse| format!("history {}", significant(nrmse, 2)));
            let all: Vec<String> =
                peaks.into_iter().chain(history).chain(row.missed.clone()).collect();
            format!("on {}: {}", row.on, all.join(", "))
        };
        let reached = if self.reached { "reached" } else { "NOT reached" };
        let measured: Vec<String> = self.measured().map(on).collect();
        match measured.is_empty() {
            true => format!("not measured; asked: {}", self.asked()),
            false => format!("{} (NRMSE); asked: {}, {reached}", measured.join("; "), self.asked()),
        }
    }

    /// The same for a screen, in parts: on the first so many of the record and the sets of motions;
    /// why this record, if there is one, does not judge springs; what was asked, and whether that
    /// is reached.
    pub(crate) fn short(&self, sets: usize, record: Option<Unjudged>) -> Vec<String> {
        let on = |(i, row): (usize, &AccuracyOn)| {
            let [peaks, nrmse] = if i == 0 { ["peaks within ", "NRMSE "] } else { [""; 2] };
            let peaks = row.peaks.map(|error| format!("{peaks}{}", within(error, row.worst)));
            let history = row.history.map(|error| format!("{nrmse}{}", significant(error, 2)));
            let all: Vec<String> =
                peaks.into_iter().chain(history).chain(row.missed.clone()).collect();
            format!("{}: {}", row.on, all.join(", "))
        };
        let measured: Vec<String> = self.measured().take(sets).enumerate().map(on).collect();
        if measured.is_empty() {
            return vec![self.sentence()];
        }
        let reached = if self.reached { "asked" } else { "NOT reached" };
        let mut said = vec![format!("{reached}: {}", self.asked())];
        said.extend(record.filter(|_| !self.on_record()).map(|why| why.words().to_string()));
        // what is wrong comes first
        if self.reached {
            said.reverse();
        }
        [measured, self.missed_beyond(sets).into_iter().collect(), said].concat()
    }

    /// What was asked for and missed on a set beyond the first so many, if not on one of these.
    fn missed_beyond(&self, sets: usize) -> Option<String> {
        let over = |found: Option<f64>, allowed: Option<f64>| {
            allowed.zip(found).is_some_and(|(allowed, found)| found > allowed)
        };
        let misses = |row: &&AccuracyOn| {
            over(row.history, row.history_allowed)
                || over(row.peaks, row.peaks_allowed)
                || row.missed.is_some()
        };
        if self.reached || self.measured().take(sets).any(|row| misses(&row)) {
            return None;
        }
        let row = self.measured().find(misses)?;
        let found = match (row.history, row.peaks) {
            _ if row.missed.is_some() => row.missed.clone()?,
            (Some(nrmse), _) if self.history_asked.is_some() => {
                format!("NRMSE {}", significant(nrmse, 2))
            }
            (_, peaks) => format!("peaks within {}", within(peaks?, row.worst)),
        };
        let on = match &row.on[..] {
            NINE_OF_TEN => format!("90 % of {} synthetic motions", row.count),
            on => on.replace(" ones ", " motions "),
        };
        Some(format!("{on}: {found}"))
    }

    /// Why springs that missed what was asked are of no use: an error beyond 100 %, on the record,
    /// in the median or in the mean of earthquakes.
    pub(crate) fn no_use(&self) -> Option<String> {
        let useless = |x: Option<f64>| x.is_some_and(|x| x > NO_USE || x.is_nan());
        let typical = |row: &&AccuracyOn| row.on != NINE_OF_TEN;
        let bad = |row: &&AccuracyOn| useless(row.peaks) || useless(row.history);
        let row = self.measured().filter(typical).find(bad).filter(|_| !self.reached)?;
        let found = match row.peaks.filter(|_| useless(row.peaks)) {
            Some(peaks) => format!("peaks err by {}", percent(peaks)),
            None => format!("NRMSE {}", significant(row.history?, 2)),
        };
        Some(format!("NOT to be used: {}: {found}", row.on))
    }

    /// Sets that something was measured on, the record among them.
    pub(crate) fn sets(&self) -> usize {
        self.measured().count()
    }

    /// Whether something was measured on the record itself.
    fn on_record(&self) -> bool {
        self.measured().any(|row| row.on.starts_with(THIS_RECORD))
    }

    /// On what anything was measured.
    fn measured(&self) -> impl Iterator<Item = &AccuracyOn> {
        self.measured.iter().filter(|row| row.peaks.or(row.history).is_some())
    }

    /// What was asked for.
    fn asked(&self) -> String {
        match (self.peaks_asked, self.history_asked) {
            (Some(peaks), _) => format!("peaks within {}", within(peaks, None)),
            (None, Some(history)) => format!("NRMSE {}", significant(history, 3)),
            (None, None) => "nothing".into(),
        }
    }

    /// The same as a table.
    pub(crate) fn table(&self) -> Table {
        let cell = |x: Option<f64>, words: fn(f64) -> String| x.map_or("-".into(), words);
        let rows = self.measured.iter().map(|row| {
            vec![
                row.on.clone(),
                row.count.to_string(),
                cell(row.peaks, percent),
                cell(row.peaks_allowed, percent),
                cell(row.history, |x| significant(x, 2)),
                cell(row.history_allowed, |x| significant(x, 2)),
            ]
        });
        let head = [
            "measured on",
            "motions",
            "error of peaks",
            "allowed",
            "NRMSE of the history",
            "allowed",
        ];
        if self.measured.iter().all(|row| row.missed.is_none()) {
            return Table::new(head).with(rows);
        }
        let missed = self.measured.iter().map(|row| row.missed.clone().unwrap_or("-".into()));
        let rows = rows.zip(missed).map(|(row, missed)| [row, vec![missed]].concat());
        Table::new(head.into_iter().chain(["also missed"])).with(rows)
    }
}

/// An error of peaks, and of which one.
fn within(error: f64, worst: Option<&str>) -> String {
    let of = worst.map_or(String::new(), |worst| format!(" ({worst})"));
    format!("{}{of}", percent(error).trim_start_matches("below "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_accuracy_names_peaks_and_history_and_on_what() {
        let row = AccuracyOn {
            on: "this record".into(),
            count: 1,
            history: Some(2.2e-5),
            peaks: Some(1.3e-4),
            worst: Some("uplift"),
            history_allowed: Some(0.002),
            peaks_allowed: None,
            missed: None,
        };
        let mut report = AccuracyReport {
            history_asked: Some(0.002),
            peaks_asked: None,
            reached: true,
            measured: vec![row],
        };
        assert_eq!(
            report.sentence(),
            "on this record: peaks within 0.013 % (uplift), history 2.2e-5 (NRMSE); asked: NRMSE \
                0.002, reached"
        );
        assert_eq!(
            report.short(2, Some(Unjudged::TooSensitive)),
            ["this record: peaks within 0.013 % (uplift), NRMSE 2.2e-5", "asked: NRMSE 0.002"]
        );
        assert_eq!(report.table().rows[0][2], "0.013 %");
        // what misses is told, even where its row is not
        let first = report.measured[0].clone();
        let (median, many) = ("24 synthetic motions (median)".to_string(), 24);
        let missed = AccuracyOn { on: median, count: many, history: Some(0.019), ..first.clone() };
        report = AccuracyReport { reached: false, measured: vec![first, missed], ..report };
        let short = report.short(1, None);
        assert_eq!(
            short[1..],
            ["24 synthetic motions (median): NRMSE 0.019", "NOT reached: NRMSE 0.002"]
        );
        assert_eq!(report.short(2, None).len(), short.len());
        assert_eq!(report.no_use(), None);
        report.measured[0].peaks = Some(8.53);
        let told = "NOT to be used: this record: peaks err by 853 %";
        assert_eq!(report.no_use().as_deref(), Some(told));
        (report.measured[0].peaks, report.measured[0].history) = (Some(0.2), Some(1.4));
        assert_eq!(report.no_use().as_deref(), Some("NOT to be used: this record: NRMSE 1.4"));
        report.measured[0].history = Some(2.2e-5);
        report.measured[1].on = NINE_OF_TEN.into();
        assert_eq!(report.short(1, None)[1], "90 % of 24 synthetic motions: NRMSE 0.019");
        report.measured.clear();
        assert!(report.sentence().starts_with("not measured"));
        assert_eq!(report.no_use(), None);
    }
}
