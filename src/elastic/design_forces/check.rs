//! The same motion with the elements doubled and on other springs, and peaks of forces.

use super::{Cutoff, ForceKind, ForcePeak, cutoff::SOLE_HZ, parts};
use crate::{
    elastic::{
        assembled::Assembled,
        fem::{BASE_FORCES, ElasticAnalysis, ElasticHistory, ElasticStart, low_pass},
        frame::{EquilibriumError, Frame},
        structure::ElasticStructure,
    },
    motion::TimedPeak,
    record::Record,
    spring::{Chain, Springs},
};

/// By what Omega_n is divided and multiplied.
pub(super) const FACTOR: f64 = 4.0;

/// Histories of the same structure that differ in what is not its own.
pub(super) struct Variants {
    pub doubled: Option<ElasticHistory>,
    pub softer: ElasticHistory,
    pub stiffer: ElasticHistory,
}

impl Variants {
    pub fn of(
        assembled: &Assembled,
        springs: &[Springs<Chain<f64>>],
        record: &Record,
    ) -> Result<Self, EquilibriumError> {
        let follow =
            |frame: &Frame, springs: &[Springs<Chain<f64>>]| follow(&assembled.structure, frame, springs, record);
        let finer = assembled.structure.with_doubled_elements().map(|structure| {
            Assembled::with_members(structure, assembled.members).map_err(|_| EquilibriumError::NoRest { lean: 0.0 })
        });
        let finer = finer.transpose()?;
        let (doubled, (softer, stiffer)) = rayon::join(
            || finer.map(|finer| follow(&finer.frame, springs)).transpose(),
            || {
                rayon::join(
                    || follow(&assembled.frame, &scaled(springs, 1.0 / FACTOR)),
                    || follow(&assembled.frame, &scaled(springs, FACTOR)),
                )
            },
        );
        Ok(Self { doubled: doubled?, softer: softer?, stiffer: stiffer? })
    }
}

/// A frame of a structure through a record, its forces finely sampled.
pub(super) fn follow(
    structure: &ElasticStructure,
    frame: &Frame,
    springs: &[Springs<Chain<f64>>],
    record: &Record,
) -> Result<ElasticHistory, EquilibriumError> {
    ElasticAnalysis {
        vertical: record.up(),
        forces: false,
        parts: parts(structure, record.dt),
        ..ElasticAnalysis::new(frame, springs, ElasticStart::Standing, record.dt, &record.accel)
    }
    .simulate()
}

/// Springs whose landing is the same but so many times as fast.
pub(super) fn scaled(springs: &[Springs<Chain<f64>>], factor: f64) -> Vec<Springs<Chain<f64>>> {
    let chain =
        |c: &Chain<f64>| Chain { k1: c.k1 * factor * factor, k2: c.k2 * factor * factor, c: c.c * factor, m2: c.m2 };
    let both = |s: &Springs<Chain<f64>>| Springs { vertical: chain(&s.vertical), horizontal: chain(&s.horizontal) };
    springs.iter().map(both).collect()
}

/// A force's peaks in one history.
#[derive(Clone, Copy, Debug)]
pub(super) struct PeakOfForce {
    kind: ForceKind,
    pub filtered: ForcePeak,
    pub raw: f64,
    pub cutoff_hz: Option<f64>,
}

/// Those of all forces.
pub(super) struct ForcePeaks(Vec<PeakOfForce>);

impl ForcePeaks {
    /// Of a history, up to a time (s), below the cutoff.
    pub fn of(history: &ElasticHistory, cutoff: Option<&Cutoff>, over: f64) -> Self {
        let Some(fine) = &history.fine else { return Self(Vec::new()) };
        let part = fine.part_s;
        let kept = (over / part).round().min(1e15) as usize;
        let peak = |series: &[f64], raw: f64, cutoff_hz: Option<f64>, kind: ForceKind| {
            let smooth = cutoff_hz.map(|hz| low_pass(series, part, hz));
            let smooth = smooth.as_deref().unwrap_or(series);
            let peak = TimedPeak::of(part, &smooth[..kept.min(smooth.len())])?;
            // as it is: the largest at any step, not of means
            let value = if cutoff_hz.is_none() && kept >= series.len() { raw } else { peak.value };
            Some(PeakOfForce { kind, filtered: ForcePeak { value, time_s: peak.time + 0.5 * part }, raw, cutoff_hz })
        };
        let of_bases = cutoff.map(|cutoff| cutoff.cutoff_hz);
        let of_soles = Some(of_bases.unwrap_or(SOLE_HZ));
        let kinds = [ForceKind::ColumnShear, ForceKind::Axial, ForceKind::ColumnBaseMoment];
        let mut out: Vec<PeakOfForce> = Vec::new();
        for (k, kind) in kinds.into_iter().enumerate() {
            let of_base = |(i, base): (usize, &[Vec<f64>; BASE_FORCES])| {
                peak(&base[k], fine.largest[BASE_FORCES * i + k], of_bases, kind)
            };
            let all = fine.bases.iter().enumerate().filter_map(of_base);
            let raw = all.clone().fold(0.0, |most: f64, p| if p.raw.abs() > most.abs() { p.raw } else { most });
            let most = all.reduce(|a, b| if b.filtered.value.abs() > a.filtered.value.abs() { b } else { a });
            out.extend(most.map(|most| PeakOfForce { raw, ..most }));
        }
        let soles = fine.largest.len().saturating_sub(2);
        for (k, kind) in [ForceKind::SoleShear, ForceKind::SoleVertical].into_iter().enumerate() {
            out.extend(peak(&fine.sole[k], fine.largest[soles + k], of_soles, kind));
        }
        Self(out)
    }

    pub fn get(&self, kind: ForceKind) -> Option<PeakOfForce> {
        self.0.iter().find(|peak| peak.kind == kind).copied()
    }
}
