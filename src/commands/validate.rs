//! `tune validate`: springs judged over many records, from files and made from a seed.

mod model;
mod tables;

use std::{
    collections::HashSet,
    path::{Path, PathBuf},
};

use clap::Args;
use serde::Serialize;

use self::model::{JudgedProgram, JudgedSprings};
use super::{CommandError, common, progress::Progress, terminal};
use decks::Stepping;
use dynamics::spring::ChainRow;
use files::message::{one_line, significant};
use parameters::Parameters;
use rocking::{conditioning::ILL_CONDITIONED, structure::Structure, synthetic};
use run_folder::{
    folder::Folder, folder::identity, folder::of_one_run, pictures::subtitle, place::check_folder,
    place::write_file,
};
use strong_motion::{
    Notice, ReadOptions, Record, RecordError, Recording, Units,
    excitation::{Excitation, VerticalLeftOut},
};
use validation::{Validation, Validator};

/// Options of `tune validate`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("source").required(true).multiple(true)
    .args(["paths", "records", "synthetic", "earthquakes"]))]
#[command(group = clap::ArgGroup::new("given").multiple(true).args(["paths", "records"]))]
#[command(group = clap::ArgGroup::new("made").multiple(true).args(["synthetic", "earthquakes"]))]
pub struct ValidateOptions {
    /// Record files, and folders of them: any mix of formats, see tune record
    #[arg(value_name = "RECORDS")]
    paths: Vec<PathBuf>,
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    /// Folder of records, the same as naming it without an option
    #[arg(long, value_name = "DIR")]
    records: Option<PathBuf>,
    /// Time step, where the files do not say
    #[arg(long, value_name = "SECONDS", requires = "given", allow_negative_numbers = true)]
    dt: Option<f64>,
    /// g, m/s2, cm/s2, mm/s2, mg, %g, ft/s2, in/s2 or mGal, where the files do not say
    #[arg(long, requires = "given")]
    units: Option<Units>,
    /// Component, by name or by azimuth in degrees, of files with several [default: the stronger
    /// horizontal one of each]
    #[arg(long, value_name = "NAME", requires = "given", allow_hyphen_values = true)]
    component: Option<String>,
    /// Factor on the acceleration of the files
    #[arg(long, value_name = "FACTOR", requires = "given", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// This many records made for the structure: Ricker and Mavroeidis-Papageorgiou pulses,
    /// filtered noise
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    synthetic: Option<u32>,
    /// This many records like earthquakes, whatever the structure: filtered noise of soils of 9 to
    /// 36 rad/s, 0.2 to 0.9 g, 20 to 60 s
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    earthquakes: Option<u32>,
    /// Seed of the records made
    #[arg(long, requires = "made", default_value_t = 1)]
    seed: u64,
    /// Length of each history [default: the whole record]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Velocity after an impact over that before, of Housner's body; that of the parameters, or by
    /// equation 2, unless given
    #[arg(long, allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// events: the springs for steps that follow touches; even, touches: those for the program of
    /// `tune run`, in an emulation of its steps, as `tune export` names them
    #[arg(long, value_name = "HOW", default_value = "events")]
    stepping: Stepping,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
    /// No figure
    #[arg(long)]
    no_figures: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

/// What there is to say of a file: its notices, its vertical motion.
type FileTold = (Vec<Notice>, Option<VerticalLeftOut>);

/// Where the records come from: files first, in the order of their names, then those made from the
/// seed, earthquakes last.
struct RecordsSource {
    files: Vec<PathBuf>,
    read: ReadOptions,
    scale: Option<f64>,
    synthetic: usize,
    earthquakes: usize,
    seed: u64,
    /// sqrt(m g R/I0) of the structure (1/s).
    p: f64,
    /// Slenderness angle alpha (rad).
    alpha: f64,
}

impl RecordsSource {
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

    /// Read every file, keep none. One that cannot be read is left out, and said; what the readers
    /// say of the others is printed.
    fn check(&mut self) -> Vec<Unread> {
        let read = |file: &PathBuf| {
            let recording = Recording::read(file, &self.read)?;
            let notices = recording.notices();
            let scale = self.scale.unwrap_or(1.0);
            let record = recording.into_record();
            record.scaled(scale)?;
            let left_out = Excitation { scale, ..Excitation::whole(record) }.vertical_left_out();
            Ok((notices, left_out))
        };
        let all: Vec<Result<FileTold, RecordError>> = parallel::map(&self.files, read);
        let (mut unread, mut vertical) = (Vec::new(), Vec::new());
        let files = std::mem::take(&mut self.files);
        for (file, found) in files.into_iter().zip(all) {
            match found {
                Ok((notices, left_out)) => {
                    notices.iter().for_each(terminal::stderr);
                    vertical.extend(left_out.map(|left_out| (file.clone(), left_out)));
                    self.files.push(file);
                }
                Err(error) => {
                    let reason = one_line(&error.to_string());
                    unread.push(Unread { file: file.display().to_string(), reason });
                }
            }
        }
        // of one file alone, the error says it
        if self.len() > 0 || unread.len() > 1 {
            unread.iter().for_each(|unread: &Unread| {
                terminal::stderr(format_args!("left out: {}", unread.reason));
            });
        }
        tell_vertical(&vertical);
        unread
    }

    /// What is judged, in words.
    fn line(&self, unread: usize) -> String {
        let mut parts = Vec::new();
        if !self.files.is_empty() || unread > 0 {
            let left_out = if unread > 0 { format!(" ({unread} left out)") } else { String::new() };
            parts.push(format!("{} from files{left_out}", self.files.len()));
        }
        if self.synthetic > 0 {
            parts.push(format!("{} synthetic of seed {}", self.synthetic, self.seed));
        }
        if self.earthquakes > 0 {
            parts.push(format!("{} earthquake-like of seed {}", self.earthquakes, self.seed));
        }
        format!("records: {}", parts.join(", "))
    }
}

/// Say of the vertical components of files that they are left out: how many, and the one that is
/// largest beside its horizontal motion.
fn tell_vertical(all: &[(PathBuf, VerticalLeftOut)]) {
    let share = |left_out: &VerticalLeftOut| left_out.peak_g / left_out.horizontal_g;
    let most = all.iter().max_by(|(_, a), (_, b)| share(a).total_cmp(&share(b)));
    let Some((file, most)) = most else { return };
    terminal::stderr(format_args!(
        "vertical motions are left out, here in {} {}: {} has {} g beside {} g across{}",
        all.len(),
        if all.len() == 1 { "file" } else { "files" },
        one_line(&file.display().to_string()),
        significant(most.peak_g, 4),
        significant(most.horizontal_g, 4),
        if all.len() == 1 { "" } else { ", the largest share" },
    ));
}

/// Every record file that was named, once, those of folders in the order of their names.
fn files(o: &ValidateOptions) -> Result<Vec<PathBuf>, RecordError> {
    let (mut files, mut seen) = (Vec::new(), HashSet::new());
    for path in o.paths.iter().chain(&o.records) {
        let named = if path.is_dir() || Some(path) == o.records.as_ref() {
            Record::list_dir(path)?
        } else {
            vec![path.clone()]
        };
        files.extend(named.into_iter().filter(|file| seen.insert(file.clone())));
    }
    Ok(files)
}

/// A file that is no record.
#[derive(Serialize)]
struct Unread {
    file: String,
    reason: String,
}

/// The records made from a seed.
#[derive(Serialize)]
struct Made {
    count: usize,
    seed: u64,
}

/// `validate.json`.
#[derive(Serialize)]
struct ValidationReport<'a> {
    structure: Structure,
    restitution: f64,
    /// Of a program with steps of one size.
    #[serde(skip_serializing_if = "Option::is_none")]
    program: Option<&'a JudgedProgram>,
    vertical: ChainRow,
    horizontal: ChainRow,
    #[serde(skip_serializing_if = "Option::is_none")]
    synthetic: Option<Made>,
    #[serde(skip_serializing_if = "Option::is_none")]
    earthquakes: Option<Made>,
    /// Files that could not be read.
    #[serde(skip_serializing_if = "<[Unread]>::is_empty")]
    left_out: &'a [Unread],
    #[serde(flatten)]
    validation: &'a Validation,
}

/// All that `tune validate` can write into its folder.
const FILES: &[&str] =
    &["validate.json", "validate.md", "validate.csv", "validation.png", "validation.svg"];

pub fn run(o: &ValidateOptions) -> Result<(), CommandError> {
    of_one_run(&o.parameters)?;
    let judged = JudgedSprings::new(Parameters::read(&o.parameters)?, o.stepping)?;
    let parameters = &judged.parameters;
    let body = parameters.structure.body::<f64>();
    let restitution =
        common::restitution(o.restitution)?.unwrap_or_else(|| parameters.restitution());
    common::duration(o.duration)?;
    check_folder(&o.out)?;
    let mut source = RecordsSource {
        files: files(o)?,
        read: ReadOptions {
            dt: o.dt,
            units: o.units,
            component: o.component.clone(),
            ..ReadOptions::default()
        },
        scale: o.scale,
        synthetic: o.synthetic.unwrap_or(0) as usize,
        earthquakes: o.earthquakes.unwrap_or(0) as usize,
        seed: o.seed,
        p: body.p(),
        alpha: body.alpha(),
    };
    let left_out = source.check();
    if source.len() == 0 {
        let first = left_out.first().map_or("", |unread| &unread.reason);
        return Err(CommandError::Result(format!(
            "no file could be read, of {}; the first: {first}",
            left_out.len()
        )));
    }
    let records = source.line(left_out.len());
    let line = judged.steps.iter().fold(records, |line, steps| format!("{line}; {steps}"));
    judged.tell();
    let judge = Validator { body, restitution, duration_s: o.duration, model: judged.model };
    let progress = Progress::new("records", o.quiet);
    let validation = judge.judge_all(
        source.len(),
        |i| source.record(i),
        |n| progress.tell(n, source.len(), ""),
    )?;
    progress.done();

    let report = ValidationReport {
        structure: parameters.structure,
        restitution,
        program: judged.program.as_ref(),
        vertical: parameters.vertical,
        horizontal: parameters.horizontal,
        synthetic: o.synthetic.map(|_| Made { count: source.synthetic, seed: source.seed }),
        earthquakes: o.earthquakes.map(|_| Made { count: source.earthquakes, seed: source.seed }),
        left_out: &left_out,
        validation: &validation,
    };
    let mut json = serde_json::to_string_pretty(&report).map_err(CommandError::result)?;
    json.push('\n');
    let folder = Folder::begin(&o.out, "validate", FILES, identity(&[&json, &o.no_figures]))?;
    write_file(&folder.path().join("validate.json"), json.as_bytes())?;
    write_file(
        &folder.path().join("validate.md"),
        tables::markdown(&validation, &line).as_bytes(),
    )?;
    write_file(&folder.path().join("validate.csv"), &tables::csv(&validation)?)?;
    if !o.no_figures {
        draw(folder.path(), &judged, &validation)?;
    }
    folder.finish()?;
    terminal::stdout(format_args!("{line}\n{}\n", tables::terminal(&validation)))?;
    for name in &validation.all.failed {
        terminal::stderr(format_args!(
            "failed: {name}; see its outcome in {}",
            terminal::shown(&o.out.join("validate.csv"))
        ));
    }
    terminal::written(&o.out);
    Ok(())
}

fn draw(out: &Path, judged: &JudgedSprings, validation: &Validation) -> Result<(), CommandError> {
    let parameters = &judged.parameters;
    let rows: Vec<figures::validation::ValidationPoint> = validation
        .records
        .iter()
        .map(|row| figures::validation::ValidationPoint {
            peak_housner: row.peak_ratio_housner,
            peak_fem: row.peak_ratio_fem.unwrap_or(f64::INFINITY),
            overturned_housner: row.overturned_housner,
            overturned_fem: row.overturned_fem.unwrap_or(false),
            sensitivity: row.sensitivity,
            // no body lifted, no error; a failure stands at the upper edge
            nrmse: row.nrmse_horizontal.unwrap_or(if row.failed() { f64::INFINITY } else { 0.0 }),
        })
        .collect();
    let of = subtitle(
        &parameters.structure,
        &format!("{} record{}", rows.len(), if rows.len() == 1 { "" } else { "s" }),
        parameters.vertical.omega_n_hz,
    );
    let steps = judged.steps.as_ref().map_or(String::new(), |steps| format!("\n{steps}"));
    figures::validation::draw(&figures::validation::ValidationFigure {
        title: &format!("Finite elements on ground springs against Housner\n{of}{steps}"),
        rows: &rows,
        ks_distance: validation.all.ks_distance,
        well_conditioned: ILL_CONDITIONED,
    })?
    .save(&out.join("validation.png"))?;
    Ok(())
}
