//! `tune run` of an elastic structure.

use std::io::Write;

use super::{Output, RunOptions, files, threads};
use crate::{
    case::ElasticCase,
    commands::{
        CommandError,
        elastic::{ElasticRun, springs_alone},
        output::{Folder, check_folder},
        progress::Progress,
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
            notices.iter().for_each(|notice| eprintln!("{notice}"));
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
    let tell = |done: usize, error: f64| progress.tell(done, 0, &format!("error {error:.2e}"));
    let record = if o.no_record { None } else { Some(referred(&assembled, case.excitation.used()?)?) };
    let (record, reference) = record.unzip();
    let tuned = tune(&assembled, case.accuracy, case.max_omega_hz, record.as_ref().zip(reference), &tell);
    progress.done();
    let mut tuned = tuned.map_err(|e| CommandError::Result(e.to_string()))?;
    let Some((record, reference)) = record.zip(tuned.reference.take()) else {
        let parameters = springs_alone(&assembled, &tuned, case.accuracy);
        let folder = Folder::begin(&o.out, "run", &all)?;
        let said = parameters.save_alone(&o.out)?;
        folder.finish()?;
        write!(std::io::stdout(), "{said}")?;
        eprintln!("no record: give one with --record\nwritten to {}", o.out.display());
        return Ok(());
    };
    let progress = Progress::new("history", o.quiet);
    let answer = ElasticAnswer::new(&assembled, &tuned.springs.corners, &record, reference);
    progress.done();
    let answer = answer.map_err(|e| CommandError::Result(e.to_string()))?;
    let run = ElasticRun::new(case, assembled, tuned, record, answer);
    let folder = Folder::begin(&o.out, "run", &all)?;
    run.save(&o.out, Output { figures: !o.no_figures, report: !o.no_report })?;
    folder.finish()?;
    write!(std::io::stdout(), "{}", run.terminal())?;
    eprintln!("{}\nwritten to {}", run.case.excitation.line(), o.out.display());
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
