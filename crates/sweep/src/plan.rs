//! The plan of a sweep: what the file asks for, checked, as a numbered list of cells that is never
//! written out.

mod ground;
mod inspection;
mod levels;
mod subjects;

use std::path::Path;

use toml::Spanned;

use super::{
    SweepError,
    motion::{MotionSource, SweepMotion},
    spec::{SweepKind, SweepModel, SweepSource},
};
use cases::{ACCURACY, LONGEST_S, MAX_HZ};
pub use inspection::InspectedSweep;
pub use levels::Measure;
use levels::levels;
use rocking::scalar::GRAVITY;
use strong_motion::ReadOptions;
pub use subjects::Subject;
use subjects::subjects;

/// How springs are tuned.
#[derive(Clone, Copy, Debug)]
pub struct SpringsAsked {
    /// Error of the history that is allowed.
    pub accuracy: f64,
    /// Stiffest springs allowed, Omega_n/2 pi (Hz).
    pub max_omega_hz: Option<f64>,
}

/// A checked sweep.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What is asked.
    pub kind: SweepKind,
    /// By which model.
    pub model: SweepModel,
    /// The structures.
    pub subjects: Vec<Subject>,
    /// The motions.
    pub motions: Vec<SweepMotion>,
    /// How motions are read and made.
    pub making: MotionSource,
    /// Velocity restitutions for all structures; each structure's own unless given.
    pub restitutions: Option<Vec<f64>>,
    /// What levels are levels of.
    pub measure: Measure,
    /// The levels.
    pub levels: Vec<f64>,
    /// theta/alpha whose exceedance is fitted.
    pub ratios: Vec<f64>,
    /// Level of confidence bounds.
    pub confidence: f64,
    /// How springs are tuned.
    pub springs: SpringsAsked,
    /// Cells to a part.
    pub part: u64,
}

/// One cell: a history, or for an overturning spectrum a frequency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Its number.
    pub index: u64,
    /// Index of the motion.
    pub motion: usize,
    /// Index of the structure.
    pub subject: usize,
    /// Index of the restitution.
    pub restitution: usize,
    /// Index of the level.
    pub level: usize,
}

/// Cells in a part: a few seconds of work, which is also what is lost when a sweep is killed.
const PART_HOUSNER: u64 = 20_000;
const PART_FEM: u64 = 500;
const PART_SPECTRUM: u64 = 64;

impl Plan {
    /// Read and check a sweep file.
    ///
    /// # Errors
    /// What is wrong with it, with the line.
    pub fn read(path: &Path) -> Result<Self, SweepError> {
        Self::new(&SweepSource::read(path)?)
    }

    /// Put the plan together.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub(crate) fn new(source: &SweepSource) -> Result<Self, SweepError> {
        let sweep = &source.spec.sweep;
        let kind = *sweep.kind.get_ref();
        let model = model(source, kind)?;
        let by_housner = !model.fem() && kind != SweepKind::Overturning;
        let subjects = subjects(source, by_housner)?;
        let restitutions = match &sweep.restitution {
            Some(values) => Some(source.all_within("restitution", values, 0.0, 1.0)?),
            None => None,
        };
        let (measure, levels) = levels(source, kind)?;
        let least = subjects.iter().map(|s| s.p).fold(f64::INFINITY, f64::min);
        let greatest = subjects.iter().map(|s| s.p).fold(0.0, f64::max);
        let records = &source.spec.records;
        let duration_s = match &records.duration_s {
            Some(duration) => Some(source.within("duration_s", duration, 1e-6, LONGEST_S)?),
            None => None,
        };
        let read = ReadOptions {
            dt: records.dt_s,
            units: records.units,
            component: records.component.clone(),
            baseline: records.baseline,
            vertical: records
                .vertical
                .clone()
                .map(|from| from.into_inner().within(source.folder())),
        };
        let motions = ground::motions(source, &read, duration_s)?;
        let ratios = match &sweep.ratios {
            Some(values) => source.all_within("ratios", values, 1e-6, 100.0)?,
            None => vec![0.1, 0.5],
        };
        let within = |name, value: &Option<Spanned<f64>>, low, high, default| match value {
            Some(value) => source.within(name, value, low, high),
            None => Ok(default),
        };
        let springs = &source.spec.springs;
        let max_omega_hz = match &springs.max_omega_hz {
            Some(hz) => Some(source.within("max_omega_hz", hz, MAX_HZ.least, MAX_HZ.most)?),
            None => None,
        };
        let default = match (kind, model) {
            (SweepKind::Overturning, _) => PART_SPECTRUM,
            (_, SweepModel::Housner) => PART_HOUSNER,
            _ => PART_FEM,
        };
        let part = match &sweep.part {
            Some(part) if (1..=1_000_000).contains(part.get_ref()) => *part.get_ref() as u64,
            Some(part) => return Err(source.at(part, "part: give 1 to 1000000 cells to a part")),
            None => default,
        };
        Ok(Self {
            kind,
            model,
            subjects,
            motions,
            making: MotionSource { read, seed: sweep.seed, duration_s, p: (least, greatest) },
            restitutions,
            measure,
            levels,
            ratios,
            confidence: within("confidence", &sweep.confidence, 0.5, 0.999, 0.9)?,
            springs: SpringsAsked {
                accuracy: within(
                    "accuracy",
                    &springs.accuracy,
                    ACCURACY.least,
                    ACCURACY.most,
                    0.002,
                )?,
                max_omega_hz,
            },
            part,
        })
    }

    /// Levels that cells are cut by: an overturning spectrum scans them all in one cell.
    fn level_count(&self) -> usize {
        if self.kind == SweepKind::Overturning { 1 } else { self.levels.len() }
    }

    /// Whether motions of files are used with their vertical component.
    pub(crate) fn takes_vertical(&self) -> bool {
        self.making.read.vertical.is_some()
    }

    /// Restitutions of each structure.
    pub fn restitution_count(&self) -> usize {
        self.restitutions.as_ref().map_or(1, Vec::len)
    }

    /// The restitution of this index of a structure.
    pub fn restitution(&self, subject: usize, index: usize) -> f64 {
        self.restitutions.as_ref().map_or(self.subjects[subject].restitution, |all| all[index])
    }

    /// Number of cells.
    pub fn cells(&self) -> u64 {
        [self.motions.len(), self.subjects.len(), self.restitution_count(), self.level_count()]
            .into_iter()
            .map(|n| n as u64)
            .product()
    }

    /// Cells in a row that a ground motion is made or read for once.
    pub fn cells_of_motion(&self) -> u64 {
        let one_structure = self.motions.iter().any(SweepMotion::is_for_structure);
        let subjects = if one_structure { 1 } else { self.subjects.len() };
        [subjects, self.restitution_count(), self.level_count()]
            .into_iter()
            .map(|n| n as u64)
            .product::<u64>()
            .max(1)
    }

    /// Cell i.
    pub(crate) fn cell(&self, index: u64) -> Cell {
        let mut rest = index;
        let mut digit = |base: usize| {
            let digit = (rest % base as u64) as usize;
            rest /= base as u64;
            digit
        };
        let level = digit(self.level_count());
        let restitution = digit(self.restitution_count());
        let subject = digit(self.subjects.len());
        Cell { index, motion: rest as usize, subject, restitution, level }
    }

    /// Number of parts.
    pub fn parts(&self) -> u64 {
        self.cells().div_ceil(self.part)
    }

    /// The factor that takes a record of this peak (m/s2) to a level for a structure.
    pub(crate) fn factor(&self, subject: &Subject, level: f64, pga: f64) -> f64 {
        match self.measure {
            Measure::Scale => level,
            Measure::PgaG => level * GRAVITY / pga,
            Measure::PgaOverUplift => level * subject.uplift() / pga,
        }
    }
}

/// The model asked for: Housner's unless given, both where they are compared.
fn model(source: &SweepSource, kind: SweepKind) -> Result<SweepModel, SweepError> {
    let compares = kind == SweepKind::Compare;
    let Some(written) = &source.spec.sweep.model else {
        return Ok(if compares { SweepModel::Both } else { SweepModel::Housner });
    };
    let model = *written.get_ref();
    if compares && model != SweepModel::Both {
        return Err(source.at(
            written,
            "kind = \"compare\" compares both models; write model = \"both\", or leave it out",
        ));
    }
    Ok(model)
}
