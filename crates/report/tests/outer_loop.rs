//! Omega_n by the accuracy asked for: what the springs that are taken hold, and the ceiling.

use cases::Case;
use dynamics::{effort::Effort, fem::Control};
use landing::{
    corners::CornerDynamics,
    design::{Geometry, springs_at_stiffness},
    plane::land,
};
use rocking::structure::Structure;
use springs::{
    job::{CEILING_HZ, Job},
    landing_simulation::report::landings,
    suite::Suites,
};
use validation::PREDICTABLE;

/// A structure's case without a record that matters.
fn case_of(structure: Structure) -> Case {
    let restitution = structure.body::<f64>().restitution();
    let mut case = Case { structure, restitution, ..Case::paper().unwrap() };
    case.record = case.record.truncated(5.0);
    case.duration_s = case.record.duration();
    case
}

/// Its springs at an accuracy, within a cap.
fn tuned(structure: Structure, accuracy: f64, cap: Option<f64>) -> Job {
    let mut case = case_of(structure);
    (case.tuning.accuracy, case.tuning.max_omega_hz) = (accuracy, cap);
    Job::new(&case, &|_, _, _| {}).unwrap()
}

/// What a landing of the whole model errs by, a body not stocky, from any lean down to 0.02 alpha,
/// moves a history of the largest sensitivity that counts as predictable by no more than the
/// accuracy.
#[test]
fn gentle_landings_of_the_springs_taken_are_as_exact_as_was_asked() {
    for structure in [
        Structure::a_frame(35.0, 7.7, 1e5).unwrap(),
        Structure::a_frame(5.0, 1.5, 1e4).unwrap(),
        Structure::a_frame(8.0, 16.0 * f64::tan(0.03), 1e5).unwrap(),
        Structure::block(2.0, 2.0 * f64::tan(0.05), 1e3).unwrap(),
        Structure::block(0.6, 0.6 * f64::tan(0.25), 1e3).unwrap(),
    ] {
        for accuracy in [0.01, 0.002] {
            let job = tuned(structure, accuracy, None);
            assert!(job.tuned.reached);
            let rows =
                landings(&job.body, &job.springs.chains(job.body.mass), job.body.restitution());
            assert_eq!(rows.len(), 8);
            let worst = rows.iter().map(|row| row.restitution_error.abs()).fold(0.0, f64::max);
            println!(
                "{structure:?} at {accuracy}: {:.0} Hz, {worst:.1e}",
                job.springs.vertical.omega_n_hz
            );
            assert!(PREDICTABLE * worst < accuracy, "{rows:?}");
        }
    }
}

/// Small bodies would need stiffer springs for the least accuracy: they get the stiffest allowed.
#[test]
fn no_springs_are_stiffer_than_the_ceiling() {
    for structure in [
        Structure::block(0.3, 0.1, 10.0).unwrap(),
        Structure::block(0.6, 0.2, 100.0).unwrap(),
        Structure::block(0.2, 0.2 * f64::tan(0.05), 1.0).unwrap(),
    ] {
        let hz = tuned(structure, 5e-4, None).springs.vertical.omega_n_hz;
        println!("{structure:?}: {hz:.0} Hz");
        assert!(hz > CEILING_HZ / 2.0 && hz <= CEILING_HZ, "{hz}");
    }
}

/// By peaks no stiffer than by histories of the same error; what was asked for is measured, and so
/// is the other.
#[test]
fn springs_by_peaks_are_no_stiffer_than_those_by_histories_of_the_same_error() {
    for structure in [
        Structure::a_frame(35.0, 7.7, 1e5).unwrap(),
        Structure::block(2.0, 0.4, 1e3).unwrap(),
        Structure::block(0.6, 0.6 * f64::tan(0.25), 1e3).unwrap(),
    ] {
        let mut case = case_of(structure);
        case.tuning.accuracy = 0.02;
        let by_histories = Job::new(&case, &|_, _, _| {}).unwrap();
        case.tuning.peaks = Some(0.02);
        let by_peaks = Job::new(&case, &|_, _, _| {}).unwrap();
        let hz = [&by_peaks, &by_histories].map(|job| job.springs.vertical.omega_n_hz);
        println!("{structure:?}: {hz:?} {:?}", by_peaks.tuned.best.errors);
        assert!(hz[0] <= hz[1] * (1.0 + 1e-9), "{hz:?}");
        let peaks = by_peaks.tuned.best.errors.peaks.largest;
        assert!(
            by_peaks.tuned.reached && peaks.synthetic_median.unwrap().value <= 0.02,
            "{peaks:?}"
        );
        // other motions
        let body = &by_peaks.body;
        let others = Suites::of_seed(2027, body, body.restitution(), None);
        let other = others
            .accuracy(
                &by_peaks.springs.chains(body.mass),
                (Control::search(), &Effort::unbounded()),
            )
            .peaks
            .largest;
        println!("on other motions: {other:?}");
        assert!(other.reaches(0.02), "{other:?}");
    }
}

/// Below 100 p, too, and where a stocky body's horizontal springs are to be much stiffer than the
/// vertical ones.
#[test]
fn no_springs_are_stiffer_than_the_cap() {
    let slender = Structure::block(0.8, 0.09, 35.0).unwrap();
    let stocky = Structure::block(1.6, 1.5, 9e3).unwrap();
    for (structure, cap, reached) in [
        (slender, 10.0, false),
        (slender, 160.0, false),
        (stocky, 160.0, false),
        (stocky, 6e4, true),
    ] {
        let job = tuned(structure, 0.002, Some(cap));
        let hz = [job.springs.vertical, job.springs.horizontal].map(|design| design.omega_n_hz);
        println!("{structure:?} within {cap} Hz: {hz:?}");
        assert!(hz.iter().all(|hz| *hz <= cap * (1.0 + 1e-9)), "{hz:?}");
        assert_eq!(job.tuned.reached, reached);
    }
}

/// A body that keeps 0.3 of its speed lands again soon: that is another landing. And the foot
/// leaves the ground as the landing in the stiff limit says, not as its absorber swings away.
#[test]
fn landings_are_followed_one_at_a_time() {
    for structure in
        [Structure::block(1.6, 1.5, 9e3).unwrap(), Structure::a_frame(17.0, 3.1, 4.2e5).unwrap()]
    {
        let body = structure.body::<f64>();
        let springs = springs_at_stiffness(&body, 4e5).unwrap();
        let geometry = Geometry::of(&body, 4e5).unwrap();
        let limit = land(&CornerDynamics::rigid(geometry.alpha(), geometry.mass_share()), &springs);
        for row in landings(&body, &springs.chains(body.mass), body.restitution()) {
            println!(
                "{structure:?} {}: {:.1e}, {:.4} {:.4}",
                row.lean, row.restitution_error, row.rebound, limit.rebound
            );
            assert!(row.restitution_error.abs() < 2e-4, "{row:?}");
            assert!((row.rebound - limit.rebound).abs() < 0.02, "{row:?}");
        }
    }
}
