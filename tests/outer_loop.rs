//! Omega_n by the accuracy asked for: what the springs that are taken hold, and the ceiling.

use groundspring::{
    case::Case,
    structure::Structure,
    tuning::{
        job::{CEILING_HZ, Job},
        whole_model::report::landings,
    },
    validate::PREDICTABLE,
};

/// A structure's case without a record that matters, at an accuracy.
fn tuned(structure: Structure, accuracy: f64) -> Job {
    let mut case = Case { structure, restitution: structure.body::<f64>().restitution(), ..Case::paper().unwrap() };
    case.record = case.record.truncated(5.0);
    case.duration_s = case.record.duration();
    case.tuning.accuracy = accuracy;
    Job::new(&case, &|_, _, _| {}).unwrap()
}

/// What a landing of the whole model errs by, a body not stocky, from any lean down to 0.02 alpha, moves a history of the largest sensitivity that counts as
/// predictable by no more than the accuracy.
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
            let job = tuned(structure, accuracy);
            assert!(job.tuned.reached);
            let rows = landings(&job.body, &job.springs.chains(job.body.mass), job.body.restitution());
            assert_eq!(rows.len(), 8);
            let worst = rows.iter().map(|row| row.restitution_error.abs()).fold(0.0, f64::max);
            println!("{structure:?} at {accuracy}: {:.0} Hz, {worst:.1e}", job.springs.vertical.omega_n_hz);
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
        let hz = tuned(structure, 5e-4).springs.vertical.omega_n_hz;
        println!("{structure:?}: {hz:.0} Hz");
        assert!(hz > CEILING_HZ / 2.0 && hz <= CEILING_HZ, "{hz}");
    }
}
