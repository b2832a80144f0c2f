//! Springs for a program with fixed time steps: what a run files, says and writes of them.

use super::*;
use files::message::significant;
use results::{Finding, ProgramAdvice, Weight};
use rocking::motion::{largest_magnitude, nrmse};

/// What a program's springs err on the record is told up to the time that is printed beside it,
/// whatever ends what can be foretold.
#[test]
fn errors_of_a_program_are_of_the_time_that_is_told() {
    let block = "[structure]\nkind = \"block\"\ntotal_height_m = 5.0\nwidth_m = 1.0\n\
                 mass_kg = 9e3\n";
    let run = run(1.2, Some(block));
    let until = predictable_to(&run.parameters.findings).unwrap();
    assert!(until < 7.0, "{until}");
    let samples = (until / run.job.record.dt).round() as usize + 1;
    let largest = |u: &[f64]| largest_magnitude(&u[..samples]);
    let [steps, housner] =
        [&run.of_steps.as_ref().unwrap().motion.u, &run.both.rocking.motion(&run.job.body).u]
            .map(|u| largest(u));
    let on = run.parameters.program.as_ref().unwrap().on_record.unwrap();
    assert!((on.top.unwrap() - (steps / housner - 1.0)).abs() < 1e-3, "{on:?} {steps} {housner}");
    // the history's own error, beside the motions' on its line
    let u = run.both.rocking.motion(&run.job.body).u;
    let steps = &run.of_steps.as_ref().unwrap().motion.u;
    assert_eq!(on.nrmse, Some(nrmse(&steps[..samples], &u[..samples])));
    let said = run.said(filed(&run, Path::new("out")));
    let program = said.program.as_ref().unwrap();
    assert_eq!((program.usable, program.on_record), (true, Some(on)));
    let line = screen_of(&said, "out");
    let nrmse = format!("NRMSE {}", significant(on.nrmse.unwrap(), 2));
    assert!(line.contains(&nrmse) && line.contains("median"), "{line}");
    let forces = run.parameters.design_forces.unwrap();
    for (name, force) in forces.all() {
        assert_eq!(force.predictable, Some(force.time_s <= until), "{name:?} {force:?}");
    }
}

/// A program's decks, what the screen says of them, and Housner's numbers in the sheet.
#[test]
fn a_program_that_is_asked_for_has_its_sheet() {
    for (name, sheet, other, says) in [
        (
            "SAP2000",
            "sap2000_by_hand.txt",
            "etabs_by_hand.txt",
            "; decks/model_sap2000.s2k, sap2000_by_hand.txt",
        ),
        (
            "ETABS",
            "etabs_by_hand.txt",
            "sap2000_by_hand.txt",
            "; type it from decks/etabs_by_hand.txt",
        ),
    ] {
        let run = run_for(name, 1e-3);
        let texts = texts(&run, Path::new("out")).unwrap();
        let find = |of: &str| texts.files.iter().find(|(file, _)| file == &format!("decks/{of}"));
        assert!(find(other).is_none());
        assert_eq!(find("model_sap2000.s2k").is_some(), name == "SAP2000");
        let (_, sheet_text) = find(sheet).unwrap();
        // the tables of its springs, beside those for steps that follow touches
        let k1 = run.parameters.program.as_ref().unwrap().units.vertical.k1_n_per_m;
        let holds = |table: &str| find(table).unwrap().1.matches(&format!("{k1:.16e}")).count();
        assert_eq!(["springs_even.csv", "springs_even.md", "springs.csv"].map(holds), [2, 2, 0]);
        assert!(find("springs_even.csv").unwrap().1.contains(",1 ms by hht:-0.333"));
        // El Centro begins at -0.063 m/s2, its function at 0
        let (_, motion) = find("ground_motion.txt").unwrap();
        let begin: Vec<&str> = motion.lines().take(2).collect();
        assert!(begin[0] == "0.000000000e0 0.000000000e0", "{begin:?}");
        assert!(begin[1].starts_with("1.000000000e-5 -6.28"), "{begin:?}");
        let sheet_words = sheet_text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(sheet_words.contains("it begins at 0, for the"), "{sheet_text}");
        let said = run.said(filed(&run, Path::new("out")));
        let text = screen_of(&said, "out");
        let last = text.lines().last().unwrap();
        assert!(last.starts_with("report    out/report.html") && last.ends_with(says), "{last}");
        // a folder that leaves no room beside it
        let far = screen_of(&said, "a/folder/whose/name/is/as/long/as/they/are");
        let told = far.lines().find(|line| line.starts_with("its model ")).unwrap();
        assert!(told.ends_with(&says[2..]), "{far}");
        assert!(far.lines().count() <= 30, "{far}");
        // its springs first, and nothing of its lines cut
        let place = |what: &str| text.find(what).unwrap();
        assert!(place(", 1 ms: vertical") < place("OpenSees, adaptive: vertical"), "{text}");
        let lines = text.lines().skip_while(|line| !line.starts_with(name));
        let of_program: Vec<_> = lines.map(str::trim).collect();
        let of_program = of_program.join(" ");
        assert!(!of_program.contains("..."), "{text}");
        // all that the form of the load case asks for
        for what in [
            "HHT alpha -1/3",
            "output 800 x 0.01 s",
            "substeps max 0.001, min 6.25e-5 s",
            "constant-stiffness 0, Newton 40",
            "no event stepping; no line search",
            "P-Delta plus large displacements",
            "case damping 0; accel U1 x 1: ground_motion.txt",
            "from GRAVITY",
        ] {
            assert!(of_program.contains(what), "{what}: {text}");
        }
        // the joint of the sheet does in Housner's history what the run found
        let line = sheet_text.lines().find(|line| line.contains("   Housner: ")).unwrap();
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        let u = &run.both.housner.u;
        let extremes =
            [u.iter().copied().fold(0.0, f64::min), u.iter().copied().fold(0.0, f64::max)];
        for (told, found) in numbers.iter().zip(extremes) {
            assert!((told - 1e3 * found).abs() < 0.1 + 1e-3 * told.abs(), "{line}: {extremes:?}");
        }
    }
}

/// Springs for an integrator that SAP2000 has not come in decks for OpenSees, and in no tables.
#[test]
fn springs_for_another_integrator_are_in_decks_that_have_it() {
    let run = run(1.0, Some(&format!("{FRAME}[program]\nintegrator = \"trbdf2\"\n")));
    let texts = texts(&run, Path::new("out")).unwrap();
    let find = |of: &str| texts.files.iter().find(|(file, _)| file == of).map(|(_, text)| text);
    let deck = find("decks/model_even.py").unwrap();
    let k1 = run.parameters.program.as_ref().unwrap().units.vertical.k1_n_per_m;
    let mut numbers = deck.split(['=', ' ', ',', '\n']).filter_map(|word| word.parse::<f64>().ok());
    assert!(
        deck.contains("TRBDF2") && numbers.any(|x| (x / k1 - 1.0).abs() < 1e-9),
        "{k1}: {deck}"
    );
    for tables in ["decks/model_sap2000.s2k", "decks/sap2000_by_hand.txt"] {
        assert!(find(tables).is_none(), "{tables}");
    }
    let page = find("report.html").unwrap();
    assert!(page.contains("model_even.py") && !page.contains("model_sap2000"), "{page}");
}

/// A step that is far too long is told in the findings, with the number, and no sheet is offered.
#[test]
fn a_step_that_is_too_long_is_not_to_be_used() {
    let run = run_for("SAP2000", 0.05);
    let row = run.parameters.program.as_ref().unwrap();
    let on_record = row.on_record.unwrap();
    assert_eq!(on_record.predictable, Some(true));
    let expected = row.not_to_be_used().unwrap();
    let told = run.parameters.findings.iter().find_map(|filed| match &filed.finding {
        Finding::ProgramNotToBeUsed { fault, advice, .. } => Some((filed.weight, *fault, *advice)),
        _ => None,
    });
    assert_eq!(told, Some((Weight::Warning, expected.fault, expected.advice)));
    // steps that are shorter were measured, and the first that helps is named
    let ProgramAdvice::MeasuredStep { step_s, median } = expected.advice else {
        panic!("{expected:?}")
    };
    assert!(step_s < 0.05 && median < 0.1, "{expected:?}");
    let at = run_for("SAP2000", step_s).parameters.program.unwrap();
    assert_eq!(at.not_to_be_used(), None, "{:?}", at.expected);
    let medians = [at.expected.synthetic, at.expected.earthquakes].map(|e| e.unwrap().peak[0]);
    assert!(medians.contains(&Some(median)), "{medians:?} {median}");
    // in the file and in the summary, too
    assert_eq!(row.not_to_be_used, Some(expected));
    let said = run.said(filed(&run, Path::new("out")));
    let json = serde_json::to_value(said.program.as_ref().unwrap()).unwrap();
    assert!(json["usable"] == false && json["not_to_be_used"]["fault"].is_object(), "{json}");
    let text = screen_of(&said, "out");
    assert!(!text.contains("_by_hand"), "{text}");
}
