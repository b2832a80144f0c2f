//! The record of `parameters.json`: enough of it to have the same ground motion again, or to say
//! why not.

use std::path::{Component, Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::Parameters;
use files::message::one_line;
use strong_motion::{
    ReadOptions, Record, RecordError, Source, Units, Vertical, cut_to, excitation::Excitation,
};

/// Record length assumed for old files that name no record and hold no match (s).
const FORMER_DURATION_S: f64 = 20.0;

/// The record the springs were tuned on. Files of schema 1 have the first four keys only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordRow {
    pub name: String,
    pub dt_s: f64,
    /// Of the whole record.
    pub samples: usize,
    /// Peak of the part used, scaled.
    pub pga_g: f64,
    /// Its time (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pga_time_s: Option<f64>,
    /// Factor on the record's acceleration.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// Length used (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Of dt and all samples, unscaled, as 16 hexadecimal digits: [`Record::fingerprint`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fnv1a_64: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRow>,
    /// The vertical component, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertical: Option<VerticalRow>,
}

/// The vertical component of the record, scaled and cut as it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VerticalRow {
    pub name: String,
    /// Peak of the part used, scaled.
    pub pga_g: f64,
    /// As of the record, of the samples up to its end; upwards is positive.
    pub fnv1a_64: String,
    pub source: SourceRow,
}

/// Where the record is to be found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum SourceRow {
    /// In the program.
    Embedded,
    File {
        /// As the user named it.
        file: String,
        /// From the folder of parameters.json, or absolute where there is no way from there; with
        /// `/`.
        path: String,
        /// Of the file's numbers, found in it or given.
        units: Units,
        /// Which component, where the file has several.
        #[serde(skip_serializing_if = "Option::is_none")]
        component: Option<String>,
        /// Whether the mean was taken off.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        baseline: bool,
    },
    /// Nowhere: the numbers were made by a program.
    Numbers,
}

/// Why a remembered record is not to be had, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum RememberedError {
    #[error(
        "{parameters}: its record {file} is not there (nor at {path}); put it back, or name a \
         record with --record"
    )]
    Missing { parameters: String, file: String, path: String },
    #[error(
        "{parameters}: its record {file} has changed since the springs were tuned ({change}); put \
         the old one back, or name this one with --record"
    )]
    Changed { parameters: String, file: String, change: String },
    #[error(
        "{parameters}: its record {name} was given as numbers and is in no file; save it as a \
         column of accelerations, in Python \
         numpy.savetxt(\"motion.txt\", record.accel), and name it with --record motion.txt --dt \
         {dt_s} --units m/s2"
    )]
    NoFile { parameters: String, name: String, dt_s: f64 },
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl SourceRow {
    /// For a parameters.json in `folder`.
    fn new(source: &Source, folder: &Path) -> Self {
        match source {
            Source::Embedded => Self::Embedded,
            Source::File { path, units, component, baseline, .. } => Self::File {
                file: slashes(path),
                path: slashes(&way(&real(folder), &real(path))),
                units: *units,
                component: component.clone(),
                baseline: *baseline,
            },
            Source::Numbers | Source::Synthetic | Source::Earthquake => Self::Numbers,
        }
    }
}

impl RecordRow {
    /// The row of a ground motion, for a parameters.json in `folder`; `used` is the part used,
    /// scaled.
    pub fn new(excitation: &Excitation, used: &Record, folder: &Path) -> Self {
        let record = &excitation.record;
        let vertical =
            record.vertical.as_ref().zip(used.vertical.as_ref()).map(|(whole, used)| VerticalRow {
                name: whole.name.clone(),
                pga_g: used.peak_g(),
                fnv1a_64: hexadecimal(whole.as_record(record.dt).fingerprint()),
                source: SourceRow::new(&whole.source, folder),
            });
        Self {
            name: record.name.clone(),
            dt_s: record.dt,
            samples: record.len(),
            pga_g: used.pga_g(),
            pga_time_s: Some(used.pga_time()),
            scale: Some(excitation.scale),
            duration_s: Some(excitation.duration()),
            fnv1a_64: Some(hexadecimal(record.fingerprint())),
            source: Some(SourceRow::new(&record.source, folder)),
            vertical,
        }
    }

    /// The ground motion again; `parameters` is the path of the file that this row is of.
    pub(super) fn excitation(&self, parameters: &Path) -> Result<Excitation, RememberedError> {
        let (record, scale) = (self.record(parameters)?, self.scale.unwrap_or(1.0));
        Ok(Excitation { record, scale, duration_s: self.duration_s })
    }

    /// The record again, whole and unscaled; `parameters` is the path of the file that this row is
    /// of.
    fn record(&self, parameters: &Path) -> Result<Record, RememberedError> {
        let source = self.source.as_ref().unwrap_or(&SourceRow::Embedded);
        let record =
            self.component(parameters, source, (&self.name, self.fnv1a_64.as_ref()), Record::read)?;
        let Some(row) = &self.vertical else { return Ok(record) };
        let remembered = (row.name.as_str(), Some(&row.fnv1a_64));
        // the hash is of what was used: up to the end of the record
        let read = |path: &Path, options: &ReadOptions| {
            Ok(cut_to(Vertical::read(path, options)?, &record))
        };
        let vertical = self.component(parameters, &row.source, remembered, read)?;
        Ok(record.with_vertical(vertical)?)
    }

    /// A component again by its source, read by `read`; its name and hash are remembered.
    fn component(
        &self,
        parameters: &Path,
        source: &SourceRow,
        (called, hash): (&str, Option<&String>),
        read: impl Fn(&Path, &ReadOptions) -> Result<Record, RecordError>,
    ) -> Result<Record, RememberedError> {
        let name = || parameters.display().to_string();
        let (record, file) = match source {
            SourceRow::Embedded => (Record::el_centro(), "the embedded El Centro".to_string()),
            SourceRow::Numbers => {
                return Err(RememberedError::NoFile {
                    parameters: name(),
                    name: one_line(called),
                    dt_s: self.dt_s,
                });
            }
            SourceRow::File { file, path, units, component, baseline } => {
                let (component, baseline) = (component.clone(), *baseline);
                let options = ReadOptions {
                    dt: Some(self.dt_s),
                    units: Some(*units),
                    component,
                    baseline,
                    vertical: None,
                };
                let here = parameters.parent().unwrap_or(Path::new("")).join(path);
                let there = [here.as_path(), Path::new(file)].into_iter().find(|p| p.exists());
                let missing = || RememberedError::Missing {
                    parameters: name(),
                    file: one_line(file),
                    path: one_line(path),
                };
                match read(there.ok_or_else(missing)?, &options) {
                    Err(RecordError::StepDiffers { .. } | RecordError::UnitsDiffer { .. }) => {
                        let change = "it says another time step or unit".to_string();
                        return Err(RememberedError::Changed {
                            parameters: name(),
                            file: one_line(file),
                            change,
                        });
                    }
                    record => (record?, one_line(file)),
                }
            }
        };
        let found = hexadecimal(record.fingerprint());
        match hash {
            Some(remembered) if *remembered != found => {
                let change =
                    format!("the hash of its numbers is {found}, not {}", one_line(remembered));
                Err(RememberedError::Changed { parameters: name(), file, change })
            }
            _ => Ok(record),
        }
    }
}

impl Parameters {
    /// The ground motion that the springs were tuned on; `path` is that of this parameters.json,
    /// from which its record's is told. A file that remembers no source stands for El Centro, over
    /// the length of its match or 20 s.
    ///
    /// # Errors
    /// The record is not there, has changed, was in no file, or is none any more.
    pub fn excitation(&self, path: &Path) -> Result<Excitation, RememberedError> {
        match &self.record {
            Some(row) if row.source.is_some() => row.excitation(path),
            _ => Ok(Excitation {
                duration_s: Some(self.matched.map_or(FORMER_DURATION_S, |m| m.duration_s)),
                ..Excitation::whole(Record::el_centro())
            }),
        }
    }
}

fn hexadecimal(hash: u64) -> String {
    format!("{hash:016x}")
}

/// A path without links and dots as far as it exists.
fn real(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    for there in absolute.ancestors() {
        if let (Ok(real), Ok(rest)) = (there.canonicalize(), absolute.strip_prefix(there)) {
            return if rest.as_os_str().is_empty() { real } else { real.join(rest) };
        }
    }
    absolute
}

/// The way from a folder to a file, both as [`real`] has them; the file's own path where nothing
/// but the root is common to both.
fn way(folder: &Path, file: &Path) -> PathBuf {
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    // without a root both start from the same folder
    if folder.has_root()
        && folder.components().take(common).all(|part| !matches!(part, Component::Normal(_)))
    {
        return file.to_owned();
    }
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    up.chain(file.components().skip(common)).collect()
}

/// A path as every system reads it.
fn slashes(path: &Path) -> String {
    let text = path.to_string_lossy();
    if std::path::MAIN_SEPARATOR == '/' {
        text.into_owned()
    } else {
        text.replace(std::path::MAIN_SEPARATOR, "/")
    }
}

#[cfg(test)]
mod tests;
