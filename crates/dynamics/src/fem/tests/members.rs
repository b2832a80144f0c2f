//! Members: the ladder energy -> force -> Newton matrix again.

use num_complex::Complex;

use super::{body, contacts, dense, largest_residual, moved, slopes, springs, state, step};
use crate::fem::{
    model::{Model, N, State},
    newton::Newton,
};
use rocking::{
    members::{Damper, Members, Tendon},
    scalar::GRAVITY,
};

/// Every combination worth testing.
fn all_members() -> Vec<Members> {
    let damper = Some(Damper { c: 3e6 });
    let tendon = Some(Tendon { stiffness: 2e6, pretension: 1e6 });
    vec![
        Members { damper, ..Members::default() },
        Members { tendon, ..Members::default() },
        Members { damper, tendon, friction: None },
    ]
}

fn model(share: f64, members: &Members) -> Model {
    Model::with_members(&body(share), &springs(), members)
}

#[test]
fn forces_at_rest_are_the_slope_of_the_energy() {
    for members in all_members() {
        let model = model(0.1, &members);
        let q = state().q;
        for feet in contacts() {
            let force = model.forces(&q, &[0.0; N], &feet, [0.0; 2]);
            for (j, force) in force.iter().enumerate() {
                let [slope] = slopes(step(j), |t| {
                    [model.energy(&State { q: moved(&q, j, t), v: [0.0; N] }, &feet)]
                });
                let close = 1e-9 * model.body.mass * GRAVITY + 1e-14 * force.abs();
                assert!((force + slope).abs() < close, "{members:?} {feet:?} {j}: {force} {slope}");
            }
        }
    }
}

#[test]
fn power_of_ground_and_dashpots_is_the_power_of_the_forces() {
    let State { q, v } = state();
    let ground = [3.3, -1.7];
    for members in all_members() {
        let model = model(0.1, &members);
        for feet in contacts() {
            let (all, without) =
                (model.forces(&q, &v, &feet, ground), model.forces(&q, &[0.0; N], &feet, [0.0; 2]));
            let power: f64 = (0..N).map(|k| (all[k] - without[k]) * v[k]).sum();
            let booked = model.input_power(&v, ground) - model.dissipation(&q, &v, &feet);
            assert!((power - booked).abs() < 1e-9 * booked.abs(), "{power} {booked}");
        }
    }
}

#[test]
fn newton_solves_with_the_dense_matrix() {
    let right = [1e6, -2e6, 3e7, 4e5, -5e5, 6e5, 7e5].map(|x| Complex::new(x, -0.3 * x + 1e5));
    for members in all_members() {
        for share in [0.0, 0.1] {
            let model = model(share, &members);
            for feet in contacts() {
                for h in [1e-4, 3e-3, 0.05] {
                    let s = Complex::new(0.16 * h, 0.18 * h);
                    let solution = Newton::new(&model, &state(), &feet, s).solve(&right);
                    let matrix = dense(&model, &feet, s);
                    let missed = largest_residual(&matrix, &solution, &right);
                    assert!(missed < 1e-9, "{members:?} {share} {feet:?} {h}: {missed}");
                }
            }
        }
    }
}

#[test]
fn rates_of_compression_are_its_slope_in_time() {
    for members in all_members() {
        let model = model(0.1, &members);
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
