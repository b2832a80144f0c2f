//! `tune simulate`: both models for given springs.

use std::path::PathBuf;

use clap::Args;

use super::{
    CommandError,
    common::{GroundOptions, RecordOptions, restitution},
    members, terminal,
};
use parameters::{Parameters, answers::compare_models};
use report::{
    filed,
    reference::{self, HousnerReport},
};
use run_folder::{
    folder::of_one_run,
    place::{file_in, not_an_input, write_file},
    tables::{Instants, history_csv, members_csv},
};

/// Options of `tune simulate`.
#[derive(Debug, Args)]
pub struct SimulateOptions {
    /// Springs and structure, as `tune run` writes them
    #[arg(long, value_name = "parameters.json")]
    parameters: PathBuf,
    #[command(flatten)]
    record: RecordOptions,
    #[command(flatten)]
    ground: GroundOptions,
    /// Velocity after an impact over that before, of Housner's body; that of the parameters, or by
    /// equation 2, unless given
    #[arg(long, allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Write the histories here (CSV); into a folder as history.csv
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write base shear and the forces in legs or at a block's base, in tendon and dampers here
    /// (CSV), at the record's samples; into a folder as members.csv
    #[arg(long, value_name = "FILE")]
    forces: Option<PathBuf>,
}

pub fn run(o: &SimulateOptions) -> Result<(), CommandError> {
    of_one_run(&o.parameters)?;
    let parameters = Parameters::read(&o.parameters)?;
    let excitation = o.record.excitation(|| parameters.excitation(&o.parameters))?;
    let record = excitation.used()?;
    let body = parameters.structure.body::<f64>();
    let e = restitution(o.restitution)?.unwrap_or_else(|| parameters.restitution());
    let file =
        |path: &Option<PathBuf>, name| path.as_deref().map(|path| file_in(path, name)).transpose();
    let (out, forces) = (file(&o.out, "history.csv")?, file(&o.forces, "members.csv")?);
    for path in out.iter().chain(&forces) {
        let inputs = [Some(&o.parameters), o.record.record.as_ref()].into_iter().flatten();
        not_an_input(path, inputs.map(PathBuf::as_path))?;
    }
    let friction = o.ground.friction()?;
    let both = compare_models(&body, e, &parameters.chains(), &parameters.members(), &record);
    if let Some(path) = &out {
        write_file(path, history_csv(record.dt, &both).as_bytes())?;
    }
    if let Some(path) = &forces {
        let of = both.with.as_ref();
        let of = of.map_or((&both.fem, &both.demands), |with| (&with.history, &with.demands));
        let body = (parameters.structure.kind, &body);
        let members = members_csv(body, record.dt, of, Instants::Samples);
        write_file(path, members.as_bytes())?;
    }
    terminal::stderr(excitation.line());
    let housner = HousnerReport::new(&body, e, &record, &both.rocking, friction);
    let housner = housner.with_members(&body, &record, &both).with_conditioning(
        &body,
        &parameters.chains(),
        &record,
        &both,
    );
    let verdict = both.verdict(&body, record.dt, &housner.conditioning);
    for finding in filed(reference::all(&parameters.structure, &record, &both, &housner, &verdict))
    {
        terminal::stderr(finding.line());
    }
    let report = members::MembersReport::new(&both.matched, &both.demands, both.with.as_ref());
    terminal::json(&report)
}
