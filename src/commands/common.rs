//! Options that several commands share, and what they stand for.

use std::{fmt::Write, path::PathBuf};

use clap::Args;

use super::{
    CommandError,
    members::{WithMembers, peaks_until},
};
use crate::{
    case::{Case, LONGEST_S},
    compare::Match,
    conditioning::Conditioning,
    excitation::Excitation,
    fem,
    housner::{self, Rocking},
    members::Members,
    motion::Motion,
    record::{ReadOptions, Record, Recording, Units, VerticalFrom},
    spring::{Chain, Springs},
    structure::Body,
    verdict::Verdict,
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
                recording.notices().iter().for_each(|notice| eprintln!("{notice}"));
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
    case.notices.iter().for_each(|notice| eprintln!("{notice}"));
    Ok(case.excitation.clone())
}

/// Both models' answers to one record.
pub struct Both {
    pub rocking: Rocking<f64>,
    /// Housner's history without the vertical component, if the record has one.
    pub level: Option<Rocking<f64>>,
    pub housner: Motion,
    pub fem: fem::History,
    pub matched: Match,
    /// Forces in the rigid body's history.
    pub demands: fem::Demands,
    /// The same with members, if there are any.
    pub with: Option<WithMembers>,
}

/// Run both models over a record; with members, the finite elements once more with them.
pub fn both(
    body: &Body<f64>,
    restitution: f64,
    springs: &Springs<Chain<f64>>,
    members: &Members<f64>,
    record: &Record,
) -> Both {
    let level = housner::Options { restitution: Some(restitution), ..Default::default() };
    let options = housner::Options { vertical: record.vertical_accel(), ..level.clone() };
    let rocking = housner::solve(body, record.dt, &record.accel, &options);
    let level = record.vertical.as_ref().map(|_| housner::solve(body, record.dt, &record.accel, &level));
    let motion = rocking.motion(body);
    let case = fem::Case {
        body: *body,
        springs: *springs,
        start: fem::Start::Settled,
        dt: record.dt,
        accel: &record.accel,
        vertical: record.up(),
        scale: 1.0,
        control: fem::Control::default(),
    };
    let matched =
        |history: &fem::History| Match::new(body, record.dt, (&motion, rocking.impacts.len()), history, restitution);
    let (fem, mut demands) = case.simulate_with(&Members::default());
    let rigid = matched(&fem);
    peaks_until(&mut demands, record.dt, rigid.overturned_fem_s);
    let with = (!members.is_none()).then(|| {
        let (history, mut demands) = case.simulate_with(members);
        let matched = matched(&history);
        peaks_until(&mut demands, record.dt, matched.overturned_fem_s);
        WithMembers { members: *members, history, demands, matched }
    });
    Both { rocking, level, housner: motion, fem, matched: rigid, demands, with }
}

impl Both {
    /// What the histories say together; `dt` in s.
    pub fn verdict(&self, body: &Body<f64>, dt: f64, conditioning: &Conditioning) -> Verdict {
        let verdict = Verdict::new(body, dt, (&self.rocking, &self.fem), &self.matched, conditioning);
        match &self.level {
            Some(level) => verdict.beside(body, dt, level),
            None => verdict,
        }
    }

    /// That a body overturned, and up to when the histories are compared.
    fn overturned(&self) -> Option<String> {
        let m = &self.matched;
        let words = |time: Option<f64>| time.map_or("stands".into(), |time| format!("overturns at t = {time:.3} s"));
        (m.overturned_housner_s.or(m.overturned_fem_s)).map(|_| {
            format!(
                "Housner's body {}, the body on its springs {}: compared up to t = {:.3} s only",
                words(m.overturned_housner_s),
                words(m.overturned_fem_s),
                m.duration_s
            )
        })
    }

    /// What to say of histories that overturned, ended before the record did, or took steps that broke their bounds.
    pub fn early(&self) -> Vec<String> {
        let said = |name: &str, history: &fem::History| {
            let (time, why) = match history.outcome {
                fem::Outcome::Completed | fem::Outcome::Stopped { .. } | fem::Outcome::Overturned { .. } => {
                    return None;
                }
                fem::Outcome::WorkBound { time } => {
                    (time, "given up at the bound on steps; use softer or damped springs")
                }
                fem::Outcome::Unstable { time } => (
                    time,
                    "the rotation lost its balance: springs too soft for a body with so little rotational inertia, or a lean \
                     at which a leg would pull; use stiffer springs, or a rotational_inertia_kgm2 above 0.002 m R^2",
                ),
            };
            Some(format!("{name} ends at t = {time:.3} s: {why}; both are compared up to there"))
        };
        let overturned = self.overturned();
        let smallest = |name: &str, history: &fem::History| match history.work.smallest {
            0 => None,
            n => Some(format!("{name}: {n} steps were taken at the smallest size, whatever their error")),
        };
        let with = self.with.as_ref().map(|with| ("finite element history with members", &with.history));
        let all = [("finite element history", &self.fem)].into_iter().chain(with);
        overturned
            .into_iter()
            .chain(all.flat_map(|(name, history)| [said(name, history), smallest(name, history)]).flatten())
            .collect()
    }
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
        // writing to a String cannot fail
        let _ = write!(out, "{comma}{}", digits_12(*x));
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
    fn steps_of_the_smallest_size_are_said_if_there_were_any() {
        let structure = crate::structure::Structure::paper();
        let chain = Chain { k1: 1e9, k2: 1e8, m2: 1e5, c: 1e6 };
        let springs = Springs { vertical: chain, horizontal: chain };
        let record = Record::new("still", 0.01, vec![0.0; 3]).unwrap();
        let mut both = both(&structure.body(), 0.98, &springs, &Members::default(), &record);
        assert_eq!((both.fem.work.smallest, both.early()), (0, Vec::new()));
        both.fem.work.smallest = 3;
        let said = "finite element history: 3 steps were taken at the smallest size, whatever their error";
        assert_eq!(both.early(), [said]);
    }

    #[test]
    fn numbers_have_twelve_significant_digits() {
        assert_eq!(digits_12(0.401181622959), "0.401181622959");
        assert_eq!(digits_12(-12.5), "-12.5000000000");
        assert_eq!(digits_12(1.0 / 3.0e6), "3.33333333333e-7");
        assert_eq!(digits_12(0.0), "0");
    }
}
