use super::*;
use crate::{DesignForce, DesignForces, OtherForces};

#[test]
fn a_finding_is_filed_with_its_quantities_and_read_back() {
    let finding = Finding::Sliding {
        needed: 0.61,
        time_s: Some(3.25),
        available: 0.5,
        press_over_weight: None,
    };
    let filed = FiledFinding::from(finding.clone());
    let json = serde_json::to_value(&filed).unwrap();
    assert_eq!(json["finding"], "sliding");
    assert_eq!(json["needed"], 0.61);
    assert_eq!(json["weight"], "warning");
    assert_eq!(
        json["message"],
        "the feet would slide: friction of 0.61 is needed at t = 3.25 s, 0.5 is available"
    );
    assert_eq!(serde_json::from_value::<FiledFinding>(json).unwrap(), filed);
    assert_eq!(filed.finding, finding);
}

#[test]
fn a_doubt_is_filed_so_that_it_can_be_read_back() {
    let finding = Finding::Doubt { message: "0.001 g".into(), remedy: "check the unit".into() };
    let filed = FiledFinding::from(finding);
    let json = serde_json::to_string(&filed).unwrap();
    assert_eq!(json.matches("\"message\"").count(), 1, "{json}");
    assert_eq!(serde_json::from_str::<FiledFinding>(&json).unwrap(), filed);
}

#[test]
fn a_force_that_holds_for_a_part_of_the_record_is_told_with_what_the_whole_has() {
    let changes = vec![PeakChange {
        quantity: "axial force".into(),
        unit: "N".into(),
        without: 4.9e6,
        with: 13.6e6,
    }];
    let finding = Finding::ForcesHeldInPart { over_s: 49.42, changes };
    assert_eq!(finding.weight(), Weight::Warning);
    assert_eq!(
        finding.message(),
        "axial force is given for the first 49.4 s only: over the whole record it would be 13.6 MN \
            but change by 5 % or more with springs or mesh"
    );
}

#[test]
fn forces_that_hang_on_the_frequency_are_told() {
    let force = |value: f64, twice: f64| DesignForce {
        value: Some(value),
        others: Some(OtherForces { doubled_cutoff: Some(twice), ..OtherForces::default() }),
        ..DesignForce::default()
    };
    let forces = DesignForces {
        below_hz: Some(31.8),
        column_shear_n: Some(force(3.72e6, -5.22e6)),
        axial_n: Some(force(-8.1e6, -8.3e6)),
        ..DesignForces::default()
    };
    let found = forces.of_cutoff().unwrap();
    assert_eq!(found.weight(), Weight::Warning);
    assert_eq!(
        found.message(),
        "column shear is low-pass filtered at 31.8 Hz; at twice that cutoff it is 5.22 MN"
    );
    assert_eq!(DesignForces { column_shear_n: None, ..forces }.of_cutoff(), None);
}

#[test]
fn answers_come_first_and_faults_weigh_most() {
    assert!(Weight::Answer < Weight::Note && Weight::Warning < Weight::Fault);
    let fault = Finding::AccuracyMissed { asked: 0.002, capped: true, another_restitution: false };
    assert_eq!(
        (fault.weight(), fault.remedy().unwrap().as_str()),
        (Weight::Fault, "raise or drop --max-hz")
    );
    assert!(fault.message().contains("NRMSE 0.002"));
}

#[test]
fn a_force_that_comes_after_what_can_be_foretold_makes_a_warning_of_it() {
    let of = |later_forces: Vec<ForceName>| Finding::ForetoldUpTo {
        time_s: 9.0,
        softer_hz: None,
        later_forces,
    };
    assert_eq!((of(Vec::new()).weight(), of(Vec::new()).remedy()), (Weight::Note, None));
    let two = of(vec![ForceName::ColumnShear, ForceName::Axial]);
    assert_eq!(two.weight(), Weight::Warning);
    let said = "column shear and axial force come after what can be predicted: ";
    assert!(two.message().starts_with(said), "{}", two.message());
    assert!(two.remedy().unwrap().starts_with("design by several records"));
}

#[test]
fn what_was_left_out_is_told_with_what_it_would_change() {
    let change = |quantity: &str, without: f64, with: f64| PeakChange {
        quantity: quantity.into(),
        unit: if quantity.contains("moment") { "N m" } else { "N" }.into(),
        without,
        with,
    };
    // the largest moment, and what grows the most of the others
    let changes = vec![
        change("moment at the apex", 10e6, 10.05e6),
        change("moment at column base", 10.8e6, 20.9e6),
        change("another moment", 6e6, 2e6),
    ];
    let told = |changes: Vec<PeakChange>, checked: bool| {
        let (vertical_g, horizontal_g, overturns_s) = (1.84, 0.99, None);
        let predictable_to_s = None;
        Finding::VerticalLeftOut {
            vertical_g,
            horizontal_g,
            overturns_s,
            changes,
            predictable_to_s,
            checked,
        }
        .message()
    };
    let left_out = "vertical motion (1.84 g) left out; with it";
    assert_eq!(told(changes, true), format!("{left_out}: moment at column base 20.9 MN m"));
    // the axial force in any case, of forces that were not measured to be the structure's
    let changes = vec![
        change("axial force", 30e6, 35.6e6),
        change("moment at column base", 10.8e6, 20.9e6),
        change("tension", 1.4e6, 7.4e6),
        change("column shear", 1.0e6, 1.1e6),
    ];
    assert_eq!(
        told(changes, false),
        format!(
            "{left_out} (unchecked): tension 7.4 MN, moment at column base 20.9 MN m, axial force \
                35.6 MN"
        )
    );
}

/// The largest of what moves it is named, whichever it is.
#[test]
fn what_moves_an_ill_conditioned_motion_the_most_is_told() {
    let of = |moved_by_restitution| Finding::IllConditioned {
        moved_by_width: 0.00974,
        moved_by_scale: 0.004,
        moved_by_restitution,
        holds_to_s: Some(20.0),
        springs_judged: true,
    };
    assert_eq!(
        of(Some(0.593)).message(),
        "ill-conditioned: a change of the restitution by 0.1 % moves the history by 59 %"
    );
    // of files that were written before it was told
    assert_eq!(
        of(None).message(),
        "ill-conditioned: a change of the width by 0.1 % moves the history by 0.97 %"
    );
}

/// One that nowhere moves by much is not told as one that cannot be predicted.
#[test]
fn a_sensitive_motion_whose_peaks_hold_is_told_so() {
    let told = Finding::IllConditioned {
        moved_by_width: 0.016,
        moved_by_scale: 0.01,
        moved_by_restitution: None,
        holds_to_s: None,
        springs_judged: true,
    };
    let (message, until) = (told.message(), told.predictable_to());
    assert!(message.contains("1.6 % (NRMSE)") && message.contains("peaks are predictable"));
    assert_eq!(until, None);
}

/// What is largest after a motion with its vertical component can be predicted is not told.
#[test]
fn a_vertical_motion_left_out_is_told_as_far_as_it_can_be_predicted() {
    let told = |overturns_s, predictable_to_s, changes: Vec<PeakChange>| {
        Finding::VerticalLeftOut {
            vertical_g: 1.84,
            horizontal_g: 0.99,
            overturns_s,
            changes,
            predictable_to_s,
            checked: true,
        }
        .message()
    };
    let none = told(None, Some(49.08), Vec::new());
    assert!(none.contains("predictable only to 49.08 s") && !none.contains(" mm"), "{none}");
    let top = PeakChange {
        quantity: "top displacement".into(),
        unit: "m".into(),
        without: 0.5,
        with: 0.2,
    };
    let some = told(None, Some(49.08), vec![top.clone()]);
    assert!(
        some.contains("top 200 mm; with it the motion is predictable only to 49.08 s"),
        "{some}"
    );
    assert!(told(None, None, vec![top]).ends_with("with it: top 200 mm"));
    let falls = told(Some(50.0), Some(49.08), Vec::new());
    assert!(falls.ends_with("at t = 50 s, which is not predictable beyond 49.08 s"), "{falls}");
    assert!(told(Some(49.0), Some(49.08), Vec::new()).ends_with("at t = 49 s"));
}

/// Springs that are taken and those that are not, with what both err, whichever they are.
#[test]
fn springs_for_another_restitution_are_told_with_those_not_taken() {
    let told = |equation_2| {
        Finding::SpringsForRestitution {
            asked: 0.89,
            share: 0.9902,
            equation_2,
            peaks: [Some(0.011), Some(0.51)],
            nrmse: [Some(0.294), None],
        }
        .message()
    };
    let (own, other) =
        ("equation 2's springs (peaks 1.10 %, NRMSE 0.29)", "(peaks 51.0 %, NRMSE unknown)");
    let (first, then) = (told(true), told(false));
    assert!(
        first.find(own) < first.find(other) && first.contains("0.9902 times equation"),
        "{first}"
    );
    assert!(then.find(other) < then.find(own) && then.find(other).is_some(), "{then}");
}

/// An A-frame 35 m by 7 m that needs mu = b/h = 0.1 to land is slender: what is short is the
/// friction given. A block half as high again as wide needs more than ground offers.
#[test]
fn too_little_friction_is_told_of_the_friction_and_a_stocky_body_of_the_body() {
    let of = |restitution, friction_needed, available| Finding::TooStocky {
        restitution,
        friction_needed,
        available,
    };
    let slender = of(0.98, 0.1, 0.08);
    assert_eq!(
        slender.message(),
        "the friction given is too little to land without bouncing: 0.1 is needed, 0.08 is \
            available"
    );
    assert_eq!(slender.remedy().unwrap(), "--friction sets what the ground offers");
    for stocky in [of(0.05, 0.6, 0.5), of(-0.1, 0.3, 0.5)] {
        assert!(stocky.message().starts_with("the body is too stocky"), "{}", stocky.message());
        assert!(stocky.remedy().unwrap().starts_with("check height"));
    }
}

/// `tune validate` takes rigid bodies alone: of an elastic structure no remedy names it.
#[test]
fn no_remedy_of_an_elastic_structure_names_what_takes_rigid_bodies_alone() {
    let missed = |capped| Finding::PeaksMissed { asked: 0.01, capped, another_restitution: false };
    let all = [
        Finding::ModelsDisagree { reference: "stands".into(), springs: "overturns".into() },
        missed(false),
        missed(true),
        Finding::AccuracyMissed { asked: 0.01, capped: false, another_restitution: false },
        Finding::AccuracyNotMeasured,
        Finding::HistoriesUnfinished { histories: 2, left_out: false },
        Finding::HistoriesUnfinished { histories: 2, left_out: true },
    ];
    for finding in all {
        let remedy = FiledFinding::from(finding).of_elastic().remedy.unwrap();
        assert!(!remedy.contains("tune validate"), "{remedy}");
    }
}

#[test]
fn where_feet_end_is_told_with_when_they_last_pressed_and_whether_it_can_be_predicted() {
    let told = |rocks_on_from_s: Option<f64>, predictable: bool| {
        let (aside_m, apart_m) = (Some(0.853), Some(-0.05102));
        let found = Finding::FeetMoved { aside_m, apart_m, rocks_on_from_s, predictable };
        (found.message(), feet_end(&found).unwrap())
    };
    let place = "853 mm beside their place and 51.02 mm closer together";
    let (warning, short) = told(None, true);
    let bent = "than at first: friction keeps the structure bent";
    assert_eq!(warning, format!("at the end the feet stand {place} {bent}"));
    let aside = "853 mm aside and 51.02 mm closer together";
    assert_eq!(short, format!("its feet end {aside}"));
    let (warning, short) = told(Some(68.42), false);
    let begins = format!(
        "the structure still rocks at the end; at t = 68.42 s, when all feet last press, they \
            stand {place}"
    );
    assert!(warning.starts_with(&begins) && warning.contains("(not predictable)"), "{warning}");
    assert_eq!(short, format!("it rocks on, its feet {aside} (not predictable)"));
    // as an earlier version filed it
    let filed = r#"{"finding": "feet_apart", "apart_m": 0.2, "predictable": true}"#;
    let found = serde_json::from_str::<Finding>(filed).unwrap();
    assert_eq!(feet_end(&found).unwrap(), "its feet end 200 mm further apart");
}

/// A tendon brings a body back from beyond alpha: its share is of the body without it.
#[test]
fn a_body_with_a_tendon_has_its_rotation_over_that_of_the_body_without() {
    let stands = |tied: bool| Finding::Stands {
        share_of_overturning: 0.171,
        reference_share: None,
        over_s: 20.0,
        largest_at_s: None,
        if_feet_hold: false,
        of_columns: false,
        tied,
    };
    assert!(stands(true).message().ends_with("17.1 % of overturning without its tendon"));
    assert!(stands(false).message().ends_with("17.1 % of overturning"));
    let json = serde_json::to_value(stands(false)).unwrap();
    assert!(json.get("tied").is_none());
}
