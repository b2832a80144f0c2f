//! The vertical component: from the same file or another one, through the commands, remembered;
//! refused where it does not fit.

use serde_json::Value;
use strong_motion::{ReadOptions, Record, VerticalFrom};

use crate::{
    program::{self, Ended, TestFolder},
    write,
};

const STRUCTURE: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 2400.0\n";

/// One column in m/s2.
fn column(values: &[f64]) -> String {
    let lines: Vec<String> = values.iter().map(|a| format!("{a:e}")).collect();
    format!("# units: m/s2\n{}\n", lines.join("\n"))
}

const RUN: &str = "--quiet --no-figures --no-front --out out";

fn folder() -> TestFolder {
    let dir = TestFolder::with(&[("sub/", "")]);
    let put = |name: &str, text: String| dir.write(name, text);
    put("site.V2A", write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0), ("Up", 6000.0)], false));
    put("fallen.V2A", write::geonet(&[("N28W", 5000.0), ("Down", 6000.0)], false));
    put("flat.V2A", write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0)], false));
    let wave = |scale: f64| write::wave(scale, 1.1);
    put("along.txt", column(&wave(4.0)));
    put("up.txt", column(&wave(3.0)));
    put("short.txt", column(&wave(3.0)[1..]));
    put("long.txt", column(&[wave(3.0), vec![9.0; 21]].concat()));
    put("strong.txt", column(&wave(14.0)));
    let tuning = "[tuning]\nobjective = \"arr\"\nmax_omega_hz = 60.0\ncandidates = 2\n";
    put(
        "case.toml",
        format!("{STRUCTURE}[record]\nfile = \"site.V2A\"\nvertical = \"auto\"\n{tuning}"),
    );
    put(
        "sub/case.toml",
        format!(
            "{STRUCTURE}[record]\nfile = \"../along.txt\"\ndt_s = 0.02\nvertical = \"../up.txt\"\n\
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
        Record::read(&dir.path(file), &options).unwrap()
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
    let run = |options: &str| {
        let ended = dir.runs(&format!("housner {options}"));
        (ended.stdout, ended.stderr)
    };
    let (level, said) = run("case.toml --record site.V2A");
    assert!(!said.contains("vertical site"), "{said}");
    let (with, said) = run("case.toml --record site.V2A --vertical auto");
    assert!(said.contains("; vertical site Up, peak 0.6") && with != level, "{said}");
    assert_eq!(run("case.toml").0, with);
    // a case that names the record leaves the vertical component out unless an option takes it
    dir.write("across.toml", dir.text("case.toml").replace("vertical = \"auto\"\n", ""));
    assert_eq!(run("across.toml").0, level);
    assert_eq!(run("across.toml --vertical auto").0, with);
    let columns = "sub/case.toml --record along.txt --dt 0.02 --vertical";
    let (with, said) = run(&format!("{columns} up.txt"));
    assert!(said.contains("; vertical up, peak 0.2"), "{said}");
    assert_eq!(run("sub/case.toml").0, with);
    // more than 1 g downwards
    let (_, said) = run(&format!("{columns} strong.txt"));
    assert!(said.contains(", leaves the ground at "), "{said}");
}

#[test]
fn a_run_shows_its_part_and_remembers_it() {
    let dir = folder();
    for case in ["case.toml", "sub/case.toml"] {
        let out = dir.runs(&format!("run {case} {RUN}")).stdout;
        assert!(out.contains("; vertical "), "{out}");
        let tables = dir.text("out/decks/model_sap2000.s2k");
        // 203 samples, and the 0 that the function begins at
        assert!(
            tables.contains("LoadName=U3   Function=GROUND_MOTION_UP")
                && tables.matches("Name=GROUND_MOTION_UP ").count() == 204,
            "{out}"
        );
        let parameters = dir.json("out/parameters.json");
        assert!(parameters["record"]["vertical"]["pga_g"].as_f64().unwrap() > 0.2);
        assert!(program::finding(&parameters, "without_vertical").is_some(), "{parameters}");
        assert!(
            parameters["verdict"]["housner_without_vertical"]["peak_ratio"].is_number(),
            "{parameters}"
        );
        let simulate = "simulate --parameters ../out/parameters.json";
        let Ended { stdout: out, stderr: err, .. } =
            program::tune(&dir.path("sub"), simulate).well();
        assert!(
            err.contains("; vertical ") && err.contains("without the vertical component it "),
            "{err}"
        );
        let found: Value = serde_json::from_str(&out).unwrap();
        assert_eq!(found["nrmse_horizontal"], parameters["match"]["nrmse_horizontal"]);
        for deck in ["model_openseespy.py", "model_opensees.tcl"] {
            let deck = dir.text(&format!("out/decks/{deck}"));
            assert!(deck.contains("positive upwards") && !deck.contains("@VERTICAL"), "{deck}");
        }
    }
    // another vertical component than the one remembered
    dir.write("up.txt", column(&write::wave(3.1, 1.1)));
    let err = dir.refuses("simulate --parameters out/parameters.json");
    assert!(err.contains("up.txt has changed since the springs were tuned"), "{err}");
}

#[test]
fn where_the_body_leaves_the_ground_housner_ends_and_the_finite_elements_go_on() {
    let dir = folder();
    dir.runs(&format!("run sub/case.toml {RUN}"));
    let record = "--record along.txt --dt 0.02 --vertical strong.txt";
    let Ended { stdout: out, stderr: err, .. } =
        dir.runs(&format!("simulate --parameters out/parameters.json --out history.csv {record}"));
    assert!(err.contains("Housner's pivot leaves the ground at 1."), "{err}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let compared = found["duration_s"].as_f64().unwrap();
    assert!(compared < 3.0, "{compared}");
    let csv = dir.text("history.csv");
    let rows: Vec<&str> = csv.lines().skip(1).collect();
    assert_eq!(rows.len(), write::SAMPLES);
    let blank = rows.iter().position(|row| row.contains(",,,,")).unwrap();
    assert!(((blank - 1) as f64 * 0.02 - compared).abs() < 1e-9);
}

#[test]
fn a_vertical_component_that_goes_on_after_the_record_is_cut_and_told() {
    let dir = folder();
    let of = |vertical: &str| {
        let record = "housner --record along.txt --dt 0.02 --out history.csv";
        dir.runs(&format!("{record} --vertical {vertical}"))
    };
    let same = of("up.txt").stdout;
    let Ended { stdout: out, stderr: err, .. } = of("long.txt");
    let told = "along.txt: the vertical component, long, has 21 more samples than the record";
    assert!(err.contains(told), "{err}");
    // all but the component's name
    assert_eq!(out.replace("long (", "up ("), same);
}

#[test]
fn what_does_not_fit_is_refused_in_one_line() {
    let dir = folder();
    for (line, words) in [
        ("housner --vertical auto", "name it with --record"),
        (
            "housner --record flat.V2A --vertical auto",
            "flat.V2A: has no vertical component; name the",
        ),
        ("housner --record site.V2A --component up --vertical auto", "taken as the horizontal"),
        ("housner --record site.V2A --vertical flat.V2A", "flat.V2A: has no vertical component"),
        ("housner --record site.V2A --vertical nowhere.V2A", "nowhere.V2A"),
        (
            "housner --record along.txt --dt 0.02 --vertical auto",
            "along.txt: has no vertical component",
        ),
        (
            "housner --record along.txt --dt 0.02 --vertical short.txt",
            "short: the vertical component has 202 samples of 0.02 s, the record 203",
        ),
        ("run --no-record --vertical auto", "--vertical"),
    ] {
        let err = dir.refuses(line);
        assert!(err.contains(words), "{line}: {err}");
    }
    for (section, words) in [
        ("vertical = \"auto\"\n", "[record] lacks file"),
        ("file = \"along.txt\"\ndt_s = 0.02\nvertical = 3\n", "case.toml, line"),
    ] {
        dir.write("case.toml", format!("{STRUCTURE}[record]\n{section}"));
        let err = dir.refuses("housner case.toml");
        assert!(err.contains(words), "{err}");
    }
}

/// A column that is there but cannot be one of accelerations is not called missing.
#[test]
fn a_vertical_column_that_cannot_be_read_is_told_by_its_own_fault() {
    let rows = (0..40).map(|i| {
        let along = f64::from(i) * if i % 2 == 0 { 0.1 } else { -0.1 };
        format!("{:?},{along:?},2.943\n", f64::from(i) * 0.02)
    });
    let table = format!("time (s),NS (m/s2),UP (m/s2)\n{}", rows.collect::<String>());
    let case = format!("{STRUCTURE}[record]\nfile = \"table.csv\"\ncomponent = \"NS\"\n");
    let dir = TestFolder::with(&[("table.csv", &table), ("case.toml", &case)]);
    dir.runs("housner case.toml");
    let told = "table.csv: column UP (m/s2) never changes its sign";
    for line in ["housner case.toml --vertical auto", "record table.csv --column 3"] {
        let refused = dir.refuses(line);
        assert!(refused.contains(told), "{line}: {refused}");
    }
}
