//! Housner's equation against the float128 reference and the closed forms of the theory.

mod el_centro;
mod free_rocking;

/// The embedded El Centro record [m/s2], dt = 0.01 s.
fn el_centro() -> Vec<f64> {
    include_str!("../../tuning/records/IELC180.AT2")
        .lines()
        .skip(4)
        .flat_map(str::split_whitespace)
        .map(|word| word.parse::<f64>().unwrap() * 9.81)
        .collect()
}
