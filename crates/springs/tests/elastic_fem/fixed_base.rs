//! Frames whose footings are held: closed forms of structural dynamics.

use std::f64::consts::TAU;

use frames::{
    Mechanics,
    fem::{ElasticAnalysis, ElasticStart},
};
use rocking::{motion::peak, scalar::GRAVITY};

use crate::common::{MODERATE, el_centro, nrmse, pier};

/// u = u0 exp(-zeta w t) (cos w_d t + zeta w/w_d sin w_d t), w^2 = (3EI/L^3 - m g/L)/m: 2 Hz by
/// construction.
#[test]
fn a_pier_let_go_vibrates_as_one_degree_of_freedom_does() {
    let frame = pier(&MODERATE).layout().fixed().frame().unwrap();
    let rest = frame.standing(&[]).unwrap();
    let hz = frame.frequencies(&rest)[0];
    assert!((hz / 2.0 - 1.0).abs() < 2e-3, "{hz}");
    let mut q = rest.as_slice().to_vec();
    let u0 = 1e-4;
    q[frame.coordinates(1)[0].unwrap()] += u0;
    let start = ElasticStart::State { q, v: vec![0.0; frame.size()], feet: Vec::new() };
    let history = ElasticAnalysis::new(&frame, &[], start, 0.01, &[0.0; 301]).simulate().unwrap();
    let (w, zeta) = (TAU * hz, 0.02 * 2.0 / hz);
    let damped = w * (1.0 - zeta * zeta).sqrt();
    let exact = |t: f64| {
        u0 * (-zeta * w * t).exp() * ((damped * t).cos() + zeta * w / damped * (damped * t).sin())
    };
    let expected: Vec<f64> = (0..301).map(|i| exact(f64::from(i) * 0.01)).collect();
    let u: Vec<f64> = history.q.iter().map(|q| q[frame.coordinates(1)[0].unwrap()]).collect();
    assert!(nrmse(&u, &expected) < 1e-3, "{}", nrmse(&u, &expected));
    assert!(history.energy_residual < 1e-6);
}

/// Base shear is the mass times its whole acceleration, averaged between samples; the base's moment
/// is that times the height, and the weight's.
#[test]
fn what_the_base_bears_is_what_the_mass_needs() {
    let accel = el_centro(801);
    let frame = pier(&MODERATE).layout().fixed().frame().unwrap();
    let history =
        ElasticAnalysis::new(&frame, &[], ElasticStart::Standing, 0.01, &accel).simulate().unwrap();
    let x = frame.coordinates(1)[0].unwrap();
    let shear: Vec<f64> = history.demands.iter().map(|demand| demand.base_shear).collect();
    let mut needed = vec![shear[0]];
    let mut borne = vec![shear[0]];
    for i in 1..accel.len() {
        let whole =
            (history.v[i][x] - history.v[i - 1][x]) / 0.01 + 0.5 * (accel[i] + accel[i - 1]);
        needed.push(MODERATE.mass * whole);
        borne.push(0.5 * (shear[i] + shear[i - 1]));
    }
    assert!(nrmse(&borne, &needed) < 1e-2, "{}", nrmse(&borne, &needed));
    let length = 10.5;
    for (demand, q) in history.demands.iter().zip(&history.q) {
        // the clamped end's moment carries the force on the hinged one about it
        let direction = frame.direction(0, q);
        let bearing = demand.bearings[0];
        assert!(
            bearing.moments[1] == 0.0
                && (bearing.moments[0] - bearing.shear * length).abs() < 1e-3 * 6e7
        );
        assert!((direction[0].hypot(direction[1]) - 1.0).abs() < 1e-12);
    }
    // a mass of 600 t at 2 Hz, 2 %, El Centro: some 0.7 g to 1 g
    let most = peak(&shear).abs() / (MODERATE.mass * GRAVITY);
    assert!((0.5..1.2).contains(&most), "{most}");
}
