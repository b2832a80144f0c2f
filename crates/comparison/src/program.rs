//! The program as its user starts it: `tune run`, `tune validate`, and the inner fit that both
//! build on.

use std::{
    ffi::OsStr,
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use crate::{least, skips::Skip};
use frequency_response::{
    bounds::Bounds,
    inner::{FitError, fit},
    target::Target,
};

/// A run of the program.
#[derive(Clone, Debug)]
pub struct ProgramRun {
    /// Its words, as "run --no-front".
    pub what: String,
    pub seconds: f64,
    /// Most memory it held (MB); none where the system does not tell.
    pub memory: Option<f64>,
}

/// Time of one inner fit with its certificate, for mass ratios of the paper's case: (mu, seconds).
///
/// # Errors
/// A fit fails.
pub fn fits(rounds: usize) -> Result<Vec<(f64, f64)>, FitError> {
    let (target, bounds) = (Target::default(), Bounds::default());
    let one = |mu: f64| {
        let (seconds, found) = least(rounds, || fit(mu, &target, &bounds));
        found.map(|_| (mu, seconds))
    };
    [0.1, 0.3, 1.0, 2.0, 10.0].into_iter().map(one).collect()
}

/// What the program took, and what it saves by leaving out what not everyone wants.
#[derive(Clone, Debug, Default)]
pub struct Jobs {
    pub runs: Vec<ProgramRun>,
    pub skips: Vec<Skip>,
}

/// The whole job, with and without what not everyone wants, then its springs judged over ever more
/// records.
///
/// # Errors
/// The program fails; one line says where.
pub fn jobs(program: &Path, records: &[usize], rounds: usize) -> Result<Jobs, String> {
    let folder = tempfile::tempdir().map_err(|e| format!("tune: no temporary folder ({e})"))?;
    let out = folder.path();
    let parameters = out.join("parameters.json");
    let mut jobs = Jobs::default();
    let mut springs = Vec::new();
    for what in ["run", "run --no-figures", "run --no-front", "run --no-front --no-figures"] {
        jobs.runs.push(fastest(rounds, || run(program, what, &[], out))?);
        springs.push(
            std::fs::read(&parameters)
                .map_err(|e| format!("tune {what}: {}: {e}", parameters.display()))?,
        );
    }
    for (what, without, with) in
        [("figures (tune run --no-figures)", 0, 1), ("front (tune run --no-front)", 0, 2)]
    {
        let same =
            if springs[without] == springs[with] { "the same bytes" } else { "DIFFERENT bytes" };
        jobs.skips.push(Skip {
            what,
            with: jobs.runs[with].seconds,
            without: jobs.runs[without].seconds,
            same: format!("{same} in parameters.json"),
        });
    }
    let given = [OsStr::new("--parameters"), parameters.as_os_str()];
    let most = records.last().copied().unwrap_or_default();
    let mut judge = |records: usize, threads: usize| {
        let what = format!("validate --synthetic {records} --no-figures --jobs {threads}");
        run(program, &what, &given, out).map(|run| jobs.runs.push(run))
    };
    for &records in records {
        judge(records, 2)?;
    }
    judge(most, 1)?;
    Ok(jobs)
}

fn fastest(
    rounds: usize,
    run: impl Fn() -> Result<ProgramRun, String>,
) -> Result<ProgramRun, String> {
    let mut best = run()?;
    for _ in 1..rounds {
        let next = run()?;
        if next.seconds < best.seconds {
            best = next;
        }
    }
    Ok(best)
}

/// Run the program with the words of `what` and more arguments, results into a folder.
fn run(program: &Path, what: &str, more: &[&OsStr], out: &Path) -> Result<ProgramRun, String> {
    let failed = |e: std::io::Error| format!("tune {what}: {e}");
    let mut command = Command::new(program);
    command.args(what.split(' ')).args(more).arg("--quiet").arg("--out").arg(out);
    let began = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .map_err(failed)?;
    let mut memory = None;
    loop {
        memory = peak_memory(&child).or(memory);
        match child.try_wait().map_err(failed)? {
            Some(status) if status.success() => break,
            Some(status) => return Err(format!("tune {what}: {status}")),
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    }
    Ok(ProgramRun { what: what.into(), seconds: began.elapsed().as_secs_f64(), memory })
}

/// Most memory a running process has held (MB), where /proc tells.
fn peak_memory(child: &Child) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kb| kb / 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_fails_or_is_not_there_is_one_line() {
        let reason = jobs(Path::new("no-such-program"), &[1], 1).unwrap_err();
        assert!(reason.starts_with("tune run: ") && reason.lines().count() == 1);
        assert!(
            jobs(Path::new("false"), &[1], 1).unwrap_err().starts_with("tune run: exit status")
        );
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_run_tells_its_time_and_memory() {
        let run =
            run(Path::new("sh"), "-c sleep${IFS}0.05;true", &[], Path::new("nowhere")).unwrap();
        assert!(run.seconds >= 0.05 && run.memory.is_some_and(|mb| mb > 0.1));
    }
}
