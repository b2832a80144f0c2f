//! The ground motions of a sweep, each made or read when it is needed.

use std::{
    f64::consts::TAU,
    path::{Path, PathBuf},
    sync::Arc,
};

use super::pulse::PulseShape;
use rocking::{
    motion::largest_magnitude,
    scalar::GRAVITY,
    synthetic::{self, MotionTarget},
};
use strong_motion::{Notice, ReadOptions, Record, RecordError, Recording, Source};

/// A pulse's frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frequency {
    /// Circular, over p of the structure.
    OverP(f64),
    /// As it is (Hz).
    Hz(f64),
}

impl Frequency {
    /// For a structure with p (1/s): circular (rad/s).
    pub fn omega(self, p: f64) -> f64 {
        match self {
            Self::OverP(q) => q * p,
            Self::Hz(hz) => TAU * hz,
        }
    }
}

/// A motion that others are made like, and what the reader of its file says of it.
#[derive(Debug)]
pub struct GivenMotion {
    /// All of it.
    pub whole: Record,
    /// Spectrum and envelope.
    pub target: MotionTarget,
    /// What its reader says.
    pub notices: Vec<Notice>,
}

/// One ground motion.
#[derive(Clone, Debug)]
pub enum SweepMotion {
    /// El Centro 1940, north-south.
    ElCentro,
    /// A file.
    File(PathBuf),
    /// `synthetic::record` of this index, made for the structure.
    Synthetic(usize),
    /// `synthetic::earthquake` of this index.
    Earthquake(usize),
    /// Of this index, like the given one.
    Like(usize, Arc<GivenMotion>),
    /// With a peak of 1 g.
    Pulse {
        /// Its shape.
        shape: PulseShape,
        /// Its frequency.
        frequency: Frequency,
    },
}

/// How motions are read and made.
#[derive(Clone, Debug)]
pub struct MotionSource {
    /// What is said of files.
    pub read: ReadOptions,
    /// Of motions that are made.
    pub seed: u64,
    /// Length used (s); all of it unless given.
    pub duration_s: Option<f64>,
    /// The least and the greatest p of the structures (1/s): silences are long enough for the one,
    /// steps fine enough for the other.
    pub p: (f64, f64),
}

impl MotionSource {
    /// The part of a record that is used.
    pub(crate) fn used(&self, record: Record) -> Record {
        match self.duration_s {
            Some(duration) => record.truncated(duration),
            None => record,
        }
    }
}

/// Silence behind a pulse, for a body to topple or to come back in [1/p].
pub(super) const SILENCE: f64 = 12.0;

impl SweepMotion {
    /// Whether each structure has its own.
    pub(crate) fn is_for_structure(&self) -> bool {
        matches!(self, Self::Synthetic(_) | Self::Pulse { frequency: Frequency::OverP(_), .. })
    }

    /// Name in tables.
    pub fn name(&self) -> String {
        match self {
            Self::ElCentro => "IELC180".into(),
            Self::File(path) => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            Self::Synthetic(i) => format!("synthetic-{i:05}"),
            Self::Earthquake(i) => format!("earthquake-{i:05}"),
            Self::Like(i, given) => format!("like-{}-{i:05}", given.target.name()),
            Self::Pulse { shape, frequency: Frequency::OverP(q) } => {
                format!("{} q {q:.4}", shape.label())
            }
            Self::Pulse { shape, frequency: Frequency::Hz(f) } => {
                format!("{} {f:.4} Hz", shape.label())
            }
        }
    }

    /// The record used, unscaled, for a structure with p (1/s) and alpha (rad) where each has its
    /// own, and its peak ground velocity (m/s): of a pulse from rest, else that of the whole
    /// record's velocity up to the last sample used.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn ground(
        &self,
        making: &MotionSource,
        (p, alpha): (f64, f64),
    ) -> Result<(Record, f64), RecordError> {
        let whole = match self {
            Self::ElCentro => Record::el_centro(),
            Self::File(path) => whole(path, making, &mut |_| {})?,
            Self::Synthetic(i) => synthetic::record(making.seed, *i, p, alpha),
            Self::Earthquake(i) => synthetic::earthquake(making.seed, *i, making.p.0),
            Self::Like(i, given) => given.target.motion(making.seed, *i, making.p.0),
            Self::Pulse { shape, frequency } => {
                let (least, greatest) = match frequency {
                    Frequency::OverP(_) => (p, p),
                    Frequency::Hz(_) => making.p,
                };
                let (dt, mut accel) = shape.sampled(frequency.omega(p), GRAVITY, greatest);
                accel.resize(accel.len() + (SILENCE / (least * dt)).ceil() as usize, 0.0);
                Record {
                    name: self.name(),
                    dt,
                    accel,
                    vertical: None,
                    source: Source::Synthetic,
                    made_of: None,
                }
            }
        };
        let velocity = match self {
            Self::Pulse { .. } => whole.velocity_from_rest(),
            _ => whole.velocity(),
        };
        let record = match self {
            // as long as its pulse, or as the given motion, which duration_s has cut already
            Self::Pulse { .. } | Self::Like(..) => whole,
            _ => making.used(whole),
        };
        let used = &velocity[..record.len()];
        Ok((record, largest_magnitude(used)))
    }
}

/// All of the record of a file; `notice` is told what its reader says of it.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn whole(
    path: &Path,
    making: &MotionSource,
    notice: &mut dyn FnMut(&Notice),
) -> Result<Record, RecordError> {
    let recording = Recording::read(path, &making.read)?;
    recording.notices().iter().for_each(notice);
    Ok(recording.into_record())
}
