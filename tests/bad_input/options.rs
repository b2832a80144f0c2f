//! Options and values out of range, folders and files in the wrong place.

use super::*;

#[test]
fn an_unknown_option() {
    refuses(&[], "run --recrd a.at2", &["--recrd"]);
}

#[test]
fn a_folder_that_cannot_be_made() {
    refuses(&[("results", "a file\n")], "run --quiet --out results", &["results"]);
}

#[test]
fn results_that_cannot_be_written_are_refused_before_the_work() {
    let file = [("results", "a file\n")];
    for args in
        ["run --quiet --out results", "run --quiet --out results/below", "chart --out results"]
    {
        refuses(&file, args, &["results: is a file where a folder is needed"]);
    }
    refuses(&[("housner.csv/", "")], "housner --out .", &["is a folder; name a file"]);
    refuses(&[], "housner --out nowhere/h.csv", &["there is no folder nowhere"]);
    let parameters = ("p.json", PARAMETERS);
    let validate = "validate --parameters p.json --synthetic 3 --out results";
    refuses(&[parameters, file[0]], validate, &["results: is a file"]);
    refuses(
        &[parameters, file[0]],
        "verify --parameters p.json --out results",
        &["results: is a file"],
    );
    refuses(&[parameters], "simulate --parameters p.json --out x/h.csv", &["there is no folder x"]);
    let export = "export --parameters p.json --format csv --out results/";
    refuses(&[parameters, file[0]], export, &["results", "is a file where a folder is needed"]);
}

#[test]
fn options_that_are_no_numbers_or_out_of_range() {
    for (args, word) in [
        ("run --scale nan", "NaN"),
        ("run --work 0", "--work is 0.0"),
        ("run --work inf", "1 is the default"),
        ("run --time-limit -1", "give seconds above zero"),
        ("run --scale 1e300", "above 50 g"),
        ("run --duration nan", "--duration is NaN"),
        ("run --duration inf", "--duration is inf"),
        ("run --max-hz nan", "--max-hz is NaN"),
        ("run --friction -1", "--friction is -1"),
        ("run --jobs -1", "unexpected argument"),
        ("run --jobs 0", "--jobs is 0; give at least one thread"),
        ("chart --jobs 0", "--jobs is 0"),
        ("chart --alpha nan", "alpha is NaN"),
        ("run --scale inf", "inf"),
        ("run --accuracy inf", "--accuracy is inf"),
        ("run --max-hz 0", "--max-hz is 0.0"),
        ("run --duration 0", "--duration is 0"),
        ("run --jobs 99999999", "--jobs is 99999999"),
        ("run --step 0", "--step is 0.0; give a time step between 1e-6 and 0.1 s"),
        ("run --step nan", "--step is NaN"),
        ("run --for abaqus", "--for is \"abaqus\"; give sap2000, etabs or opensees-even"),
        ("run --for abaqus", "for another program: --step and --integrator"),
        ("run --step 1ms", "seconds as a number: 0.001"),
        ("run --integrator hht:0.333", "give hht:-0.333"),
        ("run --integrator hht:0.9", "--integrator is \"hht:0.9\""),
        (
            "run --for sap2000 --integrator trbdf2",
            "SAP2000 takes hht:ALPHA from -1/3 to 0, or newmark:GAMMA:BETA",
        ),
        ("run --substeps 0", "--substeps is 0; give a power of two from 1"),
        (
            "run --substeps 3",
            "--substeps is 3; give a power of two from 1 to 4096: 1, 2, 4, 8, ...",
        ),
        ("run --dt 0.01", "name it with --record"),
        ("housner --restitution nan", "--restitution is NaN"),
        ("housner --restitution -1", "--restitution is -1"),
        ("response --mu nan", "mu is NaN"),
        ("response --mu 1e308", "mu"),
        ("", "tune --help"),
        ("tune", "tune --help"),
    ] {
        refuses(&[], args, &[word]);
    }
}

#[test]
fn time_steps_that_cannot_be() {
    for dt in ["0", "-0.01", "nan", "1e9"] {
        refuses(
            &[("a.txt", "0.1\n0.2\n")],
            &format!("run --record a.txt --units g --dt {dt}"),
            &["time step"],
        );
    }
}

#[test]
fn files_as_other_systems_write_them() {
    let units = "--units g --dt 0.01";
    run_record("bom.txt", "\u{feff}0.1\r\n0.2\r\nx\r\n", units, &["bom.txt, line 3", "'x'"]);
    run_record(
        "german.csv",
        "Zeit;a [g]\n0,00;0,1\n0,01;0,2\n",
        "",
        &["german.csv, line 2", "decimal commas"],
    );
    run_record("wide.txt", "\u{0}1\u{0}", units, &["not a text file"]);
    run_record("huge.txt", "1e300\n1e300\n", units, &["above 50 g"]);
    run_record("huger.txt", "1e308\n1e308\n", units, &["sample 0 (counted from 0) is inf"]);
    run_record(
        "npts.at2",
        "x\nIN UNITS OF G\nNPTS= 999999999999, DT= .01\n0.1\n",
        "",
        &["NPTS 999999999999"],
    );
}

#[test]
fn parameters_missing_extra_or_impossible() {
    let refuse = |text: &str, words: &[&str]| {
        refuses(&[("p.json", text)], "simulate --parameters p.json", words);
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
        ("legs.ea_n", 1e9.into(), "kind = \"aframe\" elastic legs of its own"),
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
        ("[tuning]\nmax_omega_hz = inf\n", "max_omega_hz is inf"),
        ("[tuning]\nmax_settlement_m = 0.0\n", "max_settlement_m is 0"),
        ("[record]\nduration_s = inf\n", "duration_s is inf"),
        ("[legs]\nea_n = 1e9\nei_nm2 = 1e9\n", "kind = \"aframe\" elastic legs of its own"),
        ("[friction]\ncoefficient = nan\n", "coefficient is NaN"),
    ] {
        run_case(&format!("{STRUCTURE}{extra}"), &[word]);
    }
}

#[test]
fn sizes_that_are_zero_or_not_finite() {
    for (key, value, word) in [
        ("height_m = 1.0", "height_m = 0.0", "height_m is 0"),
        ("height_m = 1.0", "height_m = nan", "height_m is NaN"),
        ("width_m = 0.5", "width_m = inf", "width_m is inf"),
        ("width_m = 0.5", "width_m = -0.0", "width_m is -0"),
        ("mass_kg = 100.0", "mass_kg = 0.0", "mass_kg is 0"),
        ("mass_kg = 100.0", "mass_kg = nan", "mass_kg is NaN"),
    ] {
        run_case(&STRUCTURE.replace(key, value), &[word]);
    }
}

#[test]
fn a_settlement_that_no_springs_can_keep() {
    let least = format!("{STRUCTURE}[tuning]\nmax_settlement_m = 1e-12\n");
    run_case(&least, &["max_settlement_m is 1e-12", "springs of 200000 Hz"]);
    let small = format!(
        "{STRUCTURE}[record]\nscale = 2.0\n[tuning]\nmax_settlement_m = 1e-12\n\
            max_omega_hz = 160.0\n"
    );
    run_case(&small, &["max_settlement_m is 1e-12", "5.015e-6 m at least", "--max-hz"]);
    let paper = format!("{small}objective = \"arr\"\n");
    run_case(&paper, &["max_settlement_m is 1e-12", "5.393e-6 m at least"]);
}

#[test]
fn springs_and_members_beyond_all_measure() {
    for (path, value, words) in [
        (
            "vertical.k1_n_per_m",
            1e308,
            ["vertical.k1_n_per_m is 1e308", "times the weight over the height"],
        ),
        ("horizontal.k2_n_per_m", 1e-300, ["horizontal.k2_n_per_m is 1e-300", "in N/m"]),
        ("vertical.m2_kg", 1e300, ["vertical.m2_kg is 1e300", "times the structure's mass"]),
        ("horizontal.c_ns_per_m", 1e300, ["horizontal.c_ns_per_m is 1e300", "sqrt(g/height)"]),
        ("structure.mass_kg", 1e300, ["mass_kg is 1e300", "between 1e-9 and 1e15"]),
        ("structure.height_m", 1e-200, ["height_m is 1e-200", "between 1e-4 and 1e5"]),
    ] {
        for command in ["simulate", "export --format csv --out springs.csv"] {
            let line = format!("{command} --parameters p.json");
            refuses(&[("p.json", &with(path, value.into()))], &line, &words);
        }
    }
    for (members, word) in [
        ("[damper]\nc_ns_per_m = 1e300\n", "damper.c_ns_per_m is 1e300"),
        (
            "[tendon]\nstiffness_n_per_m = 1e300\npretension_n = 1.0\n",
            "tendon.stiffness_n_per_m is 1e300",
        ),
        ("[friction]\ncoefficient = 1e300\n", "friction.coefficient is 1e300"),
    ] {
        run_case(&format!("{STRUCTURE}{members}"), &[word]);
    }
}

#[test]
fn folders_where_files_belong_and_files_where_folders_do() {
    let folder = [("d/", "")];
    refuses(&folder, "run --quiet --record d", &["d: is a folder"]);
    refuses(&folder, "run d --quiet", &["d: cannot be read"]);
    refuses(&folder, "simulate --parameters d", &["d: cannot be read"]);
    let both = [("d/", ""), ("f", "x"), ("p.json", PARAMETERS)];
    let validate = |records| format!("validate --parameters p.json --out o --records {records}");
    refuses(&both, &validate("f"), &["f: cannot be read"]);
    refuses(&both, &validate("d"), &["d: no record files"]);
    refuses(&both, &validate("nowhere"), &["nowhere: cannot be read"]);
}

/// A file renamed into place would take the device's.
#[cfg(unix)]
#[test]
fn a_device_is_not_replaced_by_results() {
    let dir = TestFolder::with(&[("p.json", PARAMETERS)]);
    let sink = dir.path("sink");
    std::os::unix::fs::symlink("/dev/null", &sink).unwrap();
    for args in [
        "housner --out sink",
        "simulate --parameters p.json --out sink",
        "export --parameters p.json --format csv --out sink",
    ] {
        refuses_in(&dir, args, &["sink: is a device or a pipe"]);
    }
    assert!(sink.symlink_metadata().unwrap().is_symlink());
}
