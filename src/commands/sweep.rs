//! `tune sweep`: many histories, and what they say together.

use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering},
    time::Instant,
};

use clap::{Args, Subcommand};

use super::{CommandError, progress::Progress, terminal};
use run_folder::place::check_folder;
use strong_motion::Notice;
use sweep::{
    manifest::Manifest,
    parts::{Share, SweepParts},
    plan::{InspectedSweep, Plan},
    springs::SpringsTable,
};

mod figures;
mod gather;
mod plan;

/// Options of `tune sweep`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct SweepOptions {
    #[command(subcommand)]
    step: Option<SweepStage>,
    #[command(flatten)]
    run: SweepRunOptions,
}

#[derive(Debug, Subcommand)]
enum SweepStage {
    /// What a sweep will compute; the springs that it needs; files that run it on a cluster.
    Plan(plan::PlanOptions),
    /// What the parts that are there say together, or which are missing.
    Gather(gather::GatherOptions),
}

/// Options of the sweep itself.
#[derive(Debug, Args)]
struct SweepRunOptions {
    /// Sweep file (TOML)
    #[arg(required = true)]
    sweep: Option<PathBuf>,
    /// Folder for the results; one that holds a part of this sweep is gone on with
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Only the I-th of N shares, without gathering them
    #[arg(long, value_name = "I/N")]
    shard: Option<Share>,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<usize>,
    /// No figures
    #[arg(long)]
    no_figures: bool,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

impl SweepOptions {
    /// The threads asked for, of the sweep itself.
    pub(super) fn jobs(&self) -> Option<usize> {
        self.run.jobs
    }
}

pub fn run(o: &SweepOptions) -> Result<(), CommandError> {
    match (&o.step, &o.run.sweep) {
        (Some(SweepStage::Plan(o)), _) => plan::run(o),
        (Some(SweepStage::Gather(o)), _) => gather::run(o),
        (None, Some(sweep)) => o.run.compute(sweep),
        (None, None) => Ok(()),
    }
}

/// A sweep whose files were read; what is to be looked at again is told.
fn inspected(plan: &Plan) -> Result<InspectedSweep, CommandError> {
    let told = |notice: &Notice| terminal::stderr(notice.with_keys_of("records"));
    let inspected = plan.inspect(&mut { told })?;
    for doubt in &inspected.doubts {
        terminal::stderr(format_args!("CHECK {doubt}"));
    }
    Ok(inspected)
}

/// The folder of a sweep, begun or gone on with; the springs that it needs.
fn begin(
    plan: &Plan,
    hash: &str,
    out: &Path,
    quiet: bool,
) -> Result<Option<SpringsTable>, CommandError> {
    check_folder(out)?;
    Manifest::new(plan, hash).begin(out)?;
    if !plan.model.fem() {
        return Ok(None);
    }
    let progress = Progress::new("springs", quiet);
    let springs =
        SpringsTable::new(plan, out, hash, &|done, all| progress.tell(done, all, "geometries"));
    progress.done();
    let springs = springs?;
    for doubt in &springs.missed {
        terminal::stderr(format_args!("CHECK {doubt}"));
    }
    Ok(Some(springs))
}

impl SweepRunOptions {
    fn compute(&self, sweep: &Path) -> Result<(), CommandError> {
        let plan = Plan::read(sweep)?;
        let inspected = inspected(&plan)?;
        let springs = begin(&plan, &inspected.hash, &self.out, self.quiet)?;
        let parts = SweepParts::new(&plan, &self.out, &inspected.hash);
        let share = self.shard.unwrap_or_default();
        let missing = parts.missing(share.parts(plan.parts()));
        for (part, reason) in &missing.unfit {
            let file = terminal::shown(&parts.path(*part));
            terminal::stderr(format_args!("{file}: {reason}; part {part} is computed again"));
        }
        let wanted = missing.parts;
        let all: u64 =
            wanted.iter().map(|part| parts.cells(*part)).map(|cells| cells.end - cells.start).sum();
        let progress = Progress::new("sweep", self.quiet);
        let (began, through) = (Instant::now(), AtomicU64::new(0));
        let done = |more: u64| {
            let n = through.fetch_add(more, Ordering::Relaxed) + more;
            progress.tell(n as usize, all as usize, &left(n, all, began.elapsed().as_secs_f64()));
        };
        for &part in &wanted {
            // another process may work on the same folder
            if parts.is_done(part) {
                let cells = parts.cells(part);
                done(cells.end - cells.start);
            } else {
                parts.compute(part, springs.as_ref(), &done)?;
            }
        }
        progress.done();
        let seconds = began.elapsed().as_secs_f64();
        if !self.quiet && all > 0 {
            terminal::stderr(format_args!(
                "{all} cells in {}: {:.0} a second",
                duration(seconds),
                all as f64 / seconds
            ));
        }
        if self.shard.is_some() {
            terminal::stdout(format_args!(
                "share {}/{}: {} of {} parts computed now; gather them with: tune sweep gather {} \
                 --out {}\n",
                share.index,
                share.of,
                wanted.len(),
                plan.parts(),
                terminal::shown(sweep),
                terminal::shown(&self.out)
            ))?;
            return Ok(());
        }
        gather::gather(&parts, &inspected, !self.no_figures)
    }
}

/// Rate and time left.
fn left(done: u64, all: u64, seconds: f64) -> String {
    let rate = done as f64 / seconds.max(1e-9);
    format!("{rate:.0} a second, {} left", duration((all - done) as f64 / rate))
}

/// A time in words.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{s:.1} s"),
        s if s < 5970.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
