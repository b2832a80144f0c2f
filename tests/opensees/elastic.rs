//! Elastic structures in OpenSees, against our own histories and plastic landings.

use super::{program::TestFolder, programs};
use decks::verify::Program;

/// `tune run` of an elastic structure, then `tune verify` in each program, with these options; the
/// folder, with the run in `out` and the last one's in `out/verify`.
fn elastic_agrees(case: &str, more: &str, verify: &str, programs: &[Program]) -> TestFolder {
    let folder = TestFolder::with(&[("case.toml", case)]);
    folder.runs(&format!("run case.toml --quiet --no-figures --no-report {more}"));
    let absolute = |word: &str| match std::fs::canonicalize(word) {
        Ok(_) if word.contains('/') => std::path::absolute(word).unwrap().display().to_string(),
        _ => word.to_string(),
    };
    for program in programs {
        let (option, command) = match program {
            Program::Python(path) => ("--python", absolute(&path.display().to_string())),
            Program::Tcl(words) => {
                ("--tcl", words.iter().map(|word| absolute(word)).collect::<Vec<_>>().join(" "))
            }
        };
        let begin = "verify --quiet --parameters out/parameters.json --out out/verify";
        let ran = folder.runs(&format!("{begin} {verify} {option} '{command}'"));
        let said = ran.stdout + &ran.stderr;
        println!("{program:?}: {said}");
        assert!(said.contains("OpenSees is within 0.002 of our own rotation"), "{said}");
    }
    folder
}

/// A column of a table of a folder.
fn column(folder: &TestFolder, file: &str, name: &str) -> Vec<f64> {
    let text = folder.text(file);
    let mut lines = text.lines();
    let at = lines.next().unwrap().split(',').position(|head| head == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

/// OpenSees' history of a column of two elements with a mass of its own, beside rigid ground with
/// plastic landings: nearer on stiffer springs.
#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn a_column_of_several_elements_in_opensees_converges_to_plastic_landings() {
    let column_of_two = "column_mass_kg = 40e3\nelements = 2\n\n[record]\nduration_s = 5.0\n";
    let case = include_str!("../../tuning/pier.toml");
    let (structure, _) = case.split_once("[record]").unwrap();
    let case = format!("{}\n{column_of_two}", structure.trim_end());
    let errors = ["250", "1000"].map(|hz| {
        let folder = elastic_agrees(
            &case,
            &format!("--max-hz {hz} --accuracy 1e-5"),
            "--duration 4.5",
            &programs()[..1],
        );
        let error = |name: &str| {
            let rigid_ground = column(&folder, "out/history.csv", &format!("{name}_reference"));
            let opensees = column(&folder, "out/verify/verify.csv", &format!("{name}_opensees_1"));
            let squares = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>();
            let missed = squares(&mut rigid_ground.iter().zip(&opensees).map(|(a, b)| b - a));
            (missed / squares(&mut rigid_ground[..opensees.len()].iter().copied())).sqrt()
        };
        let errors = [error("theta"), error("drift")];
        println!("OpenSees from plastic landings, at most {hz} Hz: {errors:?}");
        errors
    });
    let [[theta, drift], [stiff_theta, stiff_drift]] = errors;
    assert!(stiff_theta < 0.003 && stiff_drift < 0.01, "{errors:?}");
    // errors go as the compliance, 1/16, or slower where OpenSees' own steps show
    assert!(stiff_theta < 0.4 * theta && stiff_drift < 0.4 * drift, "{errors:?}");
}

const ELASTIC_FRAME: &str = "\
[structure]
kind = 'aframe'
height_m = 61.0
width_m = 12.2
mass_kg = 680.1e3
foot_mass_kg = 5e3
ea_n = 6.7e10
ei_nm2 = 1.0e11
damping_ratio = 0.02
";

#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn elastic_structures_agree() {
    let python = &programs()[..1];
    let run = "--work 0.05 --no-front";
    elastic_agrees(include_str!("../../tuning/pier.toml"), run, "--duration 5", python);
    elastic_agrees(ELASTIC_FRAME, run, "--duration 6", python);
}

/// What decks of two languages are to show needs neither the best springs nor more than a few
/// landings: three of the frame, five of the pier.
const SHORT: &str = "--duration 5 --work 0.05 --no-front";

/// The Tcl interpreter that pip installs has no damping objects: without damping it must find what
/// Python finds. In steps as long as the limit of `tune verify` allows.
#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn an_undamped_elastic_structure_agrees_in_every_language() {
    let undamped = ELASTIC_FRAME.replace("damping_ratio = 0.02", "damping_ratio = 0.0");
    let run = format!("{SHORT} --max-hz 400");
    elastic_agrees(&undamped, &run, "--duration 4.1 --accuracy 0.008", &programs());
}

/// Rocking piers of El Centro's first seconds, damped at their corners and tied down.
#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn an_elastic_structure_with_dampers_and_a_tendon_agrees_in_every_language() {
    let pier = include_str!("../../tuning/pier.toml")
        .replace("damping_ratio = 0.02", "damping_ratio = 0.0");
    let members =
        "[damper]\nc_ns_per_m = 1e6\n[tendon]\nstiffness_n_per_m = 2e7\npretension_n = 1e6\n";
    let verify = "--duration 4.5 --accuracy 0.008";
    elastic_agrees(&format!("{pier}\n{members}"), SHORT, verify, &programs());
}
