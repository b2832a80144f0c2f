//! Ground motions: acceleration at even time steps, from files or embedded.
//!
//! A record is the ground acceleration a_g(t) in m/s2, positive to the right, `accel[i]` at t = i
//! dt, linear between samples: the kinks at the samples are part of the motion, and solvers step
//! from one to the next. Numbers in g are turned into m/s2 with g = 9.81 m/s2 ([`GRAVITY`]).
//!
//! Files: PEER AT2, GeoNet V1A and V2A, COSMOS V1 and V2c, CSMIP .V2, K-NET and KiK-net,
//! ESM/ITACA/AFAD, and text columns, recognised by what they say and not by their names
//! ([`RecordFormat`]). What a file does not say (unit, time step) must be given; what it says and
//! the user says must agree, and the samples must have the peak that a header gives. A file may
//! have several components ([`Recording`]): a record is the one asked for, else the stronger
//! horizontal one.

#![warn(missing_docs)]

mod at2;
mod column;
mod columns;
mod cosmos;
mod csmip;
mod direction;
mod dyna;
mod error;
pub mod excitation;
mod folder;
mod format;
mod fortran;
mod geonet;
mod header;
mod knet;
mod measures;
mod notice;
mod parsed;
mod peak;
mod recording;
mod source;
mod text;
mod timing;
mod units;
mod vertical;

use std::{path::Path, sync::Arc};

use excitation::{Excitation, of_record};

pub use column::TableColumn;
pub use direction::Direction;
pub use error::RecordError;
pub use format::RecordFormat;
pub use notice::{Notice, notices};
pub use peak::Peak;
pub use recording::{Component, Recording};
pub use source::Source;
pub use source::fnv1a;
pub use units::{Units, UnitsError};
pub use vertical::{Vertical, VerticalFrom, cut_to};
pub use {
    measures::{Measures, measures},
    vertical::as_record,
};

/// No record file is larger; the rest is not read (bytes).
const FILE_LIMIT: u64 = 256 << 20;
/// No earthquake comes near this peak; numbers beyond it are in another unit (g).
const PGA_LIMIT_G: f64 = 50.0;

/// Acceleration of gravity (m/s2).
pub const GRAVITY: f64 = 9.81;

/// A ground motion, linear between its samples. Two are equal if their names and numbers are,
/// wherever they come from.
#[derive(Clone, Debug)]
pub struct Record {
    /// Name: the file's, without its ending.
    pub name: String,
    /// Time step (s).
    pub dt: f64,
    /// Ground acceleration at t = i dt, positive to the right (m/s2).
    pub accel: Vec<f64>,
    /// The vertical component at the same times, if there is one.
    pub vertical: Option<Vertical>,
    /// Where it comes from, which scaling and cutting do not change.
    pub source: Source,
    /// Of a record that was scaled or cut: the one that it was made of, and how.
    pub made_of: Option<Arc<Excitation>>,
}

impl PartialEq for Record {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, self.dt, &self.accel, &self.vertical)
            == (&other.name, other.dt, &other.accel, &other.vertical)
    }
}

/// What the user says about a file that the file may not say itself, and what to take of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Time step (s).
    pub dt: Option<f64>,
    /// Unit of the numbers in the file.
    pub units: Option<Units>,
    /// Component to take, by name or by azimuth (degrees clockwise from north); the stronger
    /// horizontal one unless given. Of a table of several columns the one to take: "column 3", or
    /// its name in the header.
    pub component: Option<String>,
    /// Subtract the mean of the samples.
    pub baseline: bool,
    /// Where to take the vertical component from; none unless given. Time step, unit and baseline
    /// are those of the record.
    pub vertical: Option<VerticalFrom>,
}

/// The largest magnitude of some numbers; zero of none.
pub fn largest_magnitude(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

impl Record {
    /// A record from its numbers: `dt` in s, `accel` in m/s2.
    ///
    /// # Errors
    /// dt not between 1e-6 and 1 s, no sample, a sample that is not finite, a peak above 50 g.
    pub fn new(name: impl Into<String>, dt: f64, accel: Vec<f64>) -> Result<Self, RecordError> {
        let record = Self {
            name: name.into(),
            dt,
            accel,
            vertical: None,
            source: Source::Numbers,
            made_of: None,
        };
        let name = || text::quote(&record.name);
        check_step(&record.name, dt)?;
        if record.accel.is_empty() {
            return Err(RecordError::Empty { file: name() });
        }
        if let Some(index) = record.accel.iter().position(|a| !a.is_finite()) {
            return Err(RecordError::BadSample {
                record: name(),
                index,
                value: record.accel[index],
            });
        }
        let pga_g = record.pga_g();
        if pga_g > PGA_LIMIT_G {
            return Err(RecordError::HugePeak { record: name(), pga_g });
        }
        Ok(record)
    }

    /// Imperial Valley 1940, El Centro Array #9, component 180 (north-south), PEER processing: 3995
    /// samples, dt 0.01 s.
    pub fn el_centro() -> Self {
        let bytes = include_bytes!("../../../tuning/records/IELC180.AT2");
        // The file is part of the program and a test reads it: the error cannot occur.
        let record = Self::parse("IELC180.AT2", bytes, &ReadOptions::default());
        Self { source: Source::Embedded, ..record.unwrap_or_else(|error| unreachable!("{error}")) }
    }

    /// The record in a file of any supported format; its name is the file's without the ending, and
    /// the component's where the file has several. [`ReadOptions`] asks for one of them.
    ///
    /// # Errors
    /// The file cannot be read, is no record, is damaged, or does not agree with the options: see
    /// [`RecordError`].
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, RecordError> {
        Recording::read(path, options).map(Recording::into_record)
    }

    /// The record in the bytes of a file; `file` is the file's path, for the record's name and for
    /// messages.
    ///
    /// # Errors
    /// As [`Record::read`], but for reading the file.
    pub fn parse(file: &str, bytes: &[u8], options: &ReadOptions) -> Result<Self, RecordError> {
        Recording::parse(file, bytes, options).map(Recording::into_record)
    }

    /// The record with every acceleration multiplied by a factor, both components.
    ///
    /// # Errors
    /// The factor is not finite, or takes the peak above 50 g.
    pub fn scaled(&self, factor: f64) -> Result<Self, RecordError> {
        let scaled =
            Self::new(self.name.clone(), self.dt, self.accel.iter().map(|a| a * factor).collect())?;
        let vertical = self.vertical.as_ref().map(|up| {
            let scaled =
                Self::new(up.name.clone(), self.dt, up.accel.iter().map(|a| a * factor).collect())?;
            Ok::<_, RecordError>(Vertical { accel: scaled.accel.into(), ..up.clone() })
        });
        let made_of = Some(Arc::new(of_record(self.clone(), factor, None)));
        Ok(Self { source: self.source.clone(), vertical: vertical.transpose()?, made_of, ..scaled })
    }

    /// The first `duration_s` seconds: the samples up to that time, at least the first.
    pub fn truncated(&self, duration_s: f64) -> Self {
        // 1e-6 of a step: 20 s at dt = 0.01 s is 2001 samples although 20/0.01 may round to below
        // 2000
        let steps = (duration_s / self.dt + 1e-6).floor();
        let samples = (steps as usize).saturating_add(1).min(self.accel.len());
        if samples == self.len() {
            return self.clone();
        }
        let (name, source) = (self.name.clone(), self.source.clone());
        let vertical = self.vertical.as_ref();
        let vertical = vertical.map(|up| Vertical {
            accel: up.accel[..samples.min(up.accel.len())].into(),
            ..up.clone()
        });
        let accel = self.accel[..samples].to_vec();
        let made_of = Some(Arc::new(of_record(self.clone(), 1.0, Some(duration_s))));
        Self { name, dt: self.dt, accel, vertical, source, made_of }
    }

    /// Peak ground acceleration (m/s2).
    pub fn pga(&self) -> f64 {
        largest_magnitude(&self.accel)
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

/// The bytes of a record file.
fn bytes(path: &Path) -> Result<Vec<u8>, RecordError> {
    let file = label(path);
    if path.is_dir() {
        return Err(RecordError::Folder { file });
    }
    let unreadable = |error: std::io::Error| RecordError::Unreadable {
        file: file.clone(),
        reason: text::quote(&error.to_string()),
    };
    let bytes = files::input::bytes(path, FILE_LIMIT).map_err(unreadable)?;
    bytes.ok_or(RecordError::TooLarge { file, limit_mb: FILE_LIMIT >> 20 })
}

fn check_step(record: &str, dt: f64) -> Result<(), RecordError> {
    if (1e-6..=1.0).contains(&dt) {
        Ok(())
    } else {
        Err(RecordError::BadStep { record: text::quote(record), dt })
    }
}

/// A path for messages of one line.
fn label(path: &Path) -> String {
    files::message::printable(&path.to_string_lossy()).into_owned()
}

#[cfg(test)]
mod tests;
