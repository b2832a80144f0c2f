//! Derivatives through uplifts and impacts against finite differences of the f64 run.

use num_dual::{Dual64, DualNum};
use rocking::housner::{released, solve, solve_with_derivatives};
use rocking::structure::{Body, Structure};
use strong_motion::Record;

use super::{scaled, twenty_seconds};

/// d/dx of a history by central differences of order 4.
fn differences(f: impl Fn(f64) -> Vec<f64>, step: f64) -> Vec<f64> {
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(k * step));
    (0..a.len()).map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * step)).collect()
}

fn relative_error(x: &[f64], reference: &[f64]) -> f64 {
    assert_eq!(x.len(), reference.len());
    rocking::motion::nrmse(x, reference)
}

fn lift(x: f64) -> Dual64 {
    Dual64::from(x)
}

fn wide<S: DualNum<f64> + Copy>(body: Body<f64>, relative: S) -> Body<S> {
    Body {
        mass: S::from(body.mass),
        half_width: (relative + 1.0) * body.half_width,
        height: S::from(body.height),
        inertia: S::from(body.inertia),
    }
}

#[test]
fn theta_by_width_on_el_centro_through_twelve_impacts() {
    let body = Structure::paper().body::<f64>();
    let accel = Record::el_centro().accel;
    let dual = wide(body, Dual64::new(0.0, 1.0));
    let dual = solve_with_derivatives(&dual, 0.01, &accel, &twenty_seconds());
    let options = twenty_seconds();
    let expected = differences(|x| solve(&wide(body, x), 0.01, &accel, &options).theta, 1e-5);
    let exact: Vec<f64> = dual.theta.iter().map(|theta| theta.eps).collect();
    let error = relative_error(&exact, &expected);
    assert!(error < 1e-7, "{error:e}");
    // real parts are those of the f64 run to rounding
    let plain = solve(&body, 0.01, &accel, &options);
    for (dual, plain) in dual.theta.iter().zip(&plain.theta) {
        assert!((dual.re - plain).abs() < 1e-14);
    }
}

#[test]
fn theta_by_scale_on_el_centro_of_a_solid_block() {
    let body = Structure::block(4.0, 1.0, 100.0).unwrap().body::<f64>();
    let accel = &Record::el_centro().accel[..600];
    let run = |scale: f64| solve(&body, 0.01, accel, &scaled(scale));
    let dual_body = Structure::block(4.0, 1.0, 100.0).unwrap().body::<Dual64>();
    let options = scaled(Dual64::new(1.5, 1.0));
    let exact: Vec<f64> = solve_with_derivatives(&dual_body, 0.01, accel, &options)
        .theta
        .iter()
        .map(|theta| theta.eps)
        .collect();
    let expected = differences(|x| run(1.5 + x).theta, 1e-5);
    assert!(run(1.5).impacts.len() > 3);
    let error = relative_error(&exact, &expected);
    assert!(error < 1e-6, "{error:e}");
}

#[test]
fn impact_and_uplift_times_carry_derivatives() {
    let body = Structure::paper().body::<f64>();
    let accel = Record::el_centro().accel;
    let dual = wide(body, Dual64::new(0.0, 1.0));
    let dual = solve_with_derivatives(&dual, 0.01, &accel, &twenty_seconds());
    let run = |x: f64| solve(&wide(body, x), 0.01, &accel, &twenty_seconds());
    let expected = differences(|x| run(x).impacts.iter().map(|impact| impact.time).collect(), 1e-5);
    for (impact, expected) in dual.impacts.iter().zip(&expected) {
        assert!(
            (impact.time.eps - expected).abs() < 1e-5 * (1.0 + expected.abs()),
            "{} {expected}",
            impact.time.eps
        );
    }
    let expected = differences(|x| vec![run(x).uplifts[0].time], 1e-5)[0];
    assert!((dual.uplifts[0].time.eps - expected).abs() < 1e-8 * expected.abs());
}

#[test]
fn a_quarter_period_differentiates_as_its_closed_form() {
    // small angles: t = acosh(1/(1 - phi))/p; dt/dphi = 1/(p (1 - phi) sqrt(1 - (1 - phi)^2))
    let alpha = 1e-4_f64;
    let body = Body {
        mass: lift(1.0),
        half_width: lift(10.0 * alpha),
        height: lift(10.0),
        inertia: lift(0.0),
    };
    let phi = 0.4_f64;
    let theta = Dual64::new(phi, 1.0) * body.alpha().re;
    let options = released(theta, lift(0.0));
    let rocking = solve_with_derivatives(&body, 0.01, &[0.0; 300], &options);
    let p = body.p_squared().re.sqrt();
    let expected = 1.0 / (p * (1.0 - phi) * (1.0 - (1.0 - phi).powi(2)).sqrt());
    assert!((rocking.impacts[0].time.eps / expected - 1.0).abs() < 1e-7);
}
