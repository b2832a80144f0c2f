//! What happens around OpenSees, with stand-ins for Python: the runs with OpenSees itself are in
//! tests/opensees.

use std::path::PathBuf;

use super::*;
use crate::ACCURACY;
use dynamics::spring::{Design, Springs};
use parameters::predictability::width_sensitivity;
use rocking::{members::Members, structure::Structure};

fn parameters() -> Parameters {
    let chain = Design::from_kc(0.5, 0.2, 0.92, 40.0);
    Parameters::new(Structure::paper(), &Springs { vertical: chain, horizontal: chain })
}

fn half_a_second() -> Record {
    Record::el_centro().truncated(0.5)
}

/// Verify half a second of El Centro with a shell script in the place of Python; $1 is the deck.
#[cfg(unix)]
fn with_stand_in(script: &str) -> Result<Verification, VerifyError> {
    let folder = tempfile::tempdir().unwrap();
    let python = stand_in(folder.path(), script);
    verify(&parameters(), &half_a_second(), (ACCURACY, None), &Program::Python(python), &|_, _| ())
}

#[cfg(unix)]
fn stand_in(folder: &Path, script: &str) -> PathBuf {
    use std::os::unix::fs::PermissionsExt;
    let path = folder.join("python");
    // written beside and moved: a file open for writing cannot be started
    let part = folder.join("python.part");
    fs::write(&part, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&part, fs::Permissions::from_mode(0o755)).unwrap();
    fs::rename(&part, &path).unwrap();
    path
}

#[test]
fn a_python_that_is_not_there_is_named_in_one_line() {
    for program in
        [Program::Python("/nowhere/python3".into()), Program::Tcl(vec!["/nowhere/python3".into()])]
    {
        let error = verify(&parameters(), &half_a_second(), (ACCURACY, None), &program, &|_, _| ())
            .unwrap_err();
        let said = error.to_string();
        assert!(matches!(error, VerifyError::NoProgram { .. }));
        assert!(said.contains("/nowhere/python3") && !said.contains('\n'), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn without_openseespy_one_line_says_how_to_install_it() {
    let error = with_stand_in("exit 3").unwrap_err();
    let said = error.to_string();
    assert!(matches!(error, VerifyError::NoOpenSees { .. }));
    assert!(
        said.contains("pip install openseespy") && said.contains("libblas3 liblapack3"),
        "{said}"
    );
    assert!(!said.contains('\n'), "{said}");
}

#[cfg(unix)]
#[test]
fn without_the_package_opensees_one_line_says_how_to_install_it() {
    let folder = tempfile::tempdir().unwrap();
    let python = stand_in(folder.path(), "echo 'python3: No module named opensees' >&2; exit 1");
    let program = Program::Tcl(vec![python.display().to_string(), "-m".into(), "opensees".into()]);
    let said = verify(&parameters(), &half_a_second(), (ACCURACY, None), &program, &|_, _| ())
        .unwrap_err()
        .to_string();
    assert!(said.contains("pip install opensees") && !said.contains('\n'), "{said}");
}

#[cfg(unix)]
#[test]
fn an_analysis_that_stops_gives_its_last_words() {
    let error = with_stand_in(
        "echo first >&2; echo 'no convergence at 1.5 s' >&2; echo Process 0 Terminating >&2; exit \
            2",
    );
    let said = error.unwrap_err().to_string();
    assert!(
        said.contains("no convergence at 1.5 s") && !said.contains("first") && !said.contains('\n'),
        "{said}"
    );
}

#[cfg(unix)]
#[test]
fn an_interpreter_that_ends_without_a_word_is_told_to_be_none() {
    let said = with_stand_in("exit 1").unwrap_err().to_string();
    assert!(said.contains("ended with code 1 without a word"), "{said}");
    assert!(said.contains("--python") && !said.contains("--duration"), "{said}");
}

#[cfg(unix)]
#[test]
fn a_deck_that_writes_no_history_is_an_error() {
    let error = with_stand_in("echo 'within 1 %: yes'").unwrap_err();
    assert!(matches!(error, VerifyError::History { .. }), "{error}");
}

#[cfg(unix)]
#[test]
fn a_cut_history_is_an_error() {
    let script = r#"printf 't,u,v,th\n0,0,0,0\n0.01,1e-3,0,0\n' > "${1%.py}_history.csv"; echo 'within 1 %: no'; exit 1"#;
    let said = with_stand_in(script).unwrap_err().to_string();
    assert!(said.contains("2 samples instead of 51"), "{said}");
}

/// The stand-in answers with zeros: the error of zero against any motion is 1, and 1 means nothing
/// was right.
#[cfg(unix)]
#[test]
fn a_body_that_never_moves_is_all_wrong() {
    let script = r#"(echo t,u,v,th; i=0; while [ $i -lt 51 ]; do echo 0,0,0,0; i=$((i+1)); done) > "${1%.py}_history.csv"
echo 'within 1 %: no'; exit 1"#;
    let result = with_stand_in(script).unwrap();
    assert_eq!(result.opensees_against_ours, Agreement { u: 1.0, v: 1.0, theta: 1.0 });
    assert!(!result.within_one_percent);
}

#[cfg(unix)]
#[test]
fn a_run_that_hangs_is_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let python = stand_in(folder.path(), "exec sleep 60");
    let began = Instant::now();
    let error = Program::Python(python)
        .run(&folder.path().join("deck.py"), Duration::from_millis(100), &|_| ())
        .err()
        .unwrap();
    assert!(matches!(error, VerifyError::Hung { .. }));
    assert!(began.elapsed() < Duration::from_secs(30));
}

/// Springs of 160 Hz under a 5 m frame: El Centro makes it rock in a way that hangs on the eighth
/// digit of its width.
#[test]
fn a_slight_change_of_width_moves_some_histories_and_not_others() {
    let chain = Design::from_kc(1.0, 0.74, 2.05, 107.0);
    let soft = Design { omega_n_hz: 21.7, ..chain };
    let springs = Springs { vertical: chain, horizontal: soft };
    let record = Record::el_centro().truncated(10.0);
    let width_sensitivity =
        |p: &Parameters| width_sensitivity(&simulate(p, &record).motion, p, &record);
    let frame = Parameters::new(
        with_inertia(&Structure::a_frame(5.0, 1.5, 1000.0).unwrap(), &Members::default()),
        &springs,
    );
    assert!(width_sensitivity(&frame) > 0.01, "{}", width_sensitivity(&frame));
    let paper = width_sensitivity(&parameters());
    assert!(paper > 1e-6 && paper < 5e-4, "{paper}");
}
