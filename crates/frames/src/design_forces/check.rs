//! The same motion with the elements doubled and on other springs, and peaks of forces.

use super::{Cutoff, ForceName, parts};
use crate::{
    assembled::Assembled,
    design_forces::ForcesTogether,
    fem::{
        ElasticAnalysis, ElasticHistory, FineColumn, FineSeries, RunningPeaks, StepForces, low_pass,
    },
    frame::{EquilibriumError, Frame},
    structure::ElasticStructure,
};
use dynamics::spring::{Chain, Springs};
use rocking::motion::TimedPeak;
use strong_motion::Record;

/// By what Omega_n is divided and multiplied.
pub(super) const FACTOR: f64 = 4.0;

/// Histories of the same structure that differ in what is not its own.
pub(super) struct Variants {
    pub doubled: Option<ElasticHistory>,
    pub softer: ElasticHistory,
    pub stiffer: ElasticHistory,
}

impl Variants {
    pub(crate) fn of(
        assembled: &Assembled,
        springs: &[Springs<Chain>],
        record: &Record,
    ) -> Result<Self, EquilibriumError> {
        let follow = |frame: &Frame, springs: &[Springs<Chain>]| {
            follow(&assembled.structure, frame, springs, record)
        };
        let finer = assembled.structure.with_doubled_elements().map(|structure| {
            Assembled::with_members(structure, assembled.members)
                .map_err(|_| EquilibriumError::NoRest { lean: 0.0 })
        });
        let finer = finer.transpose()?;
        let (doubled, (softer, stiffer)) = parallel::join(
            || finer.map(|finer| follow(&finer.frame, springs)).transpose(),
            || {
                parallel::join(
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
    springs: &[Springs<Chain>],
    record: &Record,
) -> Result<ElasticHistory, EquilibriumError> {
    ElasticAnalysis {
        forces: false,
        parts: parts(structure, record.dt),
        ..ElasticAnalysis::on_record(frame, springs, record)
    }
    .simulate()
}

/// Springs whose landing is the same but so many times as fast.
pub(super) fn scaled(springs: &[Springs<Chain>], factor: f64) -> Vec<Springs<Chain>> {
    let chain = |c: &Chain| Chain {
        k1: c.k1 * factor * factor,
        k2: c.k2 * factor * factor,
        c: c.c * factor,
        m2: c.m2,
    };
    let both = |s: &Springs<Chain>| Springs {
        vertical: chain(&s.vertical),
        horizontal: chain(&s.horizontal),
    };
    springs.iter().map(both).collect()
}

/// A force's peaks in one history.
#[derive(Clone, Copy, Debug)]
pub(super) struct PeakOfForce {
    kind: ForceName,
    pub filtered: TimedPeak,
    pub raw: f64,
    pub cutoff_hz: Option<f64>,
    /// What the column's base bears at that time.
    pub together: Option<ForcesTogether>,
    /// Of a shear or a tension: where, above the base along the column (m); 0 at the base.
    pub above_base_m: Option<f64>,
}

/// Those of all forces.
pub(super) struct ForcePeaks(Vec<PeakOfForce>);

impl ForcePeaks {
    /// Of a history, up to a time (s), below the cutoff.
    pub(crate) fn of(history: &ElasticHistory, cutoff: Option<&Cutoff>, over: f64) -> Self {
        Self::below(1.0, history, cutoff, over)
    }

    /// The same below so many times the frequencies.
    pub(crate) fn below(
        times: f64,
        history: &ElasticHistory,
        cutoff: Option<&Cutoff>,
        over: f64,
    ) -> Self {
        let Some(fine) = &history.fine else { return Self(Vec::new()) };
        let of_columns = cutoff.map(|cutoff| times * cutoff.cutoff_hz);
        let series = Series { part_s: fine.part_s, over_s: over };
        let mut out: Vec<PeakOfForce> = Vec::new();
        for column in &fine.columns {
            let peaks = match of_columns {
                Some(cutoff_hz) => series.of_column(column, cutoff_hz),
                None => of_massless(&column.at_steps, over),
            };
            peaks.into_iter().for_each(|peak| keep_larger(&mut out, peak));
        }
        for (k, kind) in [ForceName::SoleShear, ForceName::SoleVertical].into_iter().enumerate() {
            let rest = fine.rest_between_landings(k);
            let filtered = match of_columns {
                Some(cutoff_hz) => {
                    let held = series.smooth(&fine.held[k], cutoff_hz);
                    let all: Vec<f64> = held.iter().zip(&rest).map(|(a, b)| a + b).collect();
                    series.largest(&all)
                }
                None => series.with_rest(&fine.held_at_steps, k, &rest),
            };
            out.extend(filtered.map(|filtered| PeakOfForce {
                kind,
                filtered,
                raw: fine.sole[k].largest,
                cutoff_hz: of_columns,
                together: None,
                above_base_m: None,
            }));
        }
        for (k, kind) in [ForceName::Tendon, ForceName::Damper].into_iter().enumerate() {
            let most = |until: f64| fine.members.largest(k, until);
            let peak = most(over).zip(most(f64::INFINITY)).map(|(found, all)| PeakOfForce {
                kind,
                filtered: TimedPeak { value: found.forces[k], time: found.time },
                raw: all.forces[k],
                cutoff_hz: None,
                together: None,
                above_base_m: None,
            });
            out.extend(peak.filter(|peak| peak.raw != 0.0));
        }
        Self(out)
    }

    pub(crate) fn get(&self, kind: ForceName) -> Option<PeakOfForce> {
        self.0.iter().find(|peak| peak.kind == kind).copied()
    }
}

/// How series are sampled, and up to when their peaks are taken (s).
#[derive(Clone, Copy)]
struct Series {
    part_s: f64,
    over_s: f64,
}

impl Series {
    /// A series below a frequency (Hz).
    fn smooth(&self, series: &FineSeries, cutoff_hz: f64) -> Vec<f64> {
        low_pass(&series.means, self.part_s, cutoff_hz)
    }

    /// The largest of the samples that count, in the middle of its part.
    fn largest(&self, smooth: &[f64]) -> Option<TimedPeak> {
        let kept = (self.over_s / self.part_s).round().min(1e15) as usize;
        let peak = TimedPeak::of(self.part_s, &smooth[..kept.min(smooth.len())])?;
        Some(TimedPeak { value: peak.value, time: peak.time + 0.5 * self.part_s })
    }

    /// The largest of forces at the ends of steps, each with the rest of that time.
    fn with_rest(&self, steps: &[StepForces<2>], k: usize, rest: &[f64]) -> Option<TimedPeak> {
        let last = rest.len().checked_sub(1)?;
        let all = steps.iter().take_while(|step| step.time <= self.over_s).map(|step| {
            // between the middles of two parts
            let place = (step.time / self.part_s - 0.5).clamp(0.0, last as f64);
            let (i, share) = (place as usize, place.fract());
            let between = rest[i] + share * (rest[(i + 1).min(last)] - rest[i]);
            TimedPeak { value: step.forces[k] + between, time: step.time }
        });
        all.reduce(|a, b| if b.value.abs() > a.value.abs() { b } else { a })
    }

    /// Of one force, whose series below its cutoff is `smooth`.
    fn peak(
        &self,
        kind: ForceName,
        series: &FineSeries,
        smooth: &[f64],
        cutoff_hz: f64,
    ) -> Option<PeakOfForce> {
        Some(PeakOfForce {
            kind,
            filtered: self.largest(smooth)?,
            raw: series.largest,
            cutoff_hz: Some(cutoff_hz),
            together: None,
            above_base_m: None,
        })
    }

    /// Of all forces of a column with mass, each with what its base bears at that time.
    fn of_column(&self, column: &FineColumn, cutoff_hz: f64) -> Vec<PeakOfForce> {
        let [shear, axial, moment] = &column.base;
        let base = [shear, axial, moment].map(|series| self.smooth(series, cutoff_hz));
        let of = |kind, k: usize| self.peak(kind, &column.base[k], &base[k], cutoff_hz);
        let top = &column.top_moment;
        let at_top =
            self.peak(ForceName::ColumnTopMoment, top, &self.smooth(top, cutoff_hz), cutoff_hz);
        let at_base = of(ForceName::ColumnShear, 0)
            .map(|peak| PeakOfForce { above_base_m: Some(0.0), ..peak });
        let above = column.above.iter().zip(&column.heights).filter_map(|(series, height)| {
            let peak = self.peak(
                ForceName::ColumnShear,
                series,
                &self.smooth(series, cutoff_hz),
                cutoff_hz,
            )?;
            Some(PeakOfForce { above_base_m: Some(*height), ..peak })
        });
        let base_axial = (axial, &base[1], 0.0);
        let above_axial: Vec<Vec<f64>> =
            column.axial_above.iter().map(|series| self.smooth(series, cutoff_hz)).collect();
        let above_axial = column.axial_above.iter().zip(&above_axial).zip(&column.heights);
        let above_axial = above_axial.map(|((series, smooth), height)| (series, smooth, *height));
        // its own weight presses the base most; of a column that is always pressed there is none
        let tension =
            [base_axial].into_iter().chain(above_axial).filter_map(|(series, smooth, height)| {
                let pulled: Vec<f64> = smooth.iter().map(|axial| axial.max(0.0)).collect();
                Some(PeakOfForce {
                    kind: ForceName::AxialTension,
                    filtered: self.largest(&pulled).filter(|peak| peak.value > 0.0)?,
                    raw: series.most,
                    cutoff_hz: Some(cutoff_hz),
                    together: None,
                    above_base_m: Some(height),
                })
            });
        let peaks = at_base.into_iter().chain(above);
        let peaks = peaks
            .chain(of(ForceName::Axial, 1))
            .chain(of(ForceName::ColumnBaseMoment, 2))
            .chain(at_top);
        let peaks = peaks.chain(tension);
        let together = |peak: PeakOfForce| {
            let at = (peak.filtered.time / self.part_s - 0.5).round().max(0.0) as usize;
            let base = [0, 1, 2].map(|k| base[k][at.min(base[k].len() - 1)]);
            PeakOfForce { together: Some(ForcesTogether::of_base(base)), ..peak }
        };
        peaks.map(together).collect()
    }
}

/// Forces of a column without mass as they are at the ends of steps, up to a time (s), each with
/// what its base bears there.
fn of_massless(column: &RunningPeaks<4>, over_s: f64) -> Vec<PeakOfForce> {
    let peak =
        |kind: ForceName, k: usize, found: Option<StepForces<4>>, raw: Option<StepForces<4>>| {
            let StepForces { time, forces } = found?;
            let [shear, axial, moment, _] = forces;
            Some(PeakOfForce {
                kind,
                filtered: TimedPeak { value: forces[k], time },
                raw: raw.map_or(forces[k], |step| step.forces[k]),
                cutoff_hz: None,
                together: Some(ForcesTogether::of_base([shear, axial, moment])),
                above_base_m: (kind == ForceName::ColumnShear).then_some(0.0),
            })
        };
    let kinds = [
        ForceName::ColumnShear,
        ForceName::Axial,
        ForceName::ColumnBaseMoment,
        ForceName::ColumnTopMoment,
    ];
    let all = kinds.into_iter().enumerate().filter_map(|(k, kind)| {
        peak(kind, k, column.largest(k, over_s), column.largest(k, f64::INFINITY))
    });
    // of a column that is always pressed there is none
    let tension =
        peak(ForceName::AxialTension, 1, column.most(1, over_s), column.most(1, f64::INFINITY));
    all.chain(tension).collect()
}

/// Of several columns, and of the heights of one, that which bears the most counts, and the largest
/// unfiltered value of all.
fn keep_larger(all: &mut Vec<PeakOfForce>, peak: PeakOfForce) {
    match all.iter_mut().find(|other| other.kind == peak.kind) {
        None => all.push(peak),
        Some(other) => {
            let raw = if peak.raw.abs() > other.raw.abs() { peak.raw } else { other.raw };
            let larger =
                if peak.filtered.value.abs() > other.filtered.value.abs() { peak } else { *other };
            *other = PeakOfForce { raw, ..larger };
        }
    }
}
