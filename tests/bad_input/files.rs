//! Files that are missing, cut short or of the wrong kind; decks and interpreters.

use super::*;

#[test]
fn a_missing_record() {
    refuses(&[], "run --record nowhere.at2", &["nowhere.at2"]);
}

#[test]
fn a_missing_case() {
    refuses(&[], "run nowhere.toml", &["nowhere.toml", "check the name"]);
}

#[test]
fn a_truncated_record() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2 0.3\n"), "", &["a.at2", "4", "3"]);
}

#[test]
fn a_record_with_more_samples_than_its_header_says() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2 0.3 0.2 0.1\n"), "", &["a.at2", "4", "5"]);
}

#[test]
fn an_empty_record() {
    run_record("a.txt", "", "--dt 0.01 --units g", &["a.txt", "no samples"]);
}

#[test]
fn a_nan_in_a_record() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2\n NaN 0.3\n"), "", &["a.at2, line 6"]);
}

#[test]
fn a_word_in_a_record() {
    run_record("a.txt", "0.1\n0.2\noops\n", "--dt 0.01 --units g", &["a.txt, line 3", "oops"]);
}

#[test]
fn uneven_time_steps() {
    run_record(
        "a.csv",
        "0.00,0.1\n0.01,0.2\n0.03,0.1\n0.04,0.0\n",
        "--units g",
        &["a.csv, line 3"],
    );
}

#[test]
fn a_record_without_units() {
    run_record("a.csv", "0.00,0.1\n0.01,0.2\n0.02,0.1\n", "", &["a.csv", "--units"]);
}

#[test]
fn a_column_without_a_time_step() {
    run_record("a.txt", "0.1\n0.2\n0.1\n", "--units g", &["a.txt", "--dt"]);
}

#[test]
fn wrong_units_make_an_absurd_acceleration() {
    run_record("a.txt", "10\n300\n-250\n", "--dt 0.01 --units g", &["units"]);
}

#[test]
fn unknown_units() {
    refuses(&[("a.txt", "0.1\n")], "run --record a.txt --dt 0.01 --units furlong", &["furlong"]);
}

#[test]
fn a_negative_mass() {
    run_case(
        &STRUCTURE.replace("100.0", "-100.0"),
        &["case.toml", "mass_kg is -100", "greater than zero"],
    );
}

#[test]
fn a_structure_too_stocky_to_rock() {
    run_case(&STRUCTURE.replace("0.5", "3.0"), &["case.toml", "alpha"]);
}

#[test]
fn an_unknown_key() {
    run_case(
        &format!("{STRUCTURE}[tuning]\nmax_omega = 3.0\n"),
        &["case.toml, line 7", "did you mean \"max_omega_hz\""],
    );
}

#[test]
fn a_missing_key() {
    run_case(
        "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\n",
        &["case.toml", "mass_kg"],
    );
}

#[test]
fn a_case_that_is_not_toml() {
    run_case("[structure\n", &["case.toml, line 1"]);
}

#[test]
fn an_empty_target_band() {
    let target = "[[target.bands]]\ng_low = 2.0\ng_high = 1.0\nkind = \"cap\"\nlimit = 1.0\n";
    run_case(&format!("{STRUCTURE}{target}"), &["band 1", "g_low"]);
}

#[test]
fn the_papers_procedure_needs_a_record_that_lifts_the_structure() {
    let case = format!("{STRUCTURE}[record]\nscale = 0.1\n[tuning]\nobjective = \"arr\"\n");
    run_case(&case, &["never lifts", "--scale", "leave objective = \"arr\" out"]);
}

#[test]
fn a_stiffness_of_nothing() {
    refuses(&[], "run --max-hz -5 --out results", &["max-hz"]);
}

#[test]
fn a_mass_ratio_of_nothing() {
    refuses(&[], "response --mu -1", &["mu is -1"]);
}

#[test]
fn parameters_that_are_not_json() {
    refuses(&[("p.json", "{")], "simulate --parameters p.json", &["p.json, line 1"]);
}

#[test]
fn parameters_with_a_spring_of_no_stiffness() {
    for command in ["simulate", "verify", "export --format csv --out springs.csv"] {
        let line = format!("{command} --parameters p.json");
        refuses(&[("p.json", &parameters(0.0))], &line, &["p.json", "vertical.k1_n_per_m is 0"]);
    }
}

#[test]
fn a_deck_for_an_unknown_program() {
    export(
        "--format nastran --out deck",
        &["nastran", "openseespy, opensees-tcl, sap2000, sap2000-sheet, csv, markdown"],
    );
}

#[test]
fn a_deck_without_a_format() {
    export("--out deck", &["--format"]);
}

#[test]
fn a_deck_in_a_folder_that_is_not_there() {
    export(
        "--format csv --out nowhere/deck.csv",
        &["nowhere/deck.csv", "there is no folder nowhere"],
    );
}

#[test]
fn a_deck_of_no_duration() {
    export("--format csv --out deck.csv --duration -1", &["--duration is -1"]);
}

#[test]
fn a_deck_of_a_record_that_is_missing() {
    export("--format csv --out deck.csv --record nowhere.at2", &["nowhere.at2"]);
}

#[test]
fn a_python_that_is_missing() {
    verify("--python /nowhere/python3", &["/nowhere/python3", "--python"]);
}

/// `false` stands for a Python that ends at once, `env` for a command that is not OpenSees.
#[cfg(unix)]
#[test]
fn an_interpreter_that_runs_no_deck() {
    verify("--python false", &["ended with code 1 without a word", "--python"]);
    verify("--tcl ''", &["cannot be started", "--tcl"]);
}

#[test]
fn both_interpreters() {
    verify("--python python3 --tcl OpenSees", &["--tcl", "--python"]);
}

/// A pipe waits for ever for a writer, a device never ends.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_no_files() {
    let dir = TestFolder::with(&[]);
    let made = std::process::Command::new("mkfifo").arg(dir.path("pipe")).status();
    assert!(made.unwrap().success());
    for name in ["pipe", "/dev/zero"] {
        for command in [
            "run",
            "run --record",
            "record",
            "simulate --parameters",
            "verify --parameters",
            "housner",
            "sweep",
        ] {
            refuses_in(&dir, &format!("{command} {name}"), &[name, "copy it to a file"]);
        }
    }
}

/// The bytes get to no terminal, and the name stays one that can be read.
#[cfg(unix)]
#[test]
fn a_name_that_would_steer_a_terminal_is_spelt_out() {
    let name = "a\u{1b}[2J\u{7}\u{202e}.at2";
    refuses(&[(name, "x")], &format!("record {name}"), &["a\\u{1b}[2J\\u{7}\\u{202e}.at2"]);
    refuses(&[], &format!("run {name}"), &["a\\u{1b}[2J\\u{7}\\u{202e}.at2"]);
}
