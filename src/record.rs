//! Ground motions: acceleration at even time steps, from files or embedded.
//!
//! A record is the ground acceleration u_g''(t) in m/s2, positive to the right, `accel[i]` at t = i dt, linear between
//! samples: the kinks at the samples are part of the motion, and solvers step from one to the next. Numbers in g are
//! turned into m/s2 with g = 9.81 m/s2 ([`GRAVITY`]).
//!
//! Files: PEER AT2 in both header forms, and text columns (time, acceleration) or acceleration alone. What a file does
//! not say (unit, time step) must be given; what it says and the user says must agree.

mod at2;
mod error;
mod folder;
mod source;
mod table;
mod text;
mod timing;
mod units;

use std::fs::File;
use std::io::Read;
use std::path::Path;

pub use error::RecordError;
pub use source::Source;
pub use units::{Units, UnitsError};

use crate::scalar::GRAVITY;

/// No record file is larger; the rest is not read [bytes].
const FILE_LIMIT: u64 = 256 << 20;
/// No earthquake comes near this peak; numbers beyond it are in another unit (g).
const PGA_LIMIT_G: f64 = 50.0;

/// A ground motion, linear between its samples. Two are equal if their names and numbers are, wherever they come from.
#[derive(Clone, Debug)]
pub struct Record {
    /// Name: the file's, without its ending.
    pub name: String,
    /// Time step (s).
    pub dt: f64,
    /// Ground acceleration at t = i dt, positive to the right (m/s2).
    pub accel: Vec<f64>,
    /// Where it comes from, which scaling and cutting do not change.
    pub source: Source,
}

impl PartialEq for Record {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, self.dt, &self.accel) == (&other.name, other.dt, &other.accel)
    }
}

/// What the user says about a file that the file may not say itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Time step (s).
    pub dt: Option<f64>,
    /// Unit of the numbers in the file.
    pub units: Option<Units>,
}

/// What a reader found in a file, in the file's own unit.
struct Samples {
    units: Option<Units>,
    /// Velocity or displacement, if the header says that.
    quantity: Option<&'static str>,
    dt: Option<f64>,
    /// How far dt may be off by the rounding of printed digits (s).
    dt_rounding: f64,
    values: Vec<f64>,
}

impl Record {
    /// A record from its numbers: `dt` in s, `accel` in m/s2.
    ///
    /// # Errors
    /// dt not between 1e-6 and 1 s, no sample, a sample that is not finite, a peak above 50 g.
    pub fn new(name: impl Into<String>, dt: f64, accel: Vec<f64>) -> Result<Self, RecordError> {
        let record = Self { name: name.into(), dt, accel, source: Source::Numbers };
        let name = || text::quote(&record.name);
        check_step(&record.name, dt)?;
        if record.accel.is_empty() {
            return Err(RecordError::Empty { file: name() });
        }
        if let Some(index) = record.accel.iter().position(|a| !a.is_finite()) {
            return Err(RecordError::BadSample { record: name(), index, value: record.accel[index] });
        }
        let pga_g = record.pga_g();
        if pga_g > PGA_LIMIT_G {
            return Err(RecordError::HugePeak { record: name(), pga_g });
        }
        Ok(record)
    }

    /// Imperial Valley 1940, El Centro Array #9, component 180 (north-south), PEER processing: 3995 samples, dt 0.01 s.
    pub fn el_centro() -> Self {
        let bytes = include_bytes!("../tuning/records/IELC180.AT2");
        // The file is part of the program and a test reads it: the error cannot occur.
        let record = Self::parse("IELC180.AT2", bytes, &ReadOptions::default());
        Self { source: Source::Embedded, ..record.unwrap_or_else(|error| unreachable!("{error}")) }
    }

    /// The record in a file of any supported format; its name is the file's without the ending.
    ///
    /// # Errors
    /// The file cannot be read, is no record, is damaged, or does not agree with the options: see [`RecordError`].
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, RecordError> {
        let file = label(path);
        let unreadable = |error: std::io::Error| RecordError::Unreadable {
            file: file.clone(),
            reason: text::quote(&error.to_string()),
        };
        if path.is_dir() {
            return Err(RecordError::Folder { file });
        }
        let mut bytes = Vec::new();
        File::open(path).and_then(|f| f.take(FILE_LIMIT + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
        if bytes.len() as u64 > FILE_LIMIT {
            return Err(RecordError::TooLarge { file, limit_mb: FILE_LIMIT >> 20 });
        }
        let mut record = Self::parse(&file, &bytes, options)?;
        if let Source::File { path: named, .. } = &mut record.source {
            path.clone_into(named);
        }
        Ok(record)
    }

    /// The record in the bytes of a file; `file` is the file's path, for the record's name and for messages.
    ///
    /// # Errors
    /// As [`Record::read`], but for reading the file.
    pub fn parse(file: &str, bytes: &[u8], options: &ReadOptions) -> Result<Self, RecordError> {
        let path = Path::new(file);
        let file = &label(path);
        if let Some(dt) = options.dt {
            check_step(file, dt)?;
        }
        let text = text::decode(file, bytes)?;
        let is_at2 = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("at2"));
        let samples = match at2::header_line(&text) {
            Some(header) => at2::parse(file, &text, header)?,
            None if text.trim().is_empty() => return Err(RecordError::Empty { file: file.clone() }),
            None if is_at2 => return Err(RecordError::NoHeader { file: file.clone() }),
            None => table::parse(file, &text, options.dt)?,
        };
        let name = path.file_stem().map_or_else(|| file.clone(), |stem| label(Path::new(stem)));
        let mut record = samples.into_record(file, options)?;
        record.name = name;
        Ok(record)
    }

    /// The record with every acceleration multiplied by a factor.
    ///
    /// # Errors
    /// The factor is not finite, or takes the peak above 50 g.
    pub fn scaled(&self, factor: f64) -> Result<Self, RecordError> {
        let scaled = Self::new(self.name.clone(), self.dt, self.accel.iter().map(|a| a * factor).collect())?;
        Ok(Self { source: self.source.clone(), ..scaled })
    }

    /// The first `duration_s` seconds: the samples up to that time, at least the first.
    pub fn truncated(&self, duration_s: f64) -> Self {
        // 1e-6 of a step: 20 s at dt = 0.01 s is 2001 samples although 20/0.01 may round to below 2000
        let steps = (duration_s / self.dt + 1e-6).floor();
        let samples = (steps as usize).saturating_add(1).min(self.accel.len());
        let (name, source) = (self.name.clone(), self.source.clone());
        Self { name, dt: self.dt, accel: self.accel[..samples].to_vec(), source }
    }

    /// Peak ground acceleration (m/s2).
    pub fn pga(&self) -> f64 {
        self.accel.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
    }

    /// Time of the peak ground acceleration, the first if there are several (s).
    pub fn pga_time(&self) -> f64 {
        let pga = self.pga();
        self.accel.iter().position(|a| a.abs() == pga).unwrap_or(0) as f64 * self.dt
    }

    /// Peak ground acceleration (g).
    pub fn pga_g(&self) -> f64 {
        self.pga() / GRAVITY
    }

    /// Time of the last sample, (n - 1) dt (s).
    pub fn duration(&self) -> f64 {
        self.len().saturating_sub(1) as f64 * self.dt
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.accel.len()
    }

    /// Whether there is no sample (never so for a checked record).
    pub fn is_empty(&self) -> bool {
        self.accel.is_empty()
    }

    /// Ground acceleration at time t (s), linear between samples, zero outside the record (m/s2).
    pub fn at(&self, t: f64) -> f64 {
        let x = t / self.dt;
        if !(x >= 0.0 && x <= self.len().saturating_sub(1) as f64) {
            return 0.0;
        }
        let i = x.floor() as usize;
        let left = self.accel[i];
        let right = self.accel.get(i + 1).copied().unwrap_or(left);
        left + (right - left) * (x - i as f64)
    }
}

impl Samples {
    /// The record in SI units, what the file says and what the user says agreeing.
    fn into_record(self, file: &str, options: &ReadOptions) -> Result<Record, RecordError> {
        let file = || file.to_owned();
        if let Some(quantity) = self.quantity {
            return Err(RecordError::NotAcceleration { file: file(), quantity });
        }
        if self.values.is_empty() {
            return Err(RecordError::Empty { file: file() });
        }
        let dt = match (self.dt, options.dt) {
            (Some(file_dt), Some(given)) if (file_dt - given).abs() > self.dt_rounding + 1e-9 * file_dt => {
                return Err(RecordError::StepDiffers { file: file(), file_dt, given });
            }
            // within the rounding of the file's digits the user's step is the sharper one
            (_, Some(given)) => given,
            (Some(file_dt), None) => file_dt,
            (None, None) => return Err(RecordError::NoStep { file: file() }),
        };
        let units = match (self.units, options.units) {
            (Some(file_units), Some(given)) if file_units != given => {
                return Err(RecordError::UnitsDiffer { file: file(), file_units, given });
            }
            (Some(units), _) | (None, Some(units)) => units,
            (None, None) => return Err(RecordError::NoUnits { file: file() }),
        };
        let factor = units.metres_per_second2();
        let record = Record::new(file(), dt, self.values.into_iter().map(|value| value * factor).collect())?;
        Ok(Record { source: Source::File { path: file().into(), units }, ..record })
    }
}

fn check_step(record: &str, dt: f64) -> Result<(), RecordError> {
    if (1e-6..=1.0).contains(&dt) { Ok(()) } else { Err(RecordError::BadStep { record: text::quote(record), dt }) }
}

/// A path for messages of one line.
fn label(path: &Path) -> String {
    path.to_string_lossy().chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

#[cfg(test)]
mod tests;
