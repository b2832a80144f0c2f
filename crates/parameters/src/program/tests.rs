use super::*;
use results::{ProgramAdvice, ProgramFault};

/// Errors on 24 motions with this median of peaks; none: most are lost.
fn errors(median: Option<f64>) -> ProgramErrors {
    let lost = if median.is_some() { 0 } else { 20 };
    ProgramErrors { histories: 24, lost, history: [median; 2], peak: [median; 2] }
}

/// A row at a step of 1 ms whose floor is this.
fn row(floor: f64, synthetic: Option<f64>) -> ProgramRow<()> {
    ProgramRow {
        name: Some(ProgramName::Sap2000),
        asked: true,
        step_s: 1e-3,
        integrator: Integrator::Hht { alpha: -0.333 },
        substeps: 16,
        newton_iterations: 40,
        converged: ProgramTest::UnbalanceOverWeight(0.1),
        units: (),
        stiffer_for_earthquakes: false,
        expected: ProgramExpected {
            floor,
            stance: None,
            rebound: None,
            synthetic: Some(errors(synthetic)),
            earthquakes: None,
            instead: None,
        },
        without_deck: false,
        on_record: None,
        not_to_be_used: None,
    }
}

/// Those lost of both sets count, as on the line of a program's springs.
#[test]
fn histories_lost_are_those_of_all_motions() {
    let expected = ProgramExpected {
        earthquakes: Some(ProgramErrors { histories: 16, lost: 6, ..errors(Some(0.1)) }),
        ..row(0.02, None).expected
    };
    assert_eq!(expected.lost(), [26, 40]);
    assert_eq!(ProgramExpected { synthetic: None, ..expected }.lost(), [6, 16]);
}

fn with_top(row: ProgramRow<()>, top: f64, predictable: bool) -> ProgramRow<()> {
    let predictable = Some(predictable);
    let on_record = ProgramOnRecord { predictable, ..ProgramOnRecord::of(None, None) };
    let on_record = ProgramOnRecord { top: Some(top), until_s: Some(4.42), ..on_record };
    ProgramRow { on_record: Some(on_record), ..row }
}

fn with_earthquakes(mut row: ProgramRow<()>, median: f64) -> ProgramRow<()> {
    row.expected.earthquakes = Some(errors(Some(median)));
    row
}

fn peaks(median: f64, earthquakes: bool) -> ProgramFault {
    ProgramFault::Peaks { median, motions: 24, earthquakes }
}

/// A tenth, of motions or of a record that can be predicted, is of no use; the step follows from
/// the law of the floor and from what was measured.
#[test]
fn what_errs_by_more_than_a_tenth_is_not_to_be_used() {
    let found = |row: &ProgramRow<()>| row.not_to_be_used();
    for good in [
        row(0.01, Some(0.09)),
        with_top(row(0.01, Some(0.01)), -0.09, true),
        // of a motion that cannot be predicted nothing is judged
        with_top(row(0.01, Some(0.01)), -0.7, false),
        // springs sway on earthquakes
        with_earthquakes(row(0.05, Some(0.01)), 0.3),
    ] {
        assert_eq!(found(&good), None, "{good:?}");
    }
    let step = |step_s: f64| ProgramAdvice::Step { step_s };
    for (bad, fault, advice) in [
        // 1 ms * 0.1/0.25 is below 0.4 ms, and so is 1 ms * 0.1/0.2
        (row(0.2, Some(0.25)), peaks(0.25, false), step(2e-4)),
        (row(0.05, Some(0.25)), peaks(0.25, false), step(2e-4)),
        // errors on earthquakes fall with the step, too: 1 ms * 0.1/0.3
        (with_earthquakes(row(0.2, Some(0.05)), 0.3), peaks(0.3, true), step(2e-4)),
        (
            with_top(row(0.2, Some(0.15)), -0.75, true),
            ProgramFault::OnRecord { top: -0.75, until_s: Some(4.42) },
            step(1e-4),
        ),
        (
            with_top(row(0.02, Some(0.01)), 0.12, true),
            ProgramFault::OnRecord { top: 0.12, until_s: Some(4.42) },
            ProgramAdvice::AnotherStep,
        ),
        // peaks that err by more than 30 %, at any step
        (with_earthquakes(row(0.05, Some(0.01)), 0.31), peaks(0.31, true), step(2e-4)),
        (row(0.02, None), ProgramFault::Lost { lost: 20, motions: 24 }, ProgramAdvice::AnotherStep),
        (row(0.2, None), ProgramFault::Lost { lost: 20, motions: 24 }, step(5e-4)),
    ] {
        assert_eq!(found(&bad), Some(NotToBeUsed { fault, advice }), "{bad:?}");
        // no step mends what no deck is made of
        let bad = ProgramRow { without_deck: true, ..bad };
        assert_eq!(found(&bad).map(|found| found.advice), Some(ProgramAdvice::OtherDeck));
    }
    let of_record = found(&with_top(row(0.02, Some(0.01)), -0.338, true)).unwrap().to_string();
    let said = "this record's top displacement to 4.42 s errs by -33.8 %";
    assert!(of_record.contains(said), "{of_record}");
}

#[test]
fn an_integrator_that_fails_gives_way_to_the_usual_one() {
    use ProgramAdvice::{AnotherStep, DefaultIntegrator, ForOpenSees};
    for (name, integrator, advice) in [
        (Some(ProgramName::Sap2000), "newmark:0.5:0.25", DefaultIntegrator),
        (Some(ProgramName::Sap2000), "hht:-0.3333333333333333", AnotherStep),
        (Some(ProgramName::OpenSees), "backward-euler", AnotherStep),
        (Some(ProgramName::OpenSees), "hht:-0.333", DefaultIntegrator),
        // to leave it out would be to take SAP2000
        (None, "trbdf2", ForOpenSees),
        (None, "backward-euler", AnotherStep),
        (None, "generalized-alpha:0.8", DefaultIntegrator),
    ] {
        let failing =
            ProgramRow { name, integrator: integrator.parse().unwrap(), ..row(0.02, None) };
        assert_eq!(failing.not_to_be_used().unwrap().advice, advice, "{name:?} {integrator}");
    }
}

/// What was measured is the advice, whatever the law says.
#[test]
fn settings_that_were_measured_are_the_advice() {
    let advice = |instead| {
        let mut bad = row(0.2, Some(0.25));
        bad.expected.instead = Some(instead);
        let nameless = ProgramRow { name: None, ..bad.clone() };
        [bad, nameless].map(|row| row.judged().not_to_be_used.unwrap().advice)
    };
    let (step_s, median) = (5e-4, 0.03);
    let step = ProgramInstead::Helps { usual_of: None, step_s, median };
    assert_eq!(advice(step), [ProgramAdvice::MeasuredStep { step_s, median }; 2]);
    let usual_of = Some(ProgramName::OpenSees);
    let usual = ProgramInstead::Helps { usual_of, step_s: 1e-3, median };
    let with = |give_for| ProgramAdvice::MeasuredIntegrator { give_for, median };
    assert_eq!(advice(usual), [with(false), with(true)]);
    let said = with(true).to_string();
    assert_eq!(said, "give --for opensees-even: peaks err by 3.00 % with it (measured)");
    let none = ProgramInstead::NoneDoes { shortest_s: 2e-4 };
    assert_eq!(advice(none), [ProgramAdvice::NoneHelps { shortest_s: 2e-4 }; 2]);
}

/// An error far above what the step makes does not fall with it.
#[test]
fn no_step_is_promised_where_errors_are_not_the_steps() {
    let advice = row(0.01, Some(0.25)).not_to_be_used().unwrap().advice;
    assert_eq!(advice, ProgramAdvice::OffLaw { times: 25.0 });
    assert!(advice.to_string().starts_with("this is 25 times the error of the step alone"));
}

/// One motion in ten that errs by much more than the median is told of springs that are of use.
#[test]
fn a_large_spread_is_told() {
    let spread = |row: ProgramRow<()>| row.spreads().map(|(e, like)| (e.peak[1], like));
    let with = |ninety: f64, earthquakes: Option<f64>| {
        let mut row = row(0.05, Some(0.08));
        row.expected.synthetic = row.expected.synthetic.map(|e| wide(e, ninety));
        row.expected.earthquakes = earthquakes.map(|ninety| wide(errors(Some(0.05)), ninety));
        row
    };
    assert_eq!(spread(with(0.29, None)), None);
    assert_eq!(spread(with(0.43, None)), Some((Some(0.43), false)));
    assert_eq!(spread(with(0.43, Some(0.6))), Some((Some(0.43), false)));
    assert_eq!(spread(with(0.2, Some(0.6))), Some((Some(0.6), true)));
    // of earthquakes on which they err much anyhow another finding tells
    let much = with_earthquakes(with(0.1, None), 0.2);
    assert_eq!(spread(much), None);
    assert_eq!(spread(row(0.05, Some(0.4))), None);
}

fn wide(errors: ProgramErrors, ninety: f64) -> ProgramErrors {
    ProgramErrors { peak: [errors.peak[0], Some(ninety)], ..errors }
}

/// Steps beyond those that are measured are refused by the law alone.
#[test]
fn steps_too_long_to_be_measured_are_not_to_be_used() {
    let mut long = row(0.52, None);
    long.expected.synthetic = None;
    let NotToBeUsed { fault, advice } = long.not_to_be_used().unwrap();
    assert_eq!(fault, ProgramFault::TooLong { floor: 0.52 });
    assert_eq!(advice, ProgramAdvice::Step { step_s: 1e-4 });
    // a run that was stopped before it measured anything
    long.expected.floor = 0.01;
    assert_eq!(long.not_to_be_used(), None);
}

#[test]
fn much_error_on_earthquakes_is_told_of_springs_that_are_of_use() {
    let told = |row: ProgramRow<()>| row.errs_on_earthquakes().and_then(|e| e.peak[0]);
    assert_eq!(told(with_earthquakes(row(0.05, Some(0.01)), 0.3)), Some(0.3));
    assert_eq!(told(with_earthquakes(row(0.05, Some(0.01)), 0.08)), None);
    assert_eq!(told(with_earthquakes(row(0.2, Some(0.01)), 0.3)), None);
}

/// What a user may have edited is checked as a case's section is.
#[test]
fn a_program_that_cannot_step_so_is_refused() {
    assert!(row(0.02, None).check("p.json").is_ok());
    let refused = |edit: fn(&mut ProgramRow<()>)| {
        let mut edited = row(0.02, None);
        edit(&mut edited);
        edited.check("p.json").unwrap_err().to_string()
    };
    let messages = [
        refused(|row| row.step_s = 0.0),
        refused(|row| row.step_s = -1e-3),
        refused(|row| row.integrator = Integrator::Trbdf2),
        refused(|row| row.substeps = 0),
        refused(|row| row.substeps = 3),
    ];
    let keys = ["step_s", "step_s", "integrator", "substeps", "substeps"];
    for (message, key) in messages.iter().zip(keys) {
        assert!(message.starts_with(&format!("p.json: program.{key} is ")), "{message}");
    }
    // names are read where the file is
    let text = serde_json::to_string(&row(0.02, None)).unwrap();
    for (from, to, give) in [
        ("sap2000", "sap200", "give sap2000, etabs or opensees-even"),
        ("hht:-0.333", "hht:0.333", "give hht:-0.333"),
    ] {
        let read = serde_json::from_str::<ProgramRow<()>>(&text.replace(from, to));
        assert!(read.unwrap_err().to_string().contains(give));
    }
}
