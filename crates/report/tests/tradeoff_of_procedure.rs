//! The front of springs that the paper's procedure chose.

use cases::Case;
use report::stiffness_tradeoff::front;
use springs::job::Job;

/// Springs of the procedure stand in its column: beside them the design from the geometry errs the
/// less the stiffer it is, at the chosen Omega_n, too, and far less than they do.
#[test]
fn springs_of_the_procedure_are_no_design_from_the_geometry() {
    let text = include_str!("../../../tuning/paper.toml");
    let text = text.replace("objective = \"landing\"", "objective = \"arr\"");
    let case = Case::parse("case.toml", &text).unwrap();
    let job = Job::new(&case, &|_, _, _| {}).unwrap();
    let points = front(&job, &|_, _| {});
    let errors: Vec<f64> = points.iter().map(|point| point.landing.unwrap()).collect();
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    let chosen = points.iter().find(|point| point.chosen).unwrap();
    let measured = job.tuned.best.errors.histories.record.unwrap();
    assert!((chosen.arr.unwrap() / measured - 1.0).abs() < 0.05, "{chosen:?}, {measured}");
    assert!(chosen.landing.unwrap() < 0.1 * measured, "{chosen:?}, {measured}");
}
