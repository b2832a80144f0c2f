//! What someone who types a model finds in the table of springs, besides these.

use super::{
    elastic_tables::{PIER, PORTAL, deck_of, program_row, springs, structure},
    stepping::for_program,
};
use crate::{CornerProgram, DeckFormat, Stepping, stepped_deck, stepped_history};
use fixed_steps::{Integrator, ProgramName};
use frames::assembled::Assembled;
use parameters::{Parameters, program::ProgramRow};
use rocking::{
    housner::{self, RockingOptions},
    scalar::GRAVITY,
    structure::Structure,
};
use strong_motion::Record;

/// Cells of the rows of the table below a heading.
fn rows<'a>(text: &'a str, heading: &str) -> Vec<Vec<&'a str>> {
    let (_, below) = text.split_once(&format!("## {heading}\n\n")).unwrap();
    let table = below.lines().take_while(|line| line.starts_with('|')).skip(2);
    table.map(|line| line.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The portal's footings of 40 t, 3 m x 1.5 m, and its beam of 500 t: m (a^2 + b^2)/12 of a solid
/// footing, half of the beam's mass at each joint.
#[test]
fn joints_have_the_masses_and_weights_of_the_structure() {
    let row = ProgramRow { integrator: Integrator::HHT_MOST, ..program_row(0.001) };
    let program = CornerProgram::even(&row);
    for text in [PIER, PORTAL] {
        let model = Assembled::new(structure(text)).unwrap();
        let units = springs(model.frame.places().len());
        let write = |format| {
            deck_of(&model, &Record::el_centro(), (&units, Some(&program)), format).unwrap()
        };
        let [table, sheet] = [DeckFormat::Markdown, DeckFormat::Sap2000Sheet].map(write);
        let joints = rows(&table, "Joints");
        let number = |cell: &str| cell.parse::<f64>().unwrap_or(0.0);
        let weight = model.frame.total_mass() * GRAVITY;
        let sum: f64 = joints.iter().map(|row| number(row[6])).sum();
        assert!((sum / weight - 1.0).abs() < 1e-6, "{sum} {weight}");
        for row in &joints {
            assert!((number(row[6]) - GRAVITY * number(row[4])).abs() <= 1e-6 * weight, "{row:?}");
        }
        if text == PORTAL {
            let inertia = 40e3 * (3.0 * 3.0 + 1.5 * 1.5) / 12.0;
            assert_eq!(
                joints[0][2..6].iter().map(|c| number(c)).collect::<Vec<_>>(),
                [-5.0, 0.75, 40e3, inertia]
            );
            assert_eq!(joints[2][1..5], ["the top", "-5", "12", "250000"]);
            assert_eq!(joints[9][1..4], ["corner 4, rigid with joint 2", "6.5", "0"]);
        }
        // the same load case in both, and what comes out
        let (table, sheet) = (one_line(&table), one_line(&sheet));
        for said in [
            "IELC180: 3995 samples, dt 0.01 s, peak 0.3129 g; m/s2, positive to the right; scale 1",
            "from file ground_motion.txt beside this one",
            "2 steps of 0.01 s",
            "proportional damping 0",
            "g = 9.81 m/s2",
            "U1 from -30 mm to 20 mm",
        ] {
            assert!(table.contains(said) && sheet.contains(said), "{said}: {table}");
        }
        assert!(table.contains("(HHT alpha -1/3)") && !table.contains("hht:"), "{table}");
    }
}

/// The scale of the record, and the unbalance in newtons that its share of the weight is.
#[test]
fn a_record_is_told_with_its_scale_and_a_tolerance_in_newtons() {
    let parameters = for_program(ProgramName::Sap2000, 0.001);
    let record = Record::el_centro().scaled(0.75).unwrap().truncated(4.0);
    let write = |format| {
        stepped_deck(&parameters, &record, format, Stepping::Even, None).map(|deck| deck.text)
    };
    let text = write(DeckFormat::Markdown).unwrap();
    assert!(text.contains("scale 0.75, in the file already"), "{text}");
    // 500 kg
    let weight = 500.0 * GRAVITY;
    let (_, told) = text.split_once("the unbalance of ").unwrap();
    let [share, below] =
        [0, 4].map(|word| told.split_whitespace().nth(word).unwrap().parse::<f64>().unwrap());
    assert!((below / (share * weight) - 1.0).abs() < 1e-4, "{told}");
    assert!(text.contains("Together they weigh 4905 N"), "{text}");
}

/// Both tell when, and what Housner's body does.
#[test]
fn a_structure_that_topples_in_these_steps_is_told() {
    let parameters = for_program(ProgramName::Sap2000, 0.001);
    let record = Record::el_centro().scaled(3.0).unwrap();
    let theta = stepped_history(&parameters, &record).unwrap().motion.theta;
    let falls = 0.01 * theta.iter().position(|theta| theta.abs() >= 1.0).unwrap() as f64;
    let options = RockingOptions::on(&record, parameters.restitution());
    let body = parameters.structure.body();
    let overturned =
        housner::solve(&body, record.dt, &record.accel, &options).overturned().unwrap();
    let time = |s: f64| files::message::significant(s, 4);
    let told = |until: Option<f64>, format| {
        one_line(&stepped_deck(&parameters, &record, format, Stepping::Even, until).unwrap().text)
    };
    for format in [DeckFormat::Markdown, DeckFormat::Sap2000Sheet] {
        let whole = told(None, format);
        let said = format!(
            "The structure topples in these steps, at {} s; Housner's body overturns, at {} s.",
            time(falls),
            time(overturned)
        );
        assert!(whole.contains(&said), "{said}: {whole}");
        assert!(whole.contains("where the structure has toppled in these steps"), "{whole}");
        let beyond = told(Some(1.0), format);
        let said = format!("at {} s, after what can be predicted", time(falls));
        assert!(beyond.contains(&said), "{said}: {beyond}");
    }
    assert!(told(None, DeckFormat::Sap2000).contains("$ The structure topples in these steps"));
    let stands = Record::el_centro().scaled(0.2).unwrap();
    let deck =
        stepped_deck(&parameters, &stands, DeckFormat::Markdown, Stepping::Even, None).unwrap();
    assert!(!deck.text.contains("topple"), "{}", deck.text);
}

/// 24 inches are 0.6096 m to read, and 0.6095999999999999 m where a model is made of them.
#[test]
fn what_was_typed_in_inches_is_told_in_few_digits() {
    let inches = 0.609_599_999_999_999_9;
    let body = Structure::block(2.286, inches, 952.5).unwrap();
    let of = for_program(ProgramName::Sap2000, 0.001);
    let parameters = Parameters { structure: body, ..of };
    for format in [DeckFormat::Markdown, DeckFormat::Sap2000Sheet, DeckFormat::Sap2000] {
        let record = Record::el_centro().truncated(2.0);
        let deck = stepped_deck(&parameters, &record, format, Stepping::Even, None).unwrap();
        let title = deck.text.lines().find(|line| line.contains(" m wide")).unwrap();
        assert!(title.contains(", 0.6096 m wide, m = 952.5 kg,"), "{title}");
    }
}
