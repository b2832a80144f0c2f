//! Bad input of every kind: one clear line on stderr, exit code 2, nothing written.

use std::{fs, path::Path};

use assert_cmd::Command;
use tempfile::TempDir;

/// Run `tune` in an empty folder with the given files; it must fail cleanly and say each of `words`.
fn refuses(files: &[(&str, &str)], args: &[&str], words: &[&str]) {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    refuses_bytes(&files, args, words);
}

/// The same with files of any bytes; a name that ends in / is a folder.
fn refuses_bytes(files: &[(&str, &[u8])], args: &[&str], words: &[&str]) {
    let dir = TempDir::new().unwrap();
    for (name, bytes) in files {
        let path = dir.path().join(name);
        if name.ends_with('/') { fs::create_dir(path).unwrap() } else { fs::write(path, bytes).unwrap() }
    }
    refuses_in(dir.path(), args, words);
}

fn refuses_in(dir: &Path, args: &[&str], words: &[&str]) {
    let before = entries(dir);
    let output = Command::cargo_bin("tune").unwrap().current_dir(dir).args(args).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{args:?}: {stderr}");
    assert_eq!(stderr.trim_end().lines().count(), 1, "{args:?}: more than one line: {stderr}");
    assert!(stderr.chars().count() < 400, "{args:?}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{args:?}: {stderr:?} does not say {word:?}");
    }
    assert!(output.stdout.is_empty(), "{args:?} printed a result");
    let left = entries(dir);
    assert_eq!(left.len(), before.len(), "{args:?} wrote something: {left:?}");
}

fn entries(dir: &Path) -> Vec<String> {
    fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
}

const STRUCTURE: &str = "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";
const AT2: &str = "PEER\nname\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 4, DT= .01000 SEC\n";

fn run_case(text: &str, words: &[&str]) {
    refuses(&[("case.toml", text)], &["run", "case.toml", "--quiet", "--out", "results"], words);
}

fn run_record(name: &str, text: &str, more: &[&str], words: &[&str]) {
    let mut args = vec!["run", "--quiet", "--out", "results", "--record", name];
    args.extend(more);
    refuses(&[(name, text)], &args, words);
}

#[test]
fn a_missing_record() {
    refuses(&[], &["run", "--record", "nowhere.at2"], &["nowhere.at2"]);
}

#[test]
fn a_missing_case() {
    refuses(&[], &["run", "nowhere.toml"], &["nowhere.toml", "check the name"]);
}

#[test]
fn a_truncated_record() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2 0.3\n"), &[], &["a.at2", "4", "3"]);
}

#[test]
fn a_record_with_more_samples_than_its_header_says() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2 0.3 0.2 0.1\n"), &[], &["a.at2", "4", "5"]);
}

#[test]
fn an_empty_record() {
    run_record("a.txt", "", &["--dt", "0.01", "--units", "g"], &["a.txt", "no samples"]);
}

#[test]
fn a_nan_in_a_record() {
    run_record("a.at2", &format!("{AT2} 0.1 0.2\n NaN 0.3\n"), &[], &["a.at2, line 6"]);
}

#[test]
fn a_word_in_a_record() {
    run_record("a.txt", "0.1\n0.2\noops\n", &["--dt", "0.01", "--units", "g"], &["a.txt, line 3", "oops"]);
}

#[test]
fn uneven_time_steps() {
    run_record("a.csv", "0.00,0.1\n0.01,0.2\n0.03,0.1\n0.04,0.0\n", &["--units", "g"], &["a.csv, line 3"]);
}

#[test]
fn a_record_without_units() {
    run_record("a.csv", "0.00,0.1\n0.01,0.2\n0.02,0.1\n", &[], &["a.csv", "--units"]);
}

#[test]
fn a_column_without_a_time_step() {
    run_record("a.txt", "0.1\n0.2\n0.1\n", &["--units", "g"], &["a.txt", "--dt"]);
}

#[test]
fn wrong_units_make_an_absurd_acceleration() {
    run_record("a.txt", "10\n300\n-250\n", &["--dt", "0.01", "--units", "g"], &["units"]);
}

#[test]
fn unknown_units() {
    refuses(&[("a.txt", "0.1\n")], &["run", "--record", "a.txt", "--dt", "0.01", "--units", "furlong"], &["furlong"]);
}

#[test]
fn a_negative_mass() {
    run_case(&STRUCTURE.replace("100.0", "-100.0"), &["case.toml", "mass_kg is -100", "greater than zero"]);
}

#[test]
fn a_structure_too_stocky_to_rock() {
    run_case(&STRUCTURE.replace("0.5", "3.0"), &["case.toml", "alpha"]);
}

#[test]
fn a_height_that_is_not_a_number() {
    run_case(&STRUCTURE.replace("height_m = 1.0", "height_m = nan"), &["case.toml", "height_m is NaN"]);
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
    run_case("[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\n", &["case.toml", "mass_kg"]);
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
fn a_duration_of_zero() {
    refuses(&[], &["run", "--duration", "0", "--out", "results"], &["--duration is 0"]);
}

#[test]
fn a_stiffness_of_nothing() {
    refuses(&[], &["run", "--max-hz", "-5", "--out", "results"], &["max-hz"]);
}

#[test]
fn a_mass_ratio_of_nothing() {
    refuses(&[], &["response", "--mu", "-1"], &["mu is -1"]);
}

#[test]
fn parameters_that_are_not_json() {
    refuses(&[("p.json", "{")], &["simulate", "--parameters", "p.json"], &["p.json, line 1"]);
}

/// A parameter file whose vertical chain has this k1.
fn parameters(k1: f64) -> String {
    let row = |k1: f64| {
        format!(
            "{{\"mu\":1,\"f\":1,\"xi\":1,\"omega_n_hz\":1,\"k1_n_per_m\":{k1},\"k2_n_per_m\":1e6,\"m2_kg\":10,\"c_ns_per_m\":1e3}}"
        )
    };
    let structure =
        "{\"kind\":\"block\",\"height_m\":1,\"width_m\":0.5,\"mass_kg\":100,\"rotational_inertia_kgm2\":35}";
    format!("{{\"structure\":{structure},\"vertical\":{},\"horizontal\":{}}}", row(k1), row(1e6))
}

#[test]
fn parameters_with_a_spring_of_no_stiffness() {
    for command in [&["simulate"][..], &["verify"], &["export", "--format", "csv", "--out", "springs.csv"]] {
        let args = [command, &["--parameters", "p.json"]].concat();
        refuses(&[("p.json", &parameters(0.0))], &args, &["p.json", "vertical.k1_n_per_m is 0"]);
    }
}

fn export(more: &[&str], words: &[&str]) {
    let args = [&["export", "--parameters", "p.json"], more].concat();
    refuses(&[("p.json", &parameters(1e6))], &args, words);
}

#[test]
fn a_deck_for_an_unknown_program() {
    export(&["--format", "nastran", "--out", "deck"], &["nastran", "openseespy, opensees-tcl, sap2000, csv, markdown"]);
}

#[test]
fn a_deck_without_a_format() {
    export(&["--out", "deck"], &["--format"]);
}

#[test]
fn a_deck_in_a_folder_that_is_not_there() {
    export(&["--format", "csv", "--out", "nowhere/deck.csv"], &["nowhere/deck.csv", "there is no folder nowhere"]);
}

#[test]
fn a_deck_of_no_duration() {
    export(&["--format", "csv", "--out", "deck.csv", "--duration", "-1"], &["--duration is -1"]);
}

#[test]
fn a_deck_of_a_record_that_is_missing() {
    export(&["--format", "csv", "--out", "deck.csv", "--record", "nowhere.at2"], &["nowhere.at2"]);
}

fn verify(more: &[&str], words: &[&str]) {
    let args = [&["verify", "--parameters", "p.json", "--duration", "0.5"], more].concat();
    refuses(&[("p.json", &parameters(1e6))], &args, words);
}

#[test]
fn a_python_that_is_missing() {
    verify(&["--python", "/nowhere/python3"], &["/nowhere/python3", "--python"]);
}

/// `false` stands for a Python that ends at once, `env` for a command that is not OpenSees.
#[cfg(unix)]
#[test]
fn an_interpreter_that_runs_no_deck() {
    verify(&["--python", "false"], &["OpenSees stopped", "no message"]);
    verify(&["--tcl", ""], &["cannot be started", "--tcl"]);
}

#[test]
fn both_interpreters() {
    verify(&["--python", "python3", "--tcl", "OpenSees"], &["--tcl", "--python"]);
}

#[test]
fn an_unknown_option() {
    refuses(&[], &["run", "--recrd", "a.at2"], &["--recrd"]);
}

#[test]
fn a_folder_that_cannot_be_made() {
    refuses(&[("results", "a file\n")], &["run", "--quiet", "--out", "results"], &["results"]);
}

#[test]
fn results_that_cannot_be_written_are_refused_before_the_work() {
    let file = [("results", "a file\n")];
    for args in [
        &["run", "--quiet", "--out", "results"][..],
        &["run", "--quiet", "--out", "results/below"],
        &["bench", "--quick", "--out", "results"],
    ] {
        refuses(&file, args, &["results: is a file where a folder is needed"]);
    }
    refuses(&[], &["housner", "--out", "."], &["is a folder; name a file"]);
    refuses(&[], &["housner", "--out", "nowhere/h.csv"], &["there is no folder nowhere"]);
    let parameters = ("p.json", PARAMETERS);
    let validate = ["validate", "--parameters", "p.json", "--synthetic", "3", "--out", "results"];
    refuses(&[parameters, file[0]], &validate, &["results: is a file"]);
    refuses(&[parameters, file[0]], &["verify", "--parameters", "p.json", "--out", "results"], &["results: is a file"]);
    refuses(&[parameters], &["simulate", "--parameters", "p.json", "--out", "x/h.csv"], &["there is no folder x"]);
    let export = ["export", "--parameters", "p.json", "--format", "csv", "--out", "."];
    refuses(&[parameters], &export, &["is a folder; name a file"]);
}

const PARAMETERS: &str = include_str!("../fuzz/corpus/parameters/paper");

#[test]
fn options_that_are_no_numbers_or_out_of_range() {
    for (args, word) in [
        (&["run", "--scale", "nan"][..], "NaN"),
        (&["run", "--scale", "1e300"], "above 50 g"),
        (&["run", "--duration", "nan"], "--duration is NaN"),
        (&["run", "--duration", "inf"], "--duration is inf"),
        (&["run", "--max-hz", "nan"], "--max-hz is NaN"),
        (&["run", "--friction", "-1"], "--friction is -1"),
        (&["run", "--jobs", "-1"], "unexpected argument"),
        (&["run", "--jobs", "99999999"], "--jobs is 99999999"),
        (&["run", "--dt", "0.01"], "name it with --record"),
        (&["housner", "--restitution", "nan"], "--restitution is NaN"),
        (&["housner", "--restitution", "-1"], "--restitution is -1"),
        (&["response", "--mu", "nan"], "mu is NaN"),
        (&["response", "--mu", "1e308"], "mu"),
        (&[], "tune --help"),
        (&["tune"], "tune --help"),
    ] {
        refuses(&[], args, &[word]);
    }
}

#[test]
fn time_steps_that_cannot_be() {
    for dt in ["0", "-0.01", "nan", "1e9"] {
        refuses(&[("a.txt", "0.1\n0.2\n")], &["run", "--record", "a.txt", "--units", "g", "--dt", dt], &["time step"]);
    }
}

#[test]
fn files_as_other_systems_write_them() {
    let units = ["--units", "g", "--dt", "0.01"];
    run_record("bom.txt", "\u{feff}0.1\r\n0.2\r\nx\r\n", &units, &["bom.txt, line 3", "'x'"]);
    run_record("german.csv", "Zeit;a [g]\n0,00;0,1\n0,01;0,2\n", &[], &["german.csv, line 2", "decimal commas"]);
    run_record("wide.txt", "\u{0}1\u{0}", &units, &["not a text file"]);
    run_record("huge.txt", "1e300\n1e300\n", &units, &["above 50 g"]);
    run_record("huger.txt", "1e308\n1e308\n", &units, &["sample 0 (counted from 0) is inf"]);
    run_record("npts.at2", "x\nIN UNITS OF G\nNPTS= 999999999999, DT= .01\n0.1\n", &[], &["NPTS 999999999999"]);
}

fn with(path: &str, value: serde_json::Value) -> String {
    let mut all: serde_json::Value = serde_json::from_str(PARAMETERS).unwrap();
    let (section, key) = path.split_once('.').unwrap();
    all[section][key] = value;
    all.to_string()
}

#[test]
fn parameters_missing_extra_or_impossible() {
    let refuse = |text: &str, words: &[&str]| {
        refuses(&[("p.json", text)], &["simulate", "--parameters", "p.json"], words);
    };
    for (path, value, word) in [
        ("structure.mass_kg", 0.0.into(), "mass_kg is 0"),
        ("structure.height_m", (-3.0).into(), "height_m is -3"),
        ("structure.width_m", 1e4.into(), "slenderness"),
        ("structure.width_m", 1e9.into(), "width_m is 1000000000.0"),
        ("structure.kind", "tower".into(), "tower"),
        ("structure.colour", 1.into(), "unknown field `colour`"),
        ("vertical.k1_n_per_m", (-1.0).into(), "vertical.k1_n_per_m is -1"),
        ("vertical.k2_n_per_m", "stiff".into(), "expected f64"),
        ("horizontal.m2_kg", 0.0.into(), "horizontal.m2_kg is 0"),
        ("horizontal.c_ns_per_m", (-1.0).into(), "horizontal.c_ns_per_m is -1"),
        ("horizontal.c", 1.0.into(), "unknown field `c`"),
    ] {
        refuse(&with(path, value), &["p.json", word]);
    }
    refuse("{}", &["missing field `structure`"]);
    refuse("[1]", &["p.json, line 1"]);
    refuse("\u{feff}{}", &["p.json, line 1"]);
}

#[test]
fn case_values_that_cannot_be() {
    for (extra, word) in [
        ("restitution = -1.0\n", "restitution is -1"),
        ("[record]\nfile = \"nowhere.at2\"\n", "nowhere.at2"),
        ("[record]\nscale = nan\n", "NaN"),
        ("[tuning]\ncandidates = 0\n", "candidates is 0"),
        ("[tuning]\nmass_ratios_vertical = []\n", "at least one mass ratio"),
        ("[bounds]\nf_min = -1.0\n", "f_min is -1"),
        ("[[target.bands]]\nkind = \"cap\"\nlimit = nan\n", "limit"),
        ("[damper]\nc_ns_per_m = nan\n", "c_ns_per_m is NaN"),
    ] {
        run_case(&format!("{STRUCTURE}{extra}"), &[word]);
    }
}

#[test]
fn a_settlement_that_no_springs_can_keep() {
    let least = format!("{STRUCTURE}[tuning]\nmax_settlement_m = 1e-12\n");
    run_case(&least, &["max_settlement_m is 1e-12", "springs of 200000 Hz"]);
    let small = format!("{STRUCTURE}[record]\nscale = 2.0\n[tuning]\nmax_settlement_m = 1e-12\nmax_omega_hz = 160.0\n");
    run_case(&small, &["max_settlement_m is 1e-12", "5.015e-6 m at least", "--max-hz"]);
    let paper = format!("{small}objective = \"arr\"\n");
    run_case(&paper, &["max_settlement_m is 1e-12", "5.393e-6 m at least"]);
}

#[test]
fn springs_and_members_beyond_all_measure() {
    for (path, value, words) in [
        ("vertical.k1_n_per_m", 1e308, ["vertical.k1_n_per_m is 1e308", "times the weight over the height"]),
        ("horizontal.k2_n_per_m", 1e-300, ["horizontal.k2_n_per_m is 1e-300", "in N/m"]),
        ("vertical.m2_kg", 1e300, ["vertical.m2_kg is 1e300", "times the structure's mass"]),
        ("horizontal.c_ns_per_m", 1e300, ["horizontal.c_ns_per_m is 1e300", "sqrt(g/height)"]),
        ("structure.mass_kg", 1e300, ["mass_kg is 1e300", "between 1e-9 and 1e15"]),
        ("structure.height_m", 1e-200, ["height_m is 1e-200", "between 1e-4 and 1e5"]),
    ] {
        for command in [&["simulate"][..], &["export", "--format", "csv", "--out", "springs.csv"]] {
            let args = [command, &["--parameters", "p.json"]].concat();
            refuses(&[("p.json", &with(path, value.into()))], &args, &words);
        }
    }
    for (members, word) in [
        ("[legs]\nea_n = 1e300\nei_nm2 = 1e9\n", "legs.ea_n is 1e300, 1.0e297 times the weight"),
        ("[legs]\nea_n = 1e9\nei_nm2 = 1e-300\n", "legs.ei_nm2 is 1e-300"),
        ("[damper]\nc_ns_per_m = 1e300\n", "damper.c_ns_per_m is 1e300"),
        ("[tendon]\nstiffness_n_per_m = 1e300\npretension_n = 1.0\n", "tendon.stiffness_n_per_m is 1e300"),
        ("[friction]\ncoefficient = 1e300\n", "friction.coefficient is 1e300"),
    ] {
        run_case(&format!("{STRUCTURE}{members}"), &[word]);
    }
}

#[test]
fn folders_where_files_belong_and_files_where_folders_do() {
    let folder: [(&str, &[u8]); 1] = [("d/", b"")];
    refuses_bytes(&folder, &["run", "--quiet", "--record", "d"], &["d: is a folder"]);
    refuses_bytes(&folder, &["run", "d", "--quiet"], &["d: cannot be read"]);
    refuses_bytes(&folder, &["simulate", "--parameters", "d"], &["d: cannot be read"]);
    let both: [(&str, &[u8]); 3] = [("d/", b""), ("f", b"x"), ("p.json", PARAMETERS.as_bytes())];
    let validate = |records| ["validate", "--parameters", "p.json", "--out", "o", "--records", records];
    refuses_bytes(&both, &validate("f"), &["f: cannot be read"]);
    refuses_bytes(&both, &validate("d"), &["d: no record files"]);
    refuses_bytes(&both, &validate("nowhere"), &["nowhere: cannot be read"]);
}

/// A file renamed into place would take the device's.
#[cfg(unix)]
#[test]
fn a_device_is_not_replaced_by_results() {
    let dir = TempDir::new().unwrap();
    let sink = dir.path().join("sink");
    std::os::unix::fs::symlink("/dev/null", &sink).unwrap();
    fs::write(dir.path().join("p.json"), PARAMETERS).unwrap();
    for args in [
        &["housner", "--out", "sink"][..],
        &["simulate", "--parameters", "p.json", "--out", "sink"],
        &["export", "--parameters", "p.json", "--format", "csv", "--out", "sink"],
    ] {
        refuses_in(dir.path(), args, &["sink: is a device or a pipe"]);
    }
    assert!(fs::symlink_metadata(&sink).unwrap().is_symlink());
}

#[test]
fn cases_and_parameters_in_other_encodings_or_none() {
    let utf16 =
        |text: &str| [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let latin1 = [STRUCTURE.as_bytes(), b"# H\xf6he\n"].concat();
    for bytes in [&utf16(STRUCTURE), &latin1] {
        refuses_bytes(&[("c.toml", bytes)], &["run", "c.toml", "--out", "o"], &["c.toml: cannot be read", "UTF-8"]);
    }
    let simulate = ["simulate", "--parameters", "p.json"];
    refuses_bytes(&[("p.json", &utf16(PARAMETERS))], &simulate, &["p.json: cannot be read", "UTF-8"]);
    for (text, word) in [
        (format!("{STRUCTURE}\0"), "c.toml, line 6"),
        (format!("\u{feff}{STRUCTURE}x = 1\n"), "c.toml, line 6: unknown key \"x\""),
        (STRUCTURE.replace('\n', "\r"), "c.toml, line 1"),
        (String::new(), "missing field `structure`"),
    ] {
        refuses(&[("c.toml", &text)], &["run", "c.toml", "--out", "o"], &[word]);
    }
    let doubled = PARAMETERS.trim_end().strip_suffix('}').unwrap().to_owned() + ",\"structure\":{}}";
    for (text, word) in [
        (format!("{PARAMETERS}\0"), "trailing characters"),
        (format!("{PARAMETERS}{{}}"), "trailing characters"),
        (doubled, "duplicate field `structure`"),
        ("[".repeat(100_000), "p.json, line 1"),
        ("null".into(), "p.json, line 1"),
        (String::new(), "p.json, line 1"),
    ] {
        refuses(&[("p.json", &text)], &simulate, &[word]);
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
        run_record("a.at2", &format!("{}0.1 0.2 0.1 0.1\n", AT2.replace(from, to)), &[], &["a.at2", word]);
    }
    let whole = format!("{AT2}0.1 0.2 0.1 0.1\n");
    run_record("a.at2", &whole, &["--units", "cm/s2"], &["its unit is g but --units is cm/s2"]);
    run_record("a.at2", &whole, &["--dt", "0.02"], &["0.01 s but --dt is 0.02 s"]);
    run_record("a.txt", "# unit: g\n# unit: cm/s2\n0.1\n0.2\n", &["--dt", "0.01"], &["--units"]);
}

#[test]
fn columns_that_are_no_record() {
    let units = ["--units", "g", "--dt", "0.01"];
    run_record("one.txt", "0.9\n", &units, &["one holds 1 sample", "at least two"]);
    run_record("inf.txt", "0.1\ninf\n", &units, &["inf.txt, line 2"]);
    run_record("line.txt", &"1".repeat(1_000_000), &units, &["line.txt, line 1"]);
    run_record("a.json", "{\"a\":[1,2]}", &units, &["holds no samples"]);
    for (text, word) in [
        ("0.02,0.1\n0.01,0.2\n0.0,0.1\n", "line 2: the time step is -0.01 s"),
        ("0,0.1\n0,0.2\n0,0.1\n", "line 2: the time step is 0.0 s"),
        ("nan,0.1\nnan,0.2\n", "line 1: 'nan'"),
        ("0,0.1,3\n0.01,0.2,3\n0.02,1,3\n", "3 columns"),
        ("0,0.1\n0.01\n0.02,1\n", "line 2: 1 columns"),
    ] {
        run_record("a.csv", text, &["--units", "g"], &[word]);
    }
}

#[test]
fn values_of_the_wrong_type() {
    for (from, to, word) in [
        ("1.0", "\"1.0\"", "line 3: invalid type: string"),
        ("1.0", "[1.0]", "line 3: invalid type: sequence"),
        ("1.0", "2020-01-01", "line 3: invalid type"),
        ("100.0", "99999999999999999999999", "line 5: invalid type"),
        ("\"block\"", "\"tower\"", "unknown variant `tower`"),
        ("mass_kg = 100.0", "mass_kg = 1.0\nmass_kg = 2.0", "line 6: duplicate key"),
    ] {
        run_case(&STRUCTURE.replace(from, to), &[word]);
    }
    for (extra, word) in [
        ("[structure]\n", "line 6: duplicate key"),
        ("[tuning]\ncandidates = -1\n", "line 7: invalid value"),
        ("[tuning]\ncandidates = 1.5\n", "line 7: invalid type"),
        ("[tuning]\nobjective = \"best\"\n", "unknown variant `best`"),
        ("[tuning]\naccuracy = 0.0\n", "tuning.accuracy is 0.0; give an error between 1e-5 and 1"),
        ("[tuning]\naccuracy = nan\n", "tuning.accuracy is NaN"),
        (
            "[tuning]\nobjective = \"impact\"\n",
            "line 7: objective \"impact\" is now landing; write objective = \"landing\"",
        ),
        ("[tuning]\nmax_omega_hz = 0.0\n", "max_omega_hz is 0.0"),
        ("[tuning]\nmax_settlement_m = -1.0\n", "max_settlement_m is -1.0"),
        ("[tuning]\nmass_ratios_horizontal = [1e9]\n", "between 0.001 and 1000"),
        ("[record]\nduration_s = 1e9\n", "duration_s is 1000000000.0"),
        ("[record]\ndt_s = 0.01\n", "record.file is not given"),
        ("[record]\nunits = \"g\"\n", "record.file is not given"),
        ("[record]\nunits = \"ft\"\n", "unknown variant `ft`"),
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
        (&["run", "--duration", "1e9"][..], "--duration is 1000000000.0"),
        (&["run", "--duration", "-1"], "--duration is -1"),
        (&["run", "--duration", "1", "--duration", "2"], "multiple times"),
        (&["run", "--accuracy", "2"], "--accuracy is 2.0; give an error between 1e-5 and 1"),
        (&["run", "--max-hz", "0"], "--max-hz is 0.0"),
        (&["run", "--max-hz", "1e300"], "--max-hz is 1e300"),
        (&["run", "--jobs", "1.5"], "--jobs"),
        (&["run", "--friction", "nan"], "--friction is NaN"),
        (&["run", "--out", ""], "--out"),
        (&["run", "--out", "/dev/null"], "/dev/null: is a file where a folder is needed"),
        (&["housner", "a", "b"], "'b'"),
        (&["response", "--mu", "1e-300"], "mu is 1e-300"),
        (&["simulate"], "--parameters"),
        (&["frobnicate"], "frobnicate"),
    ] {
        refuses(&[], args, &[word]);
    }
}

/// The parameters of `PARAMETERS` with this record.
fn remembering(record: serde_json::Value) -> String {
    let mut all: serde_json::Value = serde_json::from_str(PARAMETERS).unwrap();
    all["record"] = record;
    all.to_string()
}

fn record_row(source: serde_json::Value) -> serde_json::Value {
    serde_json::json!({
        "name": "a", "dt_s": 0.01, "samples": 3, "pga_g": 0.3, "scale": 1.0, "duration_s": 0.02,
        "fnv1a_64": "0123456789abcdef", "source": source,
    })
}

/// Each command that uses the record a parameters.json remembers.
const USERS: [&[&str]; 3] = [
    &["simulate", "--parameters", "p.json"],
    &["verify", "--parameters", "p.json"],
    &["export", "--parameters", "p.json", "--format", "csv", "--out", "springs.csv"],
];

#[test]
fn a_remembered_record_that_is_missing_or_has_changed() {
    let file = |path: &str| record_row(serde_json::json!({"kind": "file", "file": path, "path": path, "units": "g"}));
    let (there, missing) = (remembering(file("a.txt")), remembering(file("b.txt")));
    let numbers = remembering(record_row(serde_json::json!({"kind": "numbers"})));
    let embedded = remembering(record_row(serde_json::json!({"kind": "embedded"})));
    for args in USERS {
        let refuse =
            |text: &str, words: &[&str]| refuses(&[("p.json", text), ("a.txt", "0.1\n0.3\n-0.2\n")], args, words);
        refuse(&there, &["p.json: its record a.txt has changed", "not 0123456789abcdef", "--record"]);
        refuse(&missing, &["p.json: its record b.txt is not there", "--record"]);
        refuse(&numbers, &["p.json: its record a was made by a program", "--record"]);
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
    refuse(&remembering(record_row(serde_json::json!({"kind": "cloud"}))), &["unknown variant `cloud`"]);
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
    refuses(&[("p.json", &all.to_string())], USERS[0], &["p.json: its schema is 99", "reads up to 2"]);
}

#[test]
fn a_scale_for_a_remembered_record_that_cannot_be() {
    let file = [("p.json", PARAMETERS)];
    let with = |more: &[&'static str]| [USERS[0], more].concat();
    refuses(&file, &with(&["--scale", "nan"]), &["NaN"]);
    refuses(&file, &with(&["--scale", "1e300"]), &["above 50 g"]);
    refuses(&file, &with(&["--duration", "0"]), &["--duration is 0"]);
    refuses(&file, &with(&["--units", "g"]), &["name it with --record"]);
}

#[test]
fn earthquakes_of_no_number() {
    let validate = |more: &[&'static str]| [&["validate", "--parameters", "p.json"][..], more].concat();
    let file = [("p.json", PARAMETERS)];
    refuses(&file, &validate(&["--earthquakes", "0"]), &["--earthquakes"]);
    refuses(&file, &validate(&["--earthquakes", "many"]), &["many"]);
    refuses(&file, &validate(&["--seed", "3"]), &["--earthquakes"]);
}
