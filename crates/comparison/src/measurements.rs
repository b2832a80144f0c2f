//! What was measured.

use crate::{
    Peer, TimedSeries, elements::HistoryCost, program::ProgramRun, rigid::LaneTimes, skips::Skip,
};

/// Everything that was measured.
#[derive(Clone, Debug, Default)]
pub struct Measurements {
    /// Housner's equation: ours first.
    pub rigid: Vec<TimedSeries>,
    pub lanes: Option<LaneTimes>,
    /// The finite element history: ours first, OpenSees after them.
    pub elements: Vec<TimedSeries>,
    /// How many of `elements` are ours.
    pub own: usize,
    pub stiffness: Vec<HistoryCost>,
    pub length: Vec<HistoryCost>,
    pub skips: Vec<Skip>,
    /// (mu, seconds)
    pub fits: Vec<(f64, f64)>,
    pub runs: Vec<ProgramRun>,
    /// Tools that were left out, and why.
    pub left_out: Vec<String>,
}

impl Measurements {
    /// A peer's series, or why there is none.
    pub fn add(left_out: &mut Vec<String>, list: &mut Vec<TimedSeries>, peer: Peer) {
        match peer {
            Ok(series) => list.push(series),
            Err(reason) => left_out.push(reason),
        }
    }
}
