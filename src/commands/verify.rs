//! `tune verify`: the deck run in OpenSees, beside our own history and Housner's.

mod elastic;
mod notes;

use std::{
    fmt::{Debug, Write as _},
    path::{Path, PathBuf},
};

use clap::Args;
use comfy_table::Table;

use super::{
    CommandError,
    common::RecordOptions,
    export::{check_accuracy, predictable_to, read},
    progress::Progress,
    terminal,
};
use decks::{
    ACCURACY,
    verify::{ComparedPeak, LIMIT, Program, Slip, Verification, verify},
};
use figures::{
    brief,
    history::{self, HistoryFigure, Trace},
};
use files::message::percent;
use parameters::{Parameters, elastic::ElasticParameters, predictability::ForetoldEnd};
use rocking::{members::slides, motion::Motion};
use run_folder::{
    folder::Folder, folder::identity, folder::of_one_run, pictures::subtitle, place::check_folder,
    place::write_file, tables::csv_row,
};
use strong_motion::{Record, excitation::Excitation};

/// Options of `tune verify`.
#[derive(Debug, Args)]
pub struct VerifyOptions {
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    /// Python interpreter that has openseespy
    #[arg(long, value_name = "PATH", default_value = "python3")]
    python: PathBuf,
    /// Run the Tcl deck instead, with this command, for example "OpenSees" or "python3 -m opensees"
    #[arg(long, value_name = "COMMAND", conflicts_with = "python")]
    tcl: Option<String>,
    /// Accuracy of OpenSees' history (normalised error) that its steps are to have
    #[arg(long, default_value_t = ACCURACY)]
    accuracy: f64,
    #[command(flatten)]
    record: RecordOptions,
    /// Folder for verify.png, verify.svg and verify.csv
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

pub fn run(o: &VerifyOptions) -> Result<(), CommandError> {
    let program = match &o.tcl {
        Some(command) => Program::Tcl(command.split_whitespace().map(str::to_string).collect()),
        None => Program::Python(o.python.clone()),
    };
    of_one_run(&o.parameters)?;
    if let Some(parameters) = ElasticParameters::read(&o.parameters)? {
        return elastic::run(o, &parameters, &program);
    }
    let (parameters, record, excitation) = read(&o.parameters, &o.record)?;
    check_folder(&o.out)?;
    check_accuracy(o.accuracy)?;
    let body = parameters.structure.body::<f64>();
    if !o.quiet && parameters.members().friction.is_some_and(|friction| slides(&friction, &body)) {
        terminal::stderr(
            "feet slip on this friction: OpenSees takes some hundred thousand steps, a minute or \
                more, where a body that rocks takes seconds",
        );
    }
    let progress = Progress::new("OpenSees [s]", o.quiet);
    let until = predictable_to(&o.record, &parameters, &record);
    let result = verify(&parameters, &record, (o.accuracy, until), &program, &|done, all| {
        progress.tell(done, all, "")
    });
    progress.done();
    let result = result?;

    let folder = Folder::begin(&o.out, "verify", FILES, of(&parameters, &record, o.accuracy))?;
    write_file(&folder.path().join("verify.csv"), csv(&result).as_bytes())?;
    draw(folder.path(), &parameters, &excitation, &result)?;
    folder.finish()?;
    terminal::stdout(format_args!("{}", said(&excitation, &record, &result)))?;
    terminal::stderr(excitation.line());
    terminal::written(&o.out);
    if result.verdict.within { Ok(()) } else { Err(CommandError::Failed(refusal(&result))) }
}

/// All that a verification writes.
const FILES: &[&str] = &["verify.csv", "verify.png", "verify.svg"];

/// The identity of a verification.
fn of(parameters: &dyn Debug, record: &Record, accuracy: f64) -> String {
    let up = record.vertical.as_ref().map(|up| up.as_record(record.dt).fingerprint());
    identity(&[parameters, &record.fingerprint(), &up, &accuracy])
}

/// Peaks first, then histories, then how often it swung, for a terminal.
fn said(excitation: &Excitation, record: &Record, result: &Verification) -> String {
    let last = (result.ours.len() - 1) as f64 * result.dt;
    let peaks = peaks_table(&title(excitation, record, last), &result.peaks);
    let mut errors = terminal::table(["error of the history (NRMSE)", "u", "v", "theta"]);
    let housner = notes::counted(&result.housner, &result.reach);
    let least = |k: usize| result.peaks.get(k).map_or(0.0, |peak| peak.least);
    for (name, a, of) in [
        ("OpenSees against tune simulate", result.opensees_against_ours, &result.ours),
        ("OpenSees against Housner", result.opensees_against_housner, &housner),
        ("tune simulate against Housner", result.ours_against_housner, &housner),
    ] {
        errors.add_row([
            name.to_string(),
            notes::error(a.u, &of.u, least(0)),
            notes::error(a.v, &of.v, least(2)),
            notes::error(a.theta, &of.theta, least(3)),
        ]);
    }
    let [ours, opensees] = result.swings;
    let mut out = format!("{peaks}\n\n{errors}\n\n");
    // writing to a String does not fail
    let _ =
        writeln!(out, "swings from foot to foot: {ours} of tune simulate, {opensees} of OpenSees");
    let _ = writeln!(out, "OpenSees took {:.1} s and {} steps", result.seconds, result.steps);
    out + &notes::notes(&result.reach, result.dt) + &judged(result)
}

/// A record and its scale.
fn scaled(excitation: &Excitation) -> String {
    format!("{} × {}", excitation.record.name, brief(excitation.scale, 4))
}

/// What is compared, and over how much of the record.
fn title(excitation: &Excitation, record: &Record, seconds: f64) -> String {
    let (name, all) = (scaled(excitation), record.duration());
    let last = (seconds * 1e6).round() / 1e6;
    if last + 0.5 * record.dt < all {
        format!("{name}, first {last:.2} s of {all:.2} s")
    } else {
        format!("{name}, all {all:.2} s")
    }
}

/// Note beside the error of a body that hardly moves: what the error is relative to.
const OF_SIZE: &str = ", over a thousandth of half the width, since the body hardly moves";

/// What a verification says nothing of.
const FORCES: &str =
    "displacements are judged; forces are checked by tune run, on other springs and meshes\n";

/// Peaks of our own history, of OpenSees', and the difference.
fn peaks_table(title: &str, peaks: &[ComparedPeak]) -> Table {
    let mut table = terminal::table([title, "tune", "OpenSees", "difference"]);
    for peak in peaks {
        let unit = if peak.unit == "m" { "mm" } else { "mrad" };
        let difference =
            peak.difference_percent().map_or("-".into(), |share| percent(1e-2 * share));
        let number = |x: f64| format!("{:.3}", x * 1e3);
        let name = format!("peak {} [{unit}]", peak.quantity);
        table.add_row([name, number(peak.ours), number(peak.opensees), difference]);
    }
    table
}

/// What is judged, and how it came out.
fn judged(result: &Verification) -> String {
    let verdict = &result.verdict;
    let (agrees, whether) =
        if verdict.within { ("AGREES", "within") } else { ("DOES NOT AGREE", "NOT within") };
    let agrees = match &verdict.slip {
        // near the largest slip, and far from where the body ends
        Some(slip) if verdict.within && slip.error_of_last() > Slip::LIMIT => "AGREES IN PART",
        _ => agrees,
    };
    let agrees = agrees.to_string() + &notes::up_to(verdict.samples, &result.reach, result.dt);
    let mut out = String::new();
    let until = verdict.until.unwrap_or_default();
    let _ = match verdict.end {
        None => Ok(()),
        Some(ForetoldEnd::Width) => writeln!(
            out,
            "judged up to {until:.2} s: from then on the history hangs on the fifth digit of the \
                width,\na change by 1e-5 moves the whole of it by {:.1e}, and no two programs \
                agree",
            result.width_sensitivity
        ),
        Some(ForetoldEnd::Flight) => writeln!(
            out,
            "judged up to {until:.2} s: then the ground falls faster than the body, which has no \
                rotational inertia\nof its own: how it turns in the air is not defined"
        ),
        Some(ForetoldEnd::IllConditioned) => writeln!(
            out,
            "judged up to {until:.2} s: beyond it a change of 0.1 % moves the motion too much"
        ),
    };
    let _ = match &verdict.slip {
        Some(slip) => writeln!(out, "{agrees}: {}", notes::slips(slip)),
        None => writeln!(
            out,
            "{agrees}: OpenSees is {whether} {LIMIT} of tune simulate's u: {:.1e}{}",
            verdict.error,
            if verdict.stands { OF_SIZE } else { "" }
        ),
    };
    if let Some(parted) = verdict.parted.filter(|_| verdict.slip.is_none()) {
        let _ = writeln!(out, "OpenSees first differs by 1 % of the largest u at {parted:.2} s");
    }
    if result.late > 0 {
        let _ = writeln!(
            out,
            "WARNING: {} touches or lifts of a foot within too long a step of OpenSees",
            result.late
        );
    }
    if result.swings == [0; 2] && verdict.slip.is_none() {
        out += "NOTE: what is judged has no swing from foot to foot: no landing is tested\n";
    }
    out + FORCES
}

/// Why OpenSees is off: its steps, or the springs.
fn refusal(result: &Verification) -> String {
    let error = result.verdict.error;
    if let Some(slip) = &result.verdict.slip {
        return format!(
            "verify: OpenSees' slip is off by {} of the largest; ask for finer steps with \
                --accuracy, or another --duration",
            percent(slip.error())
        );
    }
    let own = result.finer.map_or(0.0, |finer| finer.against_itself);
    if let Some(finer) = result.finer.filter(|finer| finer.error <= LIMIT) {
        format!(
            "verify: OpenSees is off by {error:.1e}, and by {:.1e} in steps a quarter as long: \
                this motion asks for finer steps; give --accuracy {}",
            finer.error,
            files::message::significant(finer.accuracy, 3)
        )
    } else if own > LIMIT {
        format!(
            "verify: OpenSees is off by {error:.1e}, and by {own:.1e} from itself in steps a \
                quarter as long: on these springs a lifting foot chatters, or this motion is too \
                sensitive, which no program with steps follows; take springs as tune run finds \
                them, or a motion that lifts the structure more"
        )
    } else {
        format!(
            "verify: OpenSees is off by {error:.1e}, though it agrees with itself in finer steps \
                ({own:.1e}): the two models differ on these springs; take others, and please \
                report the case"
        )
    }
}

/// All three histories, 12 significant digits; over the length that all have.
fn csv(result: &Verification) -> String {
    let all = [&result.housner, &result.ours, &result.opensees];
    let mut out = String::from(
        "t,u_housner,v_housner,th_housner,u_fem,v_fem,th_fem,u_opensees,v_opensees,th_opensees\n",
    );
    for i in 0..all.iter().map(|m| m.len()).min().unwrap_or(0) {
        let mut row = vec![i as f64 * result.dt];
        row.extend(all.iter().flat_map(|m| [m.u[i], m.v[i], m.theta[i]]));
        csv_row(&mut out, &row);
    }
    out
}

/// A history without its impacts.
fn trace<'a>(label: &'a str, motion: &'a Motion) -> Trace<'a> {
    Trace { label, u: &motion.u, v: &motion.v, ..Trace::default() }
}

/// Housner's body, which holds where it stands: it lies behind those that are compared where their
/// feet may slip, and where it overturns.
fn reference<'a>(parameters: &Parameters, motion: &'a Motion) -> Trace<'a> {
    let bare = parameters.members().friction.is_some();
    let alpha = parameters.structure.body::<f64>().alpha();
    let overturns = motion.theta.iter().any(|theta| theta.abs() > alpha);
    let label = if bare { "Housner, without members" } else { "Housner" };
    Trace { behind: bare || overturns, ..trace(label, motion) }
}

fn draw(
    out: &Path,
    parameters: &Parameters,
    excitation: &Excitation,
    result: &Verification,
) -> Result<(), CommandError> {
    let n = result.housner.len().max(result.ours.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * result.dt).collect();
    let others = [trace("tune simulate", &result.ours), trace("OpenSees", &result.opensees)];
    let of = subtitle(&parameters.structure, &scaled(excitation), parameters.vertical.omega_n_hz);
    let title = format!("The exported model in OpenSees\n{of}");
    let reference = reference(parameters, &result.housner);
    // those to another structure tell nothing
    let differences = !reference.behind;
    let data = HistoryFigure {
        title: &title,
        t: &t,
        reference,
        others: &others,
        differences,
        foretold: None,
    };
    Ok(history::draw(&data)?.save(&out.join("verify.png"))?)
}
