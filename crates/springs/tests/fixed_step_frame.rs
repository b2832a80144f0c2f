//! A portal frame in a program with fixed time steps, on horizontal springs of two stiffnesses.

use fixed_steps::{
    FixedStepAnalysis, FixedStepFrame, FixedStepOutcome, FixedStepProgram, ProgramName,
};
use frames::{
    assembled::Assembled,
    structure::{ElasticStructure, PortalSpec},
};
use springs::elastic::{program::ElasticFixedStepDesign, stand};
use strong_motion::Record;

const STEP: f64 = 1e-3;

/// 12 m tall, columns 10 m apart, 580 t on two footings 3 m wide.
fn frame() -> Assembled {
    let portal = PortalSpec {
        height_m: 12.0,
        span_m: 10.0,
        footing_width_m: 3.0,
        footing_height_m: 1.5,
        footing_mass_kg: 40e3,
        beam_mass_kg: 500e3,
        column_ea_n: 3.4e10,
        column_ei_nm2: 3e9,
        column_ga_n: None,
        beam_ea_n: 4e10,
        beam_ei_nm2: 1e10,
        damping_ratio: 0.02,
        column_mass_kg: 0.0,
        elements: None,
    };
    Assembled::new(ElasticStructure::Frame(portal).checked().unwrap()).unwrap()
}

/// 5 s of El Centro by Hilber, Hughes and Taylor's method, as SAP2000 is to be set.
fn ends(design: ElasticFixedStepDesign) -> FixedStepOutcome {
    let model = frame();
    let standing = stand(&model).unwrap();
    let springs = design.springs(&standing, STEP, &model.structure.body());
    let program = FixedStepProgram::of(ProgramName::Sap2000, STEP);
    let settings = program.settings(standing.mass * standing.uplift().unwrap());
    let frame = FixedStepFrame::new(&model.frame, &springs.corners).unwrap();
    let record = Record::el_centro().truncated(5.0);
    FixedStepAnalysis::new(&frame, settings, record.dt, &record.accel).history().unwrap().outcome
}

/// A footing that lands and stops across at once turns: on stiff horizontal springs a corner that
/// presses lifts within the step, and one that is open presses.
#[test]
fn stiff_horizontal_springs_leave_a_step_without_an_end() {
    let recipe = ElasticFixedStepDesign::RECIPE;
    assert_eq!(ends(recipe), FixedStepOutcome::Finished);
    let stiff =
        ElasticFixedStepDesign { horizontal_stance: 16.0 * recipe.horizontal_stance, ..recipe };
    let stuck = ends(stiff);
    assert!(matches!(stuck, FixedStepOutcome::GaveUp(_)), "{stuck:?}");
}

/// A stiffer stance is stuck by its horizontal springs alone.
#[test]
fn a_stiff_stance_on_soft_horizontal_springs_has_an_end_for_every_step() {
    let recipe = ElasticFixedStepDesign::RECIPE;
    let stiffer = ElasticFixedStepDesign { stance: 16.0 * recipe.stance, ..recipe };
    let stuck =
        ElasticFixedStepDesign { horizontal_stance: 16.0 * recipe.horizontal_stance, ..stiffer };
    assert!(matches!(ends(stuck), FixedStepOutcome::GaveUp(_)));
    let soft = ElasticFixedStepDesign { horizontal_stance: recipe.stance, ..stiffer };
    assert_eq!(ends(soft), FixedStepOutcome::Finished);
}

/// Horizontal units land as before whatever their stiffness: all four poles of the mass that lands
/// on them are one, (s + w)^4 with w^2 = k1/m, m = 4 m2.
#[test]
fn horizontal_units_of_any_stiffness_stop_what_lands_by_four_equal_poles() {
    let model = frame();
    let standing = stand(&model).unwrap();
    let body = model.structure.body();
    for horizontal_over_vertical in [64.0, 4.0, 1.0] {
        let recipe = ElasticFixedStepDesign::RECIPE;
        let horizontal_stance = horizontal_over_vertical * recipe.stance;
        let design = ElasticFixedStepDesign { horizontal_stance, ..recipe };
        for corner in design.springs(&standing, STEP, &body).corners {
            let (unit, m) = (corner.horizontal, 4.0 * corner.horizontal.m2);
            let close = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-9;
            assert!(close(unit.k1, horizontal_over_vertical * corner.vertical.k1), "{unit:?}");
            assert!(close(unit.k2, 0.25 * unit.k1), "{unit:?}");
            assert!(close(unit.c, (unit.k1 * m).sqrt()), "{unit:?}");
            // in series the vertical springs are what the stance asks for, whatever K
            let e = 12.0 * standing.mass / 2.0 * body.p() / (body.alpha().powi(2) * STEP);
            assert!(close(corner.vertical.in_series(), e), "{e}");
        }
    }
}
