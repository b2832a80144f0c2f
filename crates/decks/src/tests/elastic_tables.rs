//! SAP2000 tables of elastic structures.

use super::{Tables, number, read_s2k, refers_to_what_it_defines};
use crate::{CornerProgram, DeckFormat, ElasticDeck, EvenEnds, ExportError, Stepping};
use dynamics::spring::{Chain, Springs};
use fixed_steps::Integrator;
use frames::{assembled::Assembled, structure::ElasticStructure};
use parameters::program::{CornerUnits, ProgramRow};
use rocking::{
    members::{Damper, Members},
    scalar::GRAVITY,
};
use strong_motion::Record;

pub(super) const PIER: &str = "kind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
    footing_mass_kg = 60e3\nfooting_height_m = 1.5\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n\
    column_mass_kg = 40e3\nelements = 3\n";
pub(super) const LEGS: &str = "kind = 'aframe'\nheight_m = 30.0\nwidth_m = 4.0\nmass_kg = 400e3\n\
    foot_mass_kg = 10e3\nea_n = 3e10\nei_nm2 = 2.5e9\ndamping_ratio = 0.02\n";
pub(super) const PORTAL: &str = "kind = 'frame'\nheight_m = 12.0\nspan_m = 10.0\n\
    footing_width_m = 3.0\nfooting_height_m = 1.5\nfooting_mass_kg = 40e3\nbeam_mass_kg = 500e3\n\
    column_ea_n = 3.4e10\ncolumn_ei_nm2 = 3e9\nbeam_ea_n = 4e10\nbeam_ei_nm2 = 1e10\n\
    damping_ratio = 0.02\n";

pub(super) fn structure(text: &str) -> ElasticStructure {
    toml::from_str::<ElasticStructure>(text).unwrap().checked().unwrap()
}

/// Springs that differ from corner to corner.
pub(super) fn springs(corners: usize) -> Vec<Springs<Chain>> {
    let chain = |x: f64| Chain { k1: 1e10 * x, k2: 7e8 * x, m2: 2e4 * x, c: 3e7 * x };
    let of = |i: usize| 1.0 + 0.1 * i as f64;
    (0..corners)
        .map(|i| Springs { vertical: chain(of(i)), horizontal: chain(3.0 * of(i)) })
        .collect()
}

fn deck(model: &Assembled, record: &Record) -> Result<String, ExportError> {
    let springs = springs(model.frame.places().len());
    let row = ProgramRow { integrator: Integrator::HHT_MOST, ..program_row(0.001) };
    deck_of(model, record, (&springs, Some(&CornerProgram::even(&row))), DeckFormat::Sap2000)
}

pub(super) fn deck_of(
    model: &Assembled,
    record: &Record,
    (springs, program): (&[Springs<Chain>], Option<&CornerProgram>),
    format: DeckFormat,
) -> Result<String, ExportError> {
    let top = model.watched[0].top;
    let motion = [[0.0, -1e-3], [0.02, -0.5e-3], [-0.03, 1e-3]];
    ElasticDeck {
        title: "a structure",
        layout: &model.layout,
        frame: &model.frame,
        springs,
        record,
        samples: 3,
        compared: 3,
        top: (top, &motion),
        alpha: 0.1,
        frequency_hz: 2.0,
        accuracy: 0.002,
        program: program.map(|program| (program, EvenEnds::default())),
    }
    .text(format)
}

fn tables(text: &str) -> (Assembled, Tables) {
    let model = Assembled::new(structure(text)).unwrap();
    let tables = read_s2k(&deck(&model, &Record::el_centro()).unwrap());
    (model, tables)
}

fn close(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-12
}

#[test]
fn masses_and_weights_are_the_structure_s() {
    for text in [PIER, LEGS, PORTAL] {
        let (model, t) = tables(text);
        let total = model.frame.total_mass();
        let sum = |table: &str, field: &str| {
            t[table].iter().map(|row| number(row, field)).sum::<f64>() * 1e3
        };
        let springs = springs(model.frame.places().len());
        let absorbers: f64 = springs.iter().map(|s| s.vertical.m2).sum();
        assert!(close(sum("JOINT LOADS - FORCE", "F3"), -total * GRAVITY));
        assert!(close(sum("JOINT ADDED MASS ASSIGNMENTS", "Mass3"), total + absorbers));
        assert!(close(sum("JOINT ADDED MASS ASSIGNMENTS", "Mass1"), total + 3.0 * absorbers));
        refers_to_what_it_defines(&t);
    }
}

#[test]
fn every_corner_has_links_of_its_own_springs_at_its_place() {
    for text in [PIER, LEGS, PORTAL] {
        let (model, t) = tables(text);
        let find = |table: &str, keys: &[(&str, &str)]| {
            let fits = |row: &&std::collections::HashMap<String, String>| {
                keys.iter().all(|(k, v)| row[*k] == *v)
            };
            t[table].iter().find(fits).unwrap_or_else(|| panic!("{table} {keys:?}"))
        };
        for (i, (springs, corner)) in
            springs(model.frame.places().len()).iter().zip(&model.layout.corners).enumerate()
        {
            let named = |link: &str| format!("{link}_{}", i + 1);
            for (dof, unit) in [("U1", springs.vertical), ("U2", springs.horizontal)] {
                let of = |table: &str, link: &str, field: &str| {
                    1e3 * number(find(table, &[("Link", &named(link)), ("DOF", dof)]), field)
                };
                assert!(close(
                    of("LINK PROPERTY DEFINITIONS 08 - SLIDING ISOLATOR", "FOOT", "TransK"),
                    unit.k1
                ));
                assert!(close(
                    of("LINK PROPERTY DEFINITIONS 05 - GAP", "FOOT_GAP", "TransKE"),
                    unit.k1
                ));
                assert!(close(
                    of("LINK PROPERTY DEFINITIONS 02 - LINEAR", "GROUND", "TransKE"),
                    unit.k2
                ));
                assert!(close(
                    of("LINK PROPERTY DEFINITIONS 02 - LINEAR", "GROUND", "TransCE"),
                    unit.c
                ));
            }
            let link = &find("LINK PROPERTY ASSIGNMENTS", &[("LinkProp", &named("FOOT"))])["Link"];
            let ends = find("CONNECTIVITY - LINK", &[("Link", link)]);
            let foot = find("JOINT COORDINATES", &[("Joint", &ends["JointJ"])]);
            assert_eq!([number(foot, "XorR"), number(foot, "Z")], corner.place);
            // and the absorber is above the ground of the same corner
            let ground = find("LINK PROPERTY ASSIGNMENTS", &[("LinkProp", &named("GROUND"))]);
            let below = find("CONNECTIVITY - LINK", &[("Link", &ground["Link"])]);
            assert_eq!(below["JointJ"], ends["JointI"]);
        }
    }
}

/// Frames between the same joints have the beam's EA, EI and dashpots together.
#[test]
fn frames_side_by_side_are_the_beam() {
    for text in [PIER, LEGS, PORTAL] {
        let (model, t) = tables(text);
        let of = |table: &str, key: &str, name: &str| {
            t[table].iter().find(|row| row[key] == name).unwrap_or_else(|| panic!("{table} {name}"))
        };
        for (i, member) in model.layout.members.iter().enumerate() {
            let name = format!("BEAM_{}", i + 1);
            let parts = t["FRAME SECTION PROPERTIES 01 - GENERAL"].iter().filter(|row| {
                row["SectionName"]
                    .strip_prefix(&name)
                    .is_some_and(|rest| ["", "_A", "_B"].contains(&rest))
            });
            let mut sums = [0.0; 4];
            for part in parts {
                let material = &part["Material"];
                let modulus = 1e3
                    * number(
                        of(
                            "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES",
                            "Material",
                            material,
                        ),
                        "E1",
                    );
                let ahead = number(
                    of("MATERIAL PROPERTIES 06 - DAMPING PARAMETERS", "Material", material),
                    "VisStiff",
                );
                for (k, field) in ["Area", "I33"].into_iter().enumerate() {
                    let stiffness = modulus * number(part, field);
                    sums[k] += stiffness;
                    sums[2 + k] += ahead * stiffness;
                }
            }
            let s = &member.section;
            assert!(close(sums[0], s.axial) && close(sums[1], s.bending), "{name}: {sums:?}");
            // of two frames each has a millionth of the other's stiffness, damped as its own
            let [axial, bending] = [s.axial_damping / s.axial, s.bending_damping / s.bending];
            let mixed = |own: f64, other: f64| own + 1e-6 * (other - own);
            assert!(close(sums[2], mixed(axial, bending) * s.axial), "{name}: {sums:?}");
            assert!(close(sums[3], mixed(bending, axial) * s.bending), "{name}: {sums:?}");
        }
    }
}

#[test]
fn what_the_tables_cannot_hold_is_named() {
    let members = Members { damper: Some(Damper { c: 1e6 }), ..Members::default() };
    let damped = Assembled::with_members(structure(PIER), members).unwrap();
    let error = deck(&damped, &Record::el_centro()).unwrap_err().to_string();
    assert!(error.contains("damper is not written for sap2000"), "{error}");
}

/// A deck for the substeps at touches: springs for these in the same places, at the same K, and
/// twenty substeps; tables have no loop for them.
#[test]
fn substeps_at_touches_have_springs_of_their_own_and_no_tables() {
    let model = Assembled::new(structure(PIER)).unwrap();
    let mut row = program_row(0.001);
    let even = CornerProgram::new(&model, &row, Stepping::Even).unwrap();
    let touches = CornerProgram::new(&model, &row, Stepping::Touches).unwrap();
    assert_eq!(even.row, row);
    assert_eq!(touches.row.units.springs.len(), row.units.springs.len());
    for (fine, coarse) in touches.row.units.chains().iter().zip(row.units.chains()) {
        assert!(close(fine.vertical.k2 / fine.vertical.k1, 0.25));
        // k_e goes with one over the step (`springs::elastic::program`)
        let other = CornerProgram::new(&model, &program_row(0.002), Stepping::Touches).unwrap();
        let other = other.row.units.chains()[0];
        assert!(close(fine.vertical.k1, 2.0 * other.vertical.k1));
        assert_ne!(fine.vertical.k1, coarse.vertical.k1);
    }
    let record = Record::el_centro();
    let of = |program: &CornerProgram, format| {
        let springs = program.row.units.chains();
        deck_of(&model, &record, (&springs, Some(program)), format)
    };
    let text = of(&touches, DeckFormat::OpenSeesPy).unwrap();
    assert!(text.contains("TOUCHES = 20\n") && !text.contains('@'));
    assert!(of(&even, DeckFormat::OpenSeesPy).unwrap().contains("TOUCHES = 1\n"));
    let tcl = of(&touches, DeckFormat::OpenSeesTcl).unwrap();
    assert!(tcl.contains("set touches 20\n") && !tcl.contains('@'));
    let error = of(&touches, DeckFormat::Sap2000).unwrap_err().to_string();
    assert!(error.contains("no loop"), "{error}");
    let springs = even.row.units.chains();
    let events = deck_of(&model, &record, (&springs, None), DeckFormat::Sap2000);
    assert!(matches!(events, Err(ExportError::EventsInTables)));
    row.units.springs.clear();
    let error = CornerProgram::new(&model, &row, Stepping::Touches).unwrap_err().to_string();
    assert!(error.contains("no springs"), "{error}");
}

/// A program of this step (s), on springs at K = 1/4.
pub(super) fn program_row(step: f64) -> ProgramRow<CornerUnits> {
    let unit = |k1: f64| {
        let k2 = 0.25 * k1;
        format!("{{ k1_n_per_m = {k1:?}, k2_n_per_m = {k2:?}, m2_kg = 2e4, c_ns_per_m = 3e7 }}")
    };
    let corner = |x: f64| {
        let (vertical, horizontal) = (unit(1e10), unit(4e10));
        format!("[[springs]]\nx_m = {x:?}\nvertical = {vertical}\nhorizontal = {horizontal}\n")
    };
    let text = format!(
        "step_s = {step}\nintegrator = 'trbdf2'\nsubsteps = 16\nnewton_iterations = 30\n\
         converged = {{ increment_m = 1e-6 }}\nexpected = {{ floor = 0.01 }}\n{}{}",
        corner(-2.0),
        corner(2.0)
    );
    toml::from_str(&text).unwrap()
}
