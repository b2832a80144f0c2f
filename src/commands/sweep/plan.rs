//! `tune sweep plan`: what a sweep will compute, and files that run it on a cluster.

use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
    time::Instant,
};

use clap::Args;

use super::{
    super::{CommandError, terminal},
    begin, duration,
    gather::absolute,
    inspected,
};
use run_folder::place::write_file;
use sweep::{parts::SweepParts, plan::Plan, spec::SweepKind, springs::SpringsTable};

/// Shares unless said.
const SHARES: u64 = 8;

/// Options of `tune sweep plan`.
#[derive(Debug, Args)]
pub struct PlanOptions {
    /// Sweep file (TOML)
    sweep: PathBuf,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Shares of the work, no more than there are parts [default: 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    shards: Option<u64>,
    /// Write sweep.sbatch and gather.sbatch for Slurm, and commands.txt for PyLauncher, GNU
    /// parallel and their like
    #[arg(long)]
    slurm: bool,
    /// Threads of a share
    #[arg(long, value_name = "N", default_value_t = 1,
        value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: u16,
    /// Time limit of a share, as Slurm has it
    #[arg(long, value_name = "TIME", default_value = "02:00:00", requires = "slurm")]
    time: String,
    /// No progress
    #[arg(long)]
    quiet: bool,
}

pub fn run(o: &PlanOptions) -> Result<(), CommandError> {
    if o.time.is_empty() || !o.time.chars().all(|c| c.is_ascii_digit() || c == ':' || c == '-') {
        let remedy = "give minutes, or hours:minutes:seconds, as 02:00:00";
        return Err(CommandError::option("time", &o.time, remedy));
    }
    let plan = Plan::read(&o.sweep)?;
    let hash = inspected(&plan)?.hash;
    let springs = begin(&plan, &hash, &o.out, o.quiet)?;
    let parts = SweepParts::new(&plan, &o.out, &hash);
    let missing = parts.missing(0..plan.parts()).parts.len();
    terminal::stdout(format_args!(
        "{} cells: {} motions, {} structures, {} restitutions, {} levels; {} parts of {} cells, \
         {missing} missing; sweep {hash}\n",
        plan.cells(),
        plan.motions.len(),
        plan.subjects.len(),
        plan.restitution_count(),
        plan.levels.len(),
        plan.parts(),
        plan.part
    ))?;
    if !o.quiet {
        terminal::stderr(tried(&parts, springs.as_ref())?);
    }
    let shares = o.shards.unwrap_or(SHARES).min(plan.parts());
    if let Some(asked) = o.shards.filter(|asked| *asked > shares) {
        terminal::stderr(format_args!(
            "--shards {asked}: a share has one part of {} cells at least, so there are {shares}; \
             for more, write a smaller part under [sweep]",
            plan.part
        ));
    }
    let program = std::env::current_exe().unwrap_or_else(|_| PathBuf::from("tune"));
    let script = Script {
        program: quoted(&program)?,
        sweep: quoted(&absolute(&o.sweep))?,
        out: quoted(&absolute(&o.out))?,
        shares,
        jobs: o.jobs,
        time: &o.time,
    };
    write_file(&o.out.join("commands.txt"), script.commands().as_bytes())?;
    if o.slurm {
        write_file(&o.out.join("sweep.sbatch"), script.array().as_bytes())?;
        write_file(&o.out.join("gather.sbatch"), script.gather().as_bytes())?;
        write_file(&o.out.join("submit.sh"), script.submit().as_bytes())?;
        terminal::stderr(format_args!(
            "submit with: sh {}",
            terminal::shown(&o.out.join("submit.sh"))
        ));
    }
    terminal::written(&o.out);
    Ok(())
}

/// Places in a sweep at which cells are tried, and how many: as many as go in lock-step, or one
/// that is scanned.
const TRIED: (u64, u64, u64) = (3, 16, 1);

/// What the whole sweep takes, by some of its cells. A motion is made once for all of its cells,
/// which a cell by itself and more of the same motion tell apart.
fn tried(parts: &SweepParts, springs: Option<&SpringsTable>) -> Result<String, CommandError> {
    let (places, histories, scans) = TRIED;
    let plan = parts.plan;
    let (all, of_motion) = (plan.cells(), plan.cells_of_motion());
    let most = if plan.kind == SweepKind::Overturning { scans } else { histories };
    let seconds = |from: u64, to: u64| {
        let began = Instant::now();
        parts.rows(from..to, springs, &|_| {})?;
        Ok::<_, CommandError>(began.elapsed().as_secs_f64())
    };
    let (mut cells, mut motion, mut cell) = (0, 0.0, 0.0);
    for place in 0..places {
        let from = all * place / places / of_motion * of_motion;
        let count = most.min(of_motion).min(all - from);
        let one = seconds(from, from + 1)?;
        let more = if count > 1 { seconds(from, from + count)? } else { one };
        let each = if count > 1 { ((more - one) / (count - 1) as f64).max(0.0) } else { 0.0 };
        (motion, cell) = (motion + (one - each).max(0.0), cell + each);
        cells += count;
    }
    let motions = all.div_ceil(of_motion);
    let seconds = (motion * motions as f64 + cell * all as f64) / places as f64;
    Ok(format!("by {cells} cells tried on one core: about {} in all", duration(seconds)))
}

/// A word of a shell, within one line.
fn quoted(path: &Path) -> Result<String, CommandError> {
    let name = path.to_str().filter(|name| !name.contains(char::is_control));
    let name = name.ok_or_else(|| {
        let path = terminal::shown(path);
        CommandError::Result(format!(
            "{path}: no list of commands can name it; rename it without control characters"
        ))
    })?;
    Ok(format!("'{}'", name.replace('\'', "'\\''")))
}

/// All that the files for a cluster say.
struct Script<'a> {
    program: String,
    sweep: String,
    out: String,
    shares: u64,
    jobs: u16,
    time: &'a str,
}

impl Script<'_> {
    fn share(&self, index: &str) -> String {
        let Self { program, sweep, out, shares, jobs, .. } = self;
        format!(
            "{program} sweep {sweep} --out {out} --shard {index}/{shares} --jobs {jobs} --quiet"
        )
    }

    /// A line a share, then none to gather: launchers run lines in any order.
    fn commands(&self) -> String {
        let mut out = String::new();
        for index in 1..=self.shares {
            // writing to a String cannot fail
            let _ = writeln!(out, "{}", self.share(&index.to_string()));
        }
        out
    }

    /// The log stands where it is submitted, which is the folder: `#SBATCH` lines are no shell and
    /// quote no name.
    ///
    /// An array of at most a thousand tasks, as clusters allow by default; each computes every
    /// thousandth share from its own on.
    fn array(&self) -> String {
        let tasks = self.shares.min(1000);
        format!(
            "#!/bin/sh\n#SBATCH --job-name=tune-sweep\n#SBATCH --array=1-{tasks}\n\
             #SBATCH --cpus-per-task={}\n#SBATCH --time={}\n\
             #SBATCH --requeue\n#SBATCH --output=slurm-%A_%a.log\n\
             # parts are idempotent: a task that is killed or run twice leaves whole files, the \
             same ones\n\
             i=$SLURM_ARRAY_TASK_ID\n\
             while [ \"$i\" -le {} ]; do\n    {} || exit 1\n    i=$((i + {tasks}))\ndone\n",
            self.jobs,
            self.time,
            self.shares,
            self.share("\"$i\""),
        )
    }

    fn gather(&self) -> String {
        let Self { program, sweep, out, .. } = self;
        format!(
            "#!/bin/sh\n#SBATCH --job-name=tune-gather\n#SBATCH --time={}\n\
             #SBATCH --output=slurm-gather.log\n{program} sweep gather {sweep} --out {out}\n",
            self.time,
        )
    }

    /// afterany: a task that died must not keep the others' results waiting; gather says what is
    /// missing.
    fn submit(&self) -> String {
        format!(
            "#!/bin/sh\nset -e\ncd {}\njob=$(sbatch --parsable sweep.sbatch)\n\
             sbatch --dependency=afterany:\"$job\" gather.sbatch\necho \"array $job\"\n",
            self.out
        )
    }
}
