//! `tune run` of an elastic structure.

use super::{Output, RunOptions, files, springs_alone, threads};
use crate::{
    case::ElasticCase,
    commands::{
        CommandError,
        elastic::{ElasticRun, springs_alone as alone},
        output::check_folder,
        progress::{self, Progress},
    },
    elastic::{
        answer::{ElasticAnswer, Reference},
        assembled::Assembled,
    },
    record::Record,
    report,
    tuning::{elastic::tune, job::JobError},
};

/// The whole job.
pub fn run(o: &RunOptions, mut case: ElasticCase) -> Result<(), CommandError> {
    applies(o)?;
    if !o.no_record {
        case.excitation = o.record.excitation_of_case(&case.excitation, &case.notices)?;
    }
    case.max_omega_hz = o.max_hz()?.or(case.max_omega_hz);
    case.asked = o.asked()?.unwrap_or(case.asked);
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;
    threads(o.jobs)?;

    let assembled =
        Assembled::with_members(case.structure, case.members).map_err(|e| CommandError::Result(e.to_string()))?;
    if !o.no_record {
        progress::taken(&case.excitation.line(), &case.doubts(), o.quiet);
    }
    let progress = Progress::on_terminal("springs tried", o.quiet);
    let tell = |done: usize, error: f64| progress.tell(done, 0, &progress::error(error));
    let record = if o.no_record { None } else { Some(referred(&assembled, case.excitation.used()?)?) };
    let (record, reference) = record.unzip();
    let tuned = tune(&assembled, case.asked, case.max_omega_hz, record.as_ref().zip(reference), &tell);
    progress.done();
    let mut tuned = tuned.map_err(|e| CommandError::Result(e.to_string()))?;
    let Some((record, reference)) = record.zip(tuned.reference.take()) else {
        let run = report::elastic::of_case(&case, alone(&assembled, &tuned, case.asked));
        return springs_alone(o, &run);
    };
    let progress = Progress::on_terminal("histories and forces", o.quiet);
    let answer = ElasticAnswer::new(&assembled, &tuned.springs.corners, &record, reference);
    progress.done();
    let answer = answer.map_err(|e| CommandError::Result(e.to_string()))?;
    let run = ElasticRun::new(case, assembled, tuned, record, answer, friction);
    run.save(&o.out, &files(), Output { figures: !o.no_figures, report: !o.no_report })?;
    o.print(&run.said(run.filed(&o.out)))
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
    if o.no_front {
        let remedy = "that is for rigid bodies and does nothing for an elastic structure; leave it out";
        return Err(CommandError::Option { option: "no-front", value: "given".to_string(), remedy });
    }
    Ok(())
}
