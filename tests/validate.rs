//! `tune validate` and the conditioning report, through the program.

use std::fs;

use dynamics::spring::{Design, Springs};
use parameters::Parameters;
use rocking::structure::Structure;
use serde_json::Value;
use strong_motion::Record;

#[path = "support/program.rs"]
mod program;

use program::{Ended, TestFolder};

/// A folder with parameters.json (the paper's frame on springs of 160 Hz) and a folder of two
/// records.
fn folder() -> TestFolder {
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 = 1e-5 * structure.mass_kg * structure.height_m.powi(2);
    let springs = Springs {
        vertical: Design::from_kc(0.3, 0.1, 0.75, 160.0),
        horizontal: Design::from_kc(0.3, 0.57, 1.86, 160.0),
    };
    let accel = Record::el_centro().truncated(6.0).accel;
    let column: String = accel.iter().map(|a| format!("{}\n", a / 9.81)).collect();
    TestFolder::with(&[
        ("parameters.json", &Parameters::new(structure, &springs).to_json()),
        ("records/", ""),
        ("records/centro.txt", &column),
        ("records/weak.txt", "0\n0.01\n-0.02\n0\n"),
    ])
}

fn validate(dir: &TestFolder, more: &str) -> Ended {
    dir.tune(&format!("validate --parameters parameters.json --quiet {more}"))
}

/// A text of every row.
fn column<'a>(rows: &'a Value, key: &str) -> Vec<&'a str> {
    rows.as_array().unwrap().iter().map(|row| row[key].as_str().unwrap()).collect()
}

const FILES: [&str; 4] = ["validate.json", "validate.md", "validate.csv", "validation.png"];
const RECORDS: &str = "--records records --dt 0.01 --units g";

#[test]
fn the_results_are_the_same_bytes_whatever_the_number_of_threads() {
    let dir = folder();
    for jobs in ["1", "2"] {
        let more = format!("--synthetic 6 --seed 3 --duration 20 --jobs {jobs} --out {jobs}");
        validate(&dir, &format!("{RECORDS} {more}")).well();
    }
    for file in FILES {
        let read = |jobs: &str| dir.bytes(&format!("{jobs}/{file}"));
        assert!(!read("1").is_empty() && read("1") == read("2"), "{file}");
    }
}

#[test]
fn files_come_first_in_the_order_of_their_names_and_the_fields_are_those_promised() {
    let dir = folder();
    let stdout = validate(&dir, &format!("{RECORDS} --synthetic 1 --no-figures")).well().stdout;
    assert!(stdout.contains("KS distance of the peak rotations"), "{stdout}");
    assert!(!dir.has("out/validation.png"));

    let all = dir.json("out/validate.json");
    assert_eq!(column(&all["records"], "name"), ["centro", "weak", "ricker-0000"]);
    let (centro, weak) = (&all["records"][0], &all["records"][1]);
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
    for key in ["overturned_housner", "overturned_fem"] {
        assert_eq!(centro[key], false);
    }
    assert_eq!(
        (&weak["outcome"], &weak["nrmse_horizontal"]),
        (&"never_lifted".into(), &Value::Null)
    );
    for key in ["peak_ratio_housner", "peak_ratio_fem"] {
        assert_eq!(weak[key], 0.0);
    }
    assert!(all["ks_distance"].is_f64() && all["overturning_agreement"].is_f64());
    let nrmse = &all["nrmse_well_conditioned"];
    assert!(nrmse["count"].as_u64().is_some_and(|n| n >= 1), "{nrmse}");
    assert!(nrmse["median"].is_f64() && nrmse["p90"].is_f64(), "{nrmse}");
    let csv = dir.text("out/validate.csv");
    let head = "name,outcome,duration_s,pga_g,sensitivity,nrmse_horizontal,";
    assert!(csv.starts_with(head) && csv.lines().count() == 4, "{csv}");
}

#[test]
fn files_and_folders_are_named_without_an_option_and_what_cannot_be_read_is_said_and_left_out() {
    let dir = folder();
    dir.write("records/zz.txt", "0.1\n0.2\nx\n");
    dir.write("one.txt", dir.bytes("records/weak.txt"));
    // a file that is named twice counts once
    let more = "one.txt records nowhere.at2 one.txt --dt 0.01 --units g --no-figures";
    let Ended { stdout, stderr, .. } = validate(&dir, more).well();
    let said: Vec<&str> = stderr.lines().filter(|line| line.starts_with("left out: ")).collect();
    assert!(
        said.len() == 2 && said[0].contains("zz.txt, line 3") && said[1].contains("nowhere.at2"),
        "{stderr}"
    );
    assert!(stdout.starts_with("records: 3 from files (2 left out)\n"), "{stdout}");
    let all = dir.json("out/validate.json");
    assert_eq!(column(&all["records"], "name"), ["one", "centro", "weak"]);
    assert_eq!(column(&all["left_out"], "file"), ["records/zz.txt", "nowhere.at2"]);
}

#[test]
fn motions_made_beside_files_are_said_to_be() {
    let dir = folder();
    let more = "--synthetic 2 --earthquakes 1 --seed 7 --duration 5 --no-figures";
    let stdout = validate(&dir, &format!("{RECORDS} {more}")).stdout;
    let line = "records: 2 from files, 2 synthetic of seed 7, 1 earthquake-like of seed 7";
    assert!(
        stdout.starts_with(&format!("{line}\n")) && stdout.contains("all together"),
        "{stdout}"
    );
    assert!(dir.text("out/validate.md").contains(line));
}

#[test]
fn files_that_are_all_unreadable_end_the_job_before_it_begins() {
    let dir = folder();
    fs::remove_dir_all(dir.path("records")).unwrap();
    dir.write("zz.txt", "0.1\n0.2\nx\n");
    let Ended { code, stderr, .. } = validate(&dir, "zz.txt --dt 0.01 --units g");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("no file could be read, of 1; the first: zz.txt, line 3"), "{stderr}");
    assert!(!dir.has("out"));
}

#[test]
fn a_rerun_leaves_nothing_of_the_last_but_what_the_user_made() {
    let dir = folder();
    let made = "--synthetic 1 --duration 5";
    validate(&dir, made).well();
    assert!(dir.has("out/validation.png"));
    dir.write("out/notes.txt", "the user's");
    validate(&dir, &format!("{made} --no-figures")).well();
    assert!(!dir.has("out/validation.png") && dir.has("out/notes.txt"));
    assert!(dir.has("out/validate.json"));
}

#[test]
fn a_folder_takes_a_single_result_under_its_usual_name_everywhere() {
    let dir = folder();
    let short = "--parameters parameters.json --duration 1";
    for (line, name) in [
        ("housner --duration 1".into(), "housner.csv"),
        (format!("simulate {short}"), "history.csv"),
        (format!("export --format csv {short}"), "springs.csv"),
        ("init".to_string(), "case.toml"),
    ] {
        // made where it is written as a folder, used where it is there
        for folder in ["made/", "records"] {
            dir.runs(&format!("{line} --out {folder}"));
            assert!(dir.path(folder).join(name).exists(), "{line} {folder}");
        }
    }
}

#[test]
fn bad_options_are_refused_in_one_line() {
    let dir = folder();
    dir.write("records/zz.txt", "0.1\n0.2\nx\n");
    for (more, words) in [
        ("", &["RECORDS", "--synthetic"][..]),
        ("--records nowhere", &["nowhere"]),
        ("--synthetic 0", &["--synthetic"]),
        ("--synthetic 3 --duration -1", &["--duration is -1"]),
        ("--synthetic 3 --restitution 2", &["--restitution is 2"]),
        ("--synthetic 3 --dt 0.01", &["RECORDS"]),
        ("--synthetic 3 --jobs 0", &["--jobs is 0"]),
    ] {
        let stderr = validate(&dir, more).refusal();
        for word in words {
            assert!(stderr.contains(word), "{stderr:?} does not say {word:?}");
        }
        assert!(!dir.has("out"), "{more}");
    }
}

#[test]
fn suites_are_judged_apart_and_the_motions_of_one_do_not_depend_on_the_others() {
    let dir = folder();
    let suites = "--synthetic 2 --earthquakes 2 --seed 4 --no-figures";
    for (more, out) in [(RECORDS, "all"), ("", "made")] {
        let stdout = validate(&dir, &format!("{more} {suites} --out {out}")).well().stdout;
        for word in [
            "| synthetic ",
            "| earthquakes ",
            "geometric mean, sensitivity below 150",
            "e changed by 1e-5",
        ] {
            assert!(stdout.contains(word), "{word}: {stdout}");
        }
    }
    let [all, made] = ["all", "made"].map(|out| dir.json(&format!("{out}/validate.json")));
    let last = ["ricker-0000", "mavroeidis-0001", "earthquake-0000", "earthquake-0001"];
    assert_eq!(column(&all["records"], "name")[2..], last);
    assert_eq!(
        column(&all["records"], "suite"),
        ["files", "files", "synthetic", "synthetic", "earthquakes", "earthquakes"]
    );
    assert_eq!(all["records"].as_array().unwrap()[2..], made["records"].as_array().unwrap()[..]);
    for suite in ["synthetic", "earthquakes"] {
        assert_eq!((&all[suite]["count"], &all[suite]["seed"]), (&2.into(), &4.into()));
        assert_eq!(all["suites"][suite]["count"], 2);
        assert_eq!(all["suites"][suite], made["suites"][suite]);
        assert!(all["suites"][suite]["ks_distance_of_housner_changed"].is_f64());
    }
    assert!(all["suites"]["files"]["nrmse_geometric_mean"]["mean"].is_f64());
    assert!(made["suites"]["files"].is_null());
    assert_eq!(all["count"], 6);
}

#[test]
fn simulate_tells_conditioning_and_regime_on_stderr() {
    let dir = folder();
    let said = |friction: &str| {
        let simulate = "simulate --parameters parameters.json --duration 6 --friction";
        let Ended { stdout, stderr, .. } = dir.runs(&format!("{simulate} {friction}"));
        // stdout stays the match alone
        let found: Value = serde_json::from_str(&stdout).unwrap();
        assert!(found["nrmse_horizontal"].is_f64());
        stderr
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
    let case = "[structure]\nkind = 'aframe'\nheight_m = 61\nwidth_m = 12.2\nmass_kg = 680.1e3\n";
    dir.write("case.toml", case);
    dir.runs("run case.toml --quiet --no-figures --out run --step 0.002 --integrator trbdf2");
    let judge = |stepping: &str| {
        let made = "--no-figures --synthetic 12 --seed 3";
        let said = dir.runs(&format!(
            "validate --parameters run/parameters.json --quiet {made} --stepping {stepping} \
             --out {stepping}"
        ));
        (said.stdout, dir.json(&format!("{stepping}/validate.json")))
    };
    let parameters = dir.json("run/parameters.json");
    let (said, even) = judge("even");
    assert!(said.contains("steps: a program, TRBDF2, 0.002 s each, emulated"), "{said}");
    assert_eq!(even["vertical"], parameters["program"]["vertical"]);
    assert_eq!(even["program"]["step_s"], 0.002);
    assert_eq!(even["structure"]["height_m"].as_f64(), Some(Structure::paper().height_m));
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
    let said = validate(&dir, "--synthetic 2 --stepping even").refusal();
    assert!(said.contains("no springs for steps of one size"), "{said}");
}

/// Peaks by the file's header: 41.6 mm/s2 along S16W, 194.0 along S74E, 27.3 upwards.
#[test]
fn a_component_of_files_with_several_is_chosen_and_vertical_motions_are_said_to_be_left_out() {
    let dir = folder();
    let file = format!("'{}'", program::WAIPAWA);
    for (more, mm_per_s2) in [("", 194.0), ("--component S16W", 41.6)] {
        let stderr = validate(&dir, &format!("{file} --no-figures {more}")).well().stderr;
        assert_eq!(stderr.contains("choose with --component"), more.is_empty(), "{stderr}");
        let told = stderr.lines().find(|line| line.starts_with("vertical motions are left out"));
        let told = told.unwrap();
        assert!(told.contains("in 1 file") && told.contains("0.002783 g beside"), "{told}");
        let pga = dir.json("out/validate.json")["records"][0]["pga_g"].as_f64().unwrap();
        assert!((pga * 9810.0 - mm_per_s2).abs() <= 0.05, "{pga}");
    }
    let stderr = validate(&dir, &format!("{file} --component N00E")).stderr;
    assert!(stderr.contains("there is no component N00E; it has S16W"), "{stderr}");
}
