//! Options that several commands share, and what they stand for.

use std::{fmt::Write, path::PathBuf};

use clap::Args;

use super::{CommandError, terminal};
pub use crate::answers::{Both, both};
use crate::{
    case::{Case, LONGEST_S},
    excitation::Excitation,
    record::{ReadOptions, Recording, Units, VerticalFrom},
};

/// Which record, how scaled, how long.
#[derive(Clone, Debug, Default, Args)]
pub struct RecordOptions {
    /// Ground motion: PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns; that of the case or of the parameters unless given
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Time step, where the file does not say
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub dt: Option<f64>,
    /// g, m/s2, cm/s2 or mm/s2, where the file does not say
    #[arg(long)]
    pub units: Option<Units>,
    /// Component, by name or by azimuth in degrees, of a file with several [default: the stronger horizontal one]
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub component: Option<String>,
    /// Subtract the mean of the samples
    #[arg(long)]
    pub baseline: bool,
    /// Vertical component: auto, that of the record's file; or the file of one with the same times [default: none]
    #[arg(long, value_name = "FILE|auto")]
    pub vertical: Option<VerticalFrom>,
    /// Factor on the record's acceleration, in place of the case's or the parameters' [default: theirs; 1 with --record]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    pub scale: Option<f64>,
    /// Length of the history [default: the case's or the parameters'; the whole record with --record]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub duration: Option<f64>,
}

impl RecordOptions {
    /// The ground motion asked for: `default`, of which a scale or a length given replaces its own; or another record,
    /// whole and unscaled unless something is given. What its reader says goes to stderr.
    pub fn excitation<E: Into<CommandError>>(
        &self,
        default: impl FnOnce() -> Result<Excitation, E>,
    ) -> Result<Excitation, CommandError> {
        if let Some(d) = self.duration.filter(|d| !(*d > 0.0 && *d <= LONGEST_S)) {
            return Err(CommandError::Option {
                option: "duration",
                value: format!("{d:?}"),
                remedy: "give seconds greater than zero, at most 1e6",
            });
        }
        let asked = match &self.record {
            Some(path) => {
                let (component, baseline) = (self.component.clone(), self.baseline);
                let vertical = self.vertical.clone();
                let options = ReadOptions { dt: self.dt, units: self.units, component, baseline, vertical };
                let recording = Recording::read(path, &options)?;
                recording.notices().iter().for_each(terminal::stderr);
                Excitation::whole(recording.into_record())
            }
            None if self.tells_of_a_file() => {
                return Err(CommandError::Option {
                    option: "record",
                    value: "not given".into(),
                    remedy: "--dt, --units, --component, --baseline and --vertical tell of a file: name it with --record",
                });
            }
            None => default().map_err(Into::into)?,
        };
        Ok(Excitation {
            scale: self.scale.unwrap_or(asked.scale),
            duration_s: self.duration.or(asked.duration_s),
            ..asked
        })
    }
}

impl RecordOptions {
    fn tells_of_a_file(&self) -> bool {
        let said = self.dt.is_some() || self.units.is_some() || self.component.is_some();
        said || self.baseline || self.vertical.is_some()
    }
}

/// The ground motion of a case; what its reader said goes to stderr.
pub fn of_case(case: &Case) -> Result<Excitation, CommandError> {
    case.notices.iter().for_each(terminal::stderr);
    Ok(case.excitation.clone())
}

/// A velocity restitution from the command line, checked.
pub fn restitution(given: Option<f64>) -> Result<Option<f64>, CommandError> {
    match given {
        Some(e) if !(0.0..=1.0).contains(&e) => Err(CommandError::Option {
            option: "restitution",
            value: format!("{e:?}"),
            remedy: "a velocity ratio lies between 0 and 1",
        }),
        given => Ok(given),
    }
}

/// `history.csv`: the motions at the record's samples, 12 significant digits; with members three columns more.
pub fn history_csv(dt: f64, both: &Both) -> String {
    let mut motions = vec![("housner", &both.housner), ("fem", &both.fem.motion)];
    motions.extend(both.with.as_ref().map(|with| ("members", &with.history.motion)));
    let mut out = String::from("t");
    for (name, _) in &motions {
        // writing to a String cannot fail
        let _ = write!(out, ",u_{name},v_{name},th_{name}");
    }
    out.push('\n');
    // the finite elements go on where Housner's solution ends because the pivot lets go: his columns are then empty
    let left = both.rocking.left_ground().is_some();
    let compared = motions.iter().skip(usize::from(left)).map(|(_, motion)| motion.len()).min().unwrap_or(0);
    for i in 0..compared {
        out.push_str(&digits_12(i as f64 * dt));
        for (_, motion) in &motions {
            let row = (i < motion.len()).then(|| [motion.u[i], motion.v[i], motion.theta[i]].map(digits_12));
            let _ = write!(out, ",{}", row.map_or(",,".into(), |row| row.join(",")));
        }
        out.push('\n');
    }
    out
}

/// One CSV row with 12 significant digits.
pub fn csv_row(out: &mut String, row: &[f64]) {
    for (i, x) in row.iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // where a history has ended there is no number
        let cell = if x.is_nan() { String::new() } else { digits_12(*x) };
        // writing to a String cannot fail
        let _ = write!(out, "{comma}{cell}");
    }
    out.push('\n');
}

/// 12 significant digits, plain where that is short.
fn digits_12(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if (-4..12).contains(&exponent) { format!("{x:.*}", (11 - exponent).max(0) as usize) } else { format!("{x:.11e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_twelve_significant_digits() {
        assert_eq!(digits_12(0.401181622959), "0.401181622959");
        assert_eq!(digits_12(-12.5), "-12.5000000000");
        assert_eq!(digits_12(1.0 / 3.0e6), "3.33333333333e-7");
        assert_eq!(digits_12(0.0), "0");
    }
}
