//! SciPy, Octave and OpenSees, each in a process of its own that times itself.

use std::{
    fmt::Write as _,
    io::Write as _,
    path::Path,
    process::{Command, Output, Stdio},
};

use serde::{Deserialize, Serialize};

use crate::{Peer, Point, TimedSeries, elements, rigid};
use decks::{DeckFormat, Expected, export};
use parameters::predictability::width_sensitivity;
use rocking::motion::Motion;

/// What housner.py reads.
#[derive(Serialize)]
struct Question<'a> {
    p2: f64,
    alpha: f64,
    e: f64,
    g: f64,
    dt: f64,
    accel: &'a [f64],
    methods: [&'static str; 2],
    rtols: &'a [f64],
    rounds: usize,
}

/// One of its answers.
#[derive(Deserialize)]
struct PeerAnswer {
    tool: String,
    rtol: f64,
    seconds: f64,
    theta: Vec<f64>,
}

/// SciPy's RK45 and DOP853, restarted at every sample.
pub fn scipy(
    problem: &rigid::RockingProblem,
    python: &Path,
    rtols: &[f64],
    rounds: usize,
) -> Vec<Peer> {
    let rigid::RockingProblem { body, record, .. } = problem;
    let question = Question {
        p2: body.p_squared(),
        alpha: body.alpha(),
        e: body.restitution(),
        g: rocking::scalar::GRAVITY,
        dt: record.dt,
        accel: &record.accel,
        methods: ["RK45", "DOP853"],
        rtols,
        rounds,
    };
    let asked = serde_json::to_vec(&question).map_err(|e| e.to_string());
    let answers: Result<Vec<PeerAnswer>, String> = asked
        .and_then(|stdin| {
            run(
                "SciPy",
                Command::new(python).args(["-c", include_str!("peers/housner.py")]),
                &stdin,
            )
        })
        .and_then(|stdout| serde_json::from_slice(&stdout).map_err(|e| format!("SciPy: {e}")));
    let answers = match answers {
        Ok(answers) => answers,
        Err(reason) => return vec![Err(reason)],
    };
    let points = |tool: &str| {
        let own = answers.iter().filter(|answer| answer.tool == tool);
        own.map(|a| point(problem, a.rtol, a.seconds, &a.theta)).collect()
    };
    let series = |tool: &str| {
        Ok(TimedSeries { tool: format!("{tool}, restarted at every sample"), points: points(tool) })
    };
    vec![series("SciPy RK45"), series("SciPy DOP853")]
}

/// Octave's ode45 with Events, the paper's tool.
pub fn octave(problem: &rigid::RockingProblem, rtols: &[f64], rounds: usize) -> Peer {
    let rigid::RockingProblem { body, record, .. } = problem;
    let folder = tempfile::tempdir().map_err(|e| format!("Octave: no temporary folder ({e})"))?;
    let [script, asked, answer] =
        ["housner.m", "asked.txt", "answer.txt"].map(|name| folder.path().join(name));
    let mut numbers = vec![
        body.p_squared(),
        body.alpha(),
        body.restitution(),
        rocking::scalar::GRAVITY,
        record.dt,
    ];
    numbers.extend([rounds as f64, rtols.len() as f64]);
    let text =
        numbers.iter().chain(rtols).chain(&record.accel).fold(String::new(), |mut text, x| {
            // writing to a String cannot fail
            let _ = writeln!(text, "{x:?}");
            text
        });
    let folder = |e: std::io::Error| format!("Octave: {e}");
    std::fs::write(&script, include_str!("peers/housner.m")).map_err(folder)?;
    std::fs::write(&asked, text).map_err(folder)?;
    let mut command = Command::new("octave-cli");
    run(
        "Octave",
        command.args(["--no-init-file", "--quiet"]).args([&script, &asked, &answer]),
        &[],
    )?;
    let text = std::fs::read_to_string(&answer).map_err(folder)?;
    let numbers: Vec<f64> = text.lines().filter_map(|line| line.trim().parse().ok()).collect();
    let blocks = numbers.chunks(1 + record.len());
    let points = rtols
        .iter()
        .zip(blocks)
        .map(|(&rtol, block)| point(problem, rtol, block[0], &block[1..]))
        .collect();
    Ok(TimedSeries { tool: "Octave ode45 with Events".into(), points })
}

fn point(problem: &rigid::RockingProblem, rtol: f64, seconds: f64, theta: &[f64]) -> Point {
    Point {
        setting: format!("rtol {rtol:.0e}"),
        seconds,
        error: problem.error(theta),
        note: String::new(),
    }
}

/// How OpenSees steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OpenSeesStepping {
    /// All steps alike, as an engineer's own deck would.
    Even,
    /// As the exported deck does: fine ones where a foot touches or lifts.
    Watched,
}

/// OpenSees' TRBDF2 on the exported deck, at `steps` per sample. Errors are told against our own
/// tight solution and, in the note, against OpenSees' own last run, which is to be the finest.
pub fn opensees(
    bench: &elements::BenchCase,
    tight: &Motion,
    python: &Path,
    stepping: OpenSeesStepping,
    steps: &[usize],
) -> Peer {
    let (word, told) = match stepping {
        OpenSeesStepping::Even => ("even", "even steps"),
        OpenSeesStepping::Watched => ("watched", "our deck"),
    };
    let history = bench.simulate(Default::default());
    let width_sensitivity = width_sensitivity(&history.motion, &bench.parameters(), &bench.record);
    let expected = Expected::new(&history, width_sensitivity);
    let folder = tempfile::tempdir().map_err(|e| format!("OpenSees: no temporary folder ({e})"))?;
    let text = export(&bench.parameters(), &bench.record, &expected, DeckFormat::OpenSeesPy)
        .map_err(|e| e.to_string())?;
    let deck = folder.path().join("deck.py");
    std::fs::write(&deck, text).map_err(|e| format!("OpenSees: {e}"))?;
    let mut command = Command::new(python);
    command
        .args(["-c", include_str!("peers/opensees.py")])
        .arg(&deck)
        .arg(word)
        .args(steps.iter().map(usize::to_string));
    let stdout = run("OpenSees", &mut command, &[])?;
    let runs: Vec<(usize, f64, Motion)> =
        String::from_utf8_lossy(&stdout).lines().filter_map(read_run).collect();
    let Some((_, _, finest)) = runs.last().filter(|run| !run.2.is_empty()) else {
        return Err("OpenSees: the analysis stopped at every time step".into());
    };
    let point = |(steps, seconds, motion): &(usize, f64, Motion)| Point {
        setting: format!("dt {:.0e}", bench.record.dt / *steps as f64),
        seconds: *seconds,
        // infinite if the analysis stopped on its way
        error: elements::error(motion, tight),
        note: match motion.len() {
            0 => "no convergence".into(),
            _ => format!("against its own finest {:.0e}", elements::error(motion, finest)),
        },
    };
    Ok(TimedSeries {
        tool: format!("OpenSees, {told}, {}", bench.name),
        points: runs.iter().map(point).collect(),
    })
}

/// "steps seconds file" and the history in the file; "steps seconds" and none if the analysis
/// stopped.
fn read_run(line: &str) -> Option<(usize, f64, Motion)> {
    let mut words = line.splitn(3, ' ');
    let (steps, seconds) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
    let mut motion = Motion::default();
    let Some(path) = words.next() else { return Some((steps, seconds, motion)) };
    for row in csv::Reader::from_path(path).ok()?.deserialize() {
        let (_, u, v, theta): (f64, f64, f64, f64) = row.ok()?;
        motion.u.push(u);
        motion.v.push(v);
        motion.theta.push(theta);
    }
    Some((steps, seconds, motion))
}

/// A tool's stdout, or one line that says why there is none.
fn run(tool: &str, command: &mut Command, stdin: &[u8]) -> Result<Vec<u8>, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let missing = |e| format!("{tool}: {name} cannot be run ({e})");
    // one thread, as we have
    command.envs([("OMP_NUM_THREADS", "1"), ("OPENBLAS_NUM_THREADS", "1")]);
    let result =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut child = result.map_err(missing)?;
    if let Some(mut pipe) = child.stdin.take() {
        // a tool that is not there does not read; its stderr tells
        let _ = pipe.write_all(stdin);
    }
    let Output { status, stdout, stderr } =
        child.wait_with_output().map_err(|e| format!("{tool}: {e}"))?;
    if status.success() {
        return Ok(stdout);
    }
    let complaint = String::from_utf8_lossy(&stderr);
    let last = complaint
        .lines()
        .rev()
        .map(str::trim)
        .find(|l| !l.is_empty() && !l.starts_with("Process 0"));
    Err(format!("{tool}: {}", last.unwrap_or("stopped without a word")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_analysis_that_stopped_has_no_history() {
        let (steps, seconds, motion) = read_run("10 0.25").unwrap();
        assert_eq!((steps, seconds, motion.len()), (10, 0.25, 0));
        assert!(read_run("10 0.25 no-such-file").is_none() && read_run("a word").is_none());
    }

    #[test]
    fn a_tool_that_is_not_installed_or_fails_is_one_line() {
        let nothing = Path::new("no-such-interpreter");
        let [Err(reason)] = &scipy(&rigid::RockingProblem::el_centro(), nothing, &[1e-6], 1)[..]
        else {
            panic!()
        };
        assert!(
            reason.starts_with("SciPy: no-such-interpreter cannot be run")
                && reason.lines().count() == 1
        );
        let bench = elements::BenchCase::plain(20.0);
        let reason = opensees(&bench, &Motion::default(), nothing, OpenSeesStepping::Even, &[1])
            .unwrap_err();
        assert!(reason.starts_with("OpenSees: no-such-interpreter cannot be run"), "{reason}");
        let failed = run("false", &mut Command::new("false"), &[]);
        assert_eq!(failed, Err("false: stopped without a word".into()));
    }
}
