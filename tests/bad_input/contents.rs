//! Encodings, headers, columns and remembered records.

use super::*;

#[test]
fn cases_and_parameters_in_other_encodings_or_none() {
    let utf16 = |text: &str| {
        [0xfeff]
            .into_iter()
            .chain(text.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect::<Vec<u8>>()
    };
    let latin1 = [STRUCTURE.as_bytes(), b"# H\xf6he\n"].concat();
    for bytes in [&utf16(STRUCTURE), &latin1] {
        let words = ["c.toml: not a text file", "tune init"];
        refuses_bytes(("c.toml", bytes), "run c.toml --out o", &words);
    }
    let simulate = "simulate --parameters p.json";
    let words = ["p.json: cannot be read", "UTF-8"];
    refuses_bytes(("p.json", &utf16(PARAMETERS)), simulate, &words);
    for (text, word) in [
        (format!("{STRUCTURE}\0"), "c.toml, line 6"),
        (format!("\u{feff}{STRUCTURE}x = 1\n"), "c.toml, line 6: unknown key \"x\""),
        (STRUCTURE.replace('\n', "\r"), "c.toml, line 1"),
        (
            String::new(),
            "[structure] lacks kind (aframe, block, pier or frame), its sizes and its mass",
        ),
    ] {
        refuses(&[("c.toml", &text)], "run c.toml --out o", &[word]);
    }
    let doubled =
        PARAMETERS.trim_end().strip_suffix('}').unwrap().to_owned() + ",\"structure\":{}}";
    for (text, word) in [
        (format!("{PARAMETERS}\0"), "trailing characters"),
        (format!("{PARAMETERS}{{}}"), "trailing characters"),
        (doubled, "duplicate field `structure`"),
        ("[".repeat(100_000), "p.json, line 1"),
        ("null".into(), "p.json, line 1"),
        (String::new(), "p.json, line 1"),
    ] {
        refuses(&[("p.json", &text)], simulate, &[word]);
    }
}

#[test]
fn headers_that_cannot_be() {
    for (from, to, word) in [
        ("NPTS= 4", "NPTS= 0", "cannot read NPTS"),
        ("NPTS= 4", "NPTS= -4", "cannot read NPTS"),
        (".01000", "0.0", "cannot read NPTS and DT"),
        (".01000", "-.01", "cannot read NPTS and DT"),
        (".01000", "1e300", "time step is 1e300 s"),
        (", DT= .01000 SEC", "", "cannot read NPTS and DT"),
        ("ACCELERATION", "VELOCITY", "velocity"),
    ] {
        run_record(
            "a.at2",
            &format!("{}0.1 0.2 0.1 0.1\n", AT2.replace(from, to)),
            "",
            &["a.at2", word],
        );
    }
    let whole = format!("{AT2}0.1 0.2 0.1 0.1\n");
    run_record("a.at2", &whole, "--units cm/s2", &["its unit is g but --units is cm/s2"]);
    run_record("a.at2", &whole, "--dt 0.02", &["0.01 s but --dt is 0.02 s"]);
    run_record("a.txt", "# unit: g\n# unit: cm/s2\n0.1\n0.2\n", "--dt 0.01", &["--units"]);
}

#[test]
fn columns_that_are_no_record() {
    let units = "--units g --dt 0.01";
    run_record("one.txt", "0.9\n", units, &["one holds 1 sample", "at least two"]);
    run_record("inf.txt", "0.1\ninf\n", units, &["inf.txt, line 2"]);
    run_record("line.txt", &"1".repeat(1_000_000), units, &["line.txt, line 1"]);
    run_record("a.json", "{\"a\":[1,2]}", units, &["holds no samples"]);
    for (text, word) in [
        ("0.02,0.1\n0.01,0.2\n0.0,0.1\n", "line 2: the time falls from 0.02 to 0.01 s"),
        ("0,0.1\n0,0.2\n0,0.1\n", "line 2: the time step is 0.0 s"),
        ("nan,0.1\nnan,0.2\n", "line 1: 'nan'"),
        ("0,0.1,3\n0.01,0.2,3\n0.02,1,3\n", "3 columns"),
        ("0,0.1\n0.01\n0.02,1\n", "line 2: 1 column where"),
    ] {
        run_record("a.csv", text, "--units g", &[word]);
    }
}

#[test]
fn values_of_the_wrong_type() {
    for (from, to, word) in [
        ("1.0", "\"1.0\"", "line 3: height_m is \"1.0\"; write a number, without quotes"),
        ("1.0", "[1.0]", "line 3: height_m is [1.0]; write a number"),
        ("1.0", "2020-01-01", "line 3: height_m is 2020-01-01; write a number"),
        (
            "100.0",
            "99999999999999999999999",
            "line 5: mass_kg is 99999999999999999999999; write 1e23",
        ),
        (
            "\"block\"",
            "\"tower\"",
            "kind is \"tower\"; known are aframe, block (a cabinet, a tank, a column), pier",
        ),
        (
            "mass_kg = 100.0",
            "mass_kg = 1.0\nmass_kg = 2.0",
            "line 6: mass_kg is given twice; keep one",
        ),
    ] {
        run_case(&STRUCTURE.replace(from, to), &[word]);
    }
    for (extra, word) in [
        ("[structure]\n", "line 6: [structure] is there twice"),
        ("[tuning]\ncandidates = -1\n", "line 7: invalid value"),
        ("[tuning]\ncandidates = 1.5\n", "line 7: candidates is 1.5; write "),
        ("[tuning]\nobjective = \"best\"\n", "line 7: objective is \"best\"; known are "),
        ("[tuning]\naccuracy = 0.0\n", "tuning.accuracy is 0.0; give an error between 1e-5 and 1"),
        ("[tuning]\naccuracy = nan\n", "tuning.accuracy is NaN"),
        (
            "[tuning]\npeaks = 0.0\n",
            "tuning.peaks is 0.0; give an error of peaks between 1e-4 and 1",
        ),
        (
            "[tuning]\npeaks = 0.02\naccuracy = 0.01\n",
            "tuning.peaks is 0.02 and tuning.accuracy is 0.01",
        ),
        (
            "[tuning]\nobjective = \"impact\"\n",
            "line 7: objective \"impact\" is now landing; write objective = \"landing\"",
        ),
        ("[tuning]\nmax_omega_hz = 0.0\n", "max_omega_hz is 0.0"),
        ("[tuning]\nmax_settlement_m = -1.0\n", "max_settlement_m is -1.0"),
        ("[tuning]\nmass_ratios_horizontal = [1e9]\n", "between 0.001 and 1000"),
        ("[record]\nduration_s = 1e9\n", "duration_s is 1000000000.0"),
        ("[record]\ndt_s = 0.01\n", "[record] lacks file"),
        ("[record]\nunits = \"g\"\n", "[record] lacks file"),
        ("[record]\nunits = \"ft\"\n", "line 7: unit 'ft' is not known; use g, m/s2"),
        ("[record]\nfile = \".\"\n", "is a folder"),
        ("restitution = 0.5\nrestitution_ratio = 0.5\n", "not both"),
        ("[bounds]\nf_min = 2.0\nf_max = 1.0\n", "nothing lies between f_min"),
    ] {
        run_case(&format!("{STRUCTURE}{extra}"), &[word]);
    }
}

#[test]
fn options_beyond_all_measure_or_given_twice() {
    for (args, word) in [
        ("run --duration 1e9", "--duration is 1000000000.0"),
        ("run --duration -1", "--duration is -1"),
        ("run --duration 1 --duration 2", "multiple times"),
        ("run --peaks 2", "--peaks is 2.0; give an error of peaks between 1e-4 and 1"),
        ("run --peaks 0.02 --accuracy 0.01", "--peaks is 0.02; springs are chosen by"),
        ("run --accuracy 2", "--accuracy is 2.0; give an error between 1e-5 and 1"),
        ("run --max-hz 1e300", "--max-hz is 1e300"),
        ("run --jobs 1.5", "--jobs"),
        ("run --friction nan", "--friction is NaN"),
        ("run --out ''", "--out"),
        ("run --out /dev/null", "/dev/null: is a file where a folder is needed"),
        ("housner a b", "'b'"),
        ("response --mu 1e-300", "mu is 1e-300"),
        ("simulate", "--parameters"),
        ("frobnicate", "frobnicate"),
    ] {
        refuses(&[], args, &[word]);
    }
}

#[test]
fn a_remembered_record_that_is_missing_or_has_changed() {
    let file = |path: &str| {
        record_row(serde_json::json!({"kind": "file", "file": path, "path": path, "units": "g"}))
    };
    let (there, missing) = (remembering(file("a.txt")), remembering(file("b.txt")));
    let numbers = remembering(record_row(serde_json::json!({"kind": "numbers"})));
    let embedded = remembering(record_row(serde_json::json!({"kind": "embedded"})));
    for args in USERS {
        let refuse = |text: &str, words: &[&str]| {
            refuses(&[("p.json", text), ("a.txt", "0.1\n0.3\n-0.2\n")], args, words)
        };
        refuse(
            &there,
            &["p.json: its record a.txt has changed", "not 0123456789abcdef", "--record"],
        );
        refuse(&missing, &["p.json: its record b.txt is not there", "--record"]);
        refuse(&numbers, &["p.json: its record a was given as numbers", "--record"]);
        refuse(&embedded, &["its record the embedded El Centro has changed"]);
    }
    for text in ["0.1\nx\n", ""] {
        refuses(&[("p.json", &there), ("a.txt", text)], USERS[0], &["a.txt"]);
    }
}

#[test]
fn a_remembered_record_that_cannot_be() {
    let refuse = |text: &str, words: &[&str]| refuses(&[("p.json", text)], USERS[0], words);
    let embedded = || record_row(serde_json::json!({"kind": "embedded"}));
    let mut short = embedded();
    short["duration_s"] = (-1.0).into();
    refuse(&remembering(short), &["p.json: record.duration_s is -1"]);
    let mut typed = embedded();
    typed["scale"] = "one".into();
    refuse(&remembering(typed), &["p.json", "expected f64"]);
    refuse(
        &remembering(record_row(serde_json::json!({"kind": "cloud"}))),
        &["unknown variant `cloud`"],
    );
    let huge = "{\"kind\": \"embedded\"}";
    let text = remembering(serde_json::json!({
        "name": "a", "dt_s": 0.01, "samples": 3, "pga_g": 0.3, "scale": 1e300,
        "source": serde_json::from_str::<serde_json::Value>(huge).unwrap(),
    }));
    refuse(&text, &["above 50 g"]);
}

#[test]
fn parameters_of_a_newer_program() {
    let mut all: serde_json::Value = serde_json::from_str(PARAMETERS).unwrap();
    all["schema"] = 99.into();
    all["of_the_future"] = true.into();
    refuses(
        &[("p.json", &all.to_string())],
        USERS[0],
        &["p.json: its schema is 99", "reads up to 4"],
    );
}

#[test]
fn a_scale_for_a_remembered_record_that_cannot_be() {
    let file = [("p.json", PARAMETERS)];
    let with = |more: &str| format!("{} {more}", USERS[0]);
    refuses(&file, &with("--scale nan"), &["NaN"]);
    refuses(&file, &with("--scale 1e300"), &["above 50 g"]);
    refuses(&file, &with("--duration 0"), &["--duration is 0"]);
    refuses(&file, &with("--units g"), &["name it with --record"]);
}

#[test]
fn earthquakes_of_no_number() {
    let validate = |more: &str| format!("validate --parameters p.json {more}");
    let file = [("p.json", PARAMETERS)];
    refuses(&file, &validate("--earthquakes 0"), &["--earthquakes"]);
    refuses(&file, &validate("--earthquakes many"), &["many"]);
    refuses(&file, &validate("--seed 3"), &["--earthquakes"]);
}
