//! The whole run, as `tune run --no-figures --no-front` does it.

use std::{
    path::Path,
    sync::{Mutex, PoisonError},
};

use serde::Serialize;

use crate::{
    WebError,
    any_case::AnyCase,
    said::{Said, Working},
    series::HistorySeries,
};
use cases::{Case, ElasticCase};
use dynamics::effort::{Effort, StopSignal};
use fixed_steps::FixedStepProgram;
use frames::{answer::ElasticAnswer, assembled::Assembled};
use report::{
    AccuracyReport, ProgramReport, Run, Section, Unit, forces_to_design_with,
    reference::uplift_g,
    rigid::RigidRun,
    screen::{Written, screen},
};
use run_folder::{elastic::ElasticRun, rigid, texts::RunTexts};
use springs::{
    elastic::{
        ElasticAsked, MOST_WORK,
        referred::{NEAR, referred},
        tune_within,
    },
    job::Job,
};

/// The folder of results, as the program calls it unless told otherwise.
const FOLDER: &str = "out";

/// The last run's files.
static FILES: Mutex<Vec<(String, String)>> = Mutex::new(Vec::new());

/// What is said of a run.
#[derive(Serialize)]
pub(crate) struct RunAnswer {
    said: Said,
    accuracy: Option<AccuracyReport>,
    /// The forces to design with, as the report has them, and whether to design by many motions.
    forces: Option<Section>,
    design_by_many: bool,
    /// None where there are no such springs.
    program: Option<ProgramAnswer>,
    /// What the program prints.
    screen: String,
    /// Names of its files and their lengths in bytes.
    files: Vec<(String, usize)>,
    /// Decks that are left out, with the reason.
    left_out: Vec<String>,
}

/// The springs for a program with steps of one size, as the report has them.
#[derive(Serialize)]
struct ProgramAnswer {
    springs: Vec<Unit>,
    usable: bool,
    /// What they err, or why they are not to be used.
    errors: String,
    section: Section,
}

impl ProgramAnswer {
    fn of(report: ProgramReport) -> Self {
        let section = report.section();
        let ProgramReport { units, usable, errors, .. } = report;
        Self { springs: units, usable, errors, section }
    }
}

pub(crate) fn tune(case: &AnyCase, friction: f64) -> Result<RunAnswer, WebError> {
    let (run, said, RunTexts { files, left_out }) = match case {
        AnyCase::Rigid(case) => of_rigid(case, friction)?,
        AnyCase::Elastic(case) => of_elastic(case, friction)?,
    };
    let named = files.iter().map(|(name, text)| (name.clone(), text.len())).collect();
    *FILES.lock().unwrap_or_else(PoisonError::into_inner) = files;
    let written = Written { folder: FOLDER, report: true, decks: true, left_out: &left_out };
    let screen = screen(&run, &written);
    Ok(RunAnswer {
        said,
        forces: forces_to_design_with(&run),
        design_by_many: run.asks_for_many_motions(),
        program: run.program.map(ProgramAnswer::of),
        accuracy: run.accuracy,
        screen,
        files: named,
        left_out,
    })
}

pub(crate) fn file(name: &str) -> String {
    let files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    files.iter().find(|(known, _)| known == name).map(|(_, text)| text.clone()).unwrap_or_default()
}

fn of_rigid(case: &Case, friction: f64) -> Result<(Run, Said, RunTexts), WebError> {
    let job = Job::new(case, &|_, _, _| {})?;
    let run = RigidRun::new(case.clone(), job, Vec::new(), friction);
    let out = Path::new(FOLDER);
    let told = run.said(rigid::filed(&run, out));
    let RigidRun { job, both, .. } = &run;
    let history = HistorySeries::of_rigid(case.structure.kind, &job.body, both, &job.record);
    let working = Working::of(&job.body, uplift_g(&case.structure, &case.members));
    let said = Said::of(&told, working, history);
    Ok((told, said, rigid::texts(&run, out)?))
}

fn of_elastic(case: &ElasticCase, friction: f64) -> Result<(Run, Said, RunTexts), WebError> {
    let assembled = Assembled::with_members(case.structure, case.members)?;
    let record = case.excitation.used()?;
    let effort = Effort::of(MOST_WORK, StopSignal::default());
    let reference = referred(&assembled, &record, &effort)?;
    let program = case.program.unwrap_or_else(FixedStepProgram::usual);
    let asked = ElasticAsked { error: case.asked, most_hz: case.max_omega_hz, program };
    let mut tuned =
        tune_within(&assembled, asked, Some((&record, reference)), &effort, &|_, _| {})?;
    let Some(reference) = tuned.reference.take() else { return Err(WebError::NoSprings) };
    let near = Some(effort.part(NEAR));
    let answer = ElasticAnswer::new(&assembled, &tuned.springs.corners, &record, reference, near)?;
    let run = ElasticRun::new(case.clone(), assembled, tuned, record, answer, friction);
    let out = Path::new(FOLDER);
    let told = run.said(run.filed(out));
    let working = Working::of_elastic(&run.assembled);
    let history = HistorySeries::of_elastic(&run.assembled, &run.answer, &run.record);
    Ok((told.clone(), Said::of(&told, working, history), run.texts(out)?))
}
