//! What is kept of a history.

use std::sync::Arc;

use super::plan::Plan;
use sweep_table::{Column, SweepTable};

/// How a history ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellOutcome {
    /// The ground never lifted the body.
    NeverLifted,
    /// It rocks and stands.
    Rocked,
    /// It overturns.
    Overturned,
    /// With vertical motion: Housner's pivot lets go, and his equation says nothing of what
    /// follows.
    LeavesGround,
    /// A bound on work, or a number that is not finite.
    Failed,
}

impl CellOutcome {
    /// In tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::NeverLifted => "never lifted",
            Self::Rocked => "rocked",
            Self::Overturned => "overturned",
            Self::LeavesGround => "leaves the ground",
            Self::Failed => "failed",
        }
    }
}

/// One model's answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellAnswer {
    /// How it ended.
    pub outcome: CellOutcome,
    /// Largest |theta|/alpha; pi/2 / alpha of a body that overturned; none of a history that
    /// failed.
    pub peak: Option<f64>,
    /// Impacts before that.
    pub impacts: Option<usize>,
    /// When |theta| last grew past alpha (s).
    pub overturned_s: Option<f64>,
}

/// One cell of a sweep of histories.
#[derive(Clone, Debug)]
pub struct HistoryRow {
    /// Number of the cell.
    pub cell: u64,
    /// Index of the structure.
    pub subject: usize,
    /// Index of the motion.
    pub motion: usize,
    /// Velocity after an impact over that before.
    pub restitution: f64,
    /// Intensity, in what the sweep measures it by.
    pub level: f64,
    /// Name of the motion.
    pub record: Arc<str>,
    /// Factor on the record.
    pub scale: f64,
    /// As scaled [m/s2, m/s].
    pub pga: f64,
    /// Peak ground velocity (m/s).
    pub pgv: f64,
    /// Housner's answer.
    pub housner: Option<CellAnswer>,
    /// The finite elements' answer.
    pub fem: Option<CellAnswer>,
    /// Of the finite elements' u against Housner's, up to the first overturning.
    pub nrmse: Option<f64>,
}

/// Columns that a sweep of histories has.
pub fn table(plan: &Plan, rows: &[HistoryRow]) -> SweepTable {
    let count = |of: fn(&HistoryRow) -> i64| Column::Count(rows.iter().map(of).collect());
    let real =
        |of: &dyn Fn(&HistoryRow) -> Option<f64>| Column::Real(rows.iter().map(of).collect());
    let names: Vec<Arc<str>> =
        plan.subjects.iter().map(|subject| subject.name.as_str().into()).collect();
    let subject = |row: &HistoryRow| &plan.subjects[row.subject];
    let mut columns = vec![
        ("cell", count(|row| row.cell as i64)),
        ("structure_index", count(|row| row.subject as i64)),
        ("structure", Column::Text(rows.iter().map(|row| names[row.subject].clone()).collect())),
        ("alpha", real(&|row| Some(subject(row).alpha))),
        ("p_per_s", real(&|row| Some(subject(row).p))),
        ("restitution", real(&|row| Some(row.restitution))),
        ("record_index", count(|row| row.motion as i64)),
        ("record", Column::Text(rows.iter().map(|row| row.record.clone()).collect())),
        ("level", real(&|row| Some(row.level))),
        ("scale", real(&|row| Some(row.scale))),
        ("pga_m_per_s2", real(&|row| Some(row.pga))),
        ("pgv_m_per_s", real(&|row| Some(row.pgv))),
        ("pga_over_uplift", real(&|row| Some(row.pga / subject(row).uplift()))),
        ("pgv_over_uplift", real(&|row| Some(subject(row).p * row.pgv / subject(row).uplift()))),
    ];
    type AnswerOf = fn(&HistoryRow) -> Option<CellAnswer>;
    let models: [(_, AnswerOf, [&'static str; 3]); 2] = [
        (
            plan.model.housner(),
            |row| row.housner,
            ["housner_outcome", "housner_overturned", "housner_peak"],
        ),
        (plan.model.fem(), |row| row.fem, ["fem_outcome", "fem_overturned", "fem_peak"]),
    ];
    for (i, (asked, of, [outcome, overturned, peak])) in models.into_iter().enumerate() {
        if !asked {
            continue;
        }
        let word = |row: &HistoryRow| {
            Arc::from(of(row).map_or(CellOutcome::Failed, |answer| answer.outcome).name())
        };
        let known = |row: &HistoryRow| {
            of(row)
                .filter(|a| !matches!(a.outcome, CellOutcome::Failed | CellOutcome::LeavesGround))
        };
        columns.push((outcome, Column::Text(rows.iter().map(word).collect())));
        let flags = rows
            .iter()
            .map(|row| known(row).map(|a| a.outcome == CellOutcome::Overturned))
            .collect();
        columns.push((overturned, Column::Flag(flags)));
        columns.push((peak, real(&|row| of(row).and_then(|a| a.peak))));
        // on springs neither is kept
        if i == 0 {
            columns.push((
                "housner_impacts",
                real(&|row| of(row).and_then(|a| a.impacts).map(|n| n as f64)),
            ));
            columns
                .push(("housner_overturned_s", real(&|row| of(row).and_then(|a| a.overturned_s))));
        }
    }
    if plan.model.housner() && plan.model.fem() {
        columns.push(("nrmse", real(&|row| row.nrmse)));
    }
    SweepTable { columns }
}
