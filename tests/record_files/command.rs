//! `tune record`, and the other commands on files with several components.

use serde_json::Value;

use crate::{
    program::{Ended, TestFolder},
    write,
};

const BLOCK: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";

fn folder() -> TestFolder {
    let case = |record: &str| format!("{BLOCK}[record]\n{record}\n");
    let geonet = write::geonet(&[("N28W", 5000.0), ("S62W", 7000.0), ("Up", 9000.0)], false);
    TestFolder::with(&[
        ("site.V2A", &geonet),
        ("TST.EW", &write::knet("E-W")),
        ("bad.txt", "1 0.1\n2 0.2\n"),
        ("case.toml", &case("file = \"site.V2A\"\ncomponent = \"up\"")),
        ("plain.toml", &case("file = \"site.V2A\"")),
        ("nofile.toml", &case("baseline = true")),
    ])
}

#[test]
fn files_are_told_as_tables_and_as_json() {
    let dir = folder();
    let Ended { stdout: out, stderr: err, .. } = dir.runs("record site.V2A TST.EW");
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

    let line = "record site.V2A --json --component 332 --case case.toml --out figures";
    let Ended { stdout: out, stderr: err, .. } = dir.runs(line);
    assert_eq!(err, "");
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
    assert!(dir.has("figures/site.png"));
}

#[test]
fn a_case_without_a_file_stands_for_its_own_record() {
    let dir = folder();
    let json = |line: &str| serde_json::from_str::<Value>(&dir.runs(line).stdout).unwrap();
    let named = json("record site.V2A --json --component up --case case.toml");
    assert_eq!(json("record --case case.toml --json"), named);
    let other = json("record --case case.toml --component 332 --json");
    assert_eq!(other[0]["components"][0]["taken"].as_bool(), Some(true));
    dir.refuses("record");
    dir.write("none.toml", BLOCK);
    let err = dir.refuses("record --case none.toml");
    assert!(err.contains("names no record file"), "{err}");
}

#[test]
fn a_bad_file_among_others_is_said_and_fails() {
    let dir = folder();
    let err = dir.refuses("record bad.txt");
    assert!(err.contains("bad.txt, line 1: the first column counts rows"), "{err}");
    let Ended { code, stdout, stderr } = dir.tune("record bad.txt TST.EW");
    assert_eq!(code, Some(2));
    assert!(stdout.contains("TST.EW: K-NET"), "{stdout}");
    assert!(stderr.contains("1 of 2 files could not be read"), "{stderr}");
}

#[test]
fn other_commands_take_the_component_that_is_asked_for() {
    let dir = folder();
    let name = |line: &str| {
        let err = dir.runs(line).stderr;
        let used = err.lines().find_map(|line| line.strip_prefix("record ")).unwrap();
        let told = err.lines().filter(|line| !line.starts_with("CHECK "));
        (used.split(" (").next().unwrap().to_owned(), told.count())
    };
    for (line, used, lines) in [
        ("housner --record site.V2A --component N28W", "site N28W", 2),
        ("housner --record site.V2A", "site S62W", 3),
        ("housner case.toml", "site Up", 2),
        ("housner plain.toml", "site S62W", 3),
    ] {
        assert_eq!(name(line), (used.into(), lines));
    }
    let vertical = dir.runs("housner case.toml").stderr;
    assert!(
        vertical.contains("CHECK component Up (vertical), a vertical one, is taken"),
        "{vertical}"
    );
    for (line, words) in [
        ("housner --record site.V2A --component 90", "there is no component 90; it has N28W"),
        ("housner --component 90", "name it with --record"),
        ("housner --baseline", "name it with --record"),
        ("housner nofile.toml", "[record] lacks file"),
        ("record", "FILE"),
        ("record site.V2A --units g", "says its unit is mm/s2"),
    ] {
        let err = dir.refuses(line);
        assert!(err.contains(words), "{line}: {err}");
    }
}
