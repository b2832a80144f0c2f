//! What a run of a rigid body leaves in a folder.

use std::path::Path;

use decks::{DeckFormat, Expected, Stepping, with_inertia};
use figures::Figure;
use report::{
    Run,
    markdown::markdown,
    page::{Drawing, page},
    rigid::RigidRun,
    summary,
};
use springs::{
    answers::ModelComparison,
    parameters::{Parameters, RecordRow},
    predictability::{simulate, width_sensitivity},
};
use strong_motion::Record;

use crate::{
    FolderError,
    folder::{Folder, identity},
    models::{SAP2000, write_decks},
    pictures::{self, Pictures},
    place::write_file,
    tables::{history_csv, members_csv},
};

/// All that `tune run` can write into its folder, beside figures.
const FILES: &[&str] = &[
    "parameters.json",
    "parameters.md",
    "summary.csv",
    "history.csv",
    "members.csv",
    "members_envelopes.csv",
    "report.html",
    "decks/model_openseespy.py",
    "decks/model_opensees.tcl",
    "decks/model_sap2000.s2k",
    "decks/springs.csv",
    "decks/springs.md",
];

/// All that a run can leave in its folder.
pub fn files() -> Vec<&'static str> {
    [FILES, pictures::FILES].concat()
}

/// What to write besides tables and decks.
#[derive(Clone, Copy, Debug)]
pub struct Output {
    /// The figures as files and in the report.
    pub figures: bool,
    /// `report.html`.
    pub report: bool,
}

/// Write everything of a run into a folder, which is made; the decks that are left out, with the
/// reason.
///
/// # Errors
/// A file that cannot be written; a deck or a figure that cannot be made.
pub fn save(rigid: &RigidRun, out: &Path, output: Output) -> Result<Vec<String>, FolderError> {
    let files = files();
    let excitation = &rigid.case.excitation;
    let asked = (excitation.scale, excitation.duration_s, output, rigid.front.len());
    let parts: [&dyn std::fmt::Debug; 3] = [&rigid.parameters, &excitation.record.fingerprint(), &asked];
    let folder = Folder::begin(out, "run", &files, identity(&parts))?;
    let RigidRun { job, both, .. } = rigid;
    let dt = job.record.dt;
    let parameters = filed(rigid, out);
    let run = rigid.said(parameters.clone());
    let out = folder.path();
    write_file(&out.join("parameters.json"), parameters.to_json().as_bytes())?;
    write_file(&out.join("parameters.md"), markdown(&run).as_bytes())?;
    write_file(&out.join("summary.csv"), summary(&run).csv().as_bytes())?;
    write_file(&out.join("history.csv"), history_csv(dt, both).as_bytes())?;
    let demands = both.with.as_ref().map_or(&both.demands, |with| &with.demands);
    write_file(&out.join("members.csv"), members_csv(dt, demands).as_bytes())?;
    let (decks, pictures) =
        rayon::join(|| decks(out, &parameters, &job.record, both), || draw(rigid, out, &run, output));
    let left_out = decks?;
    pictures?;
    folder.finish()?;
    Ok(left_out)
}

/// Figures and the page.
fn draw(rigid: &RigidRun, out: &Path, run: &Run, output: Output) -> Result<(), FolderError> {
    let RigidRun { case, job, front, both, .. } = rigid;
    let figures = if output.figures { Pictures { case, job, both, front }.draw()? } else { Vec::new() };
    let (saved, page) = rayon::join(|| pictures::save(out, &figures), || write_report(out, output, run, &figures));
    saved.and(page)
}

/// `parameters.json` as it stands in a folder.
pub fn filed(rigid: &RigidRun, out: &Path) -> Parameters {
    let record = Some(RecordRow::new(&rigid.case.excitation, &rigid.job.record, out));
    Parameters { record, ..rigid.parameters.clone() }
}

/// `report.html`, if it is asked for.
pub fn write_report(out: &Path, output: Output, run: &Run, figures: &[Figure]) -> Result<(), FolderError> {
    if !output.report {
        return Ok(());
    }
    let drawn: Vec<Drawing> = figures.iter().map(drawing).collect();
    write_file(&out.join("report.html"), page(run, &drawn).as_bytes())
}

/// A figure for a page.
pub(crate) fn drawing(figure: &Figure) -> Drawing<'_> {
    let plots = &figure.sheet.plots;
    // plain numbers and strings always serialise
    let plots = (!plots.is_empty()).then(|| serde_json::to_string(plots).unwrap_or_default());
    Drawing { id: figure.name, caption: figure.caption, svg: &figure.sheet.svg, plots }
}

/// The model for other programs. A body without rotational inertia gets some there, and its own
/// history to check against.
fn decks(
    out: &Path,
    parameters: &Parameters,
    record: &Record,
    both: &ModelComparison,
) -> Result<Vec<String>, FolderError> {
    let folder = out.join("decks");
    let structure = with_inertia(&parameters.structure);
    let given = structure == parameters.structure;
    let parameters = Parameters { structure, ..parameters.clone() };
    let own = (!given).then(|| simulate(&parameters, record));
    let history = own.as_ref().unwrap_or_else(|| both.with.as_ref().map_or(&both.fem, |with| &with.history));
    let width_sensitivity = width_sensitivity(&history.motion, &parameters, record);
    let expected = Expected::new(history, width_sensitivity);
    // SAP2000 steps alike: the springs for that, if there are some
    let for_its_steps = |format: DeckFormat| {
        let program = parameters.program.as_ref().filter(|_| format == DeckFormat::Sap2000)?;
        let csi = matches!(program.name.as_deref(), Some("sap2000" | "etabs"));
        csi.then(|| Ok(decks::stepped_deck(&parameters, record, format, Stepping::Even)?.told(SAP2000)))
    };
    write_decks(&folder, |format| {
        let plain = || Ok((decks::export(&parameters, record, &expected, format)?, None));
        for_its_steps(format).unwrap_or_else(plain)
    })
}

#[cfg(test)]
mod tests;
