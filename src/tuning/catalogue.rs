//! Springs found before, without units: where the search for others begins.
//!
//! What a landing asks of springs depends, beside the body's proportions, on Omega_n/p alone (the landing velocity over
//! g/Omega_n), and on that slowly. So the springs of one structure are a good start for any other of like Omega_n/p.

use crate::spring::{Design, Springs};

/// Omega_n/p; K, C, mu of the vertical chain; Omega_n of the horizontal over that of the vertical chain, its K, C, mu.
const FOUND: [[f64; 8]; 10] = [
    [209.0, 0.343, 0.721, 1.227, 1.0, 0.283, 0.202, 0.045],
    [376.0, 0.388, 0.694, 1.128, 0.77, 0.428, 0.114, 0.047],
    [628.0, 0.700, 1.178, 0.965, 0.91, 0.024, 0.154, 0.013],
    [723.0, 0.377, 0.691, 1.261, 1.0, 0.230, 0.064, 0.250],
    [1256.0, 0.430, 1.074, 1.019, 1.0, 0.027, 0.086, 0.0066],
    [1440.0, 0.402, 0.929, 0.794, 1.0, 24.1, 0.877, 0.027],
    [2513.0, 0.351, 0.865, 1.426, 0.433, 0.117, 0.0325, 0.0225],
    [5027.0, 0.190, 0.870, 1.0, 0.45, 0.1, 0.04, 0.025],
    [10053.0, 0.136, 0.849, 0.587, 0.92, 0.021, 0.157, 0.018],
    [20106.0, 0.102, 0.773, 0.645, 0.94, 0.041, 0.061, 0.055],
];

/// A chain that stops a landing at once and a stiff one beside it: moderate springs for any structure.
const PLAIN: [f64; 7] = [0.2, 0.92, 0.5, 1.0, 20.0, 1.0, 0.05];

/// Entries of the catalogue that are tried.
const TRIED: usize = 3;

/// Springs of a structure of like Omega_n/p, the stiffer chain at `hz`; the nearest first, and plain ones.
pub(super) fn near(omega_over_p: f64, hz: f64) -> Vec<Springs<Design<f64>>> {
    let distance = |entry: &[f64; 8]| (entry[0] / omega_over_p).ln().abs();
    let mut order: Vec<&[f64; 8]> = FOUND.iter().collect();
    order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = order.iter().take(TRIED).map(|entry| &entry[1..]);
    nearest
        .chain([&PLAIN[..]])
        .map(|x| Springs {
            vertical: Design::from_kc(x[2], x[0], x[1], hz),
            horizontal: Design::from_kc(x[6], x[4], x[5], hz * x[3]),
        })
        .collect()
}
