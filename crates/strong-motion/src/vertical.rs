//! The vertical component that goes with a record: from the same file, or from another one.

use std::{
    fmt,
    path::{Path, PathBuf},
    str::FromStr,
    sync::Arc,
};

use serde::{Deserialize, Serialize};

use super::text::quote;
use super::{Component, Direction, ReadOptions, Record, RecordError, Recording, Source};
use crate::{GRAVITY, largest_magnitude};

/// What finds the only vertical component of a file.
const UP: &str = "up";

/// Where to take the vertical component from: `auto`, or a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "PathBuf", into = "PathBuf")]
pub enum VerticalFrom {
    /// Nowhere: the motion has none.
    None,
    /// The record's own file.
    Auto,
    /// This file.
    File(PathBuf),
}

impl From<PathBuf> for VerticalFrom {
    fn from(path: PathBuf) -> Self {
        match path.as_os_str().to_str() {
            Some("none") => Self::None,
            Some("auto") => Self::Auto,
            _ => Self::File(path),
        }
    }
}

impl From<VerticalFrom> for PathBuf {
    fn from(from: VerticalFrom) -> Self {
        match from {
            VerticalFrom::None => "none".into(),
            VerticalFrom::Auto => "auto".into(),
            VerticalFrom::File(path) => path,
        }
    }
}

impl FromStr for VerticalFrom {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(PathBuf::from(text).into())
    }
}

impl VerticalFrom {
    /// What it names, a relative path of a file starting from a folder.
    #[doc(hidden)]
    #[must_use]
    pub fn within(self, folder: &Path) -> Self {
        match self {
            Self::File(path) => Self::File(folder.join(path)),
            other => other,
        }
    }
}

/// Vertical ground acceleration at a record's times.
#[derive(Clone, Debug)]
pub struct Vertical {
    /// The file's name without its ending, and the component's where the file has several.
    pub name: String,
    /// Positive upwards (m/s2).
    pub accel: Arc<[f64]>,
    /// Where it comes from, as of a [`Record`].
    pub source: Source,
}

impl PartialEq for Vertical {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.accel) == (&other.name, &other.accel)
    }
}

impl Vertical {
    /// Peak acceleration (g).
    pub fn peak_g(&self) -> f64 {
        largest_magnitude(&self.accel) / GRAVITY
    }

    /// As a record of its own, with the time step given (s).
    #[doc(hidden)]
    pub fn as_record(&self, dt: f64) -> Record {
        let (name, source) = (self.name.clone(), self.source.clone());
        Record { name, dt, accel: self.accel.to_vec(), vertical: None, source, made_of: None }
    }

    /// The component's numbers, turned upwards where the file counts them downwards.
    fn of(component: Component) -> Record {
        let record = component.record;
        let down =
            component.name.is_some_and(|name| name.trim().to_ascii_uppercase().starts_with("DOWN"));
        if down {
            Record { accel: record.accel.iter().map(|a| -a).collect(), ..record }
        } else {
            record
        }
    }

    /// The only component of a file that may be vertical, or the one asked for, as a record of its
    /// own.
    ///
    /// # Errors
    /// The file is no record, or has no vertical component, or several.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Record, RecordError> {
        let options = ReadOptions { vertical: None, ..options.clone() };
        let mut recording = match Recording::read(path, &options) {
            // of a table the column that is called so
            Err(RecordError::TooManyColumns { file, line, found, columns }) => {
                let up = ReadOptions { component: Some(UP.into()), ..options.clone() };
                Recording::read(path, &up).map_err(|error| match error {
                    RecordError::NoComponent { .. } => {
                        RecordError::NoVerticalColumn { file, line, found, columns }
                    }
                    other => other,
                })?
            }
            other => other?,
        };
        let which = match &recording.components[..] {
            _ if options.component.is_some() || recording.is_chosen() => recording.taken,
            [only] if matches!(only.direction, Direction::Vertical | Direction::Unknown) => 0,
            _ => recording.only_vertical()?,
        };
        Ok(Self::of(recording.components.swap_remove(which)))
    }
}

impl Recording {
    /// Index of the only vertical component.
    ///
    /// # Errors
    /// There is none, or several; why the only one that the file names cannot be read.
    fn only_vertical(&self) -> Result<usize, RecordError> {
        let mut all = (0..self.components.len())
            .filter(|&i| self.components[i].direction == Direction::Vertical);
        let found = match (all.next(), all.next(), &self.vertical_refused) {
            (Some(only), None, _) => return Ok(only),
            (None, _, Some(error)) => return Err(error.clone()),
            (None, ..) => "no vertical component",
            (Some(_), ..) => "several vertical components",
        };
        Err(RecordError::NoVertical { file: self.file.clone(), found })
    }

    /// The vertical component asked for, checked against the one that a run takes, and how many
    /// samples after the end of that one are left out.
    pub(super) fn check_vertical(
        &self,
        options: &ReadOptions,
    ) -> Result<Option<(Record, usize)>, RecordError> {
        let vertical = match &options.vertical {
            None | Some(VerticalFrom::None) => return Ok(None),
            Some(VerticalFrom::Auto) => {
                let which = self.only_vertical()?;
                if which == self.taken {
                    return Err(RecordError::NoVertical {
                        file: self.file.clone(),
                        found: "one vertical component, which is taken as the horizontal motion",
                    });
                }
                Self::named(self.components[which].clone())
            }
            Some(VerticalFrom::File(path)) => {
                Vertical::read(path, &ReadOptions { component: None, ..options.clone() })?
            }
        };
        let record = &self.component().record;
        let all = vertical.len();
        let vertical = cut_to(vertical, record);
        record.agrees(&vertical)?;
        let left_out = all - vertical.len();
        Ok(Some((vertical, left_out)))
    }

    /// The component of the record's own file, its source one that finds it again.
    fn named(component: Component) -> Record {
        let mut record = Vertical::of(component);
        if let Source::File { component: name @ None, .. } = &mut record.source {
            *name = Some(UP.into());
        }
        record
    }
}

/// [`Vertical::as_record`], for the Python package.
pub fn as_record(vertical: &Vertical, dt: f64) -> Record {
    vertical.as_record(dt)
}

/// A component of the same time step without the samples after the end of `record`: the components
/// of one instrument often differ by a few.
pub fn cut_to(mut component: Record, record: &Record) -> Record {
    if component.has_step_of(record) {
        component.accel.truncate(record.len());
    }
    component
}

impl Record {
    fn has_step_of(&self, other: &Self) -> bool {
        (self.dt - other.dt).abs() <= 1e-9 * other.dt
    }

    /// Whether another record has its times.
    fn agrees(&self, other: &Self) -> Result<(), RecordError> {
        if other.has_step_of(self) && self.len() == other.len() {
            return Ok(());
        }
        Err(RecordError::VerticalDiffers {
            vertical: quote(&other.name),
            samples: other.len(),
            dt: other.dt,
            record_samples: self.len(),
            record_dt: self.dt,
        })
    }

    /// The record with a vertical component, positive upwards.
    ///
    /// # Errors
    /// It has another time step or another number of samples.
    pub fn with_vertical(self, vertical: Self) -> Result<Self, RecordError> {
        self.agrees(&vertical)?;
        // components that were scaled or cut each on its own are in no file together
        let apart = self.made_of.is_some() || vertical.made_of.is_some();
        let of = |source| if apart { Source::Numbers } else { source };
        let Self { name, accel, source, .. } = vertical;
        let vertical = Some(Vertical { name, accel: accel.into(), source: of(source) });
        Ok(Self { vertical, source: of(self.source), made_of: None, ..self })
    }

    /// Vertical acceleration at the record's times (m/s2), positive upwards; empty if it has none.
    pub fn up(&self) -> &[f64] {
        self.vertical.as_ref().map_or(&[], |vertical| &vertical.accel)
    }

    /// Vertical acceleration at the record's times (m/s2), positive upwards, shared, as
    /// `RockingOptions::vertical` takes it; none if the record has none.
    pub fn vertical_accel(&self) -> Option<Arc<[f64]>> {
        self.vertical.as_ref().map(|vertical| Arc::clone(&vertical.accel))
    }
}

impl fmt::Display for Vertical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({:.4} g)", quote(&self.name), self.peak_g())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;

    #[test]
    fn where_a_vertical_motion_comes_from_is_named_as_users_do() {
        for (text, from) in [
            ("none", VerticalFrom::None),
            ("auto", VerticalFrom::Auto),
            ("up.at2", VerticalFrom::File("up.at2".into())),
        ] {
            assert_eq!(text.parse(), Ok(from.clone()));
            assert_eq!(PathBuf::from(from), PathBuf::from(text));
        }
    }

    /// The third column as it stands there, in m/s2.
    #[test]
    fn the_vertical_column_of_a_table_is_found_by_its_name() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("rec.csv");
        let write = |head: &str| {
            std::fs::write(
                &path,
                format!("{head}\n0.00,1.0,0.5\n0.01,-2.0,0.25\n0.02,1.5,-0.75\n"),
            )
            .unwrap();
        };
        let read = |component: Option<&str>, vertical: Option<VerticalFrom>| {
            let component = component.map(str::to_owned);
            let units = Some(Units::MetrePerSecond2);
            Record::read(&path, &ReadOptions { component, vertical, units, ..Default::default() })
        };
        for name in ["UP", "ud", "Z", "V", "vertical", "Up [m/s2]"] {
            write(&format!("time,EW,{name}"));
            let auto = read(Some("EW"), Some(VerticalFrom::Auto)).unwrap();
            assert_eq!(
                (&auto.accel[..], auto.up()),
                (&[1.0, -2.0, 1.5][..], &[0.5, 0.25, -0.75][..])
            );
            let by_number = read(Some("column 2"), Some(VerticalFrom::Auto)).unwrap();
            assert_eq!(by_number.up(), auto.up(), "{name}");
            let file = read(Some("EW"), Some(VerticalFrom::File(path.clone()))).unwrap();
            assert_eq!(file.up(), auto.up(), "{name}");
            // it is found again by its source, as parameters.json has it
            let Source::File { component, units, .. } = &auto.vertical.as_ref().unwrap().source
            else {
                panic!("no file")
            };
            let options = ReadOptions {
                component: component.clone(),
                units: Some(*units),
                ..Default::default()
            };
            assert_eq!(Vertical::read(&path, &options).unwrap().accel, auto.up());
            // and told where it is left out: 0.75 m/s2
            let Source::File { vertical_left_out_g, .. } = read(Some("EW"), None).unwrap().source
            else {
                panic!("no file")
            };
            assert!((vertical_left_out_g.unwrap() - 0.75 / 9.81).abs() < 1e-15);
        }
        write("time,a,V");
        assert!(matches!(
            read(Some("a"), Some(VerticalFrom::Auto)),
            Err(RecordError::NoVertical { .. })
        ));
        write("time,EW,other");
        let refused = read(Some("EW"), Some(VerticalFrom::File(path.clone()))).unwrap_err();
        let told = "rec.csv, line 2: 3 columns, of which none or several are of a vertical motion \
            (column 2 (EW), column 3 (other)); call it UP, UD, Z, V or vertical in the header";
        assert!(refused.to_string().ends_with(told), "{refused}");
    }
}
