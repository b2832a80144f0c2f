//! What is kept of a history.

use std::sync::Arc;

use super::plan::Plan;
use sweep_table::{SweepTable, TableOf};

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
    let names: Vec<Arc<str>> =
        plan.subjects.iter().map(|subject| subject.name.as_str().into()).collect();
    let subject = |row: &HistoryRow| &plan.subjects[row.subject];
    let mut table = TableOf::new(rows)
        .count("cell", |row| row.cell)
        .count("structure_index", |row| row.subject as u64)
        .text("structure", |row| names[row.subject].clone())
        .real("alpha", |row| Some(subject(row).alpha))
        .real("p_per_s", |row| Some(subject(row).p))
        .real("restitution", |row| Some(row.restitution))
        .count("record_index", |row| row.motion as u64)
        .text("record", |row| row.record.clone())
        .real("level", |row| Some(row.level))
        .real("scale", |row| Some(row.scale))
        .real("pga_m_per_s2", |row| Some(row.pga))
        .real("pgv_m_per_s", |row| Some(row.pgv))
        .real("pga_over_uplift", |row| Some(row.pga / subject(row).uplift()))
        .real("pgv_over_uplift", |row| Some(subject(row).p * row.pgv / subject(row).uplift()));
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
        let word =
            |row: &HistoryRow| of(row).map_or(CellOutcome::Failed, |answer| answer.outcome).name();
        let known = |row: &HistoryRow| {
            of(row)
                .filter(|a| !matches!(a.outcome, CellOutcome::Failed | CellOutcome::LeavesGround))
        };
        table = table
            .text(outcome, word)
            .flag(overturned, |row| Some(known(row)?.outcome == CellOutcome::Overturned))
            .real(peak, |row| of(row)?.peak);
        // on springs neither is kept
        if i == 0 {
            table = table
                .real("housner_impacts", |row| Some(of(row)?.impacts? as f64))
                .real("housner_overturned_s", |row| of(row)?.overturned_s);
        }
    }
    if plan.model.housner() && plan.model.fem() {
        table = table.real("nrmse", |row| row.nrmse);
    }
    table.table()
}
