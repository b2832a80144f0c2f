//! Decks without the programs they are for: they hold every number, to the last bit, and parse.

mod corner_history;
mod elastic_tables;
mod refusal;
mod sliding;
mod stepping;
mod typed;

use std::{collections::HashMap, process::Command};

use super::*;
use crate::{
    language::{PYTHON, TCL},
    stepping::EvenSteps,
};
use dynamics::spring::{Design, Springs};
use fixed_steps::Integrator;
use rocking::{
    members::{Damper, Members},
    structure::Structure,
};

fn springs(hz: f64) -> Springs<Design<f64>> {
    let chain = |mu, k, hz| Design::from_kc(mu, k, 0.92, hz);
    Springs { vertical: chain(0.5, 0.2, hz), horizontal: chain(0.3, 0.57, hz / 3.0) }
}

fn parameters() -> Parameters {
    Parameters::new(Structure::paper(), &springs(40.0))
}

/// Peaks that no run gives: the tests look for them in the texts.
const EXPECTED: Expected = Expected {
    samples: 2001,
    compared: 2001,
    settled: -0.00123,
    u: (0.4567, -0.3456),
    v: (0.0421, -0.0012),
    width_sensitivity: 1e-6,
    accuracy: 0.002,
};

/// Steps that no run gives, with which SAP2000's formats are made.
fn even_steps() -> EvenSteps {
    EvenSteps {
        step: 0.001,
        integrator: Integrator::HHT_MOST,
        substeps: 16,
        touches: 1,
        newton: 40,
        unbalance: Some(0.5),
        adds_inertia: false,
        not_to_be_used: None,
        errors: [None; 2],
        etabs: false,
        ends: EvenEnds::default(),
    }
}

fn deck_on(record: &Record, format: DeckFormat) -> String {
    let model = DeckModel::new(&parameters(), record, &EXPECTED).unwrap();
    export_model(&DeckModel { even: format.is_sap2000().then(even_steps), ..model }, format)
        .unwrap()
}

fn deck(format: DeckFormat) -> String {
    deck_on(&Record::el_centro(), format)
}

/// Every number that the models need; `inertia`, I_cg, as a share of m R^2.
fn numbers(inertia: f64) -> Vec<f64> {
    let p = parameters();
    let mut all: Vec<f64> = [p.vertical, p.horizontal]
        .iter()
        .flat_map(|row| [row.k1_n_per_m, row.k2_n_per_m, row.m2_kg, row.c_ns_per_m])
        .collect();
    all.extend([61.0, 6.1, 680.1e3, inertia * 680.1e3 * (61.0 * 61.0 + 6.1 * 6.1)]);
    all.extend([-0.00123, 0.4567, -0.3456, 0.0421, -0.0012]);
    all
}

/// All numbers in a text.
fn numbers_in(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)))
        .filter_map(|word| word.parse().ok())
        .collect()
}

#[test]
fn opensees_decks_hold_every_number_to_the_last_bit() {
    for format in [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl] {
        let found = numbers_in(&deck(format));
        for number in numbers(1e-5) {
            // the inertia comes from a sum in another order
            let same = |x: &&f64| **x == number || (*x / number - 1.0).abs() < 1e-15;
            assert!(found.iter().any(|x| same(&x)), "{format:?}: {number} is missing");
        }
    }
}

/// I_cg of a deck: as given, but for a body that has none and for one with dampers that has little.
#[test]
fn a_deck_has_the_rotational_inertia_that_its_body_needs() {
    let m_r2 = 680.1e3 * (61.0 * 61.0 + 6.1 * 6.1);
    let damped = Members { damper: Some(Damper { c: 1e6 }), ..Members::default() };
    for (given, members, share) in [
        (0.0, Members::default(), 1e-5),
        (2e-5, Members::default(), 2e-5),
        (0.0, damped, 5e-4),
        (2e-5, damped, 5e-4),
        (5e-3, damped, 5e-3),
    ] {
        let structure = Structure { rotational_inertia_kgm2: given * m_r2, ..Structure::paper() };
        let held = with_inertia(&structure, &members).rotational_inertia_kgm2;
        assert!((held / (share * m_r2) - 1.0).abs() < 1e-12, "{given} {members:?}: {held}");
    }
}

/// In the air dampers hold the mass of a body whose rotation our own history takes to be massless,
/// both at once; where it has inertia they stay at its corners.
#[test]
fn dampers_of_a_massless_rotation_hold_the_mass_in_the_air() {
    let m_r2 = 680.1e3 * (61.0 * 61.0 + 6.1 * 6.1);
    let record = Record::el_centro();
    for (share, c, aloft) in [(0.0, 1e6, 2e6), (1e-3, 3e6, 6e6), (3e-3, 1e6, 0.0), (0.0, 0.0, 0.0)]
    {
        let structure = Structure { rotational_inertia_kgm2: share * m_r2, ..Structure::paper() };
        let members = Members { damper: (c > 0.0).then_some(Damper { c }), ..Members::default() };
        let parameters = Parameters::new(structure, &Springs::table_1()).with_members(members);
        for format in [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl] {
            let deck = crate::deck(&parameters, &record, format).unwrap();
            let name = match format {
                DeckFormat::OpenSeesPy => "DAMPER_ALOFT = ",
                _ => "set damperAloft ",
            };
            let text = deck.split(name).nth(1).unwrap();
            let value: f64 = text.split_whitespace().next().unwrap().parse().unwrap();
            assert_eq!(value, aloft, "{format:?} {share} {c}");
        }
    }
}

#[test]
fn opensees_decks_hold_the_whole_record_in_order() {
    let accel = Record::el_centro().accel;
    for (format, begin) in
        [(DeckFormat::OpenSeesPy, "RECORD = ("), (DeckFormat::OpenSeesTcl, "set record {")]
    {
        let text = deck(format);
        let rows = text.split(begin).nth(1).unwrap();
        let rows = rows.split([')', '}']).next().unwrap();
        assert_eq!(numbers_in(rows), accel, "{format:?}");
    }
}

#[test]
fn no_placeholder_is_left_in_a_deck() {
    for format in DeckFormat::ALL {
        assert!(!deck(format).contains('@'), "{format:?}");
    }
}

#[test]
fn the_python_deck_compiles() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.py");
    std::fs::write(&path, deck(DeckFormat::OpenSeesPy)).unwrap();
    // a machine without Python can still run the other tests
    if let Ok(run) = Command::new("python3").args(["-m", "py_compile"]).arg(&path).output() {
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    }
}

#[test]
fn a_record_name_cannot_break_out_of_a_comment() {
    let mut record = Record::el_centro();
    record.name = "a\"\"\"\n} ; exit [exec rm x] \\ @K1_V@".into();
    for format in DeckFormat::ALL {
        let text = deck_on(&record, format);
        assert!(
            !text.contains("a\"\"\"") && !text.contains("[exec") && !text.contains("@K1_V@"),
            "{format:?}"
        );
    }
}

#[test]
fn plain_tables_hold_every_chain_of_both_feet() {
    let p = parameters();
    for format in [DeckFormat::Csv, DeckFormat::Markdown] {
        let text = deck(format);
        for row in [p.vertical, p.horizontal] {
            for number in [row.k1_n_per_m, row.k2_n_per_m, row.m2_kg, row.c_ns_per_m] {
                // once a foot
                let written = format!("{number:.16e}");
                assert_eq!(written.parse::<f64>().unwrap(), number);
                assert_eq!(text.matches(&written).count(), 2, "{format:?}: {number}");
            }
        }
    }
}

/// Steps a sample at least, and the accuracy, as a deck for springs of `hz` states them.
fn stated(hz: f64, width_sensitivity: f64) -> (f64, f64) {
    let parameters = Parameters::new(Structure::paper(), &springs(hz));
    let expected = Expected { width_sensitivity, ..EXPECTED };
    let text =
        export(&parameters, &Record::el_centro(), &expected, DeckFormat::OpenSeesPy).unwrap();
    let after = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name)).unwrap();
        line[name.len()..].split_whitespace().next().unwrap().parse().unwrap()
    };
    (after("STEPS_PER_SAMPLE = "), after("ACCURACY = "))
}

/// Steps follow from the accuracy while the deck runs, not from stiffness: a pair a sample at most
/// on any springs.
#[test]
fn steps_a_sample_do_not_follow_from_stiffness() {
    for hz in [6.2, 160.0, 1e4, 1e5] {
        assert_eq!(stated(hz, 1e-6), (2.0, 0.002), "{hz} Hz");
    }
}

/// 15,000 times what a change of the width by 1e-5 does, at most 8.
#[test]
fn a_history_that_hangs_on_little_is_asked_more_accurately() {
    for (width_sensitivity, tighter) in [(5e-5, 1.0), (2e-4, 3.0), (0.1, 8.0), (0.9, 8.0)] {
        let accuracy = stated(1e4, width_sensitivity).1;
        assert!(
            (accuracy * tighter / 0.002 - 1.0).abs() < 1e-12,
            "{width_sensitivity}: {accuracy}"
        );
    }
}

/// Both routines are documented and whole without the deck around them.
#[test]
fn the_stepping_routine_is_in_both_decks_as_it_stands() {
    for (format, routine) in [
        (DeckFormat::OpenSeesPy, include_str!("steps.py")),
        (DeckFormat::OpenSeesTcl, include_str!("steps.tcl")),
    ] {
        assert!(
            deck(format).contains(routine.trim_end())
                && routine.contains("pasted into a script of your own")
        );
        assert!(!routine.contains('@'));
        // what a deck of a body that slides has otherwise is there to be replaced
        let language = if format == DeckFormat::OpenSeesPy { &PYTHON } else { &TCL };
        assert_eq!(routine.matches(language.refused[0]).count(), 1);
    }
}

#[test]
fn numbers_that_make_no_deck_are_refused_in_one_line() {
    let mut p = parameters();
    p.vertical.k1_n_per_m = f64::NAN;
    let error =
        export(&p, &Record::el_centro(), &EXPECTED, DeckFormat::Csv).unwrap_err().to_string();
    assert!(error.contains("vertical.k1_n_per_m") && !error.contains('\n'), "{error}");
    let long = Expected { samples: 4000, ..EXPECTED };
    let error = export(&parameters(), &Record::el_centro(), &long, DeckFormat::Csv)
        .unwrap_err()
        .to_string();
    assert!(error.contains("4000") && error.contains("3995"), "{error}");
    let error = "nastran".parse::<DeckFormat>().unwrap_err().to_string();
    assert!(
        error.contains("openseespy, opensees-tcl, sap2000, sap2000-sheet, csv, markdown"),
        "{error}"
    );
}

/// Rows of every table of an .s2k text: name -> [field -> value].
type Tables = HashMap<String, Vec<HashMap<String, String>>>;

fn read_s2k(text: &str) -> Tables {
    let mut tables = Tables::new();
    let mut name = String::new();
    let joined = text.replace(" _\n", " ");
    for line in joined.lines() {
        if let Some(rest) = line.strip_prefix("TABLE:  \"") {
            name = rest.trim_end_matches('"').to_string();
        } else if line == "END TABLE DATA" {
            return tables;
        } else if line.starts_with("   ") {
            let mut row = HashMap::new();
            let mut rest = line.trim();
            while let Some((key, value)) = rest.split_once('=') {
                let (value, next) = match value.strip_prefix('"') {
                    Some(quoted) => quoted.split_once('"').unwrap(),
                    None => value.split_once(' ').unwrap_or((value, "")),
                };
                row.insert(key.trim().to_string(), value.to_string());
                rest = next.trim();
            }
            tables.entry(name.clone()).or_default().push(row);
        }
    }
    panic!("no END TABLE DATA");
}

fn number(row: &HashMap<String, String>, field: &str) -> f64 {
    row[field].parse().unwrap()
}

#[test]
fn sap2000_tables_hold_masses_stiffnesses_weight_and_record_in_kilonewtons() {
    let p = parameters();
    let t = read_s2k(&deck(DeckFormat::Sap2000));
    assert_eq!(t["PROGRAM CONTROL"][0]["CurrUnits"], "KN, m, C");

    let total =
        |field| t["JOINT ADDED MASS ASSIGNMENTS"].iter().map(|row| number(row, field)).sum::<f64>();
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
    assert!(close(total("Mass1"), (680.1e3 + 2.0 * p.horizontal.m2_kg) / 1e3));
    assert!(close(total("Mass3"), (680.1e3 + 2.0 * p.vertical.m2_kg) / 1e3));
    assert!(close(total("MMI2"), 1e-5 * 680.1 * (61.0 * 61.0 + 6.1 * 6.1)));

    let find = |table: &str, link: &str, dof: &str, field: &str| {
        let row = t[table].iter().find(|row| row["Link"] == link && row["DOF"] == dof).unwrap();
        number(row, field) * 1e3
    };
    let ground = "LINK PROPERTY DEFINITIONS 02 - LINEAR";
    assert!(close(find(ground, "GROUND", "U1", "TransKE"), p.vertical.k2_n_per_m));
    assert!(close(find(ground, "GROUND", "U1", "TransCE"), p.vertical.c_ns_per_m));
    assert!(close(find(ground, "GROUND", "U2", "TransKE"), p.horizontal.k2_n_per_m));
    assert!(close(find(ground, "GROUND", "U2", "TransCE"), p.horizontal.c_ns_per_m));
    let foot = "LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR";
    assert!(close(find(foot, "FOOT", "U1", "TransK"), p.vertical.k1_n_per_m));
    assert!(close(find(foot, "FOOT", "U2", "TransK"), p.horizontal.k1_n_per_m));
    let gap = "LINK PROPERTY DEFINITIONS 05 - GAP";
    assert!(close(find(gap, "FOOT_GAP", "U1", "TransK"), p.vertical.k1_n_per_m));

    assert!(close(number(&t["JOINT LOADS - FORCE"][0], "F3"), -680.1 * 9.81));
    let function = &t["FUNCTION - TIME HISTORY - USER"];
    let accel: Vec<f64> = function.iter().map(|row| number(row, "Value")).collect();
    // the record does not begin at 0, the function does
    assert_eq!((accel[0], &accel[1..]), (0.0, &Record::el_centro().accel[..]));
    assert_eq!([0, 1, 2].map(|i| number(&function[i], "Time")), [0.0, 1e-5, 0.01]);
    let history = &t["CASE - DIRECT HISTORY 1 - GENERAL"][0];
    assert!(close(number(history, "OutSteps") * number(history, "StepSize"), 20.0));
}

#[test]
fn sap2000_tables_refer_to_what_they_define() {
    refers_to_what_it_defines(&read_s2k(&deck(DeckFormat::Sap2000)));
}

/// Every name that a table uses is defined in another one.
fn refers_to_what_it_defines(t: &Tables) {
    let names = |table: &str, field: &str| {
        t[table].iter().map(|row| row[field].clone()).collect::<Vec<_>>()
    };
    for (table, field, defined_in, key) in [
        ("CONNECTIVITY - FRAME", "JointI", "JOINT COORDINATES", "Joint"),
        ("CONNECTIVITY - FRAME", "JointJ", "JOINT COORDINATES", "Joint"),
        ("CONNECTIVITY - LINK", "JointI", "JOINT COORDINATES", "Joint"),
        ("CONNECTIVITY - LINK", "JointJ", "JOINT COORDINATES", "Joint"),
        ("LINK PROPERTY ASSIGNMENTS", "Link", "CONNECTIVITY - LINK", "Link"),
        ("LINK PROPERTY ASSIGNMENTS", "LinkProp", "LINK PROPERTY DEFINITIONS 01 - GENERAL", "Link"),
        (
            "FRAME SECTION ASSIGNMENTS",
            "AnalSect",
            "FRAME SECTION PROPERTIES 01 - GENERAL",
            "SectionName",
        ),
        (
            "FRAME SECTION PROPERTIES 01 - GENERAL",
            "Material",
            "MATERIAL PROPERTIES 01 - GENERAL",
            "Material",
        ),
        ("CASE - STATIC 1 - LOAD ASSIGNMENTS", "LoadName", "LOAD PATTERN DEFINITIONS", "LoadPat"),
        (
            "CASE - DIRECT HISTORY 2 - LOAD ASSIGNMENTS",
            "Function",
            "FUNCTION - TIME HISTORY - USER",
            "Name",
        ),
    ] {
        let defined = names(defined_in, key);
        for name in names(table, field) {
            assert!(defined.contains(&name), "{table}: {field}={name} is not in {defined_in}");
        }
    }
}
