//! Options that several commands share, and what they stand for.

use std::path::PathBuf;

use clap::Args;

use super::{CommandError, terminal};
use cases::{
    LONGEST_S, NO_MOTION,
    doubts::{Doubt, of_excitation},
};
use strong_motion::{
    Notice, ReadOptions, Record, Recording, Source, TableColumn, Units, VerticalFrom,
    excitation::Excitation,
};

/// What is to be looked at again, a line each.
pub fn look_again(doubts: &[Doubt]) {
    doubts.iter().for_each(|doubt| terminal::stderr(format_args!("CHECK {doubt}")));
}

/// What a record file does not say itself.
#[derive(Clone, Debug, Default, Args)]
pub struct ReadingOptions {
    /// Time step, where the file does not say
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    dt: Option<f64>,
    /// g, m/s2, cm/s2, mm/s2, mg, %g, ft/s2, in/s2 or mGal, where the file does not say
    #[arg(long)]
    units: Option<Units>,
    /// Component, by name or by azimuth in degrees, of a file with several [default: the stronger
    /// horizontal one]
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    component: Option<String>,
    /// Column of a table of several, by number (from 1, times included) or by its name in the
    /// header
    #[arg(long, value_name = "N|NAME", conflicts_with = "component")]
    column: Option<TableColumn>,
    /// Subtract the mean of the samples
    #[arg(long)]
    baseline: bool,
}

impl ReadingOptions {
    pub fn asked(&self) -> ReadOptions {
        let column = self.column.as_ref().map(TableColumn::component);
        ReadOptions {
            dt: self.dt,
            units: self.units,
            component: self.component.clone().or(column),
            baseline: self.baseline,
            vertical: None,
        }
    }
}

/// How to read a record's own file again: as it was read unless something else is asked for; none
/// if the record is of no file.
pub fn again(asked: ReadOptions, own: &Record) -> Option<(PathBuf, ReadOptions)> {
    let Source::File { path, units, component, baseline, .. } = &own.source else { return None };
    let options = ReadOptions {
        dt: asked.dt.or(Some(own.dt)),
        units: asked.units.or(Some(*units)),
        component: asked.component.or_else(|| component.clone()),
        baseline: asked.baseline || *baseline,
        vertical: asked.vertical,
    };
    Some((path.clone(), options))
}

/// Which record, how scaled, how long.
#[derive(Clone, Debug, Default, Args)]
pub struct RecordOptions {
    /// Ground motion: PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns; that of the case or
    /// of the parameters unless given
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    #[command(flatten)]
    file: ReadingOptions,
    /// Vertical component: auto, that of the record's file; none; or the file of one with the same
    /// times [default: the case's or the parameters'; none with --record]
    #[arg(long, value_name = "FILE|auto|none")]
    pub vertical: Option<VerticalFrom>,
    /// Factor on the record's acceleration, in place of the case's or the parameters' [default:
    /// theirs; 1 with --record]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    pub scale: Option<f64>,
    /// Length of the history [default: the case's or the parameters'; the whole record with
    /// --record]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub duration: Option<f64>,
}

impl RecordOptions {
    /// The ground motion asked for: `default`, of which a scale or a length given replaces its own;
    /// or another record, whole and unscaled unless something is given. What its reader says goes
    /// to stderr.
    pub fn excitation<E: Into<CommandError>>(
        &self,
        default: impl FnOnce() -> Result<Excitation, E>,
    ) -> Result<Excitation, CommandError> {
        self.check()?;
        let asked = match &self.record {
            Some(path) => {
                let recording = Recording::read(path, &self.reading())?;
                recording.notices().iter().for_each(terminal::stderr);
                Excitation::whole(recording.into_record())
            }
            None => {
                let own = default().map_err(Into::into)?;
                if self.reading() == ReadOptions::default() { own } else { self.read_again(own)? }
            }
        };
        Ok(self.scaled(asked))
    }

    /// The same; what is to be looked at again of another motion than the own one is told.
    pub fn checked_excitation<E: Into<CommandError>>(
        &self,
        default: impl FnOnce() -> Result<Excitation, E>,
    ) -> Result<Excitation, CommandError> {
        let excitation = self.excitation(default)?;
        if !self.is_own() || self.duration.is_some() {
            look_again(&of_excitation(&excitation));
        }
        Ok(excitation)
    }

    /// Whether the ground motion is the own one, of whatever length.
    pub fn is_own(&self) -> bool {
        self.record.is_none() && self.scale.is_none() && self.reading() == ReadOptions::default()
    }

    /// The own record from its file, with what the options say of it.
    fn read_again(&self, own: Excitation) -> Result<Excitation, CommandError> {
        let said = self.reading();
        let Some((path, options)) = again(said.clone(), &own.record) else {
            // there is none to leave out
            let none = Some(VerticalFrom::None);
            let asked_alone = said == ReadOptions { vertical: none, ..ReadOptions::default() };
            return if asked_alone { Ok(own) } else { Err(self.no_file()) };
        };
        let recording = Recording::read(&path, &options)?;
        recording.notices().iter().for_each(terminal::stderr);
        let record = recording.into_record();
        let kept = own.record.vertical.as_ref().filter(|_| options.vertical.is_none());
        let record = match kept.map(|up| up.as_record(own.record.dt)) {
            Some(up) => record.with_vertical(up)?,
            None => record,
        };
        Ok(Excitation { record, ..own })
    }

    /// The same of a case, which was read with [`RecordOptions::of_case`]: what is said of a file
    /// is said of the case's own unless `--record` names another.
    pub fn excitation_of_case(
        &self,
        own: &Excitation,
        notices: &[Notice],
    ) -> Result<Excitation, CommandError> {
        let named = matches!(own.record.source, Source::File { .. });
        if self.record.is_some() || !named {
            return self.excitation(|| -> Result<_, CommandError> { Ok(own.clone()) });
        }
        self.check()?;
        notices.iter().for_each(terminal::stderr);
        Ok(self.scaled(own.clone()))
    }

    /// How a case is to read the file that it names: as it says itself where `--record` names
    /// another.
    pub fn of_case(&self) -> ReadOptions {
        if self.record.is_some() { ReadOptions::default() } else { self.reading() }
    }

    /// What the options say of a file.
    fn reading(&self) -> ReadOptions {
        ReadOptions { vertical: self.vertical.clone(), ..self.file.asked() }
    }

    fn check(&self) -> Result<(), CommandError> {
        duration(self.duration)?;
        match self.scale {
            Some(0.0) => Err(CommandError::option("scale", 0.0, NO_MOTION)),
            Some(scale) if !scale.is_finite() => {
                Err(CommandError::option("scale", scale, "give a finite number"))
            }
            _ => Ok(()),
        }
    }

    fn no_file(&self) -> CommandError {
        CommandError::option(
            "record",
            format_args!("not given"),
            "--dt, --units, --component, --column, --baseline and --vertical tell of a file: name \
             it with --record, or in [record] of a case",
        )
    }

    fn scaled(&self, asked: Excitation) -> Excitation {
        let scale = self.scale.unwrap_or(asked.scale);
        Excitation { scale, duration_s: self.duration.or(asked.duration_s), ..asked }
    }
}

/// What the ground offers.
#[derive(Clone, Copy, Debug, Args)]
pub struct GroundOptions {
    /// Friction coefficient between foot and ground, for the warning of sliding [default: 0.5]
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    pub friction: Option<f64>,
}

/// Friction coefficient unless one is given.
const USUAL: f64 = 0.5;

impl GroundOptions {
    /// The friction coefficient, checked.
    pub fn friction(&self) -> Result<f64, CommandError> {
        let friction = self.friction.unwrap_or(USUAL);
        if friction.is_finite() && friction >= 0.0 {
            return Ok(friction);
        }
        let remedy = "give a friction coefficient, zero or greater";
        Err(CommandError::option("friction", friction, remedy))
    }
}

/// More threads than any machine uses.
const MOST_THREADS: usize = 1024;

/// Use this many threads; none: all cores. It must be told before anything is computed: the first
/// parallel work of a process starts its threads for good.
pub fn threads(jobs: Option<usize>) -> Result<(), CommandError> {
    let Some(n) = jobs else { return Ok(()) };
    if n == 0 {
        let remedy = "give at least one thread, or leave it out for one a core";
        return Err(CommandError::option("jobs", n, remedy));
    }
    if n > MOST_THREADS {
        return Err(CommandError::option("jobs", n, "give at most 1024 threads"));
    }
    let remedy = match n {
        1 => "this machine cannot start another thread: end other programs",
        _ => "this machine does not start so many threads: give fewer",
    };
    let built = rayon::ThreadPoolBuilder::new().num_threads(n).build_global();
    built.map_err(|_| CommandError::option("jobs", n, remedy))
}

/// Whether a history can be this long (s).
pub fn duration(given: Option<f64>) -> Result<(), CommandError> {
    match given {
        Some(d) if !(d > 0.0 && d <= LONGEST_S) => {
            let remedy = "give seconds greater than zero, at most 1e6";
            Err(CommandError::option("duration", d, remedy))
        }
        _ => Ok(()),
    }
}

/// A velocity restitution from the command line, checked.
pub fn restitution(given: Option<f64>) -> Result<Option<f64>, CommandError> {
    match given {
        Some(e) if !(0.0..=1.0).contains(&e) => {
            Err(CommandError::option("restitution", e, "a velocity ratio lies between 0 and 1"))
        }
        given => Ok(given),
    }
}
