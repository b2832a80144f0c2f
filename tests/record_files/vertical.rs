//! The vertical component: from the same file or another one, through the commands, remembered;
//! refused where it does not fit.

use std::fs;

use serde_json::Value;
use strong_motion::{ReadOptions, Record, VerticalFrom};
use tempfile::TempDir;

use crate::{tune, write};

/// One column in m/s2.
fn column(values: &[f64]) -> String {
    let lines: Vec<String> = values.iter().map(|a| format!("{a:e}")).collect();
    format!("# units: m/s2\n{}\n", lines.join("\n"))
}

fn folder() -> TempDir {
    let dir = TempDir::new().unwrap();
    let put = |name: &str, text: String| fs::write(dir.path().join(name), text).unwrap();
    put("site.V2A", write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0), ("Up", 6000.0)], false));
    put("fallen.V2A", write::geonet(&[("N28W", 5000.0), ("Down", 6000.0)], false));
    put("flat.V2A", write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0)], false));
    let wave = |scale: f64| write::wave(scale, 1.1);
    put("along.txt", column(&wave(4.0)));
    put("up.txt", column(&wave(3.0)));
    put("short.txt", column(&wave(3.0)[1..]));
    put("long.txt", column(&[wave(3.0), vec![9.0; 21]].concat()));
    put("strong.txt", column(&wave(14.0)));
    let structure =
        "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 2400.0\n";
    let tuning = "[tuning]\nobjective = \"arr\"\nmax_omega_hz = 60.0\ncandidates = 2\n";
    put(
        "case.toml",
        format!("{structure}[record]\nfile = \"site.V2A\"\nvertical = \"auto\"\n{tuning}"),
    );
    fs::create_dir(dir.path().join("sub")).unwrap();
    put(
        "sub/case.toml",
        format!(
            "{structure}[record]\nfile = \"../along.txt\"\ndt_s = 0.02\nvertical = \"../up.txt\"\n\
                {tuning}"
        ),
    );
    dir
}

#[test]
fn the_vertical_component_of_the_same_file_counts_upwards() {
    let dir = folder();
    let read = |file: &str, component: Option<&str>, vertical: Option<VerticalFrom>| {
        let options = ReadOptions {
            component: component.map(Into::into),
            vertical,
            ..ReadOptions::default()
        };
        Record::read(&dir.path().join(file), &options).unwrap()
    };
    let both = read("site.V2A", None, Some(VerticalFrom::Auto));
    assert_eq!(
        (both.name.as_str(), both.vertical.as_ref().unwrap().name.as_str()),
        ("site S62W", "site Up")
    );
    assert_eq!(both.up(), read("site.V2A", Some("up"), None).accel);
    let fallen = read("fallen.V2A", None, Some(VerticalFrom::Auto));
    let down = read("fallen.V2A", Some("down"), None).accel;
    assert!(fallen.up().iter().zip(&down).all(|(up, down)| *up == -down));
    // scaled and cut together
    let part = both.scaled(2.0).unwrap().truncated(1.0);
    assert_eq!((part.len(), part.up().len(), part.up()[40]), (51, 51, 2.0 * both.up()[40]));
}

#[test]
fn histories_take_it_and_the_line_says_so() {
    let dir = folder();
    let run = |args: &[&str]| {
        let (code, out, err) = tune(dir.path(), &[&["housner"], args].concat());
        assert_eq!(code, 0, "{err}");
        (out, err)
    };
    let (level, said) = run(&["case.toml", "--record", "site.V2A"]);
    assert!(!said.contains("vertical site"), "{said}");
    let (with, said) = run(&["case.toml", "--record", "site.V2A", "--vertical", "auto"]);
    assert!(said.contains("; vertical site Up, peak 0.6") && with != level, "{said}");
    assert_eq!(run(&["case.toml"]).0, with);
    // a case that names the record leaves the vertical component out unless an option takes it
    let text = fs::read_to_string(dir.path().join("case.toml")).unwrap();
    fs::write(dir.path().join("across.toml"), text.replace("vertical = \"auto\"\n", "")).unwrap();
    assert_eq!(run(&["across.toml"]).0, level);
    assert_eq!(run(&["across.toml", "--vertical", "auto"]).0, with);
    let columns = ["sub/case.toml", "--record", "along.txt", "--dt", "0.02"];
    let (with, said) = run(&[&columns[..], &["--vertical", "up.txt"]].concat());
    assert!(said.contains("; vertical up, peak 0.2"), "{said}");
    assert_eq!(run(&["sub/case.toml"]).0, with);
    // more than 1 g downwards
    let (_, said) = run(&[&columns[..], &["--vertical", "strong.txt"]].concat());
    assert!(said.contains(", leaves the ground at "), "{said}");
}

#[test]
fn a_run_shows_its_part_and_remembers_it() {
    let dir = folder();
    for case in ["case.toml", "sub/case.toml"] {
        let (code, out, err) = tune(
            dir.path(),
            &["run", case, "--quiet", "--no-figures", "--no-front", "--out", "out"],
        );
        assert_eq!(code, 0, "{err}");
        assert!(out.contains("; vertical "), "{out}");
        let tables = fs::read_to_string(dir.path().join("out/decks/model_sap2000.s2k")).unwrap();
        // 203 samples, and the 0 that the function begins at
        assert!(
            tables.contains("LoadName=U3   Function=GROUND_MOTION_UP")
                && tables.matches("Name=GROUND_MOTION_UP ").count() == 204,
            "{out}"
        );
        let parameters: Value =
            serde_json::from_slice(&fs::read(dir.path().join("out/parameters.json")).unwrap())
                .unwrap();
        assert!(parameters["record"]["vertical"]["pga_g"].as_f64().unwrap() > 0.2);
        let findings = parameters["findings"].as_array().unwrap();
        assert!(
            findings.iter().any(|finding| finding["finding"] == "without_vertical"),
            "{parameters}"
        );
        assert!(
            parameters["verdict"]["housner_without_vertical"]["peak_ratio"].is_number(),
            "{parameters}"
        );
        let (code, out, err) =
            tune(&dir.path().join("sub"), &["simulate", "--parameters", "../out/parameters.json"]);
        assert_eq!(code, 0, "{err}");
        assert!(
            err.contains("; vertical ") && err.contains("without the vertical component it "),
            "{err}"
        );
        let found: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(found["nrmse_horizontal"], parameters["match"]["nrmse_horizontal"]);
        for deck in ["model_openseespy.py", "model_opensees.tcl"] {
            let deck = fs::read_to_string(dir.path().join("out/decks").join(deck)).unwrap();
            assert!(deck.contains("positive upwards") && !deck.contains("@VERTICAL"), "{deck}");
        }
    }
    // another vertical component than the one remembered
    fs::write(dir.path().join("up.txt"), column(&write::wave(3.1, 1.1))).unwrap();
    let (code, _, err) = tune(dir.path(), &["simulate", "--parameters", "out/parameters.json"]);
    assert_eq!((code, err.lines().count()), (2, 1), "{err}");
    assert!(err.contains("up.txt has changed since the springs were tuned"), "{err}");
}

#[test]
fn where_the_body_leaves_the_ground_housner_ends_and_the_finite_elements_go_on() {
    let dir = folder();
    let run = ["run", "sub/case.toml", "--quiet", "--no-figures", "--no-front", "--out", "out"];
    assert_eq!(tune(dir.path(), &run).0, 0);
    let record = ["--record", "along.txt", "--dt", "0.02", "--vertical", "strong.txt"];
    let simulate = ["simulate", "--parameters", "out/parameters.json", "--out", "history.csv"];
    let (code, out, err) = tune(dir.path(), &[&simulate[..], &record].concat());
    assert_eq!(code, 0, "{err}");
    assert!(err.contains("Housner's pivot leaves the ground at 1."), "{err}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let compared = found["duration_s"].as_f64().unwrap();
    assert!(compared < 3.0, "{compared}");
    let csv = fs::read_to_string(dir.path().join("history.csv")).unwrap();
    let rows: Vec<&str> = csv.lines().skip(1).collect();
    assert_eq!(rows.len(), write::SAMPLES);
    let blank = rows.iter().position(|row| row.contains(",,,,")).unwrap();
    assert!(((blank - 1) as f64 * 0.02 - compared).abs() < 1e-9);
}

#[test]
fn a_vertical_component_that_goes_on_after_the_record_is_cut_and_told() {
    let dir = folder();
    let of = |vertical: &str| {
        let record = ["housner", "--record", "along.txt", "--dt", "0.02", "--vertical", vertical];
        tune(dir.path(), &[&record[..], &["--out", "history.csv"]].concat())
    };
    let (code, same, _) = of("up.txt");
    assert_eq!(code, 0);
    let (code, out, err) = of("long.txt");
    assert_eq!(code, 0, "{err}");
    let told = "along.txt: the vertical component, long, has 21 more samples than the record";
    assert!(err.contains(told), "{err}");
    // all but the component's name
    assert_eq!(out.replace("long (", "up ("), same);
}

#[test]
fn what_does_not_fit_is_refused_in_one_line() {
    let dir = folder();
    let columns = ["housner", "--record", "along.txt", "--dt", "0.02", "--vertical"];
    for (args, words) in [
        (&["housner", "--vertical", "auto"][..], "name it with --record"),
        (
            &["housner", "--record", "flat.V2A", "--vertical", "auto"],
            "flat.V2A: has no vertical component; name the",
        ),
        (
            &["housner", "--record", "site.V2A", "--component", "up", "--vertical", "auto"],
            "taken as the horizontal",
        ),
        (
            &["housner", "--record", "site.V2A", "--vertical", "flat.V2A"],
            "flat.V2A: has no vertical component",
        ),
        (&["housner", "--record", "site.V2A", "--vertical", "nowhere.V2A"], "nowhere.V2A"),
        (&[&columns[..], &["auto"]].concat(), "along.txt: has no vertical component"),
        (
            &[&columns[..], &["short.txt"]].concat(),
            "short: the vertical component has 202 samples of 0.02 s, the record 203",
        ),
        (&["run", "--no-record", "--vertical", "auto"], "--vertical"),
    ] {
        let (code, out, err) = tune(dir.path(), args);
        assert_eq!((code, out.as_str()), (2, ""), "{args:?}: {err}");
        assert!(err.contains(words), "{args:?}: {err}");
        assert!(args[0] == "run" || err.lines().count() == 1, "{args:?}: {err}");
    }
    for (section, words) in [
        ("vertical = \"auto\"\n", "[record] lacks file"),
        ("file = \"along.txt\"\ndt_s = 0.02\nvertical = 3\n", "case.toml, line"),
    ] {
        let structure =
            "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 2400.0\n";
        fs::write(dir.path().join("case.toml"), format!("{structure}[record]\n{section}")).unwrap();
        let (code, _, err) = tune(dir.path(), &["housner", "case.toml"]);
        assert_eq!((code, err.lines().count()), (2, 1), "{err}");
        assert!(err.contains(words), "{err}");
    }
}
