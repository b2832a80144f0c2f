use super::*;
use dynamics::{
    fem::Analysis,
    spring::{Design, Springs},
};
use rocking::structure::Structure;
use strong_motion::Record;

/// Both models of the paper's frame on plain springs of 640 Hz.
fn verdict(record: &Record) -> Verdict {
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 = 1e-5 * structure.mass_kg * structure.height_m.powi(2);
    let springs = Springs {
        vertical: Design::from_kc(0.3, 0.1, 0.75, 640.0),
        horizontal: Design::from_kc(0.3, 0.57, 1.86, 640.0),
    };
    let body = structure.body::<f64>();
    let (dt, accel, options) = (record.dt, &record.accel[..], housner::RockingOptions::default());
    let rocking = housner::solve(&body, dt, accel, &options);
    let springs = springs.chains(structure.mass_kg);
    let history = Analysis::new(body, springs, dt, accel).simulate();
    let motion = rocking.motion(&body);
    let matched = Match::new(&body, dt, (&motion, &rocking.impacts), &history, body.restitution());
    let conditioning = Conditioning::new(&body, dt, accel, &options);
    Verdict::new(&body, dt, (&rocking, &history), &matched, &conditioning)
}

#[test]
fn el_centro_rocks_the_papers_frame_in_both_models() {
    let found = verdict(&Record::el_centro().truncated(20.0));
    assert_eq!((found.housner.fate, found.finite_elements.fate), (Fate::Rocked, Fate::Rocked));
    // 401.18 mm at the apex (theory: the Taylor reference), u = h sin(theta) + b (1 - cos(theta))
    assert!((found.housner.peak_ratio * 0.0996687 * 61.0 - 0.40118).abs() < 2e-3, "{found:?}");
    assert!(
        (found.finite_elements.peak_ratio / found.housner.peak_ratio - 1.0).abs() < 0.01,
        "{found:?}"
    );
    assert!(found.well_conditioned && found.agrees());
}

/// A steady push of 0.15 g: the body passes alpha at acosh(3)/p = 4.4 s (small angles).
#[test]
fn a_steady_push_overturns_both_and_numbers_end_there() {
    let record = Record::new("push", 0.01, vec![0.15 * 9.81; 2000]).unwrap();
    let found = verdict(&record);
    for answer in [found.housner, found.finite_elements] {
        assert_eq!(answer.fate, Fate::Overturned);
        assert!((answer.overturned_s.unwrap() - 4.4).abs() < 0.1, "{found:?}");
        assert!((0.98..=1.0).contains(&answer.peak_ratio), "{found:?}");
    }
    assert!(found.agrees() && (4.3..4.5).contains(&found.compared_s));
    assert!(found.nrmse_horizontal.is_some_and(|x| x < 0.05), "{found:?}");
}

#[test]
fn a_weak_record_lifts_neither_and_leaves_nothing_to_compare() {
    let found = verdict(&Record::new("weak", 0.01, vec![0.02 * 9.81; 300]).unwrap());
    assert_eq!((found.housner.fate, found.housner.peak_ratio), (Fate::NeverLifted, 0.0));
    assert_eq!(
        (found.finite_elements.fate, found.finite_elements.peak_ratio),
        (Fate::NeverLifted, 0.0)
    );
    assert_eq!((found.nrmse_horizontal, found.agrees()), (None, true));
}

#[test]
fn models_that_differ_disagree() {
    let answer = |fate| Answer { fate, overturned_s: None, left_ground_s: None, peak_ratio: 0.9 };
    let mut verdict = Verdict {
        housner: answer(Fate::Rocked),
        housner_without_vertical: None,
        finite_elements: Answer { overturned_s: Some(3.456), ..answer(Fate::Overturned) },
        well_conditioned: false,
        nrmse_horizontal: Some(0.3),
        nrmse_vertical: Some(0.3),
        compared_s: 3.45,
    };
    assert!(!verdict.agrees());
    verdict.finite_elements = answer(Fate::Failed);
    assert!(!verdict.agrees());
    let json = serde_json::to_string(&verdict).unwrap();
    assert!(
        json.contains("\"finite_elements\":{\"fate\":\"failed\",\"peak_ratio\":0.9}"),
        "{json}"
    );
    assert_eq!(serde_json::from_str::<Verdict>(&json).unwrap(), verdict);
}
