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
    results::ForcesTogether,
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
    /// What the section bears at that time.
    pub together: Option<ForcesTogether>,
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
            let smooth = smoothed(series, part, cutoff_hz);
            let peak = TimedPeak::of(part, &smooth[..kept.min(smooth.len())])?;
            // as it is: the largest at any step, not of means
            let value = if cutoff_hz.is_none() && kept >= series.len() { raw } else { peak.value };
            let filtered = ForcePeak { value, time_s: peak.time + 0.5 * part };
            Some(PeakOfForce { kind, filtered, raw, cutoff_hz, together: None })
        };
        let of_bases = cutoff.map(|cutoff| cutoff.cutoff_hz);
        let of_soles = Some(of_bases.unwrap_or(SOLE_HZ));
        let mut out: Vec<PeakOfForce> = Vec::new();
        for (i, base) in fine.bases.iter().enumerate() {
            let smooth: Vec<Vec<f64>> = base.iter().map(|series| smoothed(series, part, of_bases)).collect();
            let together = |of: PeakOfForce| {
                let at = ((of.filtered.time_s / part - 0.5).round().max(0.0) as usize).min(smooth[0].len() - 1);
                let [column_shear_n, axial_n, column_base_moment_nm] = [0, 1, 2].map(|k| smooth[k][at]);
                PeakOfForce { together: Some(ForcesTogether { column_shear_n, axial_n, column_base_moment_nm }), ..of }
            };
            let kinds = [ForceKind::ColumnShear, ForceKind::Axial, ForceKind::ColumnBaseMoment];
            let mut peaks: Vec<PeakOfForce> = kinds
                .into_iter()
                .enumerate()
                .filter_map(|(k, kind)| peak(&base[k], fine.largest[BASE_FORCES * i + k], of_bases, kind))
                .collect();
            // of a column that is always pressed there is none
            let pulled: Vec<f64> = smooth[1].iter().map(|axial| axial.max(0.0)).collect();
            let tension = TimedPeak::of(part, &pulled[..kept.min(pulled.len())]).filter(|peak| peak.value > 0.0);
            peaks.extend(tension.map(|peak| PeakOfForce {
                kind: ForceKind::AxialTension,
                filtered: ForcePeak { value: peak.value, time_s: peak.time + 0.5 * part },
                raw: peak.value,
                cutoff_hz: of_bases,
                together: None,
            }));
            peaks.into_iter().map(together).for_each(|peak| keep_larger(&mut out, peak));
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

/// A series below a frequency (Hz), if there is one.
fn smoothed(series: &[f64], part: f64, cutoff_hz: Option<f64>) -> Vec<f64> {
    cutoff_hz.map_or_else(|| series.to_vec(), |hz| low_pass(series, part, hz))
}

/// Of several bases the one that bears the most counts, and the largest unfiltered value of all.
fn keep_larger(all: &mut Vec<PeakOfForce>, peak: PeakOfForce) {
    match all.iter_mut().find(|other| other.kind == peak.kind) {
        None => all.push(peak),
        Some(other) => {
            let raw = if peak.raw.abs() > other.raw.abs() { peak.raw } else { other.raw };
            let larger = if peak.filtered.value.abs() > other.filtered.value.abs() { peak } else { *other };
            *other = PeakOfForce { raw, ..larger };
        }
    }
}
