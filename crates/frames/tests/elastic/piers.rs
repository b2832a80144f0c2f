//! Piers that the stories share.

use frames::{
    Mechanics, Pier,
    reference::{ElasticRocking, GroundAcceleration, ReferenceOptions, rock},
};
use nalgebra::DVector;

/// For references: errors of a step at 1e-11.
pub fn tight() -> ReferenceOptions {
    ReferenceOptions { rtol: 1e-11, ..ReferenceOptions::default() }
}

/// Ground at rest.
pub fn ground_at_rest(dt: f64) -> GroundAcceleration<'static> {
    GroundAcceleration::horizontal(dt, &[])
}

/// The pier of theory.md: 600 t at 12 m, 4 m wide, 2 Hz, on a footing of 120 t.
pub fn light() -> Pier {
    Pier::new([6e5, 12.0, 2.0], [2.0, 0.02], [1.2e5, 0.75])
}

/// 200 t on a footing of 600 t.
pub fn heavy() -> Pier {
    Pier::new([2e5, 12.0, 2.0], [2.0, 0.02], [6e5, 4.0])
}

/// Let go at a lean (rad) and followed for some seconds at dt = 0.01 s.
pub fn free_rocking(
    pier: &Pier,
    theta: f64,
    seconds: f64,
    options: &ReferenceOptions,
) -> ElasticRocking {
    let (q, v) = (pier.leaning(theta), DVector::zeros(pier.size()));
    rock(
        pier,
        ground_at_rest(0.01),
        (&q, &v),
        &ReferenceOptions { duration: Some(seconds), ..*options },
    )
}

/// From rest through a record at dt = 0.01 s.
pub fn shaken(
    pier: &Pier,
    accel: &[f64],
    seconds: f64,
    options: &ReferenceOptions,
) -> ElasticRocking {
    let (q, v) = (pier.leaning(0.0), DVector::zeros(pier.size()));
    rock(
        pier,
        GroundAcceleration::horizontal(0.01, accel),
        (&q, &v),
        &ReferenceOptions { duration: Some(seconds), ..*options },
    )
}
