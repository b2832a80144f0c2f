//! What was measured, as tables; each target beside it.

use std::fmt::Write;

use crate::{
    TimedSeries,
    elements::HistoryCost,
    measurements::Measurements,
    program::ProgramRun,
    rigid::{self, LaneTimes},
    skips::Skip,
    table::{table, time},
    targets,
};

impl Measurements {
    /// All tables.
    pub fn text(&self) -> String {
        let mut out = format!(
            "Run time against error, the paper's A-frame on {} s of El Centro. Times are the least \
             of several rounds.\n",
            rigid::SECONDS
        );
        let mut section = |title: &str, table: String| {
            let _ = write!(out, "\n{title}\n\n{table}\n");
        };
        let errors = "Housner's equation; largest error of u against a float128 history";
        section(errors, work_precision(&self.rigid, " m", 1));
        if let Some(lanes) = &self.lanes {
            section("Many structures at once", lanes_table(lanes));
        }
        let errors =
            "Finite elements, 160 Hz springs; larger NRMSE of u and v against tolerance 1e-12";
        section(errors, work_precision(&self.elements, "", self.own));
        section(
            "Cost against stiffness (default tolerance)",
            costs(&self.stiffness, "Omega_n", "Hz"),
        );
        section(
            "Cost against length (160 Hz, the same 20 s over and over)",
            costs(&self.length, "length", "s"),
        );
        section("Skipped", skips(&self.skips));
        section("Inner fit with certificate", fits(&self.fits));
        section("The program", runs(&self.runs));
        section("Targets", targets::table_of(self));
        if !self.left_out.is_empty() {
            let _ = write!(out, "\nLeft out:\n- {}\n", self.left_out.join("\n- "));
        }
        out
    }
}

/// Each point beside the cheapest of the first `own` series that is at least as accurate.
fn work_precision(series: &[TimedSeries], unit: &str, own: usize) -> String {
    let ours = &series[..own.min(series.len())];
    let ratio = |seconds: f64, error: f64| {
        let best = ours
            .iter()
            .filter_map(|s| s.cheapest(error))
            .map(|p| p.seconds)
            .fold(f64::INFINITY, f64::min);
        let ratio = seconds / best;
        let decimals = if ratio < 10.0 { 1 } else { 0 };
        if ratio > 0.0 { format!("{ratio:.decimals$}") } else { "-".to_string() }
    };
    let rows = series.iter().enumerate().flat_map(|(k, series)| {
        series.points.iter().map(move |p| {
            // a history that does not get to its end has no error to compare at
            let whole = p.error.is_finite();
            let slower = if k < own || !whole { String::new() } else { ratio(p.seconds, p.error) };
            [
                series.tool.clone(),
                p.setting.clone(),
                time(p.seconds),
                if whole { format!("{:.1e}{unit}", p.error) } else { String::new() },
                slower,
                p.note.clone(),
            ]
        })
    });
    table(["tool", "setting", "time", "error", "times ours at this error", ""], rows.collect())
}

fn lanes_table(lanes: &LaneTimes) -> String {
    let row = |how: &str, seconds: f64| [how.to_string(), time(seconds)];
    let rows = vec![row("one by one", lanes.single), row("in lock-step", lanes.lanes)];
    let head = format!("{} structures around the paper's", lanes.structures);
    table([&head, "time of each"], rows)
}

fn costs(costs: &[HistoryCost], what: &str, unit: &str) -> String {
    let rows = costs.iter().map(|c| {
        [
            format!("{} {unit}", c.at),
            c.impacts.to_string(),
            c.steps.to_string(),
            time(c.seconds),
            format!("{:.1e}", c.error),
        ]
    });
    table([what, "impacts", "steps", "time", "error"], rows.collect())
}

fn skips(skips: &[Skip]) -> String {
    let rows = skips.iter().map(|s| {
        let saved = format!("{:.0} %", 100.0 * (1.0 - s.with / s.without));
        [s.what.to_string(), time(s.without), time(s.with), saved, s.same.clone()]
    });
    table(["skipped", "time without the skip", "with it", "saved", "both ways"], rows.collect())
}

fn fits(fits: &[(f64, f64)]) -> String {
    table(
        ["mu", "time"],
        fits.iter().map(|&(mu, seconds)| [mu.to_string(), time(seconds)]).collect(),
    )
}

fn runs(runs: &[ProgramRun]) -> String {
    let row = |run: &ProgramRun| {
        let memory = run.memory.map_or("-".to_string(), |mb| format!("{mb:.0} MB"));
        [format!("tune {}", run.what), time(run.seconds), memory]
    };
    table(["command", "time", "most memory"], runs.iter().map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::series;

    #[test]
    fn a_peer_is_compared_with_our_cheapest_run_that_is_as_accurate() {
        let all = [
            series("ours", &[(1e-3, 1e-3), (2e-3, 1e-6)]),
            series("peer", &[(1.0, 1e-4), (0.01, 1e-2)]),
        ];
        let text = work_precision(&all, "", 1);
        let cell = |row: usize| {
            text.lines().nth(row).unwrap().split('|').nth(5).unwrap().trim().to_string()
        };
        // head, rule, two of ours, two of the peer
        assert_eq!((cell(4), cell(5)), ("500".into(), "10".into()));
    }

    #[test]
    fn a_peer_more_accurate_than_anything_of_ours_has_no_ratio() {
        let all = [series("ours", &[(1e-3, 1e-3)]), series("peer", &[(1.0, 1e-9)])];
        assert!(work_precision(&all, "", 1).lines().last().unwrap().contains("| - "));
    }
}
