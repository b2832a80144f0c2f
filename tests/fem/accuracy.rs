//! Histories converge, and do not depend on what should not matter.

use groundspring::{fem::Control, motion::nrmse};

use crate::common::{el_centro, lively, paper, plastic, settled};

#[test]
fn halving_the_tolerance_changes_el_centro_by_less_than_a_thousandth() {
    let (structure, record) = (paper(0.0), el_centro());
    for springs in [plastic(160.0, structure.mass_kg), lively(160.0, structure.mass_kg)] {
        let control = Control::default();
        let half = Control { tolerance: 0.5 * control.tolerance, ..control };
        let (whole, half) =
            (settled(&structure, springs, &record, control), settled(&structure, springs, &record, half));
        let change = nrmse(&half.motion.u, &whole.motion.u);
        assert!(change < 1e-3, "{change}");
    }
}

#[test]
fn the_default_tolerance_is_within_five_ten_thousandths_of_a_converged_history() {
    let (structure, record) = (paper(0.0), el_centro());
    let springs = plastic(160.0, structure.mass_kg);
    let tight = Control { tolerance: 1e-13, ..Control::default() };
    let whole = settled(&structure, springs, &record, Control::default());
    let change = nrmse(&whole.motion.u, &settled(&structure, springs, &record, tight).motion.u);
    assert!(change < 5e-4, "{change}");
}

#[test]
fn halving_a_small_rotational_inertia_changes_nothing_that_matters() {
    let record = el_centro();
    for (share, half) in [(1e-4, 5e-5), (1e-3, 5e-4)] {
        let [whole, half] = [share, half].map(|share| {
            let structure = paper(share);
            settled(&structure, plastic(160.0, structure.mass_kg), &record, Control::default())
        });
        let change = nrmse(&half.motion.u, &whole.motion.u);
        assert!(change < 2e-3, "{share}: {change}");
    }
}
