//! Decks for programs with steps of one size.

use super::*;
use dynamics::effort::Effort;
use fixed_steps::{FixedStepProgram, Integrator, ProgramName};
use parameters::program::ProgramRow;
use springs::{fixed_steps::ProgramSprings, suite::Suites};

/// A block with springs for a program.
pub(super) fn for_program(name: ProgramName, step: f64) -> Parameters {
    let body = Structure::block(2.0, 0.5, 500.0).unwrap();
    let suites = Suites::of_seed(3, &body.body(), body.body::<f64>().restitution(), None);
    let csi = name == ProgramName::Sap2000;
    let integrator = if csi { Integrator::HHT_MOST } else { Integrator::Trbdf2 };
    let program = FixedStepProgram { integrator, ..FixedStepProgram::of(name, step) };
    let found =
        ProgramSprings::measured(&body.body(), program, &suites, false, &Effort::unbounded())
            .unwrap();
    Parameters {
        program: Some(ProgramRow::from(&found)),
        ..Parameters::new(body, &springs(4000.0))
    }
}

pub(super) fn text(parameters: &Parameters, format: DeckFormat, stepping: Stepping) -> String {
    stepped_deck(parameters, &Record::el_centro().truncated(8.0), format, stepping, None)
        .unwrap()
        .text
}

#[test]
fn decks_of_even_steps_hold_the_programs_springs_and_settings() {
    let parameters = for_program(ProgramName::OpenSees, 0.002);
    let row = parameters.program.clone().unwrap();
    for (format, integrator, step) in [
        (DeckFormat::OpenSeesPy, "analysis(\"TRBDF2\")", "STEP = 2.0"),
        (DeckFormat::OpenSeesTcl, "solver {TRBDF2} Transient", "set step 2.0"),
    ] {
        let even = text(&parameters, format, Stepping::Even);
        let found = numbers_in(&even);
        for unit in [row.units.vertical, row.units.horizontal] {
            for number in [unit.k1_n_per_m, unit.k2_n_per_m, unit.m2_kg, unit.c_ns_per_m] {
                assert!(found.contains(&number), "{format:?}: {number} is missing");
            }
        }
        assert!(
            even.contains(integrator) && even.contains(step) && !even.contains('@'),
            "{format:?}"
        );
        assert!(
            !found.contains(&parameters.vertical.k1_n_per_m),
            "{format:?}: springs of the other steps"
        );
        // stiffer springs where steps are divided at touches
        let touches = text(&parameters, format, Stepping::Touches);
        assert!(
            !numbers_in(&touches).contains(&row.units.vertical.k1_n_per_m)
                && !touches.contains('@')
        );
        // steps that follow touches are those of `deck`
        let record = Record::el_centro().truncated(8.0);
        let events =
            stepped_deck(&parameters, &record, format, Stepping::Events, None).unwrap().text;
        assert_eq!(events, super::super::deck(&parameters, &record, format).unwrap());
    }
}

/// A deck follows the whole record, but what it compares ends where the motion can no longer be
/// predicted: largest and least u are those of the history up to then.
#[test]
fn decks_compare_up_to_when_the_motion_can_be_predicted() {
    let parameters = for_program(ProgramName::OpenSees, 0.002);
    let record = Record::el_centro().truncated(8.0);
    let u = stepped_history(&parameters, &record).unwrap().motion.u;
    let most = |u: &[f64]| u.iter().fold(0.0_f64, |most, u| most.max(*u));
    assert!(most(&u[..301]) < most(&u), "the largest u comes later");
    for (format, followed, compared) in [
        (DeckFormat::OpenSeesPy, "SAMPLES = 801 ", "COMPARED = 301 "),
        (DeckFormat::OpenSeesTcl, "set samples        801 ", "set compared       301 "),
    ] {
        let deck =
            |until| stepped_deck(&parameters, &record, format, Stepping::Even, until).unwrap().text;
        let [part, all] = [deck(Some(3.0)), deck(None)];
        assert!(part.contains(followed) && part.contains(compared), "{format:?}");
        assert!(all.contains(&compared.replace("301", "801")), "{format:?}");
        assert!(numbers_in(&part).contains(&most(&u[..301])), "{format:?}");
        assert!(numbers_in(&all).contains(&most(&u)), "{format:?}");
    }
    let csi = for_program(ProgramName::Sap2000, 0.002);
    for format in [DeckFormat::Sap2000, DeckFormat::Sap2000Sheet] {
        let deck = |until| stepped_deck(&csi, &record, format, Stepping::Even, until).unwrap().text;
        assert!(deck(Some(3.0)).contains("to 3 s (beyond, the motion cannot be predicted)"));
        assert!(!deck(None).contains("cannot be predicted"), "{format:?}");
    }
}

/// Another step is advised where the emulation gives up within what can be predicted, only there.
#[test]
fn a_deck_that_ends_before_its_record_says_so() {
    let told = |until| {
        let deck = SteppedDeck { text: String::new(), gives_up_s: Some(4.0), until };
        deck.told("the deck").1.unwrap()
    };
    for until in [None, Some(5.0)] {
        assert!(told(until).contains("ends at 4.00 s") && told(until).contains("another step"));
    }
    let after = told(Some(3.0));
    assert!(after.contains("predicted to 3.00 s") && !after.contains("another step"), "{after}");
}

/// A deck that ends where the emulation gives up does not end as one that has followed its record:
/// its last line stops it, which is exit code 2.
#[test]
fn a_deck_without_the_end_of_its_record_stops() {
    let whole = for_program(ProgramName::OpenSees, 0.001);
    let mut cut = whole.clone();
    let row = cut.program.as_mut().unwrap();
    // without algorithmic damping nothing ends what a landing leaves in the springs
    (row.integrator, row.substeps) = (Integrator::AVERAGE_ACCELERATION, 1);
    let record = Record::el_centro().truncated(8.0);
    for (format, ends, stops) in [
        (DeckFormat::OpenSeesPy, "    return 0 if good else 1\n", "    stop(\"the emulation of"),
        (DeckFormat::OpenSeesTcl, "exit [expr {1 - $good}]\n", "\nstop \"the emulation of"),
    ] {
        let text = text(&whole, format, Stepping::Even);
        assert!(text.contains(ends) && !text.contains(stops), "{format:?}");
        let deck = stepped_deck(&cut, &record, format, Stepping::Even, None).unwrap();
        let time = format!("gives up at {} s", significant(deck.gives_up_s.unwrap(), 4));
        assert!(!deck.text.contains(ends) && deck.text.contains(stops));
        assert!(deck.text.contains(&time), "{format:?}: {time}");
    }
}

#[test]
fn springs_of_no_use_are_marked_in_every_format() {
    let formats =
        [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl, DeckFormat::Csv, DeckFormat::Markdown];
    for (step, marked) in [(0.02, true), (1e-3, false)] {
        let parameters = for_program(ProgramName::OpenSees, step);
        for format in formats {
            let even = text(&parameters, format, Stepping::Even);
            assert_eq!(even.contains("NOT to be used"), marked, "{format:?}, {step}");
            // springs for substeps are others
            assert!(!text(&parameters, format, Stepping::Touches).contains("NOT to be used"));
        }
        let python = text(&parameters, DeckFormat::OpenSeesPy, Stepping::Even);
        assert!(python.starts_with("#!/usr/bin/env python3\n"));
    }
}

#[test]
fn sap2000_tables_have_the_load_case_of_the_program() {
    let parameters = for_program(ProgramName::Sap2000, 0.001);
    let tables = text(&parameters, DeckFormat::Sap2000, Stepping::Even);
    let row = tables.lines().find(|line| line.contains("MaxIterCS")).unwrap();
    for setting in
        ["DTMax=1.0000000000000000e-3", "DTMin=6.25", "MaxIterCS=0", "MaxIterNR=40", "UseEvStep=No"]
    {
        assert!(row.contains(setting), "{setting}: {row}");
    }
    assert!(tables.contains("StepSize=1.0000000000000000e-2") && tables.contains("OutSteps=800"));
    assert!(numbers_in(&tables).iter().any(|x| {
        let k1 = parameters.program.as_ref().unwrap().units.vertical.k1_n_per_m;
        (x / (k1 * 1e-3) - 1.0).abs() < 1e-14
    }));
}

/// The program stops at every output time: that is a whole number of its steps, whatever the
/// record's interval of 0.01 s.
#[test]
fn tables_and_sheet_show_whole_steps() {
    for (step, output) in [(0.02, 0.02), (0.003, 0.009), (0.001, 0.01)] {
        let parameters = for_program(ProgramName::Sap2000, step);
        let tables = read_s2k(&text(&parameters, DeckFormat::Sap2000, Stepping::Even));
        let general = &tables["CASE - DIRECT HISTORY 1 - GENERAL"][0];
        let settings = &tables["CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS"][0];
        let (shown, count) = (number(general, "StepSize"), number(general, "OutSteps"));
        assert!((shown / output - 1.0).abs() < 1e-12, "{step}: {shown}");
        let steps = shown / number(settings, "DTMax");
        assert!((steps - steps.round()).abs() < 1e-9, "{step}: {steps}");
        assert!(count * shown < 8.0 + 1e-9, "{step}: {count}");
        let sheet = text(&parameters, DeckFormat::Sap2000Sheet, Stepping::Even);
        let line = sheet.lines().find(|line| line.contains("   output ")).unwrap();
        assert_eq!(numbers_in(line)[..2], [count, output], "{line}");
    }
}

/// Frames of the sheet are those of the tables: the same modulus, the same areas.
#[test]
fn the_sheet_has_the_sections_of_the_tables() {
    let parameters = for_program(ProgramName::Sap2000, 0.001);
    let tables = read_s2k(&text(&parameters, DeckFormat::Sap2000, Stepping::Even));
    let section = &tables["FRAME SECTION PROPERTIES 01 - GENERAL"][0];
    let material = &tables["MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES"][0];
    let sheet = text(&parameters, DeckFormat::Sap2000Sheet, Stepping::Even);
    let frame = sheet.lines().find(|line| line.contains("1 - 3")).unwrap();
    let cells: Vec<f64> = frame.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    for (cell, field) in [(cells[3], "Area"), (cells[4], "I33")] {
        assert!((cell / number(section, field) - 1.0).abs() < 1e-4, "{field}: {frame}");
    }
    let head = sheet.lines().find(|line| line.contains("section General")).unwrap();
    assert!(numbers_in(head).contains(&number(material, "E1")), "{head}");
    // no line search, and only masses that are added
    let settings = &tables["CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS"][0];
    assert_eq!(number(settings, "LSPerIter"), 0.0);
    let source = &tables["MASS SOURCE"][0];
    assert_eq!([&source["Elements"], &source["Masses"], &source["Loads"]], ["Yes", "Yes", "No"]);
    assert_eq!([number(material, "UnitMass"), number(material, "UnitWeight")], [0.0; 2]);
}

#[test]
fn the_sheet_to_type_from_has_the_model_of_the_tables() {
    let parameters = for_program(ProgramName::Sap2000, 0.001);
    let sheet = text(&parameters, DeckFormat::Sap2000Sheet, Stepping::Even);
    let units = parameters.program.as_ref().unwrap().units;
    let number = |line: &str, column: usize| -> f64 {
        line.split_whitespace().nth(column).unwrap().parse().unwrap()
    };
    let near = |x: f64, y: f64| (x / y - 1.0).abs() < 1e-4;
    for (name, unit, k, c) in [
        ("FOOT", "U1", units.vertical.k1_n_per_m, 0.0),
        ("FOOT", "U2", units.horizontal.k1_n_per_m, 0.0),
        ("GROUND", "U1", units.vertical.k2_n_per_m, units.vertical.c_ns_per_m),
        ("GROUND", "U2", units.horizontal.k2_n_per_m, units.horizontal.c_ns_per_m),
    ] {
        let of = |line: &&str| {
            let mut words = line.split_whitespace();
            words.next() == Some(name) && words.next() == Some(unit)
        };
        let line = sheet.lines().find(of).unwrap();
        assert!(near(number(line, 2), 1e-3 * k), "{line}");
        assert!(if c > 0.0 { near(number(line, 3), 1e-3 * c) } else { number(line, 3) == 0.0 });
    }
    // what it weighs, and the absorbers' masses across and upwards
    let weight = sheet.lines().find(|line| line.contains("joint 3      ")).unwrap();
    assert!(near(number(weight, 2), -500.0 * 9.81e-3), "{weight}");
    let absorber = sheet.lines().find(|line| line.contains("(absorber)")).unwrap();
    assert!(near(number(absorber, 3), 1e-3 * units.horizontal.m2_kg), "{absorber}");
    assert!(near(number(absorber, 4), 1e-3 * units.vertical.m2_kg), "{absorber}");
    assert!(
        sheet.contains("800 steps of 0.01 s") && sheet.contains("constant stiffness 0, Newton")
    );
    assert!(sheet.contains("alpha -0.33333") && sheet.contains("smallest 6.25e-5 s"), "{sheet}");
}

#[test]
fn what_has_no_springs_or_no_integrator_for_a_program_is_refused() {
    let record = Record::el_centro().truncated(1.0);
    let refused = |parameters: &Parameters, format, stepping| {
        stepped_deck(parameters, &record, format, stepping, None).unwrap_err().to_string()
    };
    let even = for_program(ProgramName::OpenSees, 0.002);
    let none =
        stepped_deck(&super::parameters(), &record, DeckFormat::OpenSeesPy, Stepping::Even, None);
    let none = none.unwrap_err();
    assert!(none.to_string().contains("no springs for steps of one size"), "{none}");
    assert!(none.with_options().contains("--for sap2000"));
    assert!(
        refused(&even, DeckFormat::Sap2000, Stepping::Even)
            .contains("trbdf2 is not written for SAP2000")
    );
    assert!(refused(&even, DeckFormat::Sap2000, Stepping::Touches).contains("no loop"));
    let mut damped = even.clone();
    damped.damper = Some(rocking::members::Damper { c: 1e3 });
    assert!(
        refused(&damped, DeckFormat::OpenSeesPy, Stepping::Even).contains("not made for a damper")
    );
    let mut alpha = even;
    alpha.program.as_mut().unwrap().integrator = Integrator::GENERALIZED_ALPHA_0;
    assert!(
        refused(&alpha, DeckFormat::OpenSeesPy, Stepping::Even)
            .contains("generalized-alpha:0 is not written")
    );
    assert!(
        "sometimes"
            .parse::<Stepping>()
            .unwrap_err()
            .to_string()
            .contains("give events, even or touches")
    );
}
