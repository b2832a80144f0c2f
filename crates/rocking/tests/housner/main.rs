//! Housner's equation against the float128 reference and the closed forms of the theory.

mod derivatives;
mod edges;
mod el_centro;
mod free_rocking;
mod lanes;
mod reference;
mod restrained;
mod symmetry;
mod vertical;

use rocking::housner::RockingOptions;
use rocking::scalar::Scalar;
use rocking::structure::{Body, Structure};

/// A solid block of 1 kg.
fn block(height: f64, width: f64) -> Body<f64> {
    Structure::block(height, width, 1.0).unwrap().body()
}

/// From rest, the record times a factor.
fn scaled<S: Scalar>(scale: S) -> RockingOptions<S> {
    RockingOptions { scale, ..RockingOptions::default() }
}

/// From rest, the first 20 s.
fn twenty_seconds<S: Scalar>() -> RockingOptions<S> {
    RockingOptions { duration: Some(20.0), ..RockingOptions::default() }
}

/// Four sines that swell for two seconds (g), rounded to 6 digits so that every program reads the
/// same numbers.
fn noise(dt: f64, seconds: f64) -> Vec<f64> {
    let n = (seconds / dt).round() as usize;
    (0..=n)
        .map(|i| {
            let t = i as f64 * dt;
            let sines = 0.25 * (5.1 * t).sin()
                + 0.2 * (11.3 * t + 1.0).sin()
                + 0.15 * (23.7 * t + 2.0).sin()
                + 0.1 * (47.9 * t + 0.5).sin();
            (sines * (t / 2.0).min(1.0) * 1e6).round() / 1e6
        })
        .collect()
}

/// From g to m/s2.
fn in_si(accel: &[f64]) -> Vec<f64> {
    accel.iter().map(|a| a * 9.81).collect()
}
