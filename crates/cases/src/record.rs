//! The section `[record]` of a case file: which ground motion, how scaled, how long.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{CaseError, LONGEST_S};
use strong_motion::{
    ReadOptions, Record, RecordError, TableColumn, Units, VerticalFrom, excitation::Excitation,
};

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RecordSection {
    /// Relative to the case file; the embedded El Centro record unless given.
    file: Option<PathBuf>,
    /// Time step (s), where the file does not say.
    dt_s: Option<f64>,
    /// As [`Units`] are named, where the file does not say.
    units: Option<Units>,
    /// Component by name or azimuth, where the file has several; the stronger horizontal one unless
    /// given.
    component: Option<String>,
    /// Column of a table, by number (from 1) or name, where there are several.
    column: Option<TableColumn>,
    /// Subtract the mean of the samples.
    baseline: bool,
    /// "auto", the vertical component of the same file, or the file of one, relative to the case
    /// file; none unless given.
    vertical: Option<VerticalFrom>,
    /// Factor on the acceleration; 1 unless given.
    scale: Option<f64>,
    /// Length to compare over (s); the whole record unless given.
    duration_s: Option<f64>,
}

impl RecordSection {
    /// The ground motion, its record read by `read`; `path` is where the record's path starts. What
    /// is asked goes before what the section says.
    pub(super) fn excitation(
        &self,
        path: &str,
        asked: &ReadOptions,
        read: impl FnOnce(&Path, &ReadOptions) -> Result<Record, RecordError>,
    ) -> Result<Excitation, CaseError> {
        self.check(path)?;
        let record = match &self.file {
            Some(name) => {
                let folder = Path::new(path).parent().unwrap_or(Path::new(""));
                read(&folder.join(name), &self.options(folder, asked))?
            }
            None => Record::el_centro(),
        };
        Ok(Excitation { record, scale: self.scale.unwrap_or(1.0), duration_s: self.duration_s })
    }

    /// How to read the file; paths start at a folder.
    fn options(&self, folder: &Path, asked: &ReadOptions) -> ReadOptions {
        let own =
            self.component.clone().or_else(|| self.column.as_ref().map(TableColumn::component));
        let vertical = self.vertical.clone().map(|from| from.within(folder));
        ReadOptions {
            dt: asked.dt.or(self.dt_s),
            units: asked.units.or(self.units),
            component: asked.component.clone().or(own),
            baseline: asked.baseline || self.baseline,
            vertical: asked.vertical.clone().or(vertical),
        }
    }

    fn check(&self, path: &str) -> Result<(), CaseError> {
        let refuse = |key, value: String, remedy| {
            Err(CaseError::Value { path: path.into(), key, value, remedy })
        };
        if let Some(asked) = self.duration_s.filter(|asked| !(*asked > 0.0 && *asked <= LONGEST_S))
        {
            let remedy = "give seconds greater than zero, at most 1e6";
            return refuse("record.duration_s", format!("{asked:?}"), remedy);
        }
        if let Some(scale) = self.scale.filter(|scale| *scale == 0.0) {
            return refuse("record.scale", format!("{scale:?}"), NO_MOTION);
        }
        if let Some(scale) = self.scale.filter(|scale| !scale.is_finite()) {
            return refuse("record.scale", format!("{scale:?}"), "give a finite number");
        }
        match (&self.component, &self.column) {
            (Some(component), Some(_)) => {
                let remedy = "component and column choose the same; leave one of them out";
                refuse("record.component", format!("{component:?}"), remedy)
            }
            _ => Ok(()),
        }
    }
}

/// What to do about a scale of zero.
pub const NO_MOTION: &str = "nothing would move; give another factor, as 1.0, or leave it out";
