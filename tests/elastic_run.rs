//! `tune run` on elastic structures, as a program.

use std::{
    path::Path,
    process::{Command, Output},
};

use serde_json::Value;

const PIER: &str = include_str!("../tuning/pier.toml");

fn tune(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tune")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_pier_is_tuned_and_what_is_written_agrees_with_itself() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pier.toml"), PIER).unwrap();
    let ran = tune(folder.path(), &["run", "pier.toml", "--quiet"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let said = text(&ran.stdout);
    assert!(said.contains("on its springs the rotation is within") && said.contains("rocking over fixed"), "{said}");
    let out = folder.path().join("out");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let parameters: Value = serde_json::from_str(&read("parameters.json")).unwrap();
    let on = &parameters["on_record"];
    // what the accuracy asked for allows on one record
    assert!(on["nrmse_rotation"].as_f64().unwrap() < 5.0 * 0.002, "{on}");
    assert!(on["energy_residual"].as_f64().unwrap() < 1e-5, "{on}");
    assert_eq!(parameters["springs"].as_array().unwrap().len(), 2);
    // rocking caps the moment that a fixed pier would bear: by less than its weight could turn it over
    let history = read("history.csv");
    assert_eq!(
        history.lines().next().unwrap(),
        "t,theta_reference,drift_reference,theta_fem,drift_fem,uplift_1,uplift_2"
    );
    assert_eq!(history.lines().count(), 2002);
    let page = read("report.html");
    assert!(page.contains("<h2>What the structure bears</h2>") && !page.contains("src=\"http"));
    assert!(
        read("decks/model_openseespy.py").contains("\"flatSliderBearing\"")
            && !read("decks/model_openseespy.py").contains('@')
    );
    assert!(
        read("decks/model_opensees.tcl").contains("flatSliderBearing")
            && !read("decks/model_opensees.tcl").contains('@')
    );
    assert_eq!(read("decks/springs.csv").lines().count(), 1 + 2 * 2);
    for (format, name) in
        [("openseespy", "model_openseespy.py"), ("opensees-tcl", "model_opensees.tcl"), ("csv", "springs.csv")]
    {
        let arguments = ["export", "--parameters", "out/parameters.json", "--format", format, "--out", "again"];
        let ran = tune(folder.path(), &arguments);
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        assert_eq!(
            std::fs::read_to_string(folder.path().join("again")).unwrap(),
            read(&format!("decks/{name}")),
            "{format}"
        );
    }
    for name in ["history.png", "history.svg", "forces.png", "forces.svg", "members.csv", "parameters.md"] {
        assert!(out.join(name).metadata().unwrap().len() > 300, "{name}");
    }

    // again, on one thread: the same bytes; without figures, none are left
    let before = read("parameters.json");
    let ran = tune(folder.path(), &["run", "pier.toml", "--quiet", "--jobs", "1", "--no-figures"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    assert_eq!(read("parameters.json"), before);
    assert!(!out.join("history.png").exists());

    // commands for rigid bodies say what this is
    let refused = tune(folder.path(), &["simulate", "--parameters", "out/parameters.json"]);
    assert_eq!(refused.status.code(), Some(2));
    let line = text(&refused.stderr);
    assert!(line.contains("elastic structure") && line.trim().lines().count() == 1, "{line}");
}

#[test]
fn what_cannot_be_is_refused_in_one_line_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (from, to, said) in [
        ("mass_kg = 600e3", "mass_kg = -600e3", "mass_kg"),
        ("mass_kg = 600e3", "mass_kg = nan", "mass_kg"),
        ("width_m = 4.0", "width_m = 400.0", "slenderness"),
        ("frequency_hz = 2.0", "frequency_hz = 2.0\nei_nm2 = 1e9", "one of ei_nm2 and frequency_hz"),
        ("frequency_hz = 2.0", "ei_nm2 = 1e3", "buckles"),
        ("frequency_hz", "frequenzy_hz", "did you mean \"frequency_hz\""),
        ("damping_ratio = 0.02", "damping_ratio = 2.0", "damping_ratio"),
        ("footing_mass_kg = 60e3\n", "", "footing_mass_kg"),
        ("kind = \"pier\"", "kind = \"tower\"", "pier"),
        ("[record]", "[damper]\nc_ns_per_m = 1.0\n[record]", "damper"),
    ] {
        assert!(PIER.contains(from), "{from}");
        std::fs::write(folder.path().join("case.toml"), PIER.replace(from, to)).unwrap();
        let ran = tune(folder.path(), &["run", "case.toml", "--quiet"]);
        let line = text(&ran.stderr);
        assert_eq!(ran.status.code(), Some(2), "{to}: {line}");
        assert!(line.contains(said) && line.trim().lines().count() == 1, "{to}: {line}");
        assert!(!folder.path().join("out").exists(), "{to}");
    }
}
