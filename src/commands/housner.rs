//! `tune housner`: Housner's solution as CSV, its impacts on stderr or as CSV.

use std::path::PathBuf;

use clap::Args;

use super::{
    CommandError,
    common::{RecordOptions, look_again, restitution},
    terminal,
};
use cases::{Case, doubts::of_excitation};
use rocking::{
    housner::{self, RockingOutcome},
    motion::{peak, samples_until},
};
use run_folder::{
    place::{file_in, not_an_input, write_file},
    tables::csv_row,
};

/// Options of `tune housner`.
#[derive(Debug, Args)]
pub struct HousnerOptions {
    /// Structure and record; the paper's A-frame (all mass near the apex, I_cg = 1e-5 m R^2) on El
    /// Centro unless given
    case: Option<PathBuf>,
    #[command(flatten)]
    record: RecordOptions,
    /// Velocity after an impact over that before; by equation 2 unless given
    #[arg(long, allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Write the history here instead of to stdout; into a folder as housner.csv
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the impacts (time, velocity before and after) instead of the history
    #[arg(long)]
    impacts: bool,
}

pub fn run(o: &HousnerOptions) -> Result<(), CommandError> {
    let case = match &o.case {
        Some(path) => Case::read_asking(path, &o.record.of_case())?,
        // the one that `tune run` takes
        None => Case::paper()?,
    };
    let members = case.members;
    let excitation = o.record.excitation_of_case(&case.excitation, &case.notices)?;
    let of_structure = if o.case.is_some() { case.doubts_of_structure() } else { Vec::new() };
    let out = o.out.as_deref().map(|path| file_in(path, "housner.csv")).transpose()?;
    if let Some(path) = &out {
        let inputs = [o.case.as_ref(), o.record.record.as_ref()].into_iter().flatten();
        not_an_input(path, inputs.map(PathBuf::as_path))?;
    }
    let record = excitation.used()?;
    look_again(&of_structure);
    look_again(&of_excitation(&excitation));
    let body = case.structure.body::<f64>();
    let options = housner::RockingOptions {
        restitution: restitution(o.restitution)?.or(Some(case.restitution)),
        vertical: record.vertical_accel(),
        members,
        ..Default::default()
    };
    let rocking = housner::solve(&body, record.dt, &record.accel, &options);
    let motion = rocking.motion(&body);

    let mut csv = String::new();
    if o.impacts {
        csv.push_str("t,rate_before,rate_after\n");
        for i in &rocking.impacts {
            csv_row(&mut csv, &[i.time, i.rate_before, i.rate_after]);
        }
    } else {
        csv.push_str("t,u,v,th\n");
        for i in 0..motion.len() {
            csv_row(&mut csv, &[i as f64 * record.dt, motion.u[i], motion.v[i], motion.theta[i]]);
        }
    }
    match &out {
        Some(path) => write_file(path, csv.as_bytes())?,
        None => terminal::stdout(csv)?,
    }
    let upright = samples_until(rocking.overturned(), record.dt).min(motion.len());
    let (max, min) =
        motion.u[..upright].iter().fold((0.0_f64, 0.0_f64), |(a, b), &u| (a.max(u), b.min(u)));
    terminal::stderr(format_args!(
        "{}\nu {:+.9} / {:+.9} mm, v {:.6} mm, {} impacts{}",
        excitation.line(),
        max * 1e3,
        min * 1e3,
        peak(&motion.v[..upright]) * 1e3,
        rocking.impacts.len(),
        match rocking.outcome {
            RockingOutcome::Overturned { time } =>
                format!(", overturned at {time:.3} s (peaks until then)"),
            RockingOutcome::NeverMoved => ", never lifted".into(),
            RockingOutcome::LeavesGround { time } =>
                format!(", leaves the ground at {time:.6} s, where the solution ends"),
            _ => String::new(),
        }
    ));
    Ok(())
}
