//! Springs judged over many records: peaks, overturning and histories of the finite element model
//! beside Housner's.
//!
//! ```text
//! peak ratio      max |theta| / alpha while a foot is off the ground; pi/2 / alpha for a body that toppled
//! KS distance     D = max over x of | F_H(x) - F_FE(x) |,  F the share of records whose peak ratio is at most x
//! NRMSE           sqrt( sum (u - u_H)^2 / sum u_H^2 ) over the samples that both histories have,
//!                 up to the first overturning
//! sensitivity     the worst of || du_H/dln x || / || u_H ||, x the width and the record's scale
//!                 (`conditioning`)
//! ```
//!
//! D is the two-sample distance of Kolmogorov and Smirnov (Smirnov 1939). What is counted how:
//!
//! - **Peaks.** A standing finite element body sways elastically, a rigid one does not: rotation
//!   counts while a foot is up. A record that lifts neither model gives 0 in both.
//! - **Toppled** means the same in both models: |theta| passes pi/2, or will do so whatever the
//!   rest of the record, or the history ends with a body that would topple by Housner's equation if
//!   the ground stopped. How far it had fallen when the record ended means nothing, so its peak is
//!   set to pi/2.
//! - **Histories** can be compared one to one only where Housner's own answer is well conditioned,
//!   by its derivative and by finite changes (`conditioning`), and where his pivot never has to
//!   hold the body down: a foot that can only press lifts there, in any finite element program and
//!   in reality (`regime`; a stocky body under more than g/tan(alpha)). The quantiles of NRMSE are
//!   over such records that lift Housner's body and do not topple it. The geometric mean is over
//!   the wider set with a sensitivity below 150. The other records count in the distance of the
//!   peaks and in the agreement on overturning. A body that topples on its springs alone counts
//!   with an NRMSE of 1 at least.
//! - **What statistics can tell**: beside D stands the distance of Housner's peaks from his own
//!   with a restitution smaller by 1e-5.
//! - **Suites** (files, motions made for the structure, motions like earthquakes) are judged
//!   together and apart.
//! - **Failures.** A history that meets its bound on work, or in which an emulated program gives
//!   up, is an outcome of its own: listed by name,
//!   a disagreement on overturning, an infinite NRMSE in the quantiles, and in D a peak at the
//!   other end of the scale than Housner's.
//!
//! - **Steps of one size** (`even`) are those of a program that is emulated. Their histories have
//!   no energy account and no velocities: forces are not compared.
//!
//! - **Vertical ground motion is left out** by both models, even where a record has it: the
//!   derivative that tells which histories can be compared is known without it alone.
//!
//! Histories are never kept. Beside its row a record costs its samples and Housner's rotations, of
//! 64 records at a time, or of 32 for each thread where that is more.

mod even;
mod peaks;
mod row;
mod statistics;
mod stream;
pub mod verdict;

pub use peaks::{HousnerForces, PeakErrors};
pub use row::{RecordOutcome, Row, Suite};
pub use statistics::{Confusion, GeometricMean, PREDICTABLE, Quantiles, Summary, Validation};
pub use stream::{ComparisonObserver, effective_acceleration};

use dynamics::{
    fem::Control,
    spring::{Chain, Springs},
};
use fixed_steps::{FixedStepBody, StepSettings};
use rocking::structure::Body;
use strong_motion::Record;

/// Records in memory at a time, at least, and for each thread: enough to fill its lanes several
/// times over.
const BATCH: usize = 64;
const BATCH_A_THREAD: usize = 32;

/// Springs under a body, and how their histories are stepped.
#[derive(Clone, Copy, Debug)]
pub enum JudgedModel {
    /// In steps that follow every touch.
    Events {
        /// The springs.
        springs: Springs<Chain>,
        /// How exact the steps are.
        control: Control,
    },
    /// In steps of one size, as a program takes them that is emulated.
    Even {
        /// The body as that program has it, on its springs.
        model: FixedStepBody,
        /// How it steps.
        settings: StepSettings,
    },
}

/// The springs under judgement, and what they shall follow.
#[derive(Clone, Copy, Debug)]
pub struct Validator {
    /// Housner's body.
    pub body: Body<f64>,
    /// Velocity restitution e of Housner's solution.
    pub restitution: f64,
    /// Length compared (s); each record's own unless given.
    pub duration_s: Option<f64>,
    /// What is judged.
    pub model: JudgedModel,
}

impl Validator {
    /// Judge n records in parallel. `record(i)` is called once for each i; `done` is told how many
    /// records are through. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// Of all errors of `record` the one with the smallest i.
    pub fn judge_all<E: Send>(
        &self,
        n: usize,
        record: impl Fn(usize) -> Result<Record, E> + Sync,
        done: impl Fn(usize) + Sync,
    ) -> Result<Validation, E> {
        let mut rows = Vec::with_capacity(n);
        let batch = BATCH.max(BATCH_A_THREAD * parallel::threads());
        for begin in (0..n).step_by(batch) {
            let end = (begin + batch).min(n);
            let read = parallel::map_range(begin..end, &record);
            let records = read.into_iter().collect::<Result<Vec<Record>, E>>()?;
            rows.extend(self.judge(&records));
            done(end);
        }
        Ok(Validation::new(rows))
    }
}

#[cfg(test)]
mod tests;
