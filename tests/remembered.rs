//! What `tune run` used is what later commands use, and what they say they use.

use serde_json::Value;
use strong_motion::Record;

#[path = "support/program.rs"]
mod program;

use program::{Ended, TestFolder};

/// A folder with a case beside a record in cm/s2: El Centro, 12 s of it.
fn folder() -> TestFolder {
    let accel = Record::el_centro().truncated(12.0).accel;
    let column: String = accel.iter().map(|a| format!("{:e}\n", a * 100.0)).collect();
    let case = "[structure]\nkind = \"aframe\"\nheight_m = 61.0\nwidth_m = 12.2\n\
        mass_kg = 680.1e3\n[record]\nfile = \"motions/centro.txt\"\ndt_s = 0.01\nscale = 1.5\n\
        duration_s = 8.0\n[tuning]\nobjective = \"arr\"\nmax_omega_hz = 40.0\ncandidates = 2\n";
    TestFolder::with(&[
        ("motions/", ""),
        ("motions/centro.txt", &format!("# units: cm/s2\n{column}")),
        ("case.toml", case),
    ])
}

/// The same, and the case's run in `out`.
fn folder_of_run() -> TestFolder {
    let folder = folder();
    folder.runs(&format!("{RUN} out"));
    folder
}

const RUN: &str = "run case.toml --quiet --no-figures --no-front --out";
const EXPORT: &str = "export --parameters out/parameters.json";

/// What a run prints, its lines joined.
fn screen(ended: &Ended) -> String {
    ended.stdout.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn record_scale_and_duration_are_remembered_until_told_otherwise() {
    let dir = folder();
    let run = dir.runs(&format!("{RUN} out"));
    let used = "scale 1.5, 8 of 12 s, step 0.01 s, PGA 0.46";
    assert!(screen(&run).contains(used), "{}", screen(&run));
    let parameters = dir.json("out/parameters.json");
    let row = &parameters["record"];
    assert_eq!(
        (&parameters["schema"], &row["scale"], &row["duration_s"]),
        (&4.into(), &1.5.into(), &8.0.into())
    );
    assert_eq!(
        (&row["source"]["path"], &row["source"]["units"]),
        (&"../motions/centro.txt".into(), &"cm/s2".into())
    );
    assert!(parameters["conditioning"]["well_conditioned"].is_boolean());

    // from elsewhere, with nothing said
    dir.write("elsewhere/", "");
    let elsewhere = |line: &str| {
        let (command, more) = line.split_once(' ').unwrap_or((line, ""));
        let line = format!("{command} --parameters ../out/parameters.json {more}");
        program::tune(&dir.path("elsewhere"), &line).well()
    };
    let Ended { stdout, stderr, .. } = elsewhere("simulate");
    let used = "scale 1.5, first 8 s of 12 s: 801 samples of 0.01 s, PGA 0.46";
    assert!(stderr.contains(used), "{stderr}");
    let found: Value = serde_json::from_str(&stdout).unwrap();
    for key in
        ["duration_s", "nrmse_horizontal", "nrmse_vertical", "impacts_fem", "peak_horizontal_fem_m"]
    {
        assert_eq!(found[key], parameters["match"][key], "{key}");
    }
    assert!(elsewhere("export --format markdown --out springs.md").stderr.contains(used));

    // a scale replaces the remembered one, and another record comes whole and unscaled
    let again = elsewhere("simulate --scale 1 --duration 6").stderr;
    let used = "centro.txt, in cm/s2), scale 1, first 6 s of 12 s: 601 samples";
    assert!(again.contains(used), "{again}");
    let other = elsewhere("simulate --record ../motions/centro.txt --dt 0.01").stderr;
    assert!(other.contains("scale 1, all 12 s: 1201 samples"), "{other}");
}

/// A sheet comes with the ground motion that it names; a sheet of another motion is not written
/// beside it, and has Housner's answer to it elsewhere.
#[test]
fn a_sheet_brings_its_ground_motion_and_leaves_that_of_another() {
    let dir = folder_of_run();
    let sheet = |more: &str| format!("{EXPORT} --format sap2000-sheet {more}");
    dir.runs(&sheet("--out sheets/"));
    let same = |file: &str| {
        let [own, deck] = ["sheets", "out/decks"].map(|f| dir.bytes(&format!("{f}/{file}")));
        assert!(own == deck, "{file}");
    };
    same("sap2000_by_hand.txt");
    same("ground_motion.txt");
    // tables under their own names, too
    for (stepping, file) in [("events", "springs.csv"), ("even", "springs_even.csv")] {
        dir.runs(&format!("{EXPORT} --format csv --stepping {stepping} --out sheets/"));
        same(file);
    }
    let refused = dir.refuses(&sheet("--scale 0.5 --out sheets/half.txt"));
    assert!(refused.contains("is not the ground motion of this sheet"), "{refused}");
    assert!(!dir.has("sheets/half.txt"));
    same("ground_motion.txt");
    dir.runs(&sheet("--scale 0.9 --out other/"));
    let housner = |folder: &str| {
        let sheet = dir.text(&format!("{folder}/sap2000_by_hand.txt"));
        sheet.lines().find(|line| line.trim_start().starts_with("Housner:")).map(str::to_string)
    };
    let [own, scaled] = ["sheets", "other"].map(housner);
    assert!(own.is_some() && scaled.is_some() && own != scaled, "{own:?} {scaled:?}");
    // SAP2000 takes no steps that follow touches
    let refused = dir.refuses(&sheet("--stepping events --out events/"));
    assert!(refused.contains("give --stepping even"), "{refused}");
    assert!(!dir.has("events"));
}

#[test]
fn a_scale_on_the_command_line_replaces_the_cases() {
    let dir = folder();
    let given = screen(&dir.runs(&format!("{RUN} given --scale 1.5")));
    assert!(given.contains("scale 1.5, 8 of 12 s, step 0.01 s"), "{given}");
    let plain = screen(&dir.runs(&format!("{RUN} plain")));
    // the same screen but for the folder in its commands
    assert_eq!(given.replace("given/", "F/"), plain.replace("plain/", "F/"));
    let doubled = dir.runs("housner case.toml --scale 2 --out h.csv").stderr;
    assert!(doubled.contains("scale 2, first 8 s of 12 s: 801 samples"), "{doubled}");
}

#[test]
fn the_paper_case_keeps_its_20_s_and_any_other_record_is_used_whole() {
    let dir = folder();
    let paper = dir.runs("housner --out h.csv").stderr;
    let used = "record IELC180 (embedded), scale 1, first 20 s of 39.94 s: 2001 samples of 0.01 s, \
        PGA 0.3129 g at ";
    assert!(paper.contains(used), "{paper}");
    let other = dir.runs("housner --record motions/centro.txt --dt 0.01 --out h.csv").stderr;
    assert!(other.contains("centro.txt, in cm/s2), scale 1, all 12 s: 1201 samples"), "{other}");
}

/// A steady push of 0.15 g topples the frame, which passes alpha after acosh(3)/p = 4.4 s and lies
/// flat after some 11 s: nothing after the first is counted, and no number printed is without
/// meaning.
#[test]
fn a_body_that_overturns_is_compared_up_to_there() {
    let dir = folder_of_run();
    dir.write("push.txt", "1.4715\n".repeat(2000));
    let push = "--record push.txt --dt 0.01 --units m/s2";
    let Ended { stdout, stderr: said, .. } =
        dir.runs(&format!("simulate --parameters out/parameters.json {push}"));
    let found: Value = serde_json::from_str(&stdout).unwrap();
    let time = found["overturned_housner_s"].as_f64().unwrap();
    assert!((time - 4.4).abs() < 0.1 && found["duration_s"].as_f64().unwrap() <= time, "{found}");
    // from rest to alpha: h sin(alpha) + b (1 - cos(alpha)) = 6.1 m is the most that counts
    assert!(found["peak_horizontal_housner_m"].as_f64().unwrap().abs() < 6.1, "{found}");
    assert!(found["nrmse_horizontal"].as_f64().unwrap() < 2.0, "{found}");
    for words in ["the structure overturns at t = ", "numbers count up to then"] {
        assert!(said.contains(words), "{said}");
    }
    assert!(!said.contains("inf") && !said.contains("NaN"), "{said}");
}

#[test]
fn springs_are_made_without_a_record_and_are_those_that_a_record_too_weak_to_lift_gives() {
    let dir = folder();
    let run = dir.runs("run --no-record --quiet --out none").stderr;
    assert!(run.contains("no record"), "{run}");
    let weak = dir.runs("run --scale 0.1 --quiet --no-figures --no-front --out weak").stdout;
    assert!(weak.contains("does not lift the structure"), "{weak}");
    let [none, weak] = ["none", "weak"].map(|f| dir.json(&format!("{f}/parameters.json")));
    for key in ["vertical", "horizontal", "assessment", "landings"] {
        assert_eq!(none[key], weak[key], "{key}");
    }
    assert!(none.get("record").is_none() && none.get("match").is_none());
    assert!(none["assessment"]["reached"].as_bool().unwrap());
}

/// What is said of a file without `--record` is said of the run's own; a weak part is told of.
#[test]
fn the_own_record_is_read_again_as_the_options_say() {
    let dir = folder();
    dir.runs(&format!("{RUN} out --record '{}' --scale 20", program::WAIPAWA));
    let told =
        |more: &str| dir.runs(&format!("{EXPORT} --format openseespy --out a.py {more}")).stderr;
    let own = told("");
    assert!(!own.contains("CHECK") && !own.contains("vertical"), "{own}");
    let vertical = told("--vertical auto");
    assert!(vertical.contains("S74E") && vertical.contains("vertical"), "{vertical}");
    let other = told("--component S16W");
    assert!(other.contains("S16W"), "{other}");
    let short = told("--duration 0.5");
    assert!(short.contains("CHECK ") && short.contains("use more of the record"), "{short}");
}

/// A deck does not replace what it is made from.
#[test]
fn what_is_read_is_not_written_over() {
    let dir = folder_of_run();
    for (out, what) in [
        ("out/../out/parameters.json", "is a file that this command reads"),
        ("motions/centro.txt", "is a file that this command reads"),
        ("case.toml", "is a case file"),
    ] {
        let before = dir.bytes(out);
        let told = dir.refuses(&format!("{EXPORT} --format csv --out {out}"));
        assert!(told.contains(what) && told.contains("name another file with --out"), "{told}");
        assert_eq!(dir.bytes(out), before);
    }
}
