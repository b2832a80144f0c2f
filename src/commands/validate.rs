//! `tune validate`: springs judged over many records, from files and made from a seed.

mod tables;

use std::{io::Write, path::PathBuf};

use clap::Args;
use rayon::prelude::*;
use serde::Serialize;

use super::{CommandError, draw::subtitle, output::check_folder, progress::Progress, run::threads, write_file};
use crate::{
    case::LONGEST_S,
    conditioning::ILL_CONDITIONED,
    fem, figures,
    parameters::Parameters,
    record::{Notice, ReadOptions, Record, RecordError, Recording, Units},
    spring::ChainRow,
    structure::Structure,
    synthetic,
    validate::{Judge, Validation},
};

/// Options of `tune validate`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("source").required(true).multiple(true).args(["records", "synthetic", "earthquakes"]))]
#[command(group = clap::ArgGroup::new("made").multiple(true).args(["synthetic", "earthquakes"]))]
pub struct Options {
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    /// Folder of records: any mix of formats, see tune record
    #[arg(long, value_name = "DIR")]
    records: Option<PathBuf>,
    /// Time step, where the files do not say
    #[arg(long, value_name = "SECONDS", requires = "records", allow_negative_numbers = true)]
    dt: Option<f64>,
    /// g, m/s2, cm/s2 or mm/s2, where the files do not say
    #[arg(long, requires = "records")]
    units: Option<Units>,
    /// Factor on the acceleration of the files
    #[arg(long, value_name = "FACTOR", requires = "records", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// This many records made for the structure: Ricker and Mavroeidis-Papageorgiou pulses, filtered noise
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    synthetic: Option<u32>,
    /// This many records like earthquakes, whatever the structure: filtered noise of soils of 9 to 36 rad/s, 0.2 to 0.9
    /// g, 20 to 60 s
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    earthquakes: Option<u32>,
    /// Seed of the records made
    #[arg(long, requires = "made", default_value_t = 1)]
    seed: u64,
    /// Length of each history [default: the whole record]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Velocity restitution of Housner's solution; that of the parameters, or by equation 2, unless given
    #[arg(long, allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// No figure
    #[arg(long)]
    no_figures: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

/// Where the records come from: files first, in the order of their names, then those made from the seed, earthquakes last.
struct Source {
    files: Vec<PathBuf>,
    read: ReadOptions,
    scale: Option<f64>,
    synthetic: usize,
    earthquakes: usize,
    seed: u64,
    /// sqrt(m g R/I0) of the structure [1/s].
    p: f64,
    /// Lean of balance [rad].
    alpha: f64,
}

impl Source {
    fn len(&self) -> usize {
        self.files.len() + self.synthetic + self.earthquakes
    }

    fn record(&self, i: usize) -> Result<Record, RecordError> {
        let Some(file) = self.files.get(i) else {
            let i = i - self.files.len();
            return Ok(match i.checked_sub(self.synthetic) {
                None => synthetic::record(self.seed, i, self.p, self.alpha),
                Some(i) => synthetic::earthquake(self.seed, i, self.p),
            });
        };
        let record = Record::read(file, &self.read)?;
        match self.scale {
            Some(scale) => record.scaled(scale),
            None => Ok(record),
        }
    }

    /// Read every file, keep none: a bad one ends the job before it begins. What the readers say of the others.
    fn check(&self) -> Result<Vec<Notice>, RecordError> {
        let read = |file: &PathBuf| {
            let recording = Recording::read(file, &self.read)?;
            let notices = recording.notices();
            if let Some(scale) = self.scale {
                recording.into_record().scaled(scale)?;
            }
            Ok(notices)
        };
        let notices: Vec<Result<Vec<Notice>, RecordError>> = self.files.par_iter().map(read).collect();
        Ok(notices.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
    }
}

/// The records made from a seed.
#[derive(Serialize)]
struct Made {
    count: usize,
    seed: u64,
}

/// `validate.json`.
#[derive(Serialize)]
struct Report<'a> {
    structure: Structure,
    restitution: f64,
    vertical: ChainRow,
    horizontal: ChainRow,
    #[serde(skip_serializing_if = "Option::is_none")]
    synthetic: Option<Made>,
    #[serde(skip_serializing_if = "Option::is_none")]
    earthquakes: Option<Made>,
    #[serde(flatten)]
    validation: &'a Validation,
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    let parameters = Parameters::read(&o.parameters)?;
    let body = parameters.structure.body::<f64>();
    let restitution = o.restitution.unwrap_or_else(|| parameters.restitution());
    if !(0.0..=1.0).contains(&restitution) {
        let remedy = "a velocity ratio lies between 0 and 1";
        return Err(CommandError::Option { option: "restitution", value: format!("{restitution:?}"), remedy });
    }
    if let Some(duration) = o.duration
        && !(duration > 0.0 && duration <= LONGEST_S)
    {
        let remedy = "give seconds greater than zero, at most 1e6";
        return Err(CommandError::Option { option: "duration", value: format!("{duration:?}"), remedy });
    }
    check_folder(&o.out)?;
    threads(o.jobs)?;
    let source = Source {
        files: o.records.as_deref().map_or(Ok(Vec::new()), Record::list_dir)?,
        read: ReadOptions { dt: o.dt, units: o.units, ..ReadOptions::default() },
        scale: o.scale,
        synthetic: o.synthetic.unwrap_or(0) as usize,
        earthquakes: o.earthquakes.unwrap_or(0) as usize,
        seed: o.seed,
        p: body.p_squared().sqrt(),
        alpha: body.alpha(),
    };
    source.check()?.iter().for_each(|notice| eprintln!("{notice}"));
    let judge = Judge {
        body,
        restitution,
        springs: parameters.chains(),
        duration_s: o.duration,
        control: fem::Control::default(),
    };
    let progress = Progress::new("records", o.quiet);
    let validation = judge.judge_all(source.len(), |i| source.record(i), |n| progress.tell(n, source.len(), ""))?;
    progress.done();

    let report = Report {
        structure: parameters.structure,
        restitution,
        vertical: parameters.vertical,
        horizontal: parameters.horizontal,
        synthetic: o.synthetic.map(|_| Made { count: source.synthetic, seed: source.seed }),
        earthquakes: o.earthquakes.map(|_| Made { count: source.earthquakes, seed: source.seed }),
        validation: &validation,
    };
    let mut json = serde_json::to_string_pretty(&report).map_err(|e| CommandError::Result(e.to_string()))?;
    json.push('\n');
    std::fs::create_dir_all(&o.out)
        .map_err(|source| CommandError::Write { path: o.out.display().to_string(), source })?;
    write_file(&o.out.join("validate.json"), json.as_bytes())?;
    write_file(&o.out.join("validate.md"), tables::markdown(&validation).as_bytes())?;
    write_file(&o.out.join("validate.csv"), &tables::csv(&validation)?)?;
    if !o.no_figures {
        draw(o, &parameters, &validation)?;
    }
    writeln!(std::io::stdout(), "{}", tables::terminal(&validation))?;
    for name in &validation.all.failed {
        eprintln!("failed: {name}; see its outcome in {}", o.out.join("validate.csv").display());
    }
    eprintln!("written to {}", o.out.display());
    Ok(())
}

fn draw(o: &Options, parameters: &Parameters, validation: &Validation) -> Result<(), CommandError> {
    let rows: Vec<figures::validation::Row> = validation
        .records
        .iter()
        .map(|row| figures::validation::Row {
            peak_housner: row.peak_ratio_housner,
            peak_fem: row.peak_ratio_fem.unwrap_or(f64::INFINITY),
            overturned_housner: row.overturned_housner,
            overturned_fem: row.overturned_fem.unwrap_or(false),
            sensitivity: row.sensitivity,
            // no body lifted, no error; a failure stands at the upper edge
            nrmse: row.nrmse_horizontal.unwrap_or(if row.failed() { f64::INFINITY } else { 0.0 }),
        })
        .collect();
    let of = subtitle(&parameters.structure, &format!("{} records", rows.len()), parameters.vertical.omega_n_hz);
    figures::validation::draw(&figures::validation::Validation {
        title: &format!("Finite elements on ground springs against Housner\n{of}"),
        rows: &rows,
        ks_distance: validation.all.ks_distance,
        well_conditioned: ILL_CONDITIONED,
    })?
    .save(&o.out.join("validation.png"))?;
    Ok(())
}
