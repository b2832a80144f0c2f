//! What a run of a rigid body leaves in a folder.

use std::path::Path;

use decks::{DeckFormat, Expected, ExportError, with_inertia};
use figures::Figure;
use parameters::{
    Parameters, RecordRow,
    predictability::{simulate, width_sensitivity},
};
use report::{
    Run,
    markdown::markdown,
    page::{Drawing, page},
    predictable_to,
    rigid::RigidRun,
    summary,
};

use crate::{
    FolderError,
    folder::{Folder, identity},
    models,
    pictures::{self, Pictures},
    place::write_file,
    tables::{Instants, history_csv, members_csv},
    texts::RunTexts,
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
    "decks/model_even.py",
    "decks/model_even.tcl",
    "decks/model_sap2000.s2k",
    "decks/sap2000_by_hand.txt",
    "decks/etabs_by_hand.txt",
    "decks/ground_motion.txt",
    "decks/ground_motion_up.txt",
    "decks/springs.csv",
    "decks/springs.md",
    "decks/springs_even.csv",
    "decks/springs_even.md",
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
    let parts: [&dyn std::fmt::Debug; 3] =
        [&rigid.parameters, &excitation.record.fingerprint(), &asked];
    let folder = Folder::begin(out, "run", &files, identity(&parts))?;
    let parameters = filed(rigid, out);
    let run = rigid.said(parameters.clone());
    let out = folder.path();
    tables(rigid, &parameters, &run).write(out)?;
    let written = || {
        let decks = run_decks(&parameters, rigid)?;
        decks.write(out).map(|()| decks.left_out)
    };
    let RigidRun { case, job, front, both, .. } = rigid;
    let foretold_s = predictable_to(&rigid.parameters.findings);
    let figures = || match output.figures {
        true => Pictures { case, job, both, front, foretold_s }.draw(),
        false => Ok(Vec::new()),
    };
    let (left_out, figures) = parallel::join(written, figures);
    let (left_out, figures) = (left_out?, figures?);
    let run = run.with_decks(&left_out);
    let (saved, page) = parallel::join(
        || pictures::save(out, &figures),
        || write_report(out, output, &run, &figures),
    );
    saved.and(page)?;
    folder.finish()?;
    Ok(left_out)
}

/// Everything that [`save`] writes but figures, as texts; `out` is the folder that paths start
/// from.
///
/// # Errors
/// A deck that cannot be made.
pub fn texts(rigid: &RigidRun, out: &Path) -> Result<RunTexts, FolderError> {
    let parameters = filed(rigid, out);
    let run = rigid.said(parameters.clone());
    let mut texts = tables(rigid, &parameters, &run);
    let decks = run_decks(&parameters, rigid)?;
    let run = run.with_decks(&decks.left_out);
    texts.files.push(("report.html".into(), page(&run, &[])));
    Ok(texts.and(decks))
}

/// Parameters and tables.
fn tables(rigid: &RigidRun, parameters: &Parameters, run: &Run) -> RunTexts {
    let RigidRun { job, both, .. } = rigid;
    let dt = job.record.dt;
    let of = both.with.as_ref();
    let of = of.map_or((&both.fem, &both.demands), |with| (&with.history, &with.demands));
    let members = |instants| members_csv((rigid.case.structure.kind, &job.body), dt, of, instants);
    RunTexts::of([
        ("parameters.json", parameters.to_json()),
        ("parameters.md", markdown(run)),
        ("summary.csv", summary(run).csv()),
        ("history.csv", history_csv(dt, both)),
        ("members.csv", members(Instants::Samples)),
        ("members_envelopes.csv", members(Instants::Envelopes)),
    ])
}

/// `parameters.json` as it stands in a folder.
pub fn filed(rigid: &RigidRun, out: &Path) -> Parameters {
    let record = Some(RecordRow::new(&rigid.case.excitation, &rigid.job.record, out));
    Parameters { record, ..rigid.parameters.clone() }
}

/// `report.html`, if it is asked for.
pub fn write_report(
    out: &Path,
    output: Output,
    run: &Run,
    figures: &[Figure],
) -> Result<(), FolderError> {
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
fn run_decks(parameters: &Parameters, rigid: &RigidRun) -> Result<RunTexts, FolderError> {
    let RigidRun { job, both, of_steps, .. } = rigid;
    let record = &job.record;
    let structure = with_inertia(&parameters.structure, &parameters.members());
    let given = structure == parameters.structure;
    let parameters = Parameters { structure, ..parameters.clone() };
    let own = (!given).then(|| simulate(&parameters, record));
    let history =
        own.as_ref().unwrap_or_else(|| both.with.as_ref().map_or(&both.fem, |with| &with.history));
    let width_sensitivity = width_sensitivity(&history.motion, &parameters, record);
    let until = predictable_to(&rigid.parameters.findings);
    let expected = Expected::foretold(history, width_sensitivity, record.dt, until);
    let stepped = |_: &_, format: DeckFormat| match of_steps {
        Some(history) => decks::even_deck(&parameters, record, format, history, until),
        None => Err(ExportError::NoProgram),
    };
    let all = models::decks(|format| decks::export(&parameters, record, &expected, format))?;
    Ok(all.and(models::even_decks(parameters.program.as_ref(), record, stepped)?))
}

#[cfg(test)]
mod tests;
