//! Mistakes that users make in their first case: one line each that says what, where, and what to
//! do.

use super::*;

const PIER: &str = "[structure]\nkind = \"pier\"\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
    footing_mass_kg = 60e3\nfooting_height_m = 1.5\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n";

/// Time and three accelerations, with names and without.
const NAMED: &str =
    "time [s],acc1 [g],acc2 [g],note [g]\n0.00,0.1,0.2,0\n0.01,-0.1,0.3,0\n0.02,0.2,-0.1,0\n";
const BARE: &str = "0.00 0.1 0.2\n0.01 -0.1 0.3\n0.02 0.2 -0.1\n";

#[test]
fn a_motion_of_nothing() {
    for zero in ["0.0", "0", "-0.0"] {
        run_case(
            &format!("{STRUCTURE}[record]\nscale = {zero}\n"),
            &["case.toml, line 7: record.scale is", "give another factor"],
        );
        run_case(
            &format!("{PIER}[record]\nscale = {zero}\n"),
            &["case.toml, line 11: record.scale is", "give another factor"],
        );
        refuses(
            &[],
            &format!("run --scale {zero} --out results"),
            &["--scale is 0.0; nothing would move"],
        );
    }
    let simulate = "simulate --parameters p.json --scale 0";
    refuses(&[("p.json", PARAMETERS)], simulate, &["--scale is 0.0; nothing would move"]);
}

#[test]
fn all_that_a_case_lacks_at_once() {
    let add = "add what is missing; `tune init";
    let lacks = |text: &str, words: &str| run_case(text, &[words, add]);
    lacks(
        "[structure]\nkind = \"block\"\ntotal_height_m = 2.0\n[record]\ndt_s = 0.01\n\
            units = \"g\"\n",
        "case.toml: [structure] lacks width_m, mass_kg; [record] lacks file, for dt_s, units: add",
    );
    lacks(
        "[structure]\nkind = \"block\"\nwidth_m = 0.5\n",
        "lacks total_height_m (or height_m, of the centre of mass), mass_kg",
    );
    lacks("[structure]\nkind = \"aframe\"\n", "[structure] lacks height_m, width_m, mass_kg: add");
    lacks(
        "[structure]\nkind = \"pier\"\nheight_m = 12.0\nmass_kg = 6e5\n[damper]\n",
        "[structure] lacks width_m, footing_mass_kg, footing_height_m, damping_ratio, frequency_hz \
            (or ei_nm2); [damper] lacks c_ns_per_m",
    );
    lacks(
        &PIER.replace("frequency_hz = 2.0\n", ""),
        "case.toml: [structure] lacks frequency_hz (or ei_nm2): add",
    );
    lacks(&format!("{PIER}[record]\nvertical = \"auto\"\n"), "[record] lacks file, for vertical");
    lacks(
        "[structure]\nkind = \"frame\"\nheight_m = 12.0\n",
        "lacks span_m, footing_width_m, footing_height_m, footing_mass_kg",
    );
    lacks(&format!("{STRUCTURE}[tendon]\n"), "[tendon] lacks stiffness_n_per_m, pretension_n");
    lacks(
        &PIER.replace("kind = \"pier\"\n", ""),
        "[structure] lacks kind (aframe, block, pier or frame)",
    );
    lacks(
        &STRUCTURE
            .replace("[structure]", "[tuning]")
            .replace("kind", "# kind")
            .replace("height_m", "# height_m")
            .replace("width_m", "# width_m")
            .replace("mass_kg", "# mass_kg"),
        "[structure] lacks kind",
    );
    // a key that is misspelt is named, not the one that it stands for
    run_case(
        &PIER.replace("kind", "knid"),
        &["line 2: unknown key \"knid\"; did you mean \"kind\"?"],
    );
}

#[test]
fn a_record_given_as_a_case_and_the_other_way_round() {
    let at2 = format!("{AT2} 0.1 0.2 0.3 0.2\n");
    for command in ["run", "housner", "record --case"] {
        let of = |file: &str| format!("{command} {file}");
        refuses(
            &[("a.at2", &at2)],
            &of("a.at2"),
            &["a.at2: this is a ground motion (PEER AT2)", "give it with --record"],
        );
        refuses(
            &[("a.csv", BARE)],
            &of("a.csv"),
            &["a.csv: this is a ground motion (columns), not a case file"],
        );
        refuses(
            &[("p.json", PARAMETERS)],
            &of("p.json"),
            &["p.json: this is JSON, not a case file", "--parameters p.json"],
        );
    }
    let latin1 = [NAMED.as_bytes(), b"# H\xf6he\n"].concat();
    refuses_bytes(("a.csv", &latin1), "run a.csv", &["a.csv: this is a ground motion (columns)"]);
    let case = [("case.toml", PIER), ("main.toml", "")];
    for args in ["run --record case.toml", "housner --record case.toml", "record case.toml"] {
        refuses(
            &case[..1],
            args,
            &["case.toml: this is a case file, not a ground motion; run it as `tune run \
                    case.toml`"],
        );
    }
    let of_case = format!("{STRUCTURE}[record]\nfile = \"pier.toml\"\n");
    refuses(
        &[("case.toml", &of_case), ("pier.toml", PIER)],
        "run case.toml",
        &["pier.toml: this is a case file"],
    );
}

#[test]
fn numbers_with_commas() {
    let comma =
        |from: &str, to: &str, words: &str| run_case(&STRUCTURE.replace(from, to), &[words]);
    comma(
        "1.0",
        "1,9",
        "case.toml, line 3: height_m is 1,9, a number with a comma; write it with a point: 1.9",
    );
    comma(
        "0.5",
        "0,5 # m",
        "case.toml, line 4: width_m is 0,5, a number with a comma; write it with a point: 0.5",
    );
    comma(
        "100.0",
        "680,100",
        "case.toml, line 5: mass_kg is 680,100, a number with a comma; write it with a point: \
            680.100, or 680100",
    );
    run_case(
        &PIER.replace("600e3", "6,0e5"),
        &["case.toml, line 5", "write it with a point: 6.0e5"],
    );
    refuses(&[], "run --scale 1,9", &["'1,9'", "write it with a point: 1.9"]);
}

#[test]
fn a_table_of_several_columns() {
    run_record(
        "a.csv",
        NAMED,
        "",
        &[
            "a.csv, line 2: 4 columns; choose",
            "--column",
            "column 2 (acc1 [g]), column 3 (acc2 [g])",
        ],
    );
    run_record("a.csv", BARE, "--units g", &["a.csv, line 1: 3 columns", "column 2, column 3"]);
    for (column, words) in [
        ("1", "a.csv: there is no component column 1; it has column 2 (acc1 [g])"),
        ("9", "there is no component column 9"),
        ("acc3", "there is no component acc3"),
    ] {
        run_record("a.csv", NAMED, &format!("--column {column}"), &[words]);
    }
    run_record(
        "a.csv",
        &NAMED.replace("acc2 [g]", "vel [m/s]"),
        "--column 3",
        &["a.csv: the header speaks of velocity"],
    );
    run_record(
        "a.at2",
        &format!("{AT2} 0.1 0.2 0.3 0.2\n"),
        "--column 2",
        &["there is no component column 2; it has one without a name"],
    );
    run_record("a.csv", NAMED, "--column 2 --component acc1", &["cannot be used with"]);
    let both = format!("{STRUCTURE}[record]\nfile = \"a.csv\"\ncolumn = 2\ncomponent = \"acc1\"\n");
    refuses(
        &[("case.toml", &both), ("a.csv", NAMED)],
        "run case.toml",
        &["case.toml, line 9: record.component is \"acc1\"", "leave one"],
    );
    refuses(&[], "run --column 2", &["--column", "name it with --record"]);
}
