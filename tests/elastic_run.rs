//! `tune run` on elastic structures, as a program.

use std::path::Path;

use parameters::elastic::ElasticParameters;
use serde_json::Value;

#[path = "support/program.rs"]
mod program;

use program::tune;

const PIER: &str = include_str!("../tuning/pier.toml");

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What is said of the pier on a record in g, at an accuracy that takes no time.
fn run_coarsely(folder: &Path, record: &str) -> String {
    let run = ["run", "pier.toml", "--record", record, "--units", "g", "--accuracy", "0.1"];
    let quick = ["--no-figures", "--no-report", "--quiet"];
    let ran = tune(folder, &[&run[..], &quick].concat());
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    text(&ran.stdout)
}

#[test]
fn a_pier_is_tuned_and_what_is_written_agrees_with_itself() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pier.toml"), PIER).unwrap();
    // the ground offers less friction than the pier needs
    let ran = tune(folder.path(), &["run", "pier.toml", "--quiet", "--friction", "0.05"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let said = text(&ran.stdout);
    assert!(said.contains("It rocks and stands") && said.contains("by bending"), "{said}");
    let out = folder.path().join("out");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let parameters: Value = serde_json::from_str(&read("parameters.json")).unwrap();
    let findings = parameters["findings"].as_array().unwrap();
    let sliding = findings.iter().find(|finding| finding["finding"] == "sliding").unwrap();
    assert!(
        sliding["needed"].as_f64().unwrap() > 0.05 && sliding["available"] == 0.05,
        "{sliding}"
    );
    let on = &parameters["on_record"];
    let assessment = &parameters["assessment"];
    assert_eq!(assessment["reached"], true, "{assessment}");
    assert!(
        assessment["measured"]["record"]["median"][0].as_f64().unwrap() <= 0.002,
        "{assessment}"
    );
    assert!(on["nrmse_rotation"].as_f64().unwrap() <= 0.002, "{on}");
    assert!(on["energy_residual"].as_f64().unwrap() < 1e-5, "{on}");
    assert_eq!(parameters["springs"].as_array().unwrap().len(), 2);
    // what rocking buys: less shear and a smaller moment at the column's base than held to the
    // ground
    for force in ["column_shear_n", "column_base_moment_nm", "axial_n"] {
        let force = &parameters["design_forces"][force];
        assert_eq!(force["holds"], true, "{force}");
    }
    for force in ["column_shear_n", "column_base_moment_nm"] {
        let force = &parameters["design_forces"][force];
        let share = (force["value"].as_f64().unwrap() / force["fixed"].as_f64().unwrap()).abs();
        assert!(share > 0.1 && share < 0.6, "{force}");
    }
    let peaks = &parameters["peaks"]["springs"];
    let number = |key: &str| peaks[key].as_f64().unwrap();
    assert!(number("rocking_m") > 5.0 * number("bending_m") && number("uplift_m") > 0.1, "{peaks}");
    assert!(
        (number("drift_ratio") * 12.0 / number("top_displacement_m") - 1.0).abs() < 1e-9,
        "{peaks}"
    );
    members_are_whole(&read("members.csv"));
    let history = read("history.csv");
    assert_eq!(
        history.lines().next().unwrap(),
        "t,theta_reference,drift_reference,theta_fem,drift_fem,uplift_1,uplift_2"
    );
    assert_eq!(history.lines().count(), 2002);
    let page = read("report.html");
    assert!(page.contains("<h2>Forces to design with</h2>") && !page.contains("src=\"http"));
    decks_are_whole(folder.path());
    for name in [
        "history.png",
        "history.svg",
        "forces.png",
        "forces.svg",
        "members.csv",
        "members_envelopes.csv",
        "parameters.md",
    ] {
        assert!(out.join(name).metadata().unwrap().len() > 300, "{name}");
    }

    again_on_one_thread(folder.path());
    refuses(folder.path());
}

/// Forces at the same instants, from where the column stands in compression.
fn members_are_whole(members: &str) {
    assert!(
        members
            .lines()
            .next()
            .unwrap()
            .ends_with(",ground_vertical_n,ground_vertical_below_20_hz_n")
    );
    // at first the column stands in compression, under the mass
    let axial: f64 = members.lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
    assert!((axial / (-600e3 * 9.81) - 1.0).abs() < 1e-6, "{axial}");
}

/// The same bytes; without figures, none are left.
fn again_on_one_thread(folder: &Path) {
    let out = folder.join("out");
    let read = || std::fs::read_to_string(out.join("parameters.json")).unwrap();
    let before = read();
    let ran = tune(
        folder,
        &["run", "pier.toml", "--quiet", "--friction", "0.05", "--jobs", "1", "--no-figures"],
    );
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    assert_eq!(read(), before);
    assert!(!out.join("history.png").exists());
}

/// What is refused of an elastic structure.
fn refuses(folder: &Path) {
    let refused = tune(folder, &["run", "pier.toml", "--quiet", "--friction", "-0.3"]);
    let line = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{line}");
    assert!(line.contains("--friction") && line.trim().lines().count() == 1, "{line}");
    // and springs softer than any that could be judged
    let refused = tune(folder, &["run", "pier.toml", "--quiet", "--max-hz", "0.5"]);
    let line = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{line}");
    assert!(
        line.contains("max_omega_hz (--max-hz) is 0.5") && line.trim().lines().count() == 1,
        "{line}"
    );

    // a history needs two samples
    std::fs::write(folder.join("one.txt"), "1.0\n").unwrap();
    let refused = tune(
        folder,
        &["run", "pier.toml", "--quiet", "--record", "one.txt", "--dt", "0.01", "--units", "g"],
    );
    let line = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{line}");
    assert!(line.contains("needs at least two") && line.trim().lines().count() == 1, "{line}");

    // commands for rigid bodies say what this is
    let refused = tune(folder, &["housner", "--out", "out", "pier.toml"]);
    let line = text(&refused.stderr);
    assert!(line.contains("pier.toml: this is an elastic structure"), "{line}");
    let refused = tune(folder, &["simulate", "--parameters", "out/parameters.json"]);
    assert_eq!(refused.status.code(), Some(2));
    let line = text(&refused.stderr);
    assert!(line.contains("elastic structure") && line.trim().lines().count() == 1, "{line}");
}

/// Every deck of a run is there, without places left to fill in, and exported again the same.
fn decks_are_whole(folder: &Path) {
    for (format, name, holds) in [
        ("openseespy", "model_openseespy.py", "\"flatSliderBearing\""),
        ("opensees-tcl", "model_opensees.tcl", "flatSliderBearing"),
        ("sap2000", "model_sap2000.s2k", "END TABLE DATA"),
        ("csv", "springs.csv", "corner 2"),
    ] {
        let deck = std::fs::read_to_string(folder.join("out/decks").join(name)).unwrap();
        assert!(deck.contains(holds) && !deck.contains('@'), "{name}");
        let ran = tune(
            folder,
            &[
                "export",
                "--parameters",
                "out/parameters.json",
                "--format",
                format,
                "--out",
                "again",
            ],
        );
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        assert_eq!(std::fs::read_to_string(folder.join("again")).unwrap(), deck, "{format}");
    }
    let springs = std::fs::read_to_string(folder.join("out/decks/springs.csv")).unwrap();
    assert_eq!(springs.lines().count(), 1 + 2 * 2);
}

#[test]
fn what_cannot_be_is_refused_in_one_line_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (from, to, said) in [
        ("mass_kg = 600e3", "mass_kg = -600e3", "mass_kg"),
        ("frequency_hz", "frequenzy_hz", "did you mean \"frequency_hz\""),
        ("footing_mass_kg = 60e3\n", "", "footing_mass_kg"),
        ("kind = \"pier\"", "kind = \"tower\"", "pier"),
        ("[record]", "[damper]\nc_ns_per_m = -1.0\n[record]", "damper.c_ns_per_m is -1"),
        ("[record]", "[damper]\nc = 1.0\n[record]", "did you mean \"c_ns_per_m\""),
        ("[record]", "[tendon]\nstiffness_n_per_m = 1e8\n[record]", "pretension_n"),
        (
            "[record]",
            "[tendon]\nstiffness_n_per_m = 0.0\npretension_n = 1.0\n[record]",
            "stiffness_n_per_m is 0",
        ),
        ("[record]", "[tendon]\nstiffness_n_per_m = 1e9\npretension_n = 4e9\n[record]", "tendon"),
        ("[record]", "[friction]\ncoefficient = 0.5\n[record]", "rigid bodies only"),
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

/// A history that ends early is said, and filed so that it can be read.
#[test]
fn a_pier_that_overturns_is_told_to() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pier.toml"), PIER).unwrap();
    // three times what lifts it, for two seconds
    let pulse: String =
        (0..600).map(|i| if (100..300).contains(&i) { "0.54\n" } else { "0.0\n" }).collect();
    std::fs::write(folder.path().join("pulse.txt"), format!("# dt = 0.01\n{pulse}")).unwrap();
    let said = run_coarsely(folder.path(), "pulse.txt");
    assert!(
        said.contains("The structure overturns at t = ") && said.contains("(in the reference at "),
        "{said}"
    );
    let out = folder.path().join("out");
    let json = std::fs::read_to_string(out.join("parameters.json")).unwrap();
    let parameters = ElasticParameters::parse("parameters.json", &json).unwrap();
    assert!(!parameters.on_record.unwrap().whole);
    // both models' histories to their ends, cells of the one that ends before are empty
    let history = std::fs::read_to_string(out.join("history.csv")).unwrap();
    let columns: Vec<Vec<&str>> =
        history.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let given = |k: usize| columns.iter().filter(|row| !row[k].is_empty()).count();
    assert_eq!(given(1).max(given(3)), columns.len());
    assert!(given(1) < 600 && given(3) < 600 && given(5) == given(3), "{} {}", given(1), given(3));
}

/// Without a motion there are no landings to speak of, and no errors of rounding over rounding.
#[test]
fn of_a_record_without_a_motion_no_landing_and_no_error_is_said() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pier.toml"), PIER).unwrap();
    std::fs::write(
        folder.path().join("still.txt"),
        "# dt = 0.01\n".to_string() + &"0.0\n".repeat(20),
    )
    .unwrap();
    let said = run_coarsely(folder.path(), "still.txt");
    assert!(said.contains("The record does not lift the structure"), "{said}");
    assert!(!said.contains("on this record"), "{said}");
}

/// A portal with all that takes lines: a vertical motion, doubts, forces, a search that was cut.
#[test]
fn a_crowded_screen_has_thirty_lines_at_most() {
    let folder = tempfile::tempdir().unwrap();
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20161113_110259_WTMC_20.V2A");
    let case = format!(
        "[structure]\nkind = 'frame'\nheight_m = 11.25\nspan_m = 13.25\nfooting_width_m = 3.25\n\
        footing_height_m = 1.25\nfooting_mass_kg = 40\nbeam_mass_kg = 300e3\ncolumn_ea_n = 4e10\n\
        column_ei_nm2 = 6e9\nbeam_ea_n = 5e10\nbeam_ei_nm2 = 9e9\ndamping_ratio = 0.03\n\
        [record]\nfile = '{record}'\nvertical = 'auto'\nscale = -0.55\nduration_s = 200\n"
    );
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let run = ["run", "case.toml", "--quiet", "--no-figures", "--time-limit", "1"];
    let ran = tune(folder.path(), &run);
    let screen = text(&ran.stdout);
    assert!(ran.status.success() && screen.lines().count() <= 30, "{screen}");
    assert!(screen.lines().all(|line| line.chars().count() <= 100), "{screen}");
    assert_eq!(screen.lines().filter(|line| line.starts_with("CHECK ")).count(), 3, "{screen}");
    assert!(screen.lines().last().is_some_and(|line| line.starts_with("report ")), "{screen}");
}
