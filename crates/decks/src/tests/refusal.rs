//! Decks of springs that are of no use say so when they run; what decks compare with, and how far.

use super::{
    elastic_tables::{PIER, deck_of, program_row, springs, structure},
    stepping::{for_program, text},
};
use crate::{CornerProgram, DeckFormat, ElasticDeck, EvenEnds, Stepping};
use fixed_steps::{Integrator, ProgramName};
use frames::assembled::Assembled;
use parameters::program::ProgramRow;
use strong_motion::Record;

const OPENSEES: [DeckFormat; 2] = [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl];

/// Steps of 20 ms are too long for a block 2 m tall: its deck prints why at its begin and its end,
/// and does not end as a good one, whose peaks are the emulation's, not the springs' own.
#[test]
fn a_deck_of_refused_springs_prints_why_and_ends_with_code_4() {
    for (step, refused) in [(0.02, true), (1e-3, false)] {
        let parameters = for_program(ProgramName::OpenSees, step);
        for (format, print, [good, bad]) in [
            (
                DeckFormat::OpenSeesPy,
                "    print(\"NOT to be used: ",
                ["    return 0 if good else 1\n", "    return 4 if good else 1\n"],
            ),
            (
                DeckFormat::OpenSeesTcl,
                "\nputs \"NOT to be used: ",
                ["exit [expr {1 - $good}]\n", "exit [expr {$good ? 4 : 1}]\n"],
            ),
        ] {
            let even = text(&parameters, format, Stepping::Even);
            assert_eq!(even.matches(print).count(), if refused { 2 } else { 0 }, "{format:?}");
            assert_eq!([even.contains(good), even.contains(bad)], [!refused, refused]);
            assert!(even.contains("within 1 % of the emulation: "), "{format:?}");
            assert!(even.contains("the emulation of these steps found for the same springs"));
            assert!(even.contains("4 within 1 % on springs that are of no use"), "{format:?}");
            // springs for substeps are others; steps that follow touches are no emulation
            let touches = text(&parameters, format, Stepping::Touches);
            assert!(touches.contains(good) && !touches.contains(print), "{format:?}");
            let events = text(&parameters, format, Stepping::Events);
            assert!(events.contains("within 1 %: ") && !events.contains("emulation"));
        }
    }
}

/// Above all that one would type or import.
#[test]
fn sap2000_formats_begin_with_the_refusal() {
    for (step, refused) in [(0.02, true), (1e-3, false)] {
        let parameters = for_program(ProgramName::Sap2000, step);
        for format in [DeckFormat::Sap2000, DeckFormat::Sap2000Sheet] {
            let even = text(&parameters, format, Stepping::Even);
            let head = even.lines().take(3).any(|line| line.contains("NOT to be used: "));
            assert_eq!(head, refused, "{format:?}");
        }
    }
}

/// What ends a comparison, these steps on these springs or the motion, is told as it is.
#[test]
fn decks_tell_whether_the_steps_or_the_motion_end_the_comparison() {
    let model = Assembled::new(structure(PIER)).unwrap();
    let (record, units) = (Record::el_centro(), springs(2));
    let program = CornerProgram::even(&program_row(0.001));
    let motion = [[0.0, -1e-3], [0.02, -0.5e-3], [-0.03, 1e-3]];
    let deck = |format, compared_by_steps| {
        let ends = EvenEnds { compared_by_steps, ..EvenEnds::default() };
        ElasticDeck {
            title: "a structure",
            layout: &model.layout,
            frame: &model.frame,
            springs: &units,
            record: &record,
            samples: 3,
            compared: 2,
            top: (1, &motion),
            alpha: 0.1,
            frequency_hz: 2.0,
            accuracy: 0.002,
            program: Some((&program, ends)),
        }
        .text(format)
        .unwrap()
    };
    let [steps, of_motion] =
        ["these steps on these springs cannot be compared", "the motion cannot be predicted"];
    for format in OPENSEES {
        let [by_steps, by_motion] = [true, false].map(|by| deck(format, by));
        assert!(by_steps.contains(&format!("beyond, {steps}")), "{format:?}");
        assert!(!by_steps.contains(of_motion), "{format:?}");
        assert!(by_motion.contains(&format!("beyond, {of_motion}")), "{format:?}");
        assert!(!by_motion.contains(steps), "{format:?}");
    }
}

/// The pier's damping, with its two coefficients: damping over stiffness.
#[test]
fn decks_say_which_damping_their_springs_were_measured_with() {
    let model = Assembled::new(structure(PIER)).unwrap();
    let section = model.layout.members[0].section;
    let [axial, bending] =
        [section.axial_damping / section.axial, section.bending_damping / section.bending];
    assert!(axial > 0.0 && bending > 0.0 && (axial / bending - 1.0).abs() > 0.01);
    let units = springs(2);
    let row = ProgramRow { integrator: Integrator::HHT_MOST, ..program_row(0.001) };
    let program = CornerProgram::even(&row);
    for format in [
        DeckFormat::OpenSeesPy,
        DeckFormat::OpenSeesTcl,
        DeckFormat::Sap2000,
        DeckFormat::Sap2000Sheet,
        DeckFormat::Markdown,
    ] {
        let text = deck_of(&model, &Record::el_centro(), (&units, Some(&program)), format).unwrap();
        // in one line, however it is set
        let words = text.replace(['$', '#'], " ");
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        let [axial, bending] = [axial, bending].map(|x| files::message::significant(x, 4));
        let told = format!("({axial} s axial, {bending} s bending)");
        assert!(words.contains(&told) && words.contains("Rayleigh"), "{format:?}: {told}");
        let opensees = OPENSEES.contains(&format);
        assert_eq!(words.contains("below 0.667 of it"), opensees, "{format:?}");
    }
}
