//! Against the nonsmooth reference, event-driven with plastic landings, of the same frame.

use cases::{Asked, Yardstick};
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Chain, Springs},
};
use frames::{
    Mechanics,
    answer::Reference,
    assembled::{Assembled, errors as sway_errors},
    beam::BeamSection,
    fem::{ElasticAnalysis, ElasticHistory, ElasticStart},
    frame::{Base, Frame, LeggedFrame, StraightMember},
    reference::{
        CornerSet, ElasticRocking, GroundAcceleration, ReferenceOptions, What, at_rest, rock,
    },
    structure::{ElasticStructure, PierSpec},
};
use nalgebra::DVector;
use rocking::scalar::GRAVITY;
use springs::elastic::{
    ElasticAsked, ElasticTuneError, ElasticTuned,
    design::{springs as springs_of_design, with_k},
    landing_speed, stand,
    suite::ElasticSuite,
    trial::ElasticTrial,
    tune_within,
};
use strong_motion::Record;

use crate::common::{
    MODERATE, Numbers, PIER, answer, el_centro, nrmse, on_rigid_ground, only, pier, portal, springs,
};

fn tuned_for(
    model: &Assembled,
    asked: ElasticAsked,
    record: (&Record, Reference),
) -> Result<ElasticTuned, ElasticTuneError> {
    tune_within(model, asked, Some(record), &Effort::unbounded(), &|_, _| ())
}

/// NRMSE of a base's rotation and of a mass's drift from it.
fn errors(
    frame: &Frame,
    (base, mass): (Base, usize),
    history: &ElasticHistory,
    reference: &ElasticRocking,
) -> [f64; 2] {
    let rotation: Vec<f64> =
        reference.q.iter().map(|q| base.rotation(frame, q.as_slice())).collect();
    let drift: Vec<f64> =
        reference.q.iter().map(|q| base.drift(frame, mass, q.as_slice())[0]).collect();
    [
        nrmse(&history.rotation(frame, base), &rotation),
        nrmse(&history.drift(frame, mass, base), &drift),
    ]
}

/// The same on springs of two kinds, over 20 s of El Centro.
fn el_centro_errors(
    frame: &Frame,
    of: (Base, usize),
    springs: [Vec<Springs<Chain>>; 2],
) -> [[f64; 2]; 2] {
    let (accel, still) = (el_centro(2001), DVector::zeros(frame.size()));
    let ground = GroundAcceleration::horizontal(0.01, &accel);
    let rest = at_rest(frame, &still, CornerSet::NONE.with(0).with(1), &[]).unwrap();
    let reference = rock(frame, ground, (&rest, &still), &ReferenceOptions::default());
    springs.map(|springs| {
        let on = ElasticAnalysis::new(frame, &springs, ElasticStart::Standing, 0.01, &accel);
        errors(frame, of, &on.simulate().unwrap(), &reference)
    })
}

/// Let go at half of alpha, on springs of 10 kHz of what lands: a light, a moderate, a heavy
/// footing.
#[test]
fn free_rocking_follows_the_reference() {
    let heavy = Numbers { mass: 2e5, footing: 6e5, centre: 4.0, axial: 4e9, ..MODERATE };
    // the heavy one's corner slides in hops: on springs by chatter
    for numbers in [Numbers { footing: 6e4, ..MODERATE }, MODERATE, heavy] {
        let frame = pier(&numbers).layout().frame().unwrap();
        let Numbers { mass, footing, centre, .. } = numbers;
        let alpha = (2.0 * (mass + footing) / (mass * 12.0 + footing * centre)).atan();
        let (still, springs) = (vec![0.0; 1001], springs(&frame, 1e4, 20.0));
        let history = ElasticAnalysis::new(
            &frame,
            &springs,
            ElasticStart::Leaning(0.5 * alpha),
            0.005,
            &still,
        )
        .simulate()
        .unwrap();
        // the same lean, its pivot where it would be on rigid ground
        let mut q = DVector::from_column_slice(&history.q[0]);
        let [x, z] = frame.places()[1].reach(q.as_slice()).place;
        for node in 0..frame.nodes() {
            let [i, j, _] = frame.coordinates(node).map(Option::unwrap_or_default);
            (q[i], q[j]) = (q[i] - x, q[j] - z);
        }
        let start = (&q, &DVector::zeros(frame.size()));
        let reference = rock(
            &frame,
            GroundAcceleration::horizontal(0.005, &still),
            start,
            &ReferenceOptions::default(),
        );
        let [rotation, drift] = errors(&frame, (Base::Footing(0), 1), &history, &reference);
        assert!(rotation < 1e-3 && drift < 5e-3, "{footing}: {rotation:e} {drift:e}");
        assert!(history.energy_residual < 1e-6);
    }
}

/// 20 s of El Centro, a pier of 2 Hz on a footing of 60 t; stiffer springs follow more closely.
#[test]
fn el_centro_follows_the_reference() {
    let frame = pier(&Numbers { footing: 6e4, ..MODERATE }).layout().frame().unwrap();
    let on = [2.5e3, 4e4].map(|hz| springs(&frame, hz, 20.0));
    let [soft, stiff] = el_centro_errors(&frame, (Base::Footing(0), 1), on);
    assert!(stiff[0] < 3e-3 && stiff[1] < 1e-2, "{stiff:?}");
    assert!(4.0 * stiff[0] < soft[0] && 4.0 * stiff[1] < soft[1], "{soft:?} {stiff:?}");
}

/// 20 s of El Centro, an A-frame of 61 m whose legs shorten by 1e-4 of their length under the
/// weight. A foot lifts as soon as it has landed: its horizontal spring must have stopped it by
/// then.
#[test]
fn legs_that_give_way_follow_the_reference() {
    let (mass, height, width): (f64, f64, f64) = (680.1e3, 61.0, 12.2);
    let length = height.hypot(0.5 * width);
    let axial = 0.5 * mass * GRAVITY / 1e-4;
    // radius of gyration 1 m; 2 % of damping at some 3 Hz
    let damping = 2e-3 * axial;
    let section = BeamSection {
        axial_damping: damping,
        bending_damping: damping,
        ..BeamSection::elastic(axial, axial)
    };
    let inertia = 0.01 * mass * length * length;
    let leg = StraightMember { section, elements: 1 };
    let frame =
        LeggedFrame { mass, inertia, height, width, foot_mass: 1e4, leg }.layout().frame().unwrap();
    let on = [4.0, 20.0].map(|ratio| springs(&frame, 1e4, ratio));
    let [soft, stiff] = el_centro_errors(&frame, (Base::Feet, 2), on);
    assert!(stiff[0] < 1e-2 && stiff[1] < 1e-2, "{stiff:?}");
    assert!(soft[0] > 5e-2, "{soft:?}");
}

/// A 61 m A-frame on legs that shorten by 1e-7 to 1e-3 of their length under its weight, let go
/// from leans: on springs of its own it does not bounce. From 0.2 alpha on legs of 1e-4 the leg in
/// the air springs straight, and its foot comes down at 7.7 m/s across and 0.8 m/s down.
#[test]
fn legs_of_any_stiffness_follow_the_reference() {
    for (shortening, radius, lean) in [
        (1e-7, 1.0, 0.5),
        (1e-6, 1.0, 0.5),
        (1e-5, 1.0, 0.5),
        (1e-4, 1.0, 0.5),
        (1e-4, 1.0, 0.2),
        (1e-3, 10.0, 0.5),
    ] {
        let mass = 680.1e3;
        let axial = 0.5 * mass * GRAVITY / shortening;
        let bending = axial * radius * radius;
        let spec = format!(
            "kind = 'aframe'\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = {mass:?}\n\
             foot_mass_kg = 1e4\nea_n = {axial:?}\nei_nm2 = {bending:?}\ndamping_ratio = 0.02\n"
        );
        let structure: ElasticStructure = toml::from_str(&spec).unwrap();
        let (alpha, landing) = (structure.body().alpha(), landing_speed(&structure));
        let model = Assembled::new(structure).unwrap();
        let springs = springs_of_design(&stand(&model).unwrap(), 1e-5, landing, 1.0);
        let effort = Effort::unbounded();
        let trial =
            ElasticTrial::released(&model, lean * alpha, (0.0125, 9.0), &effort).trial().unwrap();
        let judged = trial.judge(&model, &springs, None, (Control::search(), &effort));
        let [rotation, drift] = judged.errors;
        let touches = judged.touches as f64 / trial.landings as f64;
        println!(
            "{shortening:e} from {lean} alpha: {rotation:.1e} {drift:.1e}, {touches:.1} touches to \
             each of {} landings",
            trial.landings
        );
        assert!(rotation < 1e-3 && drift < 5e-3, "{shortening:e}: {rotation:e} {drift:e}");
        assert!(
            trial.landings >= 1 && touches <= 4.0,
            "{shortening:e}: {touches} {}",
            trial.landings
        );
    }
}

/// 20 s of El Centro, the pier of 2 Hz on a footing of 200 t: what changes it by a millionth is
/// more than a thousandth of the peak after 12.7 s. Springs stiffer than the accuracy needs up to
/// there follow it to its end.
#[test]
fn springs_are_stiffened_until_they_follow_the_record_to_its_end() {
    let pier = ElasticStructure::Pier(PierSpec { footing_mass_kg: 200e3, ..PIER });
    let model = Assembled::new(pier.checked().unwrap()).unwrap();
    let record = Record::new("El Centro", 0.01, el_centro(2001)).unwrap();
    let reference = on_rigid_ground(&model, &record);
    let foretold = reference.foretold;
    assert!((1200..1400).contains(&foretold), "{foretold}");
    let accuracy = 0.002;
    let asked = Asked { by: Yardstick::Histories, error: accuracy };
    let tuned = tuned_for(&model, only(asked), (&record, reference)).unwrap();
    assert!(tuned.reached, "{tuned:?}");
    let reference = tuned.reference.unwrap();
    assert_eq!((reference.foretold, reference.followed), (foretold, record.len()));
    let answer = answer(&model, &tuned.springs, &record, reference);
    let [rotation, drift] = answer.errors;
    assert!(
        answer.compared.whole() && rotation <= accuracy && drift <= 5.0 * accuracy,
        "{rotation:e} {drift:e}"
    );
    // statistics stand beside it all the same
    assert!(answer.ensemble.is_some());
    let touches = answer.histories.fem.contacts.iter().filter(|contact| contact.touches).count();
    let landings = answer.histories.reference.history.landings().count();
    assert!(touches <= 4 * landings, "{touches} {landings}");
    // as stiff as is allowed for, no further: up to what can be foretold
    let reference = Reference { followed: foretold, ..answer.histories.reference };
    let softer = tuned.softer_hz.unwrap();
    let capped = ElasticAsked { most_hz: Some(softer.ceil()), ..only(asked) };
    let soft = tuned_for(&model, capped, (&record, reference)).unwrap();
    assert!(soft.reached && soft.springs.omega_n_hz == softer && soft.softer_hz.is_none());
    assert_eq!(soft.reference.map(|reference| reference.followed), Some(foretold));
}

/// A column of four elements with its own mass, let go at 0.7 of alpha: waves in it relieve the
/// corner it stands on, which slides without carrying anything for 2 ms. A horizontal spring that
/// held it would throw it up some fifty times.
#[test]
fn a_corner_that_carries_nothing_slides_as_on_rigid_ground() {
    let column = PierSpec {
        height_m: 15.0,
        width_m: 3.4,
        mass_kg: 120e3,
        footing_mass_kg: 40e3,
        footing_height_m: 1.2,
        frequency_hz: Some(1.4),
        column_mass_kg: 30e3,
        elements: Some(4),
        ..PIER
    };
    let structure = ElasticStructure::Pier(column).checked().unwrap();
    let model = Assembled::new(structure).unwrap();
    let lean = 0.7 * structure.body().alpha();
    let (dt, still) = (1e-3, vec![0.0; 3001]);
    let ground = GroundAcceleration::horizontal(dt, &still);
    let reference = model.rock(ground, &model.leaning(lean).unwrap(), u64::MAX);
    let slips = reference.events.iter().filter(|event| event.what == What::Slip).count();
    assert!(slips >= 1, "{slips}");
    let springs = springs_of_design(&stand(&model).unwrap(), 3e-6, landing_speed(&structure), 1.0);
    let start = ElasticStart::Leaning(lean);
    let history =
        ElasticAnalysis::new(&model.frame, &springs.corners, start, dt, &still).simulate().unwrap();
    let touches = history.contacts.iter().filter(|contact| contact.touches).count();
    assert!(touches <= 2 * reference.landings().count(), "{touches}");
    let [of_reference, of_fem] = [
        model.sways(reference.q.iter().map(|q| q.as_slice())),
        model.sways(history.q.iter().map(Vec::as_slice)),
    ];
    let [rotation, drift] = sway_errors(&of_reference, &of_fem, still.len());
    assert!(rotation < 1e-4 && drift < 1e-3, "{rotation:e} {drift:e}");
    // sliding takes energy, and the account has it
    assert!(history.energy_residual < 1e-6, "{:e}", history.energy_residual);
}

/// A footing of a portal that has left the ground altogether lands so flat that stopping it
/// sideways would throw it up: it slides on, on springs too, and they follow the reference beyond.
/// Up to there springs err the less the stiffer they are. The landing itself, in which the ground's
/// push changes while they give, leaves 5e-4, whatever their stiffness and both models' steps.
#[test]
fn a_corner_that_lands_flat_slides_on_springs_as_on_rigid_ground() {
    let structure: ElasticStructure = toml::from_str(
        "kind = 'frame'\nheight_m = 7.14\nspan_m = 5.78\nfooting_width_m = 1.46\n\
         footing_height_m = 0.767\nfooting_mass_kg = 38e3\n\
         beam_mass_kg = 653e3\ncolumn_ea_n = 4.18e10\ncolumn_ei_nm2 = 1.69e9\nbeam_ea_n = 9.05e9\n\
         beam_ei_nm2 = 8e9\ndamping_ratio = 0.03\n",
    )
    .unwrap();
    let model = Assembled::new(structure).unwrap();
    let accel: Vec<f64> = el_centro(401).iter().map(|a| 1.43 * a).collect();
    let reference = model.rock(
        GroundAcceleration::horizontal(0.01, &accel),
        &model.upright().unwrap(),
        u64::MAX,
    );
    let first_sliding_landing_s = reference.first_sliding_landing_s.unwrap();
    assert!(first_sliding_landing_s < 3.0, "{first_sliding_landing_s}");
    let of_reference = model.sways(reference.q.iter().map(|q| q.as_slice()));
    let standing = stand(&model).unwrap();
    let error = |compliance_ratio: f64| {
        let springs =
            springs_of_design(&standing, compliance_ratio, landing_speed(&structure), 1.0);
        let start = ElasticStart::Standing;
        let history = ElasticAnalysis::new(&model.frame, &springs.corners, start, 0.01, &accel)
            .simulate()
            .unwrap();
        let sways = model.sways(history.q.iter().map(Vec::as_slice));
        let before = (first_sliding_landing_s / 0.01) as usize;
        [before, accel.len()].map(|samples| sway_errors(&of_reference, &sways, samples))
    };
    let [[soft_before, soft], [stiff_before, stiff]] = [1e-5, 1e-7].map(error);
    for k in 0..2 {
        assert!(stiff_before[k] < 0.2 * soft_before[k], "{stiff_before:?} {soft_before:?}");
        assert!(stiff[k] < soft[k], "{stiff:?} {soft:?}");
    }
    assert!(soft[0] < 2e-3 && soft[1] < 5e-3, "{soft:?}");
    assert!(stiff[0] < 1e-3 && stiff[1] < 2e-3, "{stiff:?}");
}

/// A touch that a long step suspects beyond its end is none of its events: a history on these
/// springs once never got past one.
#[test]
fn histories_on_stiff_springs_get_to_their_end() {
    let model = Assembled::new(portal()).unwrap();
    let standing = stand(&model).unwrap();
    let suite = ElasticSuite::new(model, None, &Effort::unbounded());
    for k in [0.0061, 0.0083] {
        let motions =
            suite.measure(&with_k(&standing, 1e-6, k), Control::search()).motions.unwrap();
        assert!(motions.p90[0] < 0.01 && motions.p90[1] < 0.05, "{k}: {motions:?}");
    }
}
