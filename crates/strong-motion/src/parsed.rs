//! What a reader found in a file, in the file's own unit, before it is a record.

use super::peak::Peak;
use super::{Component, Direction, ReadOptions, Record, RecordError, Units};

/// A file as its reader leaves it.
#[derive(Default)]
pub(super) struct Parsed {
    pub station: Option<String>,
    pub channels: Vec<Channel>,
    /// The file has more columns than the one that was chosen.
    pub chosen: bool,
    /// Columns of bare values that were read row by row, where there are several.
    pub row_by_row: Option<usize>,
    /// Its times were in ms.
    pub milliseconds: bool,
    /// The time step that the header says, where its times have another (s).
    pub other_step: Option<f64>,
    /// Why the first column of a vertical motion that cannot be read is none.
    pub vertical_refused: Option<RecordError>,
}

/// One component.
pub(super) struct Channel {
    /// What the file calls it.
    pub name: Option<String>,
    pub direction: Direction,
    pub samples: Samples,
    /// The header's peak acceleration, checked, in the samples' unit.
    pub pga: Option<Peak>,
    /// The header's peak velocity (m/s).
    pub pgv: Option<Peak>,
}

/// Samples in the file's own unit.
#[derive(Debug, Default)]
pub(super) struct Samples {
    pub units: Option<Units>,
    /// What the header speaks of, if that is not acceleration.
    pub quantity: Option<&'static str>,
    pub dt: Option<f64>,
    /// How far dt may be off by the rounding of printed digits (s).
    pub dt_rounding: f64,
    /// Time of the first sample on the clock of the file's header (s).
    pub start: f64,
    pub values: Vec<f64>,
}

impl Parsed {
    /// A file that knows nothing but its samples.
    pub(super) fn bare(samples: Samples) -> Self {
        let channel =
            Channel { name: None, direction: Direction::Unknown, samples, pga: None, pgv: None };
        Self { channels: vec![channel], ..Self::default() }
    }
}

impl Channel {
    /// The component in SI units, what the file says and what the user says agreeing.
    pub(super) fn into_component(
        self,
        file: &str,
        record: &str,
        options: &ReadOptions,
    ) -> Result<Component, RecordError> {
        let (dt, units) = (self.samples.step(file, options)?, self.samples.unit(file, options)?);
        let factor = units.metres_per_second2();
        let mut accel: Vec<f64> =
            self.samples.values.into_iter().map(|value| value * factor).collect();
        let offset = mean(&accel);
        if options.baseline {
            accel.iter_mut().for_each(|a| *a -= offset);
        }
        let mut record_read = Record::new(file, dt, accel)?;
        record_read.name = record.to_owned();
        Ok(Component {
            name: self.name,
            direction: self.direction,
            units,
            start: self.samples.start,
            offset,
            header_pga: self.pga.map(|peak| peak.times(factor)),
            header_pgv: self.pgv,
            record: record_read,
        })
    }
}

impl Samples {
    fn step(&self, file: &str, options: &ReadOptions) -> Result<f64, RecordError> {
        let file = || file.to_owned();
        if let Some(quantity) = self.quantity {
            return Err(RecordError::NotAcceleration { file: file(), quantity });
        }
        if self.values.is_empty() {
            return Err(RecordError::Empty { file: file() });
        }
        match (self.dt, options.dt) {
            (Some(file_dt), Some(given))
                if (file_dt - given).abs() > self.dt_rounding + 1e-9 * file_dt =>
            {
                Err(RecordError::StepDiffers { file: file(), file_dt, given })
            }
            // within the rounding of the file's digits the user's step is the sharper one
            (_, Some(given)) => Ok(given),
            (Some(file_dt), None) => Ok(file_dt),
            (None, None) => Err(RecordError::NoStep { file: file() }),
        }
    }

    fn unit(&self, file: &str, options: &ReadOptions) -> Result<Units, RecordError> {
        let file = || file.to_owned();
        match (self.units, options.units) {
            (Some(file_units), Some(given)) if file_units != given => {
                Err(RecordError::UnitsDiffer { file: file(), file_units, given })
            }
            (Some(units), _) | (None, Some(units)) => Ok(units),
            (None, None) => Err(RecordError::NoUnits { file: file() }),
        }
    }
}

/// Mean of the values; zero of none.
pub(super) fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}
