//! The exported decks in OpenSees itself, on El Centro, against our own histories: 20 s, NRMSE of u, v and theta.
//!
//! Runs with OPENSEES=1. The Python deck needs openseespy (`pip install openseespy`; Debian: libblas3 liblapack3) in
//! OPENSEES_PYTHON, `python3` unless set. The Tcl deck needs OPENSEES_TCL to name an interpreter's command, for example
//! "python3 -m opensees" (`pip install opensees`) or "OpenSees".

use groundspring::{
    case::{Case, Objective},
    parameters::Parameters,
    record::Record,
    spring::{Design, Springs},
    structure::Structure,
    tuning::job::Job,
    verify::{Program, verify},
};

/// Largest NRMSE of u, v and theta against our own history.
const AGREEMENT: f64 = 0.005;

fn wanted(variable: &str) -> Option<String> {
    let value = std::env::var(variable).ok().filter(|value| !value.is_empty());
    if value.is_none() {
        println!("skipped: {variable} is not set");
    }
    value
}

/// The interpreters to run the decks in: none, Python's, both.
fn programs() -> Vec<Program> {
    if wanted("OPENSEES").is_none() {
        return Vec::new();
    }
    let python = std::env::var("OPENSEES_PYTHON").unwrap_or_else(|_| "python3".into());
    let tcl =
        wanted("OPENSEES_TCL").map(|command| Program::Tcl(command.split_whitespace().map(str::to_string).collect()));
    [Program::Python(python.into())].into_iter().chain(tcl).collect()
}

/// Table 1 as recovered, its ratios at mu = 10.2: 6.2 and 10 Hz.
fn table_1() -> Springs<Design<f64>> {
    Springs { vertical: Design::from_kc(10.2, 9.214, 4.4, 6.2), horizontal: Design::from_kc(10.2, 9.214, 4.4, 10.0) }
}

/// What `tune run --max-hz` finds for the structure on the embedded record.
fn tuned(structure: Structure, objective: Objective, max_hz: f64) -> Springs<Design<f64>> {
    let mut case = Case::paper().unwrap();
    case.structure = groundspring::export::with_inertia(&structure);
    case.restitution = case.structure.body::<f64>().restitution();
    case.tuning.objective = objective;
    case.tuning.max_omega_hz = max_hz;
    Job::new(&case, &|_, _, _| ()).unwrap().springs
}

fn agrees(programs: &[Program], structure: Structure, springs: Springs<Design<f64>>) {
    let parameters = Parameters::new(structure, &springs);
    for program in programs {
        let result = verify(&parameters, &Record::el_centro().truncated(20.0), program).unwrap();
        let a = result.opensees_against_ours;
        println!("{program:?}: {} steps a sample, {:.1} s: {a:?}", result.steps_per_sample, result.seconds);
        assert_eq!(result.opensees.len(), 2001);
        assert!(a.u <= AGREEMENT && a.v <= AGREEMENT && a.theta <= AGREEMENT, "{a:?}");
        assert!(result.within_one_percent, "{}", result.report);
    }
}

fn tuned_agrees(structure: Structure, objective: Objective, max_hz: f64) {
    let programs = programs();
    if !programs.is_empty() {
        agrees(&programs, structure, tuned(structure, objective, max_hz));
    }
}

#[test]
fn the_paper_frame_on_table_1_springs_agrees() {
    agrees(&programs(), Structure::paper(), table_1());
}

#[test]
fn the_paper_frame_on_its_springs_of_40_hz_agrees() {
    tuned_agrees(Structure::paper(), Objective::Arr, 40.0);
}

#[test]
fn the_paper_frame_on_its_springs_of_160_hz_agrees() {
    tuned_agrees(Structure::paper(), Objective::Arr, 160.0);
}

#[test]
fn the_paper_frame_on_springs_tuned_on_impacts_to_40_hz_agrees() {
    tuned_agrees(Structure::paper(), Objective::Impact, 40.0);
}

#[test]
fn the_paper_frame_on_springs_tuned_on_impacts_to_160_hz_agrees() {
    tuned_agrees(Structure::paper(), Objective::Impact, 160.0);
}
