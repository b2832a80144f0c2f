//! Every job ends: by the bound on work, the same bytes on any number of threads; by a time limit
//! and ^C, and it is marked.

use std::process::Command;

use cases::Case;
use serde_json::Value;
use springs::job::{Job, JobError};
use strong_motion::Record;

#[path = "support/program.rs"]
mod program;

use program::{Ended, TestFolder, finding};

/// Light, with the inertia of a heavy one, and another restitution than equation 2's: a search over
/// all parameters.
const SLOW: &str = "[structure]\nkind = 'aframe'\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 2.0\n\
    rotational_inertia_kgm2 = 413464.8\nrestitution_ratio = 0.95\n\n[record]\nduration_s = 3.0\n";
const PIER: &str = include_str!("../tuning/pier.toml");

/// A run, without what takes time to write.
fn run(folder: &TestFolder, options: &str) -> Command {
    let line = format!("run {options} --quiet --no-figures --no-report");
    program::command(&folder.path(""), &line)
}

fn ended(folder: &TestFolder, options: &str) -> Ended {
    run(folder, options).output().unwrap().into()
}

fn folder_with(text: &str) -> TestFolder {
    TestFolder::with(&[("case.toml", text)])
}

/// What is in the folder of the results, which must be whole.
fn parameters(folder: &TestFolder) -> Value {
    let names: Vec<String> = std::fs::read_dir(folder.path("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(names.iter().all(|name| !name.contains("UNFINISHED")), "{names:?}");
    folder.json("out/parameters.json")
}

/// The finding of a search that was cut: a warning with what was not done and what to do.
fn cut(parameters: &Value, by: &str) {
    let cut =
        finding(parameters, "search_cut").unwrap_or_else(|| panic!("{:#}", parameters["findings"]));
    assert_eq!((cut["by"].as_str(), cut["weight"].as_str()), (Some(by), Some("warning")), "{cut}");
    assert!(
        cut["message"].as_str().unwrap().contains("not done: other springs")
            && cut["remedy"].is_string(),
        "{cut}"
    );
}

fn springs(parameters: &Value) -> f64 {
    parameters["vertical"]["k1_n_per_m"].as_f64().unwrap()
}

#[test]
fn a_search_that_meets_its_bound_has_the_same_bytes_on_one_thread_and_on_two() {
    let results = ["1", "2"].map(|threads| {
        let folder = folder_with(SLOW);
        let mut command = run(&folder, "case.toml --work 0.05");
        let ran = command.env("RAYON_NUM_THREADS", threads).output().unwrap();
        let ran = Ended::from(ran).well();
        let parameters = parameters(&folder);
        cut(&parameters, "work");
        assert!(springs(&parameters) > 0.0);
        let files = ["parameters.json", "history.csv", "members.csv", "decks/model_openseespy.py"];
        let bytes = files.map(|name| folder.bytes(&format!("out/{name}")));
        (bytes, ran.stdout)
    });
    assert!(results[0] == results[1]);
}

#[test]
fn a_tiny_bound_leaves_the_best_springs_so_far_and_says_what_was_not_done() {
    let folder = TestFolder::with(&[]);
    let ran = ended(&folder, "--work 1e-9").well();
    let found = parameters(&folder);
    cut(&found, "work");
    // one rung, measured on all suites
    let cut = finding(&found, "search_cut").unwrap();
    assert!(cut["stiffnesses"] == 1 && cut["reached"].as_f64().unwrap() > 0.0, "{cut}");
    assert!(ran.stdout.contains("The bound on work ended the search after 1 stiffness"));
    // more work, and nothing is cut
    ended(&folder, "--work 10").well();
    assert!(finding(&parameters(&folder), "search_cut").is_none());
}

#[test]
fn motions_whose_references_meet_their_bound_are_left_out_and_told() {
    let folder = folder_with(PIER);
    ended(&folder, "case.toml --work 0.02 --duration 5").well();
    let parameters = parameters(&folder);
    let told = finding(&parameters, "histories_unfinished")
        .unwrap_or_else(|| panic!("{:#}", parameters["findings"]));
    assert!(
        told["left_out"] == true
            && told["histories"].as_u64().unwrap() > 0
            && told["remedy"].is_string(),
        "{told}"
    );
    assert_eq!(parameters["springs"].as_array().unwrap().len(), 2);
}

#[test]
fn a_time_limit_ends_a_search_and_is_marked() {
    for text in [
        SLOW,
        PIER,
        "[structure]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n",
    ] {
        let folder = folder_with(text);
        let ran = ended(&folder, "case.toml --time-limit 0.001 --duration 3").well();
        let parameters = parameters(&folder);
        cut(&parameters, "time_limit");
        assert_eq!(parameters["assessment"]["reached"], false, "{text}");
        // what was cut is on the screen, and the springs are those of the file
        assert!(ran.stdout.contains("The time limit ended the search"), "{text}");
        assert!(folder.has("out/decks/model_openseespy.py"));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_whole_results_that_are_marked_and_an_exit_code_of_its_own() {
    use std::{os::unix::process::ExitStatusExt, process::Stdio, time::Duration};

    // however slow the machine: once the program has begun
    for wait in [0.5, 2.0, 8.0, 30.0] {
        let folder = folder_with(SLOW);
        let mut command = run(&folder, "case.toml --work 1e6");
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(Duration::from_secs_f64(wait));
        assert!(
            Command::new("kill")
                .args(["-INT", &child.id().to_string()])
                .status()
                .unwrap()
                .success()
        );
        let ended = child.wait_with_output().unwrap();
        if ended.status.signal().is_some() {
            // it had not begun: nothing is there
            assert!(!folder.has("out"));
            continue;
        }
        let Ended { code, stderr, .. } = ended.into();
        assert_eq!(code, Some(130), "{stderr}");
        assert!(stderr.contains("error: ^C ended the search; out has the best springs so far"));
        cut(&parameters(&folder), "interrupt");
        return;
    }
    panic!("it never began");
}

#[test]
fn what_is_out_of_reach_is_refused_early_with_the_reason() {
    let mut case = Case::paper().unwrap();
    let record = Record::new("long", 0.01, vec![0.1; 2_000_002]).unwrap();
    (case.record, case.duration_s) = (record, f64::INFINITY);
    let refused = Job::new(&case, &|_, _, _| ()).unwrap_err();
    assert!(
        matches!(refused, JobError::OutOfReach { steps: 2_000_001, most: 2_000_000, .. }),
        "{refused}"
    );

    let folder = folder_with(PIER);
    let said = ended(&folder, "case.toml --work 1e-4").refusal();
    assert!(said.contains("out of reach") && said.contains("--work"), "{said}");
    assert!(!folder.has("out"));
}

/// A block on a vertical motion of 1.84 g: what a deck ends early by is whole in the report, and
/// near landings the block bears what the springs' own forces say at that instant.
#[test]
fn a_deck_that_ends_early_is_told_in_the_report() {
    let (screen, report, folder) = vertical(0.45, 1.0);
    assert!(report.contains("Decks that are left out or end early"), "{screen}");
    assert!(report.contains("the motion can be predicted to 48.34 s"), "{screen}");
    assert!(screen.contains("axial compression  17.13 kN at 49.14 s"), "{screen}");
    let members = folder.text("out/members.csv");
    let row = members.lines().find(|row| row.starts_with("49.14")).unwrap();
    let axial: f64 = row.split(',').nth(2).unwrap().parse().unwrap();
    assert!((axial / -17.13e3 - 1.0).abs() < 1e-3, "{row}");
}

/// A block that lifts by nanometres: no model is compared on it. What springs for a program err on
/// earthquake-like motions is said unasked.
#[test]
fn a_motion_of_nanometres_is_not_called_rocking() {
    let (screen, ..) = vertical(1.2, 0.5);
    assert!(screen.contains("The structure lifts but hardly rocks"), "{screen}");
    assert!(!screen.contains("Ill-conditioned") && !screen.contains("1000 %"), "{screen}");
    assert!(screen.contains("it does not rock"), "{screen}");
    assert!(screen.contains("SAP2000   1 ms steps: ") && screen.contains("on earthquakes top "));
}

/// Screen and report of a block of 2.1 m and 640 kg on the record of Te Mara Farm, and the folder.
fn vertical(width: f64, scale: f64) -> (String, String, TestFolder) {
    let record = program::TE_MARA;
    let case = format!(
        "[structure]\nkind = 'block'\nheight_m = 1.05\nwidth_m = {width}\nmass_kg = 640\n\
         [record]\nfile = '{record}'\nvertical = 'auto'\nscale = {scale:?}\nduration_s = 90\n"
    );
    let folder = folder_with(&case);
    let screen = folder.runs("run case.toml --quiet --no-figures --no-front").stdout;
    let report = folder.text("out/report.html");
    // without the marks that keep numbers and units together
    let report = report.replace("<span class=\"q\">", "").replace("</span>", "");
    (screen, report, folder)
}

/// The paper's frame moves furthest at 9.59 s: cut shortly before, a record ends in the swing.
#[test]
fn a_record_cut_in_the_largest_swing_is_told() {
    let told = |duration: &str| {
        let folder = folder_with("");
        ended(&folder, &format!("--duration {duration}")).well();
        finding(&parameters(&folder), "cut_at_largest").is_some()
    };
    assert!(told("9.5") && !told("12"));
}

/// Without a case `tune housner` takes the structure of `tune run`, as `tune init` writes it.
#[test]
fn housner_s_solution_without_a_case_is_that_of_the_default_case() {
    let folder = TestFolder::with(&[("case.toml", include_str!("../tuning/paper.toml"))]);
    let peaks = |line: &str| folder.runs(line).stderr;
    assert_eq!(peaks("housner --out a.csv"), peaks("housner case.toml --out b.csv"));
    assert_eq!(folder.bytes("a.csv"), folder.bytes("b.csv"));
}

/// Springs so soft that no foot lifts before it overturns: it sways, and that is said, with what
/// it sinks, and that its springs are not to be used.
#[test]
fn a_structure_that_sways_on_soft_springs_is_not_said_to_rock() {
    let case = "[structure]\nkind = 'aframe'\nheight_m = 12.0\nwidth_m = 2.4\nmass_kg = 350e3\n\
        [tuning]\nmax_settlement_m = 1.0\n[record]\nduration_s = 10.0\n";
    let folder = folder_with(case);
    let run = "run case.toml --max-hz 1 --quiet --no-figures --no-front";
    let screen = folder.runs(run).stdout.replace('\n', " ");
    for told in ["its springs sways and never lifts", "NOT to be used: this record", "(rocking)"] {
        assert!(screen.contains(told), "{told}: {screen}");
    }
    let parameters = parameters(&folder);
    let sinks = finding(&parameters, "sinks_on_springs").unwrap();
    assert!(sinks["lifts_at_share"].as_f64().unwrap() > 1.0, "{sinks}");
}
