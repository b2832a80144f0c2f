//! Overturning spectra: the intervals of pulse amplitude that overturn a body.
//!
//! Overturning is not monotone in the amplitude, so a spectrum is a set of intervals. A scan over
//! the levels finds cells whose ends differ, and bisection finds the end of an interval in each.
//! When the pulse is over the ground is still, and what happens then is a matter of energy: with w
//! = |theta|, per I0,
//!
//! ```text
//! E = w'^2/2 + p^2 [cos(alpha - w) - cos(alpha)],     E_top = p^2 [1 - cos(alpha)]
//! outwards, w < alpha:              overturns if E > E_top
//! beyond alpha, inwards:            overturns there if E < E_top
//! back through theta = 0:           overturns on the other side if e^2 E > E_top
//! ```
//!
//! so that Housner's histories end with the pulse and a decision is exact however long the body
//! would take. On springs the record goes on for 12/p.

use std::ops::Range;

use super::{
    SweepError,
    history::{self, WantedHistory},
    motion::SweepMotion,
    plan::{Cell, Plan},
    row::CellOutcome,
    springs::SpringsTable,
};
use rocking::{
    housner::{self, RockingSummary},
    structure::Body,
};
use strong_motion::{Record, Source};
use sweep_table::{SweepTable, TableOf};

/// An interval of PGA/(g tan alpha) that overturns after one number of impacts; an end is missing
/// where the scan ends first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverturningInterval {
    /// Its lower end.
    pub from: Option<f64>,
    /// Its upper end.
    pub to: Option<f64>,
    /// Impacts before the body overturns: 0, 1, or 2 for two and more; not counted on springs.
    pub impacts: Option<usize>,
}

/// The intervals of one cell by one model.
#[derive(Clone, Debug)]
pub struct OverturningRow {
    /// Which.
    pub cell: Cell,
    /// Frequency of the pulse over p.
    pub omega_over_p: f64,
    /// Name of the model.
    pub model: &'static str,
    /// The intervals, from below.
    pub intervals: Vec<OverturningInterval>,
}

/// What becomes of a body: it stands, or overturns after none, one or several impacts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum OverturningFate {
    Stands,
    /// After so many impacts; on springs they are not counted.
    Overturns(Option<usize>),
}

/// Impacts that are told apart: a body that comes to rest and is lifted again within a long pulse
/// has any number of them.
const SEVERAL: usize = 2;

impl OverturningFate {
    fn new(overturns: bool, impacts: Option<usize>) -> Self {
        if overturns { Self::Overturns(impacts.map(|n| n.min(SEVERAL))) } else { Self::Stands }
    }
}

/// Relative width to which an end of an interval is found: by Housner, where the samples of the
/// pulse are off by 1e-5 anyway; on springs.
const WIDTH: f64 = 1e-7;
const WIDTH_FEM: f64 = 1e-4;

/// The spectra of a range of cells, in their order.
///
/// # Errors
/// Those of the motions; pulses have none.
pub(crate) fn rows(
    plan: &Plan,
    springs: Option<&SpringsTable>,
    cells: Range<u64>,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Vec<OverturningRow>, SweepError> {
    let cells: Vec<u64> = cells.collect();
    let rows = parallel::map(&cells, |&index| {
        let rows = of_cell(plan, springs, plan.cell(index));
        done(1);
        rows
    });
    Ok(rows.into_iter().flatten().collect())
}

fn of_cell(plan: &Plan, springs: Option<&SpringsTable>, cell: Cell) -> Vec<OverturningRow> {
    let subject = &plan.subjects[cell.subject];
    let SweepMotion::Pulse { shape, frequency } = &plan.motions[cell.motion] else {
        return Vec::new();
    };
    let omega = frequency.omega(subject.p);
    // an amplitude of 1 lifts the body
    let (dt, accel) = shape.sampled(omega, subject.uplift(), subject.p);
    let e = plan.restitution(cell.subject, cell.restitution);
    let mut rows = Vec::new();
    let mut add = |model, intervals| {
        rows.push(OverturningRow { cell, omega_over_p: omega / subject.p, model, intervals })
    };
    if plan.model.housner() {
        let pulse = LonePulse { body: &subject.body, e, dt, accel: &accel };
        add("housner", intervals(&plan.levels, WIDTH, &|amplitudes| pulse.fates(amplitudes)));
    }
    if let Some(springs) = springs {
        let springs = springs.of(cell.subject, cell.restitution);
        let mut accel = accel;
        accel
            .resize(accel.len() + (super::motion::SILENCE / (subject.p * dt)).ceil() as usize, 0.0);
        let record = Record {
            name: shape.name().into(),
            dt,
            accel,
            vertical: None,
            source: Source::Synthetic,
            made_of: None,
        };
        let still = housner::history(&subject.body, dt, &[0.0]);
        let wanted = |&scale: &f64| WantedHistory { subject, springs, scale, rigid: &still };
        let fates = |amplitudes: &[f64]| {
            let found =
                history::elements(&amplitudes.iter().map(wanted).collect::<Vec<_>>(), &record);
            found
                .iter()
                .map(|(answer, _)| {
                    OverturningFate::new(answer.outcome == CellOutcome::Overturned, None)
                })
                .collect()
        };
        add("fem", intervals(&plan.levels, WIDTH_FEM, &fates));
    }
    rows
}

/// Changes of fate that are sought between two neighbours of a scan.
const CHANGES: usize = 16;

/// The overturning intervals of a body under a pulse: scanned at amplitudes (increasing, over g tan
/// alpha), ends by bisection. Neighbours that overturn after different numbers of impacts are
/// looked between, too: often the body stands in a gap there.
fn intervals(
    levels: &[f64],
    width: f64,
    fates: &dyn Fn(&[f64]) -> Vec<OverturningFate>,
) -> Vec<OverturningInterval> {
    let scanned = fates(levels);
    let (Some(&low), Some(&first)) = (levels.first(), scanned.first()) else { return Vec::new() };
    // each stretch of one fate: where it begins
    let mut stretches = vec![(low, first)];
    for i in 1..levels.len() {
        let (mut from, mut fate) = (levels[i - 1], scanned[i - 1]);
        for _ in 0..CHANGES {
            if fate == scanned[i] {
                break;
            }
            let (mut low, mut high, mut beyond) = (from, levels[i], scanned[i]);
            while high - low > width * high {
                let middle = 0.5 * (low + high);
                let Some(&found) = fates(&[middle]).first() else { break };
                if found == fate {
                    low = middle;
                } else {
                    (high, beyond) = (middle, found);
                }
            }
            stretches.push((0.5 * (low + high), beyond));
            (from, fate) = (high, beyond);
        }
        // more changes than are sought: the scan's own answer holds from here on
        if fate != scanned[i] {
            stretches.push((levels[i], scanned[i]));
        }
    }
    let mut found = Vec::new();
    for (i, (from, fate)) in stretches.iter().enumerate() {
        if let OverturningFate::Overturns(impacts) = fate {
            let from = (i > 0).then_some(*from);
            found.push(OverturningInterval {
                from,
                to: stretches.get(i + 1).map(|(to, _)| *to),
                impacts: *impacts,
            });
        }
    }
    found
}

/// A pulse, and nothing behind it.
struct LonePulse<'a> {
    body: &'a Body<f64>,
    e: f64,
    dt: f64,
    accel: &'a [f64],
}

impl LonePulse<'_> {
    fn fates(&self, amplitudes: &[f64]) -> Vec<OverturningFate> {
        let options = |scale: &f64| housner::RockingOptions {
            scale: *scale,
            restitution: Some(self.e),
            ..Default::default()
        };
        let options: Vec<housner::RockingOptions<f64>> = amplitudes.iter().map(options).collect();
        housner::summaries(std::slice::from_ref(self.body), self.dt, self.accel, &options)
            .iter()
            .map(|rocking| self.fate(rocking))
            .collect()
    }

    /// What becomes of a body whose history is over when the pulse is.
    fn fate(&self, rocking: &RockingSummary) -> OverturningFate {
        let (during, (theta, rate)) = (rocking.impacts, rocking.last);
        if rocking.samples == 0 {
            return OverturningFate::Stands;
        }
        // lying already
        if rocking.samples < self.accel.len() {
            return OverturningFate::new(rocking.overturned().is_some(), Some(during));
        }
        let (alpha, p2) = (self.body.alpha(), self.body.p_squared());
        let side = if theta < 0.0 || (theta == 0.0 && rate < 0.0) { -1.0 } else { 1.0 };
        let (w, rate) = (theta * side, rate * side);
        // 1 - cos(x) = 2 sin^2(x/2): no cancellation near alpha
        let half = |x: f64| 2.0 * (0.5 * x).sin().powi(2);
        let top = p2 * half(alpha);
        let energy = 0.5 * rate * rate + top - p2 * half(alpha - w);
        let climbs = energy > top;
        let there = if w > alpha { rate >= 0.0 || !climbs } else { rate > 0.0 && climbs };
        let across = !there && rate < 0.0 && self.e * self.e * energy > top;
        OverturningFate::new(there || across, Some(during + usize::from(across)))
    }
}

/// Columns that an overturning spectrum has: a row an interval.
pub fn table(plan: &Plan, rows: &[OverturningRow]) -> SweepTable {
    let all: Vec<(&OverturningRow, usize, &OverturningInterval)> = rows
        .iter()
        .flat_map(|row| row.intervals.iter().enumerate().map(move |(i, found)| (row, i, found)))
        .collect();
    let subject = |row: &OverturningRow| &plan.subjects[row.cell.subject];
    let pulse = |row: &OverturningRow| match &plan.motions[row.cell.motion] {
        SweepMotion::Pulse { shape, .. } => shape.label(),
        other => other.name(),
    };
    let restitution =
        |row: &OverturningRow| plan.restitution(row.cell.subject, row.cell.restitution);
    TableOf::new(&all)
        .count("cell", |(row, ..)| row.cell.index)
        .count("structure_index", |(row, ..)| row.cell.subject as u64)
        .text("structure", |(row, ..)| subject(row).name.clone())
        .real("alpha", |(row, ..)| Some(subject(row).alpha))
        .real("p_per_s", |(row, ..)| Some(subject(row).p))
        .real("restitution", |(row, ..)| Some(restitution(row)))
        .text("pulse", |(row, ..)| pulse(row))
        .real("omega_over_p", |(row, ..)| Some(row.omega_over_p))
        .text("model", |(row, ..)| row.model.to_string())
        .count("interval", |(_, i, _)| *i as u64 + 1)
        .real("from_over_uplift", |(.., found)| found.from)
        .real("to_over_uplift", |(.., found)| found.to)
        .real("impacts", |(.., found)| found.impacts.map(|n| n as f64))
        .table()
}

#[cfg(test)]
mod tests;
