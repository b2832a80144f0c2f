//! `tune run` of an elastic structure.

use super::{Output, RunOptions, files, threads};
use crate::{
    case::ElasticCase,
    commands::{
        CommandError,
        elastic::{ElasticRun, springs_alone},
        output::{Folder, check_folder, identity},
        progress::{self, Progress},
        terminal,
    },
    elastic::{
        answer::{ElasticAnswer, Reference},
        assembled::Assembled,
    },
    record::Record,
    tuning::{elastic::tune, job::JobError},
};

/// The whole job.
pub fn run(o: &RunOptions, mut case: ElasticCase) -> Result<(), CommandError> {
    applies(o)?;
    if !o.no_record {
        let notices = std::mem::take(&mut case.notices);
        let of_case = || -> Result<_, CommandError> {
            notices.iter().for_each(terminal::stderr);
            Ok(case.excitation.clone())
        };
        case.excitation = o.record.excitation(of_case)?;
    }
    case.max_omega_hz = o.max_hz()?.or(case.max_omega_hz);
    case.accuracy = o.accuracy()?.unwrap_or(case.accuracy);
    check_folder(&o.out)?;
    threads(o.jobs)?;
    let all = files();

    let assembled =
        Assembled::with_members(case.structure, case.members).map_err(|e| CommandError::Result(e.to_string()))?;
    let progress = Progress::new("tuning", o.quiet);
    let tell = |done: usize, error: f64| progress.tell(done, 0, &progress::error(error));
    let record = if o.no_record { None } else { Some(referred(&assembled, case.excitation.used()?)?) };
    let (record, reference) = record.unzip();
    let tuned = tune(&assembled, case.accuracy, case.max_omega_hz, record.as_ref().zip(reference), &tell);
    progress.done();
    let mut tuned = tuned.map_err(|e| CommandError::Result(e.to_string()))?;
    let Some((record, reference)) = record.zip(tuned.reference.take()) else {
        let parameters = springs_alone(&assembled, &tuned, case.accuracy);
        let folder = Folder::begin(&o.out, "run", &all, identity(&[&parameters]))?;
        let said = parameters.save_alone(folder.path())?;
        folder.finish()?;
        terminal::stdout(said)?;
        terminal::stderr(format_args!("no record: give one with --record\nwritten to {}", terminal::shown(&o.out)));
        return Ok(());
    };
    let progress = Progress::new("history", o.quiet);
    let answer = ElasticAnswer::new(&assembled, &tuned.springs.corners, &record, reference);
    progress.done();
    let answer = answer.map_err(|e| CommandError::Result(e.to_string()))?;
    let run = ElasticRun::new(case, assembled, tuned, record, answer);
    run.save(&o.out, &all, Output { figures: !o.no_figures, report: !o.no_report })?;
    terminal::stdout(run.terminal())?;
    terminal::stderr(format_args!("{}\nwritten to {}", run.case.excitation.line(), terminal::shown(&o.out)));
    Ok(())
}

/// A record with what the structure does in it on rigid ground.
fn referred(assembled: &Assembled, record: Record) -> Result<(Record, Reference), CommandError> {
    if record.len() < 2 {
        return Err(JobError::TooShort { samples: record.len(), record: record.name }.into());
    }
    let reference = Reference::new(assembled, &record).map_err(|e| CommandError::Result(e.to_string()))?;
    Ok((record, reference))
}

/// Options that mean nothing for an elastic structure are refused.
fn applies(o: &RunOptions) -> Result<(), CommandError> {
    let friction = o.ground.friction.map(|value| format!("{value:?}"));
    let given = [("friction", friction), ("no-front", o.no_front.then(|| "given".to_string()))];
    match given.into_iter().find_map(|(option, value)| Some((option, value?))) {
        Some((option, value)) => {
            let remedy = "that is for rigid bodies and does nothing for an elastic structure; leave it out";
            Err(CommandError::Option { option, value, remedy })
        }
        None => Ok(()),
    }
}
