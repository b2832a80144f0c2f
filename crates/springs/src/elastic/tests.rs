use super::*;
use crate::elastic::suite::ElasticErrors;

fn springs(i: i64, share: f64) -> CornerSprings {
    CornerSprings {
        corners: Vec::new(),
        k: 0.1 * share,
        compliance_ratio: compliance_ratio(i),
        omega_n_hz: 2.0 / compliance_ratio(i).sqrt(),
    }
}

fn hz(i: i64) -> f64 {
    springs(i, 1.0).omega_n_hz
}

/// As if one release had been followed, with this error of both.
fn measured(error: f64) -> Measured {
    let (median, p90) = ([error; 2], [error; 2]);
    let releases = ElasticErrors { median, p90, count: 1, touches: 2.0, peaks: None };
    Measured { releases: Some(releases), ..Measured::default() }
}

#[test]
fn springs_softer_than_any_rung_are_refused_and_others_bound_the_search() {
    let softest = hz(RUNGS.0);
    let refused = ladder(0.002, Some(0.9 * softest), hz).unwrap_err();
    assert!(
        matches!(refused, ElasticTuneError::TooSoft { softest_hz, .. } if softest_hz == softest),
        "{refused}"
    );
    for most in [softest, 1.5 * softest, 1e3 * softest] {
        let rungs = ladder(1e-5, Some(most), hz).unwrap();
        assert!(
            hz(rungs.ends.1) <= most * (1.0 + 1e-12) && hz(rungs.ends.1 + 1) > most,
            "{most} {rungs:?}"
        );
        assert!(rungs.guess <= rungs.ends.1);
    }
    assert_eq!(ladder(0.002, None, hz).unwrap(), Ladder { ends: RUNGS, guess: 37 });
}

/// What a search to 0.002 takes of springs with these errors.
fn searched(errors: &dyn Fn(&CornerSprings) -> Measured) -> ElasticRung {
    let (rungs, asked) = (ladder(0.002, None, hz).unwrap(), Asked::new(0.002, None));
    let tell = |_, _| assert!(!errors(&springs(37, 1.0)).nothing(), "nothing to tell");
    search(rungs, asked, springs, errors, &Effort::unbounded(), &tell)
}

/// Errors of a tenth of the compliance ratio, as good as asked at 0.7 times 0.002.
#[test]
fn the_softest_springs_that_hold_are_taken() {
    let tuned = searched(&|springs| measured(0.1 * springs.compliance_ratio));
    let ratio = tuned.springs.compliance_ratio;
    assert!(tuned.reached && ratio <= 0.014 && ratio > 0.011, "{tuned:?}");
}

/// Those at the balance of K leave a landing too fast, whatever their stiffness.
#[test]
fn springs_with_less_rebound_are_tried_where_the_balanced_ones_do_not_hold() {
    let tuned = searched(&|springs| measured(0.1 * springs.compliance_ratio + 0.02 * springs.k));
    assert!(tuned.reached && tuned.springs.k < 0.05, "{tuned:?}");
}

#[test]
fn springs_that_nothing_could_be_measured_on_have_not_reached_the_accuracy() {
    let tuned = searched(&|_| Measured::default());
    assert!(!tuned.reached && tuned.measured.nothing());
    assert_eq!(tuned.springs, springs(37, 1.0));
}
