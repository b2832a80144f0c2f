//! Histories converge, and do not depend on what should not matter.

use dynamics::fem::Control;
use rocking::{motion::nrmse, structure::Structure};

use crate::common::{chains, el_centro, lively, paper, plastic, settled, settled_with};

#[test]
fn halving_the_tolerance_changes_el_centro_by_less_than_a_thousandth() {
    let (structure, record) = (paper(0.0), el_centro());
    for springs in [plastic(160.0, structure.mass_kg), lively(160.0, structure.mass_kg)] {
        let control = Control::default();
        let half = Control { tolerance: 0.5 * control.tolerance, ..control };
        let (whole, half) = (
            settled_with(&structure, springs, &record, control),
            settled_with(&structure, springs, &record, half),
        );
        let change = nrmse(&half.motion.u, &whole.motion.u);
        assert!(change < 1e-3, "{change}");
    }
}

#[test]
fn the_default_tolerance_is_within_five_ten_thousandths_of_a_converged_history() {
    let (structure, record) = (paper(0.0), el_centro());
    let springs = plastic(160.0, structure.mass_kg);
    let tight = Control { tolerance: 1e-13, ..Control::default() };
    let whole = settled(&structure, springs, &record);
    let change =
        nrmse(&whole.motion.u, &settled_with(&structure, springs, &record, tight).motion.u);
    assert!(change < 5e-4, "{change}");
}

#[test]
fn halving_a_small_rotational_inertia_changes_nothing_that_matters() {
    let record = el_centro();
    for (share, half) in [(1e-4, 5e-5), (1e-3, 5e-4)] {
        let [whole, half] = [share, half].map(|share| {
            let structure = paper(share);
            settled(&structure, plastic(160.0, structure.mass_kg), &record)
        });
        let change = nrmse(&half.motion.u, &whole.motion.u);
        assert!(change < 2e-3, "{share}: {change}");
    }
}

/// The history's error follows the tolerance, against one of 1e-12. On stiff springs under a frame
/// it is small from the start (most steps end at samples). The last bounds are two to ten times
/// what is measured; a block lands on springs that ring, and passes on what its impacts add.
#[test]
fn the_tolerance_controls_the_error_of_the_history() {
    let (frame, block) = (paper(0.0), Structure::block(2.0, 0.5, 1e3).unwrap());
    let (m, record) = (frame.mass_kg, el_centro());
    let stiff = chains((0.66, 0.05, 0.6), (0.3, 1.0, 2.0), 20e3, m);
    let cases = [
        (frame, plastic(160.0, m), 1e-7),
        (frame, plastic(2500.0, m), 1e-7),
        (frame, plastic(20e3, m), 5e-7),
        (frame, stiff, 5e-7),
        (block, plastic(320.0, 1e3), 2e-6),
    ];
    for (structure, springs, last) in cases {
        let at = |tolerance: f64| {
            let control = Control { tolerance, ..Control::default() };
            settled_with(&structure, springs, &record, control).motion.u
        };
        let tight = at(1e-12);
        let errors = [1e-5, 1e-7, 1e-9].map(|tolerance| nrmse(&at(tolerance), &tight));
        assert!(
            errors.windows(2).all(|pair| pair[1] < pair[0]) && errors[2] < errors[0] / 4.0,
            "{errors:?}"
        );
        assert!(errors[0] < 1e-3 && errors[2] < last, "{errors:?}");
    }
}
