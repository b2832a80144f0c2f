//! The plan of a sweep: what the file asks for, checked, as a numbered list of cells that is never
//! written out.

mod ground;

use std::path::Path;

use serde::Serialize;
use toml::Spanned;

use super::{
    SweepError,
    motion::{MotionSource, SweepMotion},
    spec::{Grid, Kinds, SweepKind, SweepModel, SweepSource},
};
use rocking::{
    scalar::GRAVITY,
    structure::{self, Body, Structure},
};
use springs::case::{ACCURACY, LONGEST_S, MAX_HZ};
use strong_motion::{Notice, ReadOptions, fnv1a};

/// One structure of a sweep.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its name.
    pub name: String,
    /// As given.
    pub structure: Structure,
    /// As the models have it.
    pub body: Body<f64>,
    /// Its own velocity restitution.
    pub restitution: f64,
    /// (rad)
    pub alpha: f64,
    /// (1/s)
    pub p: f64,
}

impl Subject {
    fn new(structure: Structure, restitution: f64) -> Self {
        let body = structure.body::<f64>();
        let kind = match structure.kind {
            structure::Kind::AFrame => "A-frame",
            structure::Kind::Block => "block",
        };
        let name = format!("{kind} R {} m, alpha {}", digits(body.radius()), digits(body.alpha()));
        Self { name, structure, body, restitution, alpha: body.alpha(), p: body.p_squared().sqrt() }
    }

    /// g tan(alpha): what lifts it at rest (m/s2).
    pub(crate) fn uplift(&self) -> f64 {
        GRAVITY * self.alpha.tan()
    }
}

/// Four significant digits at most, as short as they come.
fn digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    rounded.to_string()
}

/// What the levels are levels of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// The factor on the acceleration.
    Scale,
    /// The peak ground acceleration (g).
    PgaG,
    /// PGA over that which lifts the body, g tan alpha.
    PgaOverUplift,
}

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

/// Cells to a part: some seconds of work, and so much that is lost when a sweep is killed.
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
        let default =
            if kind == SweepKind::Compare { SweepModel::Both } else { SweepModel::Housner };
        let model = sweep.model.as_ref().map_or(default, |model| *model.get_ref());
        if let Some(written) = &sweep.model
            && kind == SweepKind::Compare
            && model != SweepModel::Both
        {
            return Err(source.at(
                written,
                "kind = \"compare\" compares both models; write model = \"both\", or leave it out",
            ));
        }
        let subjects = subjects(source)?;
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
            vertical: records.vertical.clone().map(|from| from.within(source.folder())),
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

    /// A number that tells sweeps apart: FNV-1a of the program's version, of everything that
    /// decides a result, and of the samples of every file. `notice` is told what the readers say of
    /// the files.
    ///
    /// # Errors
    /// A record that cannot be read, or has no motion.
    pub fn hash(&self, notice: &mut dyn FnMut(&Notice)) -> Result<String, SweepError> {
        let MotionSource { seed, duration_s, p, .. } = &self.making;
        let mut text = format!(
            "{} {:?} {:?} {seed} {duration_s:?} {p:?}",
            env!("CARGO_PKG_VERSION"),
            self.kind,
            self.model
        );
        for subject in &self.subjects {
            text += &format!("{:?} {:?}", subject.structure, subject.restitution);
        }
        text +=
            &format!("{:?} {:?} {:?} {}", self.restitutions, self.measure, self.levels, self.part);
        if self.model.fem() {
            text += &format!("{:?}", self.springs);
        }
        let any = (self.subjects[0].p, self.subjects[0].alpha);
        for motion in &self.motions {
            if let SweepMotion::Like(index, given) = motion {
                text += &format!("{} {:x}", motion.name(), given.target.fingerprint());
                if *index == 0 {
                    given.notices.iter().for_each(&mut *notice);
                }
            } else if !matches!(motion, SweepMotion::File(_)) {
                text += &format!("{motion:?}");
            } else {
                // not where it lies, but what is in it
                text += &motion.name();
                let record = motion.told(&self.making, any, notice)?;
                if record.pga() == 0.0 {
                    return Err(SweepError::Still { record: record.name });
                }
                text += &format!("{:x}", record.fingerprint());
                if let Some(up) = &record.vertical {
                    text += &format!("{:x}", up.as_record(record.dt).fingerprint());
                }
            }
        }
        Ok(format!("{:016x}", fnv1a(text.bytes())))
    }
}

fn subjects(source: &SweepSource) -> Result<Vec<Subject>, SweepError> {
    let mut subjects = Vec::new();
    for section in &source.spec.structure {
        let (structure, e) = section
            .get_ref()
            .checked(&source.path)
            .map_err(|e| source.at(section, reason(&source.path, &e.to_string())))?;
        subjects.push(Subject::new(structure, e));
    }
    if let Some(grid) = &source.spec.grid {
        of_grid(source, grid, &mut subjects)?;
    }
    if subjects.is_empty() {
        return Err(source.at(
            &source.spec.sweep.kind,
            "no structure; give [[structure]] as in a case file, or [grid]",
        ));
    }
    Ok(subjects)
}

/// The message of an error without the file's name, which stands before it anyway.
fn reason(path: &str, message: &str) -> String {
    message.strip_prefix(&format!("{path}: ")).unwrap_or(message).to_string()
}

fn of_grid(
    source: &SweepSource,
    grid: &Spanned<Grid>,
    subjects: &mut Vec<Subject>,
) -> Result<(), SweepError> {
    let Grid { kind, size_m, slenderness } = grid.get_ref();
    let kinds = match kind {
        Kinds::One(kind) => std::slice::from_ref(kind),
        Kinds::Some(kinds) => kinds,
    };
    let sizes = source.all_within("size_m", size_m, 1e-3, 1e4)?;
    let alphas = source.all_within("slenderness", slenderness, 0.005, 0.9)?;
    for &kind in kinds {
        for &alpha in &alphas {
            for &radius in &sizes {
                let mass_kg = 1000.0;
                let m_r2 = mass_kg * radius * radius;
                let structure = Structure {
                    kind,
                    height_m: radius * alpha.cos(),
                    width_m: 2.0 * radius * alpha.sin(),
                    mass_kg,
                    rotational_inertia_kgm2: match kind {
                        structure::Kind::AFrame => structure::LEAST_INERTIA * m_r2,
                        structure::Kind::Block => m_r2 / 3.0,
                    },
                };
                let structure =
                    structure.checked().map_err(|e| source.at(slenderness, e.to_string()))?;
                subjects.push(Subject::new(structure, structure.body::<f64>().restitution()));
            }
        }
    }
    Ok(())
}

fn levels(source: &SweepSource, kind: SweepKind) -> Result<(Measure, Vec<f64>), SweepError> {
    let Some(section) = &source.spec.levels else {
        if matches!(kind, SweepKind::Rocking | SweepKind::Compare) {
            return Ok((Measure::Scale, vec![1.0]));
        }
        let remedy = "no [levels]; give scale, pga_g or pga_over_uplift";
        return Err(source.at(&source.spec.sweep.kind, remedy));
    };
    let all = section.get_ref();
    let given = [
        (Measure::Scale, "scale", &all.scale, 100.0),
        (Measure::PgaG, "pga_g", &all.pga_g, 50.0),
        (Measure::PgaOverUplift, "pga_over_uplift", &all.pga_over_uplift, 1e4),
    ];
    let mut given = given
        .into_iter()
        .filter_map(|(m, name, values, most)| values.as_ref().map(|v| (m, name, v, most)));
    let (Some((measure, name, values, most)), None) = (given.next(), given.next()) else {
        return Err(source.at(section, "levels: give one of scale, pga_g and pga_over_uplift"));
    };
    let mut levels = source.all_within(name, values, 1e-6, most)?;
    if kind == SweepKind::Overturning {
        if measure != Measure::PgaOverUplift || levels.len() < 2 {
            let remedy = "an overturning spectrum scans pga_over_uplift; give a range, as { from = 1.0, to = 12.0, count = 400, spacing = \"log\" }";
            return Err(source.at(values, remedy));
        }
        levels.sort_by(f64::total_cmp);
    }
    Ok((measure, levels))
}
