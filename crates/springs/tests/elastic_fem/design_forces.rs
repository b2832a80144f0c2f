//! Forces to design for are the structure's: finer meshes and other springs leave them as they are.

use std::f64::consts::TAU;

use cases::Asked;
use dynamics::{
    effort::Effort,
    spring::{Chain, Springs},
};
use frames::{
    answer::ElasticAnswer,
    assembled::Assembled,
    design_forces::{ColumnForces, ForceName, StructureForces, stiffer},
    fem::{ElasticAnalysis, ElasticStart, default_control},
    frame::Base,
    structure::{ElasticStructure, PierSpec},
};
use results::MOST_CHANGE;
use rocking::{motion::largest_magnitude, scalar::GRAVITY, synthetic};
use springs::elastic::{design::springs, landing_speed, stand, trial::ElasticTrial, tune_within};
use strong_motion::Record;

use crate::common::{PIER, answer, el_centro, on_rigid_ground, only};

const HEAVY_COLUMN: PierSpec = PierSpec {
    height_m: 14.0,
    width_m: 3.2,
    mass_kg: 450e3,
    footing_mass_kg: 90e3,
    ei_nm2: Some(7.65e9),
    frequency_hz: None,
    damping_ratio: 0.05,
    column_mass_kg: 79e3,
    elements: Some(4),
    ..PIER
};

/// Over 5 s of El Centro, on springs that settle by this share of the structure's own deformation.
fn forces(elements: usize, compliance_ratio: f64) -> StructureForces {
    let structure = ElasticStructure::Pier(PierSpec { elements: Some(elements), ..HEAVY_COLUMN })
        .checked()
        .unwrap();
    let model = Assembled::new(structure).unwrap();
    let record = Record::new("El Centro", 0.01, el_centro(501)).unwrap();
    let springs =
        springs(&stand(&model).unwrap(), compliance_ratio, landing_speed(&structure), 1.0);
    let reference = on_rigid_ground(&model, &record);
    answer(&model, &springs, &record, reference).design
}

#[test]
fn a_pier_s_design_forces_hold_and_stay_with_the_elements_doubled_and_on_softer_springs() {
    let compliance_ratio = 3e-5;
    let four = forces(4, compliance_ratio);
    let cutoff = four.cutoff.as_ref().unwrap();
    assert!(
        cutoff.modes_hz.len() == 3 && cutoff.modes_hz.iter().all(|mode| *mode < cutoff.cutoff_hz)
    );
    // Omega_n^2 goes as 1/compliance_ratio
    for other in [forces(8, compliance_ratio), forces(4, 16.0 * compliance_ratio)] {
        for kind in [ForceName::ColumnShear, ForceName::ColumnBaseMoment, ForceName::Axial] {
            let [a, b] = [&four, &other].map(|forces| *forces.get(kind).unwrap());
            assert!(a.holds && b.holds && a.others.change() < MOST_CHANGE, "{a:?} {b:?}");
            let change = (b.others.found.abs() / a.others.found.abs() - 1.0).abs();
            assert!(change < MOST_CHANGE, "{kind:?}: {change} {a:?} {b:?}");
        }
    }
}

/// A pier that stands in a ground acceleration that grows slowly to a: the shear across an element
/// that leans by (x, z) is what is above it times a z + g x, from the base to the top, and the base
/// has the largest.
#[test]
fn shear_is_sampled_along_the_column_and_is_what_is_above_times_the_acceleration() {
    let model = assembled(PierSpec { column_mass_kg: 300e3, ..HEAVY_COLUMN });
    let a = 0.5 * 3.2 / 28.0 * GRAVITY;
    let record = Record::new(
        "made up",
        0.01,
        (0..4000).map(|i| a * (f64::from(i) / 1500.0).min(1.0)).collect(),
    )
    .unwrap();
    let springs = springs(&stand(&model).unwrap(), 1e-5, landing_speed(&model.structure), 1.0);
    let on_record = ElasticAnalysis::on_record(&model.frame, &springs.corners, &record);
    let history = ElasticAnalysis { parts: 1, ..on_record }.simulate().unwrap();
    let (q, fine) = (history.q.last().unwrap(), history.fine.unwrap());
    let [column] = fine.columns.as_slice() else { panic!("one column") };
    let length = HEAVY_COLUMN.height_m - HEAVY_COLUMN.footing_height_m;
    let eighths = [1.0, 3.0, 5.0, 7.0, 8.0].map(|x| x * length / 8.0);
    assert!(
        column.heights.iter().zip(eighths).all(|(x, y)| (x - y).abs() < 1e-9),
        "{:?}",
        column.heights
    );
    let beams = &model.frame.columns()[0].beams;
    let beams = [beams[0]].into_iter().chain(beams.iter().copied()).chain([beams[3]]);
    let heights = [0.0].into_iter().chain(eighths);
    for ((series, height), beam) in
        [&column.base[0]].into_iter().chain(&column.above).zip(heights.clone()).zip(beams.clone())
    {
        let above = HEAVY_COLUMN.mass_kg + 300e3 * (1.0 - height / length);
        let [x, z] = model.frame.direction(beam, q);
        let expected = above * (a * z + GRAVITY * x.abs());
        let last = series.means.last().unwrap().abs();
        assert!((last / expected - 1.0).abs() < 1e-3, "{height}: {last} {expected}");
    }
    // the weight above, also at heights, where a column that is pulled bears the most; and a top
    // without a moment
    let axials = [&column.base[1]].into_iter().chain(&column.axial_above);
    for ((series, height), beam) in axials.zip(heights).zip(beams) {
        let above = HEAVY_COLUMN.mass_kg + 300e3 * (1.0 - height / length);
        let [x, z] = model.frame.direction(beam, q);
        let expected = above * (a * x.abs() - GRAVITY * z);
        let axial = series.means.last().unwrap();
        assert!((axial / expected - 1.0).abs() < 1e-4, "{height}: {axial} {expected}");
    }
    assert!(column.top_moment.largest.abs() < 1e-6 * column.base[2].largest.abs());
    let peaks = ColumnForces::of(&model.structure);
    assert!(peaks.parts(record.dt) > 1);
    let push = |i: i32| a * (f64::from(i) / 1500.0).min(1.0);
    let shear =
        *through(&model, (0..2000).map(push).collect()).design.get(ForceName::ColumnShear).unwrap();
    assert_eq!(shear.above_base_m, Some(0.0), "{shear:?}");
}

/// Pier of a column without mass, stiff enough that its bending takes no part in a landing.
const STIFF: PierSpec = PierSpec {
    ea_n: Some(AXIAL_STIFFNESS * LENGTH),
    frequency_hz: Some(6.0),
    axial_damping_ratio: Some(0.001),
    ..PIER
};
/// EA/L (N/m), and the length of its column (m).
const AXIAL_STIFFNESS: f64 = 8e9;
const LENGTH: f64 = 10.5;

fn assembled(structure: PierSpec) -> Assembled {
    Assembled::new(ElasticStructure::Pier(structure).checked().unwrap()).unwrap()
}

fn through(model: &Assembled, accel: Vec<f64>) -> ElasticAnswer {
    let record = Record::new("made up", 0.01, accel).unwrap();
    let springs = springs(&stand(model).unwrap(), 1e-5, landing_speed(&model.structure), 1.0);
    let reference = on_rigid_ground(model, &record);
    answer(model, &springs, &record, reference)
}

/// A ground acceleration that grows for 12 s and stays for 3 s: shear m a, moment m (a L + g u)
/// with u = a/omega^2, axial force the weight above. The base lifts where the moments about a
/// corner are in balance, (m h + m_f h_f/2) a = W b: g tan(alpha) of a rigid pier.
#[test]
fn a_slow_push_gives_the_forces_of_statics_and_lifts_where_moments_about_the_corner_say() {
    let model = assembled(STIFF);
    let (m, footing) = (STIFF.mass_kg, STIFF.footing_mass_kg);
    let weight = (m + footing) * GRAVITY;
    let lever = m * STIFF.height_m + footing * 0.5 * STIFF.footing_height_m;
    let push = |level: f64| -> Vec<f64> {
        (0..1500).map(|i| level * (f64::from(i) / 1200.0).min(1.0)).collect()
    };
    let omega = TAU * 6.0;
    // the weight moves over by u
    let lifts = weight * 2.0 / (lever + m * GRAVITY / (omega * omega));
    let below = through(&model, push(0.98 * lifts));
    let above = through(&model, push(1.01 * lifts));
    assert!(
        !below.histories.reference.history.lifts() && above.histories.reference.history.lifts()
    );
    let a = 0.98 * lifts;
    let forces = [
        (ForceName::ColumnShear, m * a),
        (ForceName::ColumnBaseMoment, m * (a * LENGTH + GRAVITY * a / (omega * omega))),
        (ForceName::Axial, -m * GRAVITY),
        (ForceName::SoleShear, (m + footing) * a),
        (ForceName::SoleVertical, weight),
    ];
    for (kind, expected) in forces {
        let force = below.design.get(kind).unwrap();
        let value = force.value.unwrap_or_else(|| panic!("{kind:?} withheld: {force:?}"));
        assert!(
            (value.abs() / expected.abs() - 1.0).abs() < 5e-3,
            "{kind:?}: {value:e}, by hand {expected:e}"
        );
    }
    // what acts with the largest shear; and nothing pulls the column
    let with = below.design.get(ForceName::ColumnShear).unwrap().together.unwrap();
    assert!((with.axial_n / (-m * GRAVITY) - 1.0).abs() < 5e-3, "{with:?}");
    assert!((with.column_base_moment_nm.abs() / forces[1].1 - 1.0).abs() < 5e-3, "{with:?}");
    assert!(below.design.get(ForceName::AxialTension).is_none());
}

/// A footing lands flat and stops; the mass above, which came down at dv = b |theta'|, is stopped
/// by the column: largest axial force W + dv sqrt(k m). The column is soft across, so that it lifts
/// no corner before the axial force is over.
#[test]
fn a_landing_gives_the_column_the_axial_force_of_a_mass_that_is_stopped_by_its_stiffness() {
    let model = assembled(PierSpec { frequency_hz: Some(1.0), ..STIFF });
    let m = STIFF.mass_kg;
    // a push of 1 s that lifts it, and rest
    let pushed = |samples: usize| -> Vec<f64> {
        let push = |i: usize| if i < 100 { 3.0 * (TAU * i as f64 / 200.0).sin() } else { 0.0 };
        (0..samples).map(push).collect()
    };
    let record = Record::new("made up", 0.01, pushed(400)).unwrap();
    let reference = on_rigid_ground(&model, &record);
    let first = reference.history.landings().next().unwrap();
    let [before, after] =
        [0, 1].map(|k| Base::Footing(0).rotation(&model.frame, first.velocity[k].as_slice()).abs());
    assert!(after < 1e-9 * before, "it does not land flat: {before} {after}");
    let expected = m * GRAVITY + 2.0 * before * (AXIAL_STIFFNESS * m).sqrt();
    // a quarter of the axial period, 14 ms, is over by then
    let design = through(&model, pushed((1e2 * first.time) as usize + 6)).design;
    let axial = design.get(ForceName::Axial).unwrap();
    let value = axial.value.unwrap_or_else(|| panic!("withheld: {axial:?}"));
    assert!(
        (-value / expected - 1.0).abs() < 0.03,
        "{value:e}, by hand {expected:e} at {} s",
        axial.time_s
    );
    // the ground bears that and the footing at rest: the impulse that stopped it is not in it
    let sole = design.get(ForceName::SoleVertical).unwrap();
    let found = sole.value.unwrap_or_else(|| panic!("withheld: {sole:?}"));
    let due = value.abs() + STIFF.footing_mass_kg * GRAVITY;
    assert!((found / due - 1.0).abs() < 5e-3, "{found:e}, {due:e}");
    assert!(sole.raw > 5.0 * due && sole.cutoff_hz.is_none(), "{sole:?}");
}

/// Springs chosen by peaks on the suite's own motions hold what was asked for on others, beside
/// springs of 16 times their Omega_n: those are not what they were chosen beside. Median over
/// motions of another seed.
fn hold_forces_on_other_motions(column_mass_kg: f64, elements: Option<usize>) {
    let pier = PierSpec { column_mass_kg, elements, ..HEAVY_COLUMN };
    let structure = ElasticStructure::Pier(pier).checked().unwrap();
    let model = Assembled::new(structure).unwrap();
    let error = 0.02;
    let tuned = tune_within(
        &model,
        only(Asked::new(0.002, Some(error))),
        None,
        &Effort::unbounded(),
        &|_, _| (),
    )
    .unwrap();
    assert!(tuned.reached, "{tuned:?}");
    let forces = ColumnForces::of(&structure);
    let stiff = stiffer(&stiffer(&tuned.springs.corners));
    let body = structure.body();
    let (p, alpha) = (body.p(), body.alpha());
    let trials = (0..8).filter_map(|i| {
        ElasticTrial::shaken(&model, &synthetic::record(77, i, p, alpha), &Effort::unbounded())
            .trial()
    });
    let peaks = |trial: &ElasticTrial, springs: &[Springs<Chain>]| {
        let parts = forces.parts(trial.dt);
        forces.peaks(&trial.follow(&model, springs, default_control(), parts).unwrap())
    };
    let found = trials.map(|trial| {
        peaks(&trial, &tuned.springs.corners)
            .error(&peaks(&trial, &stiff))
            .expect("forces of a pier's column")
    });
    let mut errors: Vec<f64> = found.collect();
    errors.sort_by(f64::total_cmp);
    println!("{:.1} Hz: {errors:?}", tuned.springs.omega_n_hz);
    assert!(errors.len() > 3, "{errors:?}");
    assert!(errors[errors.len() / 2] < error, "{errors:?}");
}

#[test]
fn springs_chosen_by_peaks_hold_forces_on_other_motions() {
    hold_forces_on_other_motions(0.0, None);
}

#[test]
fn springs_chosen_by_peaks_hold_forces_of_a_column_with_mass_on_other_motions() {
    hold_forces_on_other_motions(HEAVY_COLUMN.column_mass_kg, Some(2));
}

/// What ColumnForces takes from a history of a pier fixed to the ground, its column without mass:
/// the moment at the base is the shear times the column's length, less what the top's inertia
/// takes, here none: F = m a acts at the top.
#[test]
fn the_moment_at_a_fixed_base_is_the_shear_times_the_length() {
    let stiff =
        PierSpec { column_mass_kg: 0.0, elements: None, ei_nm2: Some(7.65e13), ..HEAVY_COLUMN };
    let structure = ElasticStructure::Pier(stiff).checked().unwrap();
    let model = Assembled::new(structure).unwrap();
    let frame = model.layout.fixed().frame().unwrap();
    let accel = el_centro(501);
    let forces = ColumnForces::of(&structure);
    let history = ElasticAnalysis {
        parts: forces.parts(0.01),
        forces: false,
        ..ElasticAnalysis::new(&frame, &[], ElasticStart::Standing, 0.01, &accel)
    }
    .simulate()
    .unwrap();
    let [shear, moment, axial] = forces.peaks(&history).0.map(Option::unwrap);
    let length = 14.0 - 1.5;
    println!("{shear} {moment} {axial}");
    // a stiff column: P-Delta is g/(omega^2 L) of it
    let second_order = 9.81 / ((TAU * structure.frequency_hz()).powi(2) * length);
    assert!(
        (moment / (shear * length) - 1.0).abs() < 2.0 * second_order + 1e-6,
        "{moment} {shear} {second_order}"
    );
    // it shakes with the ground: m a_max, amplified a little; and it carries its weight
    let pushed = 450e3 * largest_magnitude(&accel);
    assert!((0.98..1.2).contains(&(shear / pushed)), "{}", shear / pushed);
    assert!((axial / (450e3 * 9.81) - 1.0).abs() < 1e-2, "{axial}");
}

/// The pier of tuning/pier.toml beside an independent program: largest forces by `Pier(m=6e5,
/// h=12., b=2., f=2., zeta=.02, mb=6e4, hb=.75, ka=115.1e9/10.5, za=.02, g=9.80665, chord=10.5)` of
/// reference/flexible_pier.py on 20 s of El Centro in steps of 0.5 ms: shear across the base's axis
/// k u + c u' 1.7032 MN, moment at the base 17.972 MN m, axial force 20.677 MN.
#[test]
fn a_pier_s_design_forces_are_those_of_an_independent_program() {
    let pier = PierSpec {
        frequency_hz: Some(2.0),
        ea_n: Some(115.1e9),
        axial_damping_ratio: Some(0.02),
        ..STIFF
    };
    let answer = through(&assembled(pier), el_centro(2001));
    for (kind, expected) in [
        (ForceName::ColumnShear, 1.7032e6),
        (ForceName::ColumnBaseMoment, 17.972e6),
        (ForceName::Axial, 20.677e6),
    ] {
        let force = answer.design.get(kind).unwrap();
        let value = force.value.unwrap_or_else(|| panic!("{kind:?} withheld: {force:?}"));
        assert!(
            (value.abs() / expected - 1.0).abs() < 0.01,
            "{kind:?}: {value:e}, there {expected:e}"
        );
    }
}
