//! `tune run` of an elastic structure.

use super::{RunOptions, saved, springs_alone, threads};
use crate::commands::{
    CommandError,
    bounds::ended,
    progress::{self, Progress},
};
use dynamics::effort::Effort;
use fixed_steps::FixedStepProgram;
use frames::{
    Mechanics,
    answer::{ElasticAnswer, Reference},
    assembled::Assembled,
    fem::{default_control, most_steps},
    reference::{self, FORETOLD},
};
use run_folder::{
    elastic::{ElasticRun, springs_alone as alone},
    place::check_folder,
    rigid::{Output, files},
};
use springs::{
    case::ElasticCase,
    results::NotDone,
    tuning::{
        elastic::{ElasticAsked, MOST_WORK, tune_within},
        job::JobError,
    },
};
use strong_motion::Record;

/// A history on rigid ground through the record may take one in so many of all units of work, each
/// of the motions near it one in so many.
const RECORD: u64 = 12;
const NEAR: u64 = 120;

/// The whole job.
pub fn run(o: &RunOptions, mut case: ElasticCase) -> Result<(), CommandError> {
    applies(o)?;
    if !o.no_record {
        case.excitation = o.record.excitation_of_case(&case.excitation, &case.notices)?;
    }
    case.max_omega_hz = o.max_hz()?.or(case.max_omega_hz);
    case.asked = o.asked()?.unwrap_or(case.asked);
    case.program = o.program.over(case.program)?;
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;
    threads(o.jobs)?;

    let assembled =
        Assembled::with_members(case.structure, case.members).map_err(|e| CommandError::Result(e.to_string()))?;
    if !o.no_record {
        progress::taken(&case.excitation.line(), &case.doubts(), o.quiet);
    }
    let effort = o.effort.of(MOST_WORK)?;
    let progress = Progress::on_terminal("springs tried", o.quiet);
    let tell = |done: usize, error: f64| progress.tell(done, 0, &progress::error(error));
    let record = if o.no_record { None } else { Some(referred(&assembled, case.excitation.used()?, &effort)?) };
    let (record, reference) = record.unzip();
    let program = case.program.unwrap_or_else(FixedStepProgram::usual);
    let asked = ElasticAsked { error: case.asked, most_hz: case.max_omega_hz, program };
    let tuned = tune_within(&assembled, asked, record.as_ref().zip(reference), &effort, &tell);
    progress.done();
    let mut tuned = tuned.map_err(|e| CommandError::Result(e.to_string()))?;
    let Some((record, reference)) = record.zip(tuned.reference.take()) else {
        let run = report::elastic::of_case(&case, alone(&assembled, &tuned, case.asked));
        springs_alone(o, &run)?;
        return ended(&effort, &o.out);
    };
    let progress = Progress::on_terminal("histories and forces", o.quiet);
    let near = Some(effort.part(NEAR)).filter(|_| !effort.stopped_from_outside());
    if near.is_none() {
        tuned.not_done.push(NotDone::ForceChecks);
        tuned.not_done.extend(reference.foretold_seconds(record.dt).map(|_| NotDone::NearMotions));
    }
    let answer = ElasticAnswer::within(&assembled, &tuned.springs.corners, &record, reference, near);
    progress.done();
    let answer = answer.map_err(|e| CommandError::Result(e.to_string()))?;
    let run = ElasticRun::new(case, assembled, tuned, record, answer, friction);
    saved(run.save(&o.out, &files(), Output { figures: !o.no_figures, report: !o.no_report })?);
    o.print(&run.said(run.filed(&o.out)))?;
    ended(&effort, &o.out)
}

/// A record with what the structure does in it on rigid ground.
fn referred(assembled: &Assembled, record: Record, effort: &Effort) -> Result<(Record, Reference), CommandError> {
    if record.len() < 2 {
        return Err(JobError::TooShort { samples: record.len(), record: record.name }.into());
    }
    let most_work = effort.part(RECORD);
    within_reach(assembled, &record, most_work)?;
    let reference = Reference::within(assembled, &record, FORETOLD, most_work);
    let reference = reference.map_err(|e| CommandError::Result(e.to_string()))?;
    Ok((record, reference))
}

/// A record that has a step to a sample at least, of which more are needed than a history may take,
/// is refused.
fn within_reach(assembled: &Assembled, record: &Record, most_work: u64) -> Result<(), CommandError> {
    let coordinates = assembled.frame.size();
    let by_work = (most_work / reference::step_units(coordinates)) as usize;
    let most = by_work.min(most_steps(default_control(), coordinates));
    let steps = record.len() - 1;
    if steps <= most {
        return Ok(());
    }
    let remedy = "shorten it (--duration), give the structure fewer elements, or allow more (--work)";
    Err(CommandError::Result(format!(
        "{}: {steps} steps at least, one to a sample, are out of reach: a history of this structure may take {most}; {remedy}",
        record.name
    )))
}

/// Options that mean nothing for an elastic structure are refused.
fn applies(o: &RunOptions) -> Result<(), CommandError> {
    if o.no_front {
        let remedy = "that is for rigid bodies and does nothing for an elastic structure; leave it out";
        return Err(CommandError::Option { option: "no-front", value: "given".to_string(), remedy });
    }
    Ok(())
}
