//! `tune run` of an elastic structure.

use super::{RunOptions, springs_alone};
use crate::commands::{
    CommandError,
    bounds::ended,
    progress::{self, Progress},
};
use cases::ElasticCase;
use fixed_steps::FixedStepProgram;
use frames::{answer::ElasticAnswer, assembled::Assembled};
use results::NotDone;
use run_folder::{
    elastic::{ElasticRun, springs_alone as alone},
    place::check_folder,
    rigid::{Output, files},
};
use springs::elastic::{
    ElasticAsked, MOST_WORK,
    referred::{NEAR, ReferredError, referred},
    tune_within,
};

/// The whole job.
pub fn run(o: &RunOptions, mut case: ElasticCase) -> Result<(), CommandError> {
    if !o.no_record {
        case.excitation = o.record.excitation_of_case(&case.excitation, &case.notices)?;
    }
    case.max_omega_hz = o.max_hz()?.or(case.max_omega_hz);
    case.asked = o.asked()?.unwrap_or(case.asked);
    case.program = o.program.over(case.program)?;
    let friction = o.ground.friction()?;
    check_folder(&o.out)?;

    let assembled =
        Assembled::with_members(case.structure, case.members).map_err(CommandError::result)?;
    if !o.no_record {
        progress::taken(&case.excitation.line(), &case.doubts(), o.quiet);
    }
    let effort = o.effort.of(MOST_WORK)?;
    let progress = Progress::on_terminal("springs tried", o.quiet);
    let tell = |done: usize, error: f64| progress.tell(done, 0, &progress::error(error));
    let record = if o.no_record { None } else { Some(case.excitation.used()?) };
    let reference = record.as_ref().map(|record| referred(&assembled, record, &effort)).transpose();
    let reference = reference.map_err(|e| match e {
        ReferredError::TooShort(e) => e.into(),
        e => CommandError::result(e),
    })?;
    let program = case.program.unwrap_or_else(FixedStepProgram::usual);
    let asked = ElasticAsked { error: case.asked, most_hz: case.max_omega_hz, program };
    let tuned = tune_within(&assembled, asked, record.as_ref().zip(reference), &effort, &tell);
    progress.done();
    let mut tuned = tuned.map_err(CommandError::result)?;
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
    let answer = ElasticAnswer::new(&assembled, &tuned.springs.corners, &record, reference, near);
    progress.done();
    let answer = answer.map_err(CommandError::result)?;
    let run = ElasticRun::new(case, assembled, tuned, record, answer, friction);
    let output = Output { figures: !o.no_figures, report: !o.no_report };
    let left_out = run.save(&o.out, &files(), output)?;
    o.print(&run.said(run.filed(&o.out)), &left_out)?;
    ended(&effort, &o.out)
}
