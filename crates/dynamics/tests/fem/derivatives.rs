//! Derivatives by dual numbers pass through the integrator and its events.

use dynamics::{
    fem::{Analysis, Control, Start, View},
    spring::{Design, Springs},
};
use nalgebra::SVector;
use num_dual::DualSVec64;
use rocking::{
    scalar::{Scalar, real},
    structure::{Body, Structure},
};
use std::ops::ControlFlow;

/// mu, K, C, Hz of the vertical, then of the horizontal chain: stiff enough to land fast, soft
/// enough to be felt.
const DESIGN: [f64; 8] = [0.3, 0.1, 0.75, 30.0, 0.3, 0.57, 1.86, 30.0];

/// Horizontal displacement after free rocking on springs of these parameters.
fn end<S: Scalar>(parameters: [S; 8], share: f64, duration: f64, control: Control) -> S {
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 =
        share * structure.mass_kg * structure.body::<f64>().radius().powi(2);
    let body: Body<S> = structure.body();
    let [mu, k, c, hz, mu_h, k_h, c_h, hz_h] = parameters;
    let springs = Springs {
        vertical: Design::from_kc(mu, k, c, hz),
        horizontal: Design::from_kc(mu_h, k_h, c_h, hz_h),
    };
    let accel = vec![0.0; 201];
    let dt = duration / 200.0;
    let mut last = S::zero();
    let mut observer = |_: usize, view: &View<S>| {
        last = view.x();
        ControlFlow::Continue(())
    };
    let start = Start::Leaning(real(0.04));
    let case = Analysis {
        body,
        springs: springs.chains(body.mass),
        start,
        dt,
        accel: &accel,
        vertical: &[],
        scale: S::one(),
        control,
    };
    case.observe(&mut observer);
    last
}

fn assert_derivatives(share: f64, duration: f64) {
    let control = Control { tolerance: 1e-13, extra_iterations: 2, ..Control::default() };
    let duals = std::array::from_fn(|i| {
        let mut unit = SVector::<f64, 8>::zeros();
        unit[i] = 1.0;
        DualSVec64::<8>::new(DESIGN[i], num_dual::Derivative::some(unit))
    });
    let dual = end(duals, share, duration, control);
    let gradient = dual.eps.unwrap_generic(nalgebra::Const::<8>, nalgebra::U1);
    let scale = (0..8).map(|i| (gradient[i] * DESIGN[i]).abs()).fold(0.0, f64::max);
    assert!(scale > 1e-4, "the springs are felt: {gradient:?}");
    for i in 0..8 {
        let at = |factor: f64| {
            let mut parameters = DESIGN;
            parameters[i] *= 1.0 + factor;
            end(parameters, share, duration, control)
        };
        // fourth order, so that the difference's own error does not show
        let e = 2e-4;
        let slope = (8.0 * (at(e) - at(-e)) - (at(2.0 * e) - at(-2.0 * e))) / (12.0 * e);
        let exact = gradient[i] * DESIGN[i];
        assert!(
            (slope - exact).abs() < 1e-5 * scale,
            "I_cg {share}, parameter {i}: {slope} {exact} of {scale}"
        );
    }
}

#[test]
fn derivatives_pass_a_single_landing() {
    // Housner's quarter period from 0.4 alpha is 1.0/p^0.5: 2.6 s
    assert_derivatives(0.0, 3.2);
    assert_derivatives(0.1, 3.2);
}

#[test]
fn derivatives_pass_two_impacts() {
    assert_derivatives(0.0, 8.0);
    assert_derivatives(0.1, 8.0);
}
