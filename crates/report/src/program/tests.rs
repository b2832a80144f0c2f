use super::*;
use fixed_steps::FixedStepProgram;
use parameters::program::{ProgramErrors, ProgramExpected};

/// A row of OpenSees' at a step of 5 ms.
fn row(substeps: usize) -> ProgramRow<()> {
    let errors = ProgramErrors {
        histories: 9,
        lost: 0,
        history: [Some(0.0056), Some(0.2)],
        peak: [Some(0.02), Some(0.25)],
    };
    ProgramRow {
        name: Some("opensees-even".parse().unwrap()),
        asked: true,
        step_s: 5e-3,
        integrator: FixedStepProgram::usual().integrator,
        substeps,
        newton_iterations: 30,
        converged: ProgramTest::IncrementM(2.45e-5),
        units: (),
        stiffer_for_earthquakes: false,
        expected: ProgramExpected {
            floor: 0.05,
            stance: None,
            rebound: None,
            synthetic: Some(errors),
            earthquakes: None,
            instead: None,
        },
        without_deck: false,
        on_record: Some(ProgramOnRecord::of(Some([1.01, 1.0]), None).with_history(0.089)),
        not_to_be_used: None,
    }
}

fn report(elastic: bool) -> ProgramReport {
    let told = told(["peaks", "motions"], elastic, &[]);
    ProgramReport::new(&row(16), Vec::new(), (None, None), told)
}

/// A half of a half, as steps are halved; of one substep none.
#[test]
fn substeps_are_halves_of_halves() {
    let said = |substeps| settings(&row(substeps), None, None)[1].short.clone();
    assert_eq!(said(1), "steps of 0.005 s, none halved");
    assert_eq!(said(3), "steps of 0.005 s, halved down to 0.0025 s where one fails");
    assert_eq!(said(16), "steps of 0.005 s, halved down to 0.0003125 s where one fails");
}

/// The record's own error is told as such, those of motions with what they are.
#[test]
fn errors_of_the_record_and_of_motions_are_told_apart() {
    let [all, _, fewest] = report(true).lines();
    let told = "this record: top +1.00 %, NRMSE 0.089; peaks median 2.00 %, 90 %: 25.0 %";
    assert!(fewest.contains(told), "{fewest}");
    assert!(all.contains("this record: top +1.00 %, NRMSE 0.089; "), "{all}");
    assert!(all.contains("2.00 % (median), 25.0 % (90 %) on 9 motions"), "{all}");
    assert!(all.contains("NRMSE 0.0056 (median), 0.2 (90 %)"), "{all}");
}

/// Of an elastic structure no law of the step is known.
#[test]
fn the_law_of_a_rigid_body_is_told_of_one_alone() {
    let [rigid, elastic] = [false, true].map(|elastic| report(elastic).section());
    assert_eq!(elastic.title, "Springs for OpenSees with even steps of 5 ms");
    assert!(rigid.text[0].contains("causes a median error of 13 p dt"), "{}", rigid.text[0]);
    assert!(!elastic.text[0].contains("13 p dt"), "{}", elastic.text[0]);
    let of_record = &elastic.table.unwrap().rows[2];
    assert_eq!(of_record[..2], ["measured on this record", "0.089"]);
}

/// The doubt of the record's errors is the number of the finding, in every place the same, and says
/// nothing of what can be predicted.
#[test]
fn what_a_small_change_moves_is_told_in_one_way() {
    let finding = Finding::IllConditioned {
        moved_by_width: 0.0077,
        moved_by_scale: 0.0095,
        moved_by_restitution: Some(0.009_62),
        holds_to_s: None,
        springs_judged: true,
    };
    let said = ProgramReport::new(
        &row(16),
        Vec::new(),
        (None, None),
        told(["peaks", "motions"], true, &filed(vec![finding])),
    );
    let told = "(a change of 0.1 % moves it by 0.96 %)";
    let section = said.section();
    let cell = section.table.unwrap().rows[2][0].clone();
    for text in said.lines().into_iter().chain([section.text[1].clone(), cell]) {
        assert!(text.contains(told) && !text.contains("predictable"), "{text}");
    }
    assert!(!report(true).line().contains("0.1 %"));
}
