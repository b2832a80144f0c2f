//! How much of a record is shown.

use super::{HistoryFigure, Trace};

/// Share of the largest displacement below which a history has come to rest.
const AT_REST: f64 = 2e-3;
/// How much longer than what moves is shown.
const MARGIN: f64 = 0.08;
/// Share of the record that what moves takes at most for the rest to be left out.
const QUIET: f64 = 0.8;

/// Samples to show: of a record that ends in quiet, those up to where the last of the histories has
/// come to rest, or ended, and a margin.
pub(super) fn shown(data: &HistoryFigure<'_>) -> usize {
    let all = data.t.len();
    let compared = |trace: &&Trace| !trace.behind;
    let traces = || std::iter::once(&data.reference).chain(data.others).filter(compared);
    let curves: Vec<&[f64]> = traces().map(|trace| trace.u).collect();
    let end = |trace: &Trace| trace.end.map(|end| data.t.partition_point(|t| *t <= end.time));
    let last = traces().filter_map(end).max().unwrap_or(0);
    with_margin(last.max(last_moving(&curves)), all)
}

/// The last sample at which one of these curves of a quantity is not where it comes to rest.
pub(crate) fn last_moving(curves: &[&[f64]]) -> usize {
    let largest = curves.iter().copied().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
    let moves = |u: &&[f64]| {
        let rest = u.last().copied().unwrap_or(0.0);
        u.iter().rposition(|u| (u - rest).abs() > AT_REST * largest)
    };
    curves.iter().filter_map(moves).max().unwrap_or(0)
}

/// Samples to show, of so many, of what moves up to the sample `last`.
pub(crate) fn with_margin(last: usize, all: usize) -> usize {
    match (last as f64 * (1.0 + MARGIN)).ceil() as usize + 2 {
        n if last > 0 && (n as f64) < QUIET * all as f64 => n,
        _ => all,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::EventMark;

    /// 18 s of motion in 300 s of record: what is shown ends with the motion and a margin of a
    /// twelfth; a slide that stays at its end is at rest; a history that ends later is shown to
    /// there; and a motion over all of the record is shown in whole.
    #[test]
    fn a_record_that_ends_in_quiet_is_shown_as_far_as_anything_moves() {
        let t: Vec<f64> = (0..30_001).map(|i| f64::from(i) * 0.01).collect();
        let moved = |until: f64, stays: f64| -> Vec<f64> {
            t.iter()
                .map(|t| stays + if *t <= until { 0.1 * (5.0 * t).cos() } else { 0.0 })
                .collect()
        };
        let seconds = |u: &[f64], end: Option<EventMark>| {
            let v = vec![0.0; t.len()];
            let reference = Trace { u, v: &v, end, ..Trace::default() };
            let data = HistoryFigure { t: &t, reference, ..HistoryFigure::default() };
            0.01 * shown(&data) as f64
        };
        for stays in [0.0, 0.03] {
            let shown = seconds(&moved(18.0, stays), None);
            assert!((18.5..20.0).contains(&shown), "{shown}");
        }
        assert!((seconds(&moved(280.0, 0.0), None) - 300.01).abs() < 1e-9);
        let end = EventMark { time: 40.0, text: "ends" };
        assert!((40.0..44.0).contains(&seconds(&moved(18.0, 0.0), Some(end))));
    }
}
