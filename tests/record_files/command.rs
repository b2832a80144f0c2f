//! `tune record`, and the other commands on files with several components.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::{tune, write};

fn folder() -> TempDir {
    let dir = TempDir::new().unwrap();
    let geonet = write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0), ("Up", 9000.0)], false);
    fs::write(dir.path().join("site.V2A"), geonet).unwrap();
    fs::write(dir.path().join("TST.EW"), write::knet("E-W")).unwrap();
    fs::write(dir.path().join("bad.txt"), "1 0.1\n2 0.2\n").unwrap();
    let block =
        "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n[record]\n";
    fs::write(
        dir.path().join("case.toml"),
        format!("{block}file = \"site.V2A\"\ncomponent = \"up\"\n"),
    )
    .unwrap();
    fs::write(dir.path().join("plain.toml"), format!("{block}file = \"site.V2A\"\n")).unwrap();
    fs::write(dir.path().join("nofile.toml"), format!("{block}baseline = true\n")).unwrap();
    dir
}

#[test]
fn files_are_told_as_tables_and_as_json() {
    let dir = folder();
    let (code, out, err) = tune(dir.path(), &["record", "site.V2A", "TST.EW"]);
    assert_eq!(code, 0, "{err}");
    for words in [
        "site.V2A: GeoNet, TEST Made up Farm",
        "| S62W*",
        "| N28W ",
        "TST.EW: K-NET",
        "tune run takes site S62W",
    ] {
        assert!(out.contains(words), "{words}: {out}");
    }
    assert!(
        err.contains("component S62W (azimuth 242) is taken, the stronger horizontal one"),
        "{err}"
    );

    let args = [
        "record",
        "site.V2A",
        "--json",
        "--component",
        "332",
        "--case",
        "case.toml",
        "--out",
        "figures",
    ];
    let (code, out, err) = tune(dir.path(), &args);
    assert_eq!((code, err.as_str()), (0, ""));
    let all: Value = serde_json::from_str(&out).unwrap();
    let rows = all[0]["components"].as_array().unwrap();
    assert_eq!((rows.len(), all[0]["format"].as_str()), (3, Some("GeoNet")));
    let taken: Vec<bool> = rows.iter().map(|row| row["taken"].as_bool().unwrap()).collect();
    assert_eq!(taken, [true, false, false]);
    let values = write::rounded(&write::wave(5000.0, 0.3), 1);
    let (value, time) = write::peak(&values);
    let number = |key: &str| rows[0][key].as_f64().unwrap();
    assert!((number("pga_m_per_s2") - value * 1e-3).abs() < 1e-12);
    assert!((number("pga_time_s") - (time - write::PREPENDED)).abs() < 1e-9);
    assert!(
        (rows[0]["header_pga_m_per_s2"]["time_s"].as_f64().unwrap() - number("pga_time_s")).abs()
            < 0.011
    );
    // tan(alpha) = 0.25, g = 9.81 m/s2
    let ratio = rows[0]["structure"]["pga_over_g_tan_alpha"].as_f64().unwrap();
    assert!((ratio - number("pga_g").abs() / 0.25).abs() < 1e-12);
    assert!(dir.path().join("figures/site.png").exists());
}

#[test]
fn a_case_without_a_file_stands_for_its_own_record() {
    let dir = folder();
    let json = |args: &[&str]| {
        let (code, out, err) = tune(dir.path(), args);
        assert_eq!(code, 0, "{err}");
        serde_json::from_str::<Value>(&out).unwrap()
    };
    let named = json(&["record", "site.V2A", "--json", "--component", "up", "--case", "case.toml"]);
    assert_eq!(json(&["record", "--case", "case.toml", "--json"]), named);
    let other = json(&["record", "--case", "case.toml", "--component", "332", "--json"]);
    assert_eq!(other[0]["components"][0]["taken"].as_bool(), Some(true));
    let (code, out, err) = tune(dir.path(), &["record"]);
    assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
    let block = "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";
    fs::write(dir.path().join("none.toml"), block).unwrap();
    let (code, _, err) = tune(dir.path(), &["record", "--case", "none.toml"]);
    assert!(code == 2 && err.contains("names no record file"), "{err}");
}

#[test]
fn a_bad_file_among_others_is_said_and_fails() {
    let dir = folder();
    let (code, out, err) = tune(dir.path(), &["record", "bad.txt"]);
    assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
    assert!(err.contains("bad.txt, line 1: the first column counts rows"), "{err}");
    let (code, out, err) = tune(dir.path(), &["record", "bad.txt", "TST.EW"]);
    assert_eq!(code, 2);
    assert!(
        out.contains("TST.EW: K-NET") && err.contains("1 of 2 files could not be read"),
        "{err}"
    );
}

#[test]
fn other_commands_take_the_component_that_is_asked_for() {
    let dir = folder();
    let name = |args: &[&str]| {
        let (code, _, err) = tune(dir.path(), args);
        assert_eq!(code, 0, "{err}");
        let used = err.lines().find_map(|line| line.strip_prefix("record ")).unwrap();
        (used.split(" (").next().unwrap().to_owned(), err.lines().count())
    };
    assert_eq!(
        name(&["housner", "--record", "site.V2A", "--component", "N28W"]),
        ("site N28W".into(), 2)
    );
    assert_eq!(name(&["housner", "--record", "site.V2A"]), ("site S62W".into(), 3));
    assert_eq!(name(&["housner", "case.toml"]), ("site Up".into(), 2));
    assert_eq!(name(&["housner", "plain.toml"]), ("site S62W".into(), 3));
    for (args, words) in [
        (
            &["housner", "--record", "site.V2A", "--component", "90"][..],
            "there is no component 90; it has N28W",
        ),
        (&["housner", "--component", "90"], "name it with --record"),
        (&["housner", "--baseline"], "name it with --record"),
        (&["housner", "nofile.toml"], "[record] lacks file"),
        (&["record"], "FILE"),
        (&["record", "site.V2A", "--units", "g"], "says its unit is mm/s2"),
    ] {
        let (code, out, err) = tune(dir.path(), args);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{args:?}: {err}");
        assert!(err.contains(words), "{args:?}: {err}");
    }
}
