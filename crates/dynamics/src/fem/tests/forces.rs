//! The ladder energy -> force -> Newton matrix, each rung the derivative of the one below, without
//! members and with them.

use num_complex::Complex;
use rocking::members::Members;

use super::{body, contacts, dense, largest_residual, models, moved, slopes, springs, state, step};
use crate::fem::{
    model::{Foot, Model, N, State, Vector},
    newton::Newton,
};

#[test]
fn forces_at_rest_are_the_slope_of_the_energy_in_every_contact() {
    for (members, model) in models(&[0.0, 0.1]) {
        let q = state().q;
        let weight = model.body.mass * 9.81;
        for feet in contacts() {
            let force = model.forces(&q, &[0.0; N], &feet, [0.0; 2]);
            for (j, force) in force.iter().enumerate() {
                let [slope] = slopes(step(j), |t| {
                    [model.energy(&State { q: moved(&q, j, t), v: [0.0; N] }, &feet)]
                });
                // forces of some 1e2 weights, the moment with an arm of 60 m; and rounding
                let close = 1e-9 * weight + 1e-14 * force.abs();
                assert!((force + slope).abs() < close, "{members:?} {feet:?} {j}: {force} {slope}");
            }
        }
    }
}

#[test]
fn power_of_ground_and_dashpots_is_the_power_of_the_forces() {
    let State { q, v } = state();
    let ground = [3.3, -1.7];
    for (_, model) in models(&[0.1]) {
        for feet in contacts() {
            let (all, without) =
                (model.forces(&q, &v, &feet, ground), model.forces(&q, &[0.0; N], &feet, [0.0; 2]));
            let power: f64 = (0..N).map(|k| (all[k] - without[k]) * v[k]).sum();
            let booked = model.input_power(&v, ground) - model.dissipation(&q, &v, &feet);
            assert!((power - booked).abs() < 1e-9 * booked.abs(), "{power} {booked}");
        }
    }
}

const RIGHT_SIDE: Vector = [1e6, -2e6, 3e7, 4e5, -5e5, 6e5, 7e5];

#[test]
fn newton_solves_with_the_dense_matrix_for_a_real_eigenvalue() {
    for share in [0.0, 0.1] {
        let model = Model::new(&body(share), &springs());
        for feet in contacts() {
            for s in [1e-4, 3e-3, 0.05] {
                let solution = Newton::new(&model, &state(), &feet, s).solve(&RIGHT_SIDE);
                let missed = largest_residual(&dense(&model, &feet, s), &solution, &RIGHT_SIDE);
                assert!(missed < 1e-11, "{feet:?} {s}: {missed}");
            }
        }
    }
}

/// What Newton's solution leaves of the dense matrix for a complex eigenvalue of a step h (s).
pub(super) fn complex_residual(model: &Model, feet: &[Foot; 2], h: f64) -> f64 {
    let right = RIGHT_SIDE.map(|x| Complex::new(x, -0.3 * x + 1e5));
    let s = Complex::new(0.16 * h, 0.18 * h);
    let solution = Newton::new(model, &state(), feet, s).solve(&right);
    largest_residual(&dense(model, feet, s), &solution, &right)
}

#[test]
fn newton_solves_with_the_dense_matrix_for_a_complex_eigenvalue() {
    for (members, model) in models(&[0.0, 0.1]) {
        let most = if members == Members::default() { 1e-11 } else { 1e-9 };
        for feet in contacts() {
            for h in [1e-4, 3e-3, 0.05] {
                let missed = complex_residual(&model, &feet, h);
                assert!(missed < most, "{members:?} {feet:?} {h}: {missed}");
            }
        }
    }
}

#[test]
fn rates_of_compression_are_its_slope_in_time() {
    for (_, model) in models(&[0.1]) {
        let State { q, v } = state();
        for feet in contacts() {
            for i in 0..2 {
                let [slope] = slopes(2e-3, |t| {
                    [model.compression(i, &std::array::from_fn(|k| q[k] + t * v[k]))]
                });
                let rate = model.compression_rate(i, &State { q, v });
                assert!(
                    (rate - slope).abs() < 1e-9 * slope.abs().max(0.1),
                    "{feet:?} {i}: {rate} {slope}"
                );
            }
        }
    }
}

#[test]
fn a_massless_rotation_turns_to_where_no_moment_acts() {
    let model = Model::new(&body(0.0), &springs());
    for feet in contacts().into_iter().filter(|f| f[0].closed() || f[1].closed()) {
        let (mut settled, _) = model.settled();
        settled.q[0] += 1e-4;
        assert!(model.turn_to_balance(&mut settled, &feet));
        let moment = model.forces(&settled.q, &[0.0; N], &feet, [0.0; 2])[2];
        let scale = model.body.mass * 9.81 * model.body.half_width;
        assert!(moment.abs() < 1e-9 * scale, "{feet:?} {moment}");
    }
}
