//! The same case mirrored, shifted in time, in other units, at another scale: the same springs.

use cases::{Case, Objective};
use dynamics::spring::{Design, Springs};
use landing::design::springs_at_stiffness;
use rocking::structure::Structure;
use springs::{job::Job, landing_simulation::report::landings};
use strong_motion::Record;

/// The paper's frame on 10 s of El Centro, begun at rest, few candidates.
fn paper() -> Case {
    let mut case = Case::paper().unwrap();
    case.record = case.record.truncated(10.0);
    case.record.accel[0] = 0.0;
    case.duration_s = case.record.duration();
    case.tuning.max_omega_hz = None;
    case.tuning.candidates = 16;
    case
}

/// Springs of the design from the geometry, and of the paper's procedure up to 160 Hz or the case's
/// cap.
fn tuned(case: &Case) -> [Springs<Design<f64>>; 2] {
    let tune = |case: &Case| Job::new(case, &|_, _, _| {}).unwrap().springs;
    let mut arr = case.clone();
    arr.tuning.objective = Objective::Arr;
    arr.tuning.max_omega_hz = case.tuning.max_omega_hz.or(Some(160.0));
    let mut landing = case.clone();
    landing.tuning.max_omega_hz = None;
    [tune(&landing), tune(&arr)]
}

/// Largest relative difference of mu, f, xi and Omega_n, the frequencies of `other` first
/// multiplied by `time`.
fn difference(one: &Springs<Design<f64>>, other: &Springs<Design<f64>>, time: f64) -> f64 {
    let numbers = |s: &Springs<Design<f64>>, time: f64| {
        [s.vertical, s.horizontal].map(|d| [d.mu, d.f, d.xi, d.omega_n_hz * time])
    };
    let pairs =
        numbers(one, 1.0).into_iter().flatten().zip(numbers(other, time).into_iter().flatten());
    pairs.map(|(a, b)| (b / a - 1.0).abs()).fold(0.0, f64::max)
}

/// Lengths times `length`, times times its root, masses times `mass`.
fn scaled(case: &Case, length: f64, mass: f64) -> Case {
    let (mut case, time, s) = (case.clone(), length.sqrt(), case.structure);
    case.structure = Structure {
        height_m: s.height_m * length,
        width_m: s.width_m * length,
        mass_kg: s.mass_kg * mass,
        rotational_inertia_kgm2: s.rotational_inertia_kgm2 * mass * length * length,
        ..s
    };
    case.restitution = case.structure.body::<f64>().restitution();
    case.record = Record { dt: case.record.dt * time, ..case.record };
    case.duration_s *= time;
    case.tuning.max_omega_hz = case.tuning.max_omega_hz.map(|hz| hz / time);
    case.tuning.max_settlement_m *= length;
    case
}

#[test]
fn a_mirrored_record_gives_the_same_springs() {
    let case = paper();
    let mut mirrored = case.clone();
    mirrored.record.accel.iter_mut().for_each(|a| *a = -*a);
    assert_eq!(tuned(&case), tuned(&mirrored));
}

#[test]
fn quiet_before_the_record_changes_no_springs() {
    let case = paper();
    let mut shifted = case.clone();
    shifted.record.accel = [vec![0.0; 137], case.record.accel.clone()].concat();
    shifted.duration_s = shifted.record.duration();
    assert_eq!(tuned(&case), tuned(&shifted));
}

#[test]
fn a_mass_in_tonnes_or_pounds_gives_the_same_springs() {
    for structure in [paper().structure, Structure::block(2.0, 0.5, 1e3).unwrap()] {
        let case =
            Case { structure, restitution: structure.body::<f64>().restitution(), ..paper() };
        let [landing, arr] = tuned(&case);
        for unit in [1e-3, 1.0 / 0.453_592_37] {
            let other = tuned(&scaled(&case, 1.0, unit));
            let design = |d: &Design<f64>| (d.mu, d.f, d.xi);
            assert_eq!(
                design(&landing.vertical),
                design(&other[0].vertical),
                "masses times {unit}"
            );
            assert_eq!(
                design(&landing.horizontal),
                design(&other[0].horizontal),
                "masses times {unit}"
            );
            assert!(difference(&landing, &other[0], 1.0) < 1e-12, "masses times {unit}");
            let error = difference(&arr, &other[1], 1.0);
            assert!(error < 1e-12, "masses times {unit}: {error:e}");
        }
    }
}

/// Neither the paper's procedure nor the design from the geometry knows a scale; Omega_n of the
/// latter does, for earthquakes have frequencies of their own.
#[test]
fn similar_structures_have_similar_springs_by_the_papers_procedure() {
    for structure in [paper().structure, Structure::block(2.0, 0.5, 1e3).unwrap()] {
        let mut case =
            Case { structure, restitution: structure.body::<f64>().restitution(), ..paper() };
        case.tuning.objective = Objective::Arr;
        case.tuning.max_omega_hz = Some(160.0);
        let tuned = |case: &Case| Job::new(case, &|_, _, _| {}).unwrap().springs;
        let one = tuned(&case);
        for (length, mass) in [(4.0, 64.0), (1.0 / 64.0, 1e-3), (3.280_839_895, 2.0)] {
            let error = difference(&one, &tuned(&scaled(&case, length, mass)), length.sqrt());
            assert!(error < 1e-12, "lengths times {length}: {error:e}");
        }
    }
}

#[test]
fn landings_of_similar_bodies_on_similar_springs_are_similar() {
    let case = paper();
    let [springs, _] = tuned(&case);
    let rows = |case: &Case, springs: &Springs<Design<f64>>| {
        let body = case.structure.body::<f64>();
        landings(&body, &springs.chains(body.mass), case.restitution)
    };
    let ones = rows(&case, &springs);
    for (length, mass) in [(4.0, 64.0), (1.0 / 64.0, 1.0 / 1024.0)] {
        let (mut other, time) = (springs, f64::sqrt(length));
        other.vertical.omega_n_hz /= time;
        other.horizontal.omega_n_hz /= time;
        for (one, row) in ones.iter().zip(rows(&scaled(&case, length, mass), &other)) {
            assert_eq!(one.restitution, row.restitution);
            assert_eq!(one.air_s * time, row.air_s);
        }
    }
}

/// A body of the same slenderness and mass share, at the same Omega_n/p: the same springs to the
/// last digit, whatever its size, its mass, the record and its scale.
#[test]
fn the_design_depends_on_the_geometry_alone() {
    let p = |case: &Case| case.structure.body::<f64>().p();
    let case = paper();
    for stiffness in [3e3, 1e5] {
        let one = springs_at_stiffness(&case.structure.body(), stiffness).unwrap();
        for (length, mass) in [(4.0, 64.0), (1.0 / 64.0, 1e-3), (3.280_839_895, 2.0)] {
            let other = scaled(&case, length, mass);
            let two = springs_at_stiffness(&other.structure.body(), stiffness).unwrap();
            for (a, b) in [(one.vertical, two.vertical), (one.horizontal, two.horizontal)] {
                assert_eq!((a.mu, a.f, a.xi), (b.mu, b.f, b.xi));
                assert!((a.omega_n_hz / p(&case) / (b.omega_n_hz / p(&other)) - 1.0).abs() < 1e-12);
            }
        }
    }
}
