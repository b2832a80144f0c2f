//! What `tune run` used is what later commands use, and what they say they use.

use std::{fs, path::Path, process::Output};

use serde_json::Value;
use strong_motion::Record;
use tempfile::TempDir;

#[path = "support/program.rs"]
mod program;

fn tune(dir: &Path, args: &[&str]) -> Output {
    let output = program::tune(dir, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A folder with a case beside a record in cm/s2: El Centro, 12 s of it.
fn folder() -> TempDir {
    let dir = TempDir::new().unwrap();
    let accel = Record::el_centro().truncated(12.0).accel;
    let column: String = accel.iter().map(|a| format!("{:e}\n", a * 100.0)).collect();
    fs::create_dir(dir.path().join("motions")).unwrap();
    fs::write(dir.path().join("motions/centro.txt"), format!("# units: cm/s2\n{column}")).unwrap();
    let case = "[structure]\nkind = \"aframe\"\nheight_m = 61.0\nwidth_m = 12.2\n\
        mass_kg = 680.1e3\n[record]\nfile = \"motions/centro.txt\"\ndt_s = 0.01\nscale = 1.5\n\
        duration_s = 8.0\n[tuning]\nobjective = \"arr\"\nmax_omega_hz = 40.0\ncandidates = 2\n";
    fs::write(dir.path().join("case.toml"), case).unwrap();
    dir
}

const RUN: [&str; 6] = ["run", "case.toml", "--quiet", "--no-figures", "--no-front", "--out"];

/// What a run prints, its lines joined.
fn screen(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn record_scale_and_duration_are_remembered_until_told_otherwise() {
    let dir = folder();
    let run = tune(dir.path(), &[&RUN[..], &["out"]].concat());
    let used = "scale 1.5, 8 of 12 s, step 0.01 s, PGA 0.46";
    assert!(screen(&run).contains(used), "{}", screen(&run));
    let parameters = json(&fs::read(dir.path().join("out/parameters.json")).unwrap());
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
    let elsewhere = dir.path().join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    let simulate = ["simulate", "--parameters", "../out/parameters.json"];
    let output = tune(&elsewhere, &simulate);
    let used = "scale 1.5, first 8 s of 12 s: 801 samples of 0.01 s, PGA 0.46";
    assert!(stderr(&output).contains(used), "{}", stderr(&output));
    let found = json(&output.stdout);
    for key in
        ["duration_s", "nrmse_horizontal", "nrmse_vertical", "impacts_fem", "peak_horizontal_fem_m"]
    {
        assert_eq!(found[key], parameters["match"][key], "{key}");
    }
    let export = [
        "export",
        "--parameters",
        "../out/parameters.json",
        "--format",
        "markdown",
        "--out",
        "springs.md",
    ];
    assert!(stderr(&tune(&elsewhere, &export)).contains(used));

    // a scale replaces the remembered one, and another record comes whole and unscaled
    let again =
        stderr(&tune(&elsewhere, &[&simulate[..], &["--scale", "1", "--duration", "6"]].concat()));
    assert!(
        again.contains("centro.txt, in cm/s2), scale 1, first 6 s of 12 s: 601 samples"),
        "{again}"
    );
    let other = ["--record", "../motions/centro.txt", "--dt", "0.01"];
    let other = stderr(&tune(&elsewhere, &[&simulate[..], &other].concat()));
    assert!(other.contains("scale 1, all 12 s: 1201 samples"), "{other}");
}

/// A sheet comes with the ground motion that it names; a sheet of another motion is not written
/// beside it, and has Housner's answer to it elsewhere.
#[test]
fn a_sheet_brings_its_ground_motion_and_leaves_that_of_another() {
    let dir = folder();
    tune(dir.path(), &[&RUN[..], &["out"]].concat());
    let sheet = ["export", "--parameters", "out/parameters.json", "--format", "sap2000-sheet"];
    tune(dir.path(), &[&sheet[..], &["--out", "sheets/"]].concat());
    let read = |path: &str| fs::read(dir.path().join(path)).unwrap();
    for file in ["sap2000_by_hand.txt", "ground_motion.txt"] {
        assert_eq!(read(&format!("sheets/{file}")), read(&format!("out/decks/{file}")), "{file}");
    }
    // tables under their own names, too
    for (stepping, file) in [("events", "springs.csv"), ("even", "springs_even.csv")] {
        let table = ["export", "--parameters", "out/parameters.json", "--format", "csv"];
        let rest = ["--stepping", stepping, "--out", "sheets/"];
        tune(dir.path(), &[&table[..], &rest].concat());
        assert_eq!(read(&format!("sheets/{file}")), read(&format!("out/decks/{file}")), "{file}");
    }
    let other = [&sheet[..], &["--scale", "0.5", "--out", "sheets/half.txt"]].concat();
    let output = program::tune(dir.path(), &other);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is not the ground motion of this sheet"), "{output:?}");
    assert!(!dir.path().join("sheets/half.txt").exists());
    assert_eq!(read("sheets/ground_motion.txt"), read("out/decks/ground_motion.txt"));
    let other = [&sheet[..], &["--scale", "0.9", "--out", "other/"]].concat();
    tune(dir.path(), &other);
    let housner = |path: &str| {
        let sheet = String::from_utf8(read(path)).unwrap();
        sheet.lines().find(|line| line.trim_start().starts_with("Housner:")).map(str::to_string)
    };
    let [own, scaled] = ["sheets", "other"].map(|f| housner(&format!("{f}/sap2000_by_hand.txt")));
    assert!(own.is_some() && scaled.is_some() && own != scaled, "{own:?} {scaled:?}");
    // SAP2000 takes no steps that follow touches
    let events = [&sheet[..], &["--stepping", "events", "--out", "events/"]].concat();
    let output = program::tune(dir.path(), &events);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("give --stepping even"), "{output:?}");
    assert!(!dir.path().join("events").exists());
}

#[test]
fn a_scale_on_the_command_line_replaces_the_cases() {
    let dir = folder();
    let run = tune(dir.path(), &[&RUN[..], &["given", "--scale", "1.5"]].concat());
    assert!(screen(&run).contains("scale 1.5, 8 of 12 s, step 0.01 s"), "{}", screen(&run));
    let plain = tune(dir.path(), &[&RUN[..], &["plain"]].concat());
    // the same screen but for the folder in its commands
    assert_eq!(screen(&run).replace("given/", "F/"), screen(&plain).replace("plain/", "F/"));
    let doubled =
        stderr(&tune(dir.path(), &["housner", "case.toml", "--scale", "2", "--out", "h.csv"]));
    assert!(doubled.contains("scale 2, first 8 s of 12 s: 801 samples"), "{doubled}");
}

#[test]
fn the_paper_case_keeps_its_20_s_and_any_other_record_is_used_whole() {
    let dir = folder();
    let paper = stderr(&tune(dir.path(), &["housner", "--out", "h.csv"]));
    let used = "record IELC180 (embedded), scale 1, first 20 s of 39.94 s: 2001 samples of 0.01 s, \
        PGA 0.3129 g at ";
    assert!(paper.contains(used), "{paper}");
    let other = ["housner", "--record", "motions/centro.txt", "--dt", "0.01", "--out", "h.csv"];
    let other = stderr(&tune(dir.path(), &other));
    assert!(other.contains("centro.txt, in cm/s2), scale 1, all 12 s: 1201 samples"), "{other}");
}

/// A steady push of 0.15 g topples the frame, which passes alpha after acosh(3)/p = 4.4 s and lies
/// flat after some 11 s: nothing after the first is counted, and no number printed is without
/// meaning.
#[test]
fn a_body_that_overturns_is_compared_up_to_there() {
    let dir = folder();
    tune(dir.path(), &[&RUN[..], &["out"]].concat());
    fs::write(dir.path().join("push.txt"), "1.4715\n".repeat(2000)).unwrap();
    let push = ["--record", "push.txt", "--dt", "0.01", "--units", "m/s2"];
    let output = tune(
        dir.path(),
        &[&["simulate", "--parameters", "out/parameters.json"][..], &push].concat(),
    );
    let (found, said) = (json(&output.stdout), stderr(&output));
    let time = found["overturned_housner_s"].as_f64().unwrap();
    assert!((time - 4.4).abs() < 0.1 && found["duration_s"].as_f64().unwrap() <= time, "{found}");
    // from rest to alpha: h sin(alpha) + b (1 - cos(alpha)) = 6.1 m is the most that counts
    assert!(found["peak_horizontal_housner_m"].as_f64().unwrap().abs() < 6.1, "{found}");
    assert!(found["nrmse_horizontal"].as_f64().unwrap() < 2.0, "{found}");
    assert!(
        said.contains("the structure overturns at t = ")
            && said.contains("numbers count up to then"),
        "{said}"
    );
    assert!(!said.contains("inf") && !said.contains("NaN"), "{said}");
}

#[test]
fn springs_are_made_without_a_record_and_are_those_that_a_record_too_weak_to_lift_gives() {
    let dir = folder();
    let run = tune(dir.path(), &["run", "--no-record", "--quiet", "--out", "none"]);
    assert!(stderr(&run).contains("no record"), "{}", stderr(&run));
    let weak = ["run", "--scale", "0.1", "--quiet", "--no-figures", "--no-front", "--out", "weak"];
    let output = tune(dir.path(), &weak);
    assert!(
        String::from_utf8_lossy(&output.stdout).contains("does not lift the structure"),
        "{output:?}"
    );
    let read =
        |folder: &str| json(&fs::read(dir.path().join(folder).join("parameters.json")).unwrap());
    let (none, weak) = (read("none"), read("weak"));
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
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20180212_211557_WPWS_20.V2A");
    let more = ["out", "--record", record, "--scale", "20"];
    tune(dir.path(), &[&RUN[..], &more].concat());
    let parameters = "out/parameters.json";
    let export = ["export", "--parameters", parameters, "--format", "openseespy", "--out", "a.py"];
    let told = |more: &[&str]| stderr(&tune(dir.path(), &[&export[..], more].concat()));
    let own = told(&[]);
    assert!(!own.contains("CHECK") && !own.contains("vertical"), "{own}");
    let vertical = told(&["--vertical", "auto"]);
    assert!(vertical.contains("S74E") && vertical.contains("vertical"), "{vertical}");
    let other = told(&["--component", "S16W"]);
    assert!(other.contains("S16W"), "{other}");
    let short = told(&["--duration", "0.5"]);
    assert!(short.contains("CHECK ") && short.contains("use more of the record"), "{short}");
}

/// A deck does not replace what it is made from.
#[test]
fn what_is_read_is_not_written_over() {
    let dir = folder();
    tune(dir.path(), &[&RUN[..], &["out"]].concat());
    for (out, what) in [
        ("out/../out/parameters.json", "is a file that this command reads"),
        ("motions/centro.txt", "is a file that this command reads"),
        ("case.toml", "is a case file"),
    ] {
        let before = fs::read(dir.path().join(out)).unwrap();
        let export =
            ["export", "--parameters", "out/parameters.json", "--format", "csv", "--out", out];
        let refused = program::tune(dir.path(), &export);
        assert_eq!(refused.status.code(), Some(2));
        let told = stderr(&refused);
        assert!(told.contains(what) && told.contains("name another file with --out"), "{told}");
        assert_eq!(fs::read(dir.path().join(out)).unwrap(), before);
    }
}
