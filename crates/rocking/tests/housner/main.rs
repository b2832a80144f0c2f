//! Housner's equation against the float128 reference and the closed forms of the theory.

mod derivatives;
mod edges;
mod el_centro;
mod free_rocking;
mod lanes;
mod reference;
mod symmetry;
mod vertical;

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
