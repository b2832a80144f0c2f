//! `tune validate` and the conditioning report, through the program.

use std::{fs, path::Path, process::Output};

use dynamics::spring::{Design, Springs};
use parameters::Parameters;
use rocking::structure::Structure;
use serde_json::Value;
use strong_motion::Record;
use tempfile::TempDir;

#[path = "support/program.rs"]
mod program;

use program::tune;

/// A folder with parameters.json (the paper's frame on springs of 160 Hz) and a folder of two
/// records.
fn folder() -> TempDir {
    let dir = TempDir::new().unwrap();
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 = 1e-5 * structure.mass_kg * structure.height_m.powi(2);
    let springs = Springs {
        vertical: Design::from_kc(0.3, 0.1, 0.75, 160.0),
        horizontal: Design::from_kc(0.3, 0.57, 1.86, 160.0),
    };
    fs::write(dir.path().join("parameters.json"), Parameters::new(structure, &springs).to_json())
        .unwrap();
    let records = dir.path().join("records");
    fs::create_dir(&records).unwrap();
    let accel = Record::el_centro().truncated(6.0).accel;
    let column: String = accel.iter().map(|a| format!("{}\n", a / 9.81)).collect();
    fs::write(records.join("centro.txt"), column).unwrap();
    fs::write(records.join("weak.txt"), "0\n0.01\n-0.02\n0\n").unwrap();
    dir
}

fn validate(dir: &Path, more: &[&str]) -> Output {
    let args = ["validate", "--parameters", "parameters.json", "--quiet"];
    tune(dir, &[&args, more].concat())
}

const FILES: [&str; 4] = ["validate.json", "validate.md", "validate.csv", "validation.png"];
const RECORDS: [&str; 6] = ["--records", "records", "--dt", "0.01", "--units", "g"];

#[test]
fn the_results_are_the_same_bytes_whatever_the_number_of_threads() {
    let dir = folder();
    for jobs in ["1", "2"] {
        let more =
            ["--synthetic", "6", "--seed", "3", "--duration", "20", "--jobs", jobs, "--out", jobs];
        let output = validate(dir.path(), &[&RECORDS[..], &more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    for file in FILES {
        let read = |jobs: &str| fs::read(dir.path().join(jobs).join(file)).unwrap();
        assert!(!read("1").is_empty() && read("1") == read("2"), "{file}");
    }
}

#[test]
fn files_come_first_in_the_order_of_their_names_and_the_fields_are_those_promised() {
    let dir = folder();
    let output =
        validate(dir.path(), &[&RECORDS[..], &["--synthetic", "1", "--no-figures"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let stdout = String::from_utf8(output.stdout).unwrap();
    assert!(stdout.contains("KS distance of the peak rotations"), "{stdout}");
    assert!(!dir.path().join("out/validation.png").exists());

    let all: Value =
        serde_json::from_slice(&fs::read(dir.path().join("out/validate.json")).unwrap()).unwrap();
    let rows = all["records"].as_array().unwrap();
    let names: Vec<&str> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["centro", "weak", "ricker-0000"]);
    let (centro, weak) = (&rows[0], &rows[1]);
    for number in [
        "pga_g",
        "sensitivity",
        "nrmse_horizontal",
        "nrmse_vertical",
        "peak_ratio_housner",
        "peak_ratio_fem",
    ] {
        assert!(centro[number].as_f64().is_some_and(|x| x > 0.0), "{number}: {centro}");
    }
    assert_eq!(
        (&centro["overturned_housner"], &centro["overturned_fem"]),
        (&false.into(), &false.into())
    );
    assert_eq!(
        (&weak["outcome"], &weak["nrmse_horizontal"]),
        (&"never_lifted".into(), &Value::Null)
    );
    assert_eq!((&weak["peak_ratio_housner"], &weak["peak_ratio_fem"]), (&0.0.into(), &0.0.into()));
    assert!(all["ks_distance"].is_f64() && all["overturning_agreement"].is_f64());
    assert!(all["nrmse_well_conditioned"]["count"].as_u64().is_some_and(|n| n >= 1));
    assert!(
        all["nrmse_well_conditioned"]["median"].is_f64()
            && all["nrmse_well_conditioned"]["p90"].is_f64()
    );
    let csv = fs::read_to_string(dir.path().join("out/validate.csv")).unwrap();
    assert!(
        csv.starts_with("name,outcome,duration_s,pga_g,sensitivity,nrmse_horizontal,"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 4);
}

fn refuses(more: &[&str], words: &[&str]) {
    let dir = folder();
    fs::write(dir.path().join("records/zz.txt"), "0.1\n0.2\nx\n").unwrap();
    let output = validate(dir.path(), more);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert_eq!(stderr.trim_end().lines().count(), 1, "{stderr}");
    for word in words {
        assert!(stderr.contains(word), "{stderr:?} does not say {word:?}");
    }
    assert!(output.stdout.is_empty() && !dir.path().join("out").exists());
}

#[test]
fn files_and_folders_are_named_without_an_option_and_what_cannot_be_read_is_said_and_left_out() {
    let dir = folder();
    let records = dir.path().join("records");
    fs::write(records.join("zz.txt"), "0.1\n0.2\nx\n").unwrap();
    fs::copy(records.join("weak.txt"), dir.path().join("one.txt")).unwrap();
    // a file that is named twice counts once
    let more = [
        "one.txt",
        "records",
        "nowhere.at2",
        "one.txt",
        "--dt",
        "0.01",
        "--units",
        "g",
        "--no-figures",
    ];
    let output = validate(dir.path(), &more);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{stderr}");
    let said: Vec<&str> = stderr.lines().filter(|line| line.starts_with("left out: ")).collect();
    assert!(
        said.len() == 2 && said[0].contains("zz.txt, line 3") && said[1].contains("nowhere.at2"),
        "{stderr}"
    );
    let stdout = String::from_utf8(output.stdout).unwrap();
    assert!(stdout.starts_with("records: 3 from files (2 left out)\n"), "{stdout}");
    let all: Value =
        serde_json::from_slice(&fs::read(dir.path().join("out/validate.json")).unwrap()).unwrap();
    let names: Vec<&str> = all["records"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["one", "centro", "weak"]);
    let left_out: Vec<&str> = all["left_out"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["file"].as_str().unwrap())
        .collect();
    assert_eq!(left_out, ["records/zz.txt", "nowhere.at2"]);
}

#[test]
fn motions_made_beside_files_are_said_to_be() {
    let dir = folder();
    let more = [
        "--synthetic",
        "2",
        "--earthquakes",
        "1",
        "--seed",
        "7",
        "--duration",
        "5",
        "--no-figures",
    ];
    let output = validate(dir.path(), &[&RECORDS[..], &more].concat());
    let stdout = String::from_utf8(output.stdout).unwrap();
    let line = "records: 2 from files, 2 synthetic of seed 7, 1 earthquake-like of seed 7";
    assert!(
        stdout.starts_with(&format!("{line}\n")) && stdout.contains("all together"),
        "{stdout}"
    );
    assert!(fs::read_to_string(dir.path().join("out/validate.md")).unwrap().contains(line));
}

#[test]
fn files_that_are_all_unreadable_end_the_job_before_it_begins() {
    let dir = folder();
    fs::remove_dir_all(dir.path().join("records")).unwrap();
    fs::write(dir.path().join("zz.txt"), "0.1\n0.2\nx\n").unwrap();
    let output = validate(dir.path(), &["zz.txt", "--dt", "0.01", "--units", "g"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("no file could be read, of 1; the first: zz.txt, line 3"), "{stderr}");
    assert!(!dir.path().join("out").exists());
}

#[test]
fn a_rerun_leaves_nothing_of_the_last_but_what_the_user_made() {
    let dir = folder();
    let made = ["--synthetic", "1", "--duration", "5"];
    assert!(validate(dir.path(), &made).status.success());
    let out = dir.path().join("out");
    assert!(out.join("validation.png").exists());
    fs::write(out.join("notes.txt"), "the user's").unwrap();
    assert!(validate(dir.path(), &[&made[..], &["--no-figures"]].concat()).status.success());
    assert!(!out.join("validation.png").exists() && out.join("notes.txt").exists());
    assert!(out.join("validate.json").exists());
}

#[test]
fn a_folder_takes_a_single_result_under_its_usual_name_everywhere() {
    let dir = folder();
    let parameters = ["--parameters", "parameters.json"];
    let short = ["--duration", "1"];
    for (args, more, name) in [
        (&["housner"][..], &short[..], "housner.csv"),
        (&["simulate"], &[&parameters[..], &short].concat(), "history.csv"),
        (&["export", "--format", "csv"], &[&parameters[..], &short].concat(), "springs.csv"),
        (&["init"], &[], "case.toml"),
    ] {
        // made where it is written as a folder, used where it is there
        for folder in ["made/", "records"] {
            let output = tune(dir.path(), &[args, more, &["--out", folder]].concat());
            assert!(
                output.status.success(),
                "{args:?}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
            assert!(dir.path().join(folder).join(name).exists(), "{args:?} {folder}");
        }
    }
}

#[test]
fn bad_options_are_refused_in_one_line() {
    refuses(&[], &["RECORDS", "--synthetic"]);
    refuses(&["--records", "nowhere"], &["nowhere"]);
    refuses(&["--synthetic", "0"], &["--synthetic"]);
    refuses(&["--synthetic", "3", "--duration", "-1"], &["--duration is -1"]);
    refuses(&["--synthetic", "3", "--restitution", "2"], &["--restitution is 2"]);
    refuses(&["--synthetic", "3", "--dt", "0.01"], &["RECORDS"]);
    refuses(&["--synthetic", "3", "--jobs", "0"], &["--jobs is 0"]);
}

#[test]
fn suites_are_judged_apart_and_the_motions_of_one_do_not_depend_on_the_others() {
    let dir = folder();
    let suites = ["--synthetic", "2", "--earthquakes", "2", "--seed", "4", "--out"];
    for (more, out) in [(&RECORDS[..], "all"), (&[], "made")] {
        let output = validate(dir.path(), &[more, &suites, &[out, "--no-figures"]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let stdout = String::from_utf8(output.stdout).unwrap();
        for word in [
            "| synthetic ",
            "| earthquakes ",
            "geometric mean, sensitivity below 150",
            "e changed by 1e-5",
        ] {
            assert!(stdout.contains(word), "{word}: {stdout}");
        }
    }
    let read = |out: &str| -> Value {
        serde_json::from_slice(&fs::read(dir.path().join(out).join("validate.json")).unwrap())
            .unwrap()
    };
    let (all, made) = (read("all"), read("made"));
    let names = |all: &Value, key: &str| -> Vec<String> {
        all["records"]
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row[key].as_str().unwrap().to_string())
            .collect()
    };
    let last = ["ricker-0000", "mavroeidis-0001", "earthquake-0000", "earthquake-0001"];
    assert_eq!(names(&all, "name")[2..], last);
    assert_eq!(
        names(&all, "suite"),
        ["files", "files", "synthetic", "synthetic", "earthquakes", "earthquakes"]
    );
    assert_eq!(all["records"].as_array().unwrap()[2..], made["records"].as_array().unwrap()[..]);
    for suite in ["synthetic", "earthquakes"] {
        assert_eq!((&all[suite]["count"], &all[suite]["seed"]), (&2.into(), &4.into()));
        assert_eq!(all["suites"][suite]["count"], 2);
        assert_eq!(all["suites"][suite], made["suites"][suite]);
        assert!(all["suites"][suite]["ks_distance_of_housner_changed"].is_f64());
    }
    assert!(
        all["suites"]["files"]["nrmse_geometric_mean"]["mean"].is_f64()
            && made["suites"]["files"].is_null()
    );
    assert_eq!(all["count"], 6);
}

#[test]
fn simulate_tells_conditioning_and_regime_on_stderr() {
    let dir = folder();
    let args = ["simulate", "--parameters", "parameters.json", "--duration", "6", "--friction"];
    let said = |friction: &str| {
        let output = tune(dir.path(), &[&args[..], &[friction]].concat());
        assert!(output.status.success());
        // stdout stays the match alone
        assert!(
            serde_json::from_slice::<Value>(&output.stdout).unwrap()["nrmse_horizontal"].is_f64()
        );
        String::from_utf8(output.stderr).unwrap()
    };
    let stderr = said("0.9");
    assert!(!stderr.contains("slide"), "{stderr}");
    let used = "record IELC180 (embedded), scale 1, first 6 s of 39.94 s: 601 samples of 0.01 s, \
        PGA 0.3129 g at 2.";
    assert!(stderr.contains(used), "{stderr}");
    assert!(stderr.contains("it rocks and stands: largest rotation "), "{stderr}");
    let stderr = said("0.05");
    assert!(stderr.contains("the feet would slide: friction of 0."), "{stderr}");
}

/// The springs for a program's steps, judged in an emulation of them; what they are for is said.
#[test]
fn springs_for_a_program_are_judged_in_its_steps() {
    let dir = folder();
    let structure = Structure::paper();
    let case = "[structure]\nkind = 'aframe'\nheight_m = 61\nwidth_m = 12.2\nmass_kg = 680.1e3\n";
    fs::write(dir.path().join("case.toml"), case).unwrap();
    let run = ["run", "case.toml", "--quiet", "--no-figures", "--out", "run", "--step", "0.002"];
    assert!(tune(dir.path(), &[&run[..], &["--integrator", "trbdf2"]].concat()).status.success());
    let judge = |stepping: &str| {
        let args = ["validate", "--parameters", "run/parameters.json", "--quiet", "--no-figures"];
        let more = ["--synthetic", "12", "--seed", "3", "--stepping", stepping, "--out", stepping];
        let output = tune(dir.path(), &[&args[..], &more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let json = fs::read(dir.path().join(stepping).join("validate.json")).unwrap();
        let found: Value = serde_json::from_slice(&json).unwrap();
        (String::from_utf8(output.stdout).unwrap(), found)
    };
    let parameters = fs::read(dir.path().join("run/parameters.json")).unwrap();
    let parameters: Value = serde_json::from_slice(&parameters).unwrap();
    let (said, even) = judge("even");
    assert!(said.contains("steps: a program, TRBDF2, 0.002 s each, emulated"), "{said}");
    assert_eq!(even["vertical"], parameters["program"]["vertical"]);
    assert_eq!(even["program"]["step_s"], 0.002);
    assert_eq!(even["structure"]["height_m"].as_f64(), Some(structure.height_m));
    let (said, touches) = judge("touches");
    assert!(said.contains("20 substeps at touches"), "{said}");
    let (said, events) = judge("events");
    assert!(!said.contains("emulated"), "{said}");
    assert_eq!((&events["vertical"], &events["program"]), (&parameters["vertical"], &Value::Null));
    let median = |of: &Value| of["nrmse_well_conditioned"]["median"].as_f64().unwrap();
    assert!(median(&even) > 3.0 * median(&touches), "{even} {touches}");
    assert!(median(&touches) > 3.0 * median(&events), "{touches} {events}");
    assert!(even["energy_residual_max"].is_null() && events["energy_residual_max"].is_number());

    // parameters without such springs
    let output = validate(dir.path(), &["--synthetic", "2", "--stepping", "even"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), said.lines().count()), (Some(2), 1), "{said}");
    assert!(said.contains("no springs for steps of one size"), "{said}");
}

/// Peaks by the file's header: 41.6 mm/s2 along S16W, 194.0 along S74E, 27.3 upwards.
#[test]
fn a_component_of_files_with_several_is_chosen_and_vertical_motions_are_said_to_be_left_out() {
    let dir = folder();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20180212_211557_WPWS_20.V2A");
    for (more, mm_per_s2) in [(&[][..], 194.0), (&["--component", "S16W"][..], 41.6)] {
        let output = validate(dir.path(), &[&[file, "--no-figures"], more].concat());
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{stderr}");
        assert_eq!(stderr.contains("choose with --component"), more.is_empty(), "{stderr}");
        let told = stderr.lines().find(|line| line.starts_with("vertical motions are left out"));
        let told = told.unwrap();
        assert!(told.contains("of 1 file") && told.contains("0.002783 g beside"), "{told}");
        let all: Value =
            serde_json::from_slice(&fs::read(dir.path().join("out/validate.json")).unwrap())
                .unwrap();
        let pga = all["records"][0]["pga_g"].as_f64().unwrap();
        assert!((pga * 9810.0 - mm_per_s2).abs() <= 0.05, "{pga}");
    }
    let output = validate(dir.path(), &[file, "--component", "N00E"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("there is no component N00E; it has S16W"), "{stderr}");
}
