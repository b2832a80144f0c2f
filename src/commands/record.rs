//! `tune record`: what is in record files, and what a run would take of them.

mod row;

use std::path::{Path, PathBuf};

use clap::{Arg, Args};
use serde::Serialize;

use super::{
    CommandError,
    common::{ReadingOptions, again},
    terminal,
};
use cases::{
    Case, LONGEST_S,
    doubts::{Doubt, of_excitation},
};
use files::message::printable;
use rocking::{scalar::GRAVITY, structure::Body};
use row::ComponentRow;
use run_folder::FolderError;
use run_folder::place::check_folder;
use strong_motion::{Notice, ReadOptions, Record, RecordFormat, Recording, excitation::of_record};

/// Options of `tune record`.
#[derive(Debug, Args)]
#[command(mut_args(of_several_files))]
pub struct RecordFileOptions {
    /// Record files of any format; that of the case unless given
    #[arg(required_unless_present = "case", value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Case file: the structure to measure the records on, and the record where none is named
    #[arg(long, value_name = "case.toml")]
    case: Option<PathBuf>,
    /// JSON on stdout instead of tables
    #[arg(long)]
    json: bool,
    /// Folder for a figure of each record: acceleration and velocity
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// The help of options that other commands have for one file.
fn of_several_files(option: Arg) -> Arg {
    let help = match option.get_id().as_str() {
        "dt" => "Time step, where the files do not say",
        "units" => {
            "g, m/s2, cm/s2, mm/s2, mg, %g, ft/s2, in/s2 or mGal, where the files do not say"
        }
        "component" => {
            "Component to take, by name or by azimuth in degrees [default: the stronger \
             horizontal one]"
        }
        _ => return option,
    };
    option.help(help)
}

/// One file.
#[derive(Serialize)]
struct FileReport {
    file: String,
    format: RecordFormat,
    station: Option<String>,
    components: Vec<ComponentRow>,
    run: RunInputs,
    notices: Vec<String>,
}

/// What `tune run` would take.
#[derive(Serialize)]
struct RunInputs {
    /// Name of the record.
    record: String,
    /// Length taken unless another is asked for.
    duration_s: f64,
    #[serde(skip)]
    is_cut: bool,
    /// Peak acceleration within that length.
    pga_g: f64,
    /// Time of the record's peak from its first sample, as histories count it.
    pga_time_s: f64,
}

pub fn run(o: &RecordFileOptions) -> Result<(), CommandError> {
    let own = if o.files.is_empty() { o.reading.asked() } else { ReadOptions::default() };
    let case = o.case.as_deref().map(|path| Case::read_asking(path, &own)).transpose()?;
    let body = case.as_ref().map(|case| case.structure.body::<f64>());
    // a case's length is that of its own record: another one is taken whole
    let own = case.as_ref().filter(|_| o.files.is_empty());
    let duration = own.and_then(|case| case.excitation.duration_s).unwrap_or(LONGEST_S);
    if let Some(folder) = &o.out {
        check_folder(folder)?;
    }
    let (mut reports, mut bad) = (Vec::new(), Vec::new());
    for (file, options) in &named(o, case.as_ref())? {
        match Recording::read(file, options) {
            Ok(recording) => {
                if let Some(folder) = &o.out {
                    draw(folder, file, &recording, body.as_ref())?;
                }
                reports.push(FileReport::new(file, &recording, body.as_ref(), duration));
            }
            Err(error) => bad.push(error),
        }
    }
    if let ([only], []) = (&bad[..], &reports[..]) {
        return Err(only.clone().into());
    }
    if o.json {
        terminal::json(&reports)?;
    } else {
        let texts: Vec<String> = reports.iter().map(FileReport::text).collect();
        terminal::stdout(texts.join("\n"))?;
    }
    for notice in reports.iter().flat_map(|report| &report.notices) {
        terminal::stderr(notice);
    }
    for error in &bad {
        terminal::stderr(format_args!("error: {error}"));
    }
    match bad.len() {
        0 => Ok(()),
        n => Err(CommandError::Result(format!("{n} of {} files could not be read", o.files.len()))),
    }
}

/// The files that were named and how to read them; with none named, that of the case, as the case
/// says unless an option does.
fn named(
    o: &RecordFileOptions,
    case: Option<&Case>,
) -> Result<Vec<(PathBuf, ReadOptions)>, CommandError> {
    let asked = o.reading.asked();
    let Some(case) = case.filter(|_| o.files.is_empty()) else {
        return Ok(o.files.iter().map(|file| (file.clone(), asked.clone())).collect());
    };
    let read = again(asked, &case.excitation.record).ok_or_else(|| {
        CommandError::Result(
            "the case names no record file, and so stands for El Centro, which is part of the \
             program; name a file to look at"
                .into(),
        )
    })?;
    Ok(vec![read])
}

/// What a run would say of the peak of the part that it takes.
fn of_peak(record: &Record, duration_s: f64) -> impl Iterator<Item = Doubt> {
    let excitation = of_record(record.clone(), 1.0, Some(duration_s));
    let of_its_peak =
        |doubt: &Doubt| matches!(doubt, Doubt::WeakMotion { .. } | Doubt::StrongMotion { .. });
    of_excitation(&excitation).into_iter().filter(of_its_peak)
}

impl FileReport {
    fn new(file: &Path, recording: &Recording, body: Option<&Body<f64>>, duration_s: f64) -> Self {
        let taken = recording.component();
        let peak = taken.record.measures().pga;
        // what is said of the other components belongs here, too
        let mut notices = recording.notices();
        for (i, component) in recording.components.iter().enumerate() {
            if i != recording.taken {
                notices.extend(component.notices(&file.display().to_string()));
            }
        }
        let shown = file.display().to_string();
        let of_a_peak =
            |notice: &Notice| matches!(notice, Notice::Weak { .. } | Notice::Strong { .. });
        let told = notices.iter().any(of_a_peak);
        let mut notices: Vec<String> = notices.iter().map(ToString::to_string).collect();
        let doubts = of_peak(&taken.record, duration_s).filter(|_| !told);
        notices.extend(doubts.map(|doubt| format!("{shown}: {doubt}")));
        Self {
            file: shown,
            format: recording.format,
            station: recording.station.clone(),
            components: (0..recording.components.len())
                .map(|i| ComponentRow::new(recording, i, body))
                .collect(),
            run: RunInputs {
                record: taken.record.name.clone(),
                duration_s: duration_s.min(taken.record.duration()),
                is_cut: duration_s < LONGEST_S,
                pga_g: taken.record.truncated(duration_s).pga_g(),
                pga_time_s: peak.time.unwrap_or(0.0),
            },
            notices,
        }
    }

    /// A heading, a row a component, what a run takes.
    fn text(&self) -> String {
        let station = self.station.as_ref().map_or(String::new(), |station| format!(", {station}"));
        let on_structure = self.components.iter().any(|row| row.structure.is_some());
        let mut table = terminal::table(row::head(on_structure));
        table.add_rows(self.components.iter().map(ComponentRow::cells));
        let run = &self.run;
        let mut text = format!(
            "{}: {}{station}\n\n{table}\n\n\
             tune run takes {}, {} unless --duration says otherwise: ",
            printable(&self.file),
            self.format,
            run.record,
            if run.is_cut { format!("its first {} s", run.duration_s) } else { "all of it".into() }
        );
        let whole = self.components.iter().find(|row| row.taken).map_or(0.0, |row| row.pga_g.abs());
        if run.pga_g < whole {
            text.push_str(&format!(
                "the peak comes later, {:.2} s after the first sample ({:.4} g before): give a \
                 longer one\n",
                run.pga_time_s, run.pga_g
            ));
        } else {
            text.push_str(&format!(
                "the peak comes {:.2} s after the first sample\n",
                run.pga_time_s
            ));
        }
        if let Some(row) = self.components.iter().find(|row| row.start_s != 0.0) {
            let start = row.start_s;
            text.push_str(&format!(
                "times are those of the file's header, on which the first sample is at {start} s\n"
            ));
        }
        text
    }
}

/// The figure of the component that a run takes.
fn draw(
    folder: &Path,
    file: &Path,
    recording: &Recording,
    body: Option<&Body<f64>>,
) -> Result<(), CommandError> {
    let row = ComponentRow::new(recording, recording.taken, body);
    let record = &recording.component().record;
    let t: Vec<f64> = (0..record.len()).map(|i| i as f64 * record.dt).collect();
    let accel: Vec<f64> = record.accel.iter().map(|a| a / GRAVITY).collect();
    let mut notes = vec![format!(
        "PGA {:.3} g, PGV {:.3} m/s, pulse period {:.2} s",
        row.pga_g.abs(),
        row.pgv_m_per_s.abs(),
        row.pulse_period_s
    )];
    if let Some(on) = &row.structure {
        notes.push(format!(
            "PGA/(g tan α) = {:.2}, p PGV/(g tan α) = {:.3}, ω/p of the pulse {:.2}",
            on.pga_over_g_tan_alpha, on.p_pgv_over_g_tan_alpha, on.pulse_omega_over_p
        ));
    }
    std::fs::create_dir_all(folder)
        .map_err(|source| FolderError::Write { path: folder.display().to_string(), source })?;
    let stem = file.file_stem().unwrap_or(file.as_os_str());
    let mut name = stem.to_os_string();
    name.push(".png");
    figures::record::draw(&figures::record::RecordFigure {
        title: &record.name,
        t: &t,
        accel_g: &accel,
        velocity: &record.velocity(),
        uplift_g: body.map(|body| body.alpha().tan()),
        notes: &notes,
    })?
    .save(&folder.join(name))?;
    Ok(())
}
