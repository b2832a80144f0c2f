//! Springs found before, without units: where the search for others begins.
//!
//! What a landing asks of springs depends, beside the body's proportions, on Omega_n/p alone (the landing velocity over
//! g/Omega_n), and on that slowly. So the springs of one structure are a good start for any other of like Omega_n/p. These
//! came from global searches (CMA-ES) of `Impact`'s error for A-frames 5, 20 and 61 m high and for blocks of 0.6 and 2 m, on
//! springs of 40 to 1280 Hz.

use crate::spring::{Design, Springs};

/// Omega_n/p; m R^2/I0; restitution over that of equation 2; K, C, mu of the vertical chain; Omega_n of the horizontal
/// over that of the vertical chain, its K, C, mu.
const FOUND: [[f64; 10]; 41] = [
    [209.0, 0.75, 1.0, 0.409, 0.689, 1.206, 1.0, 0.311, 0.0886, 0.0293],
    [209.0, 0.75, 1.0, 0.25896, 0.79939, 0.9075, 1.0, 0.40647, 0.06411, 0.02079],
    [376.0, 0.75, 1.0, 0.395, 0.687, 1.12, 1.0, 0.207, 0.082, 0.0436],
    [376.0, 0.75, 1.0, 0.24384, 0.76607, 0.82103, 0.5091, 30.0, 0.21826, 0.00908],
    [834.0, 0.75, 1.0, 0.2941, 0.7959, 0.6973, 0.7327, 0.4956, 0.1616, 0.0328],
    [834.0, 0.75, 1.0, 0.12858, 0.82828, 0.70265, 1.0, 0.46478, 0.18445, 0.05404],
    [838.0, 0.75, 1.0, 0.162, 0.75, 0.73, 0.95, 0.351, 0.18, 0.0357],
    [941.0, 0.75, 1.0, 0.2453, 0.7721, 0.7261, 0.7037, 0.3941, 0.0865, 0.034],
    [941.0, 0.75, 1.0, 0.16628, 0.73878, 0.62832, 0.87802, 0.27286, 0.09302, 0.02997],
    [1505.0, 0.75, 1.0, 0.121, 0.78, 0.636, 0.72, 0.489, 0.258, 0.0253],
    [628.0, 1.0, 1.0, 0.507, 1.205, 0.733, 1.0, 0.476, 0.308, 0.0114],
    [628.0, 1.0, 1.0, 0.96399, 0.94498, 1.05109, 0.80418, 0.001, 3.95306, 0.00471],
    [628.0, 1.0, 1.0, 0.63475, 1.11141, 0.8709, 1.0, 0.00181, 6.9772, 0.00632],
    [723.0, 1.0, 1.0, 0.36, 0.843, 1.658, 1.0, 0.0477, 0.044, 0.0538],
    [723.0, 1.0, 1.0, 0.4046, 0.83906, 1.91973, 1.0, 0.03507, 0.03909, 0.03925],
    [723.0, 1.0, 1.0, 0.27591, 27.13439, 0.70016, 1.0, 0.00726, 0.01858, 0.01123],
    [1256.0, 1.0, 1.0, 0.354, 1.05, 1.076, 1.0, 0.0264, 0.0417, 0.0368],
    [1256.0, 1.0, 1.0, 0.29996, 0.98552, 0.52707, 1.0, 0.001, 7.25346, 0.0025],
    [1256.0, 1.0, 1.0, 0.27468, 1.42457, 2.76577, 1.0, 0.01106, 0.01068, 0.01027],
    [1256.0, 1.0, 1.0, 0.378, 1.36008, 2.61546, 1.0, 0.00778, 0.01106, 0.00851],
    [1440.0, 1.0, 1.0, 0.392, 0.719, 1.378, 0.9, 0.0952, 0.0283, 0.0807],
    [1440.0, 1.0, 1.0, 0.26745, 1.01453, 1.04663, 1.0, 0.05142, 0.02749, 0.04846],
    [1440.0, 1.0, 1.0, 0.47961, 1.90836, 2.83697, 0.79849, 0.00828, 0.01908, 0.00749],
    [2513.0, 1.0, 1.0, 0.3812, 0.8159, 1.4687, 0.4558, 0.1077, 0.0315, 0.02277],
    [2513.0, 1.0, 1.0, 0.44197, 1.60092, 2.51136, 0.81354, 0.00876, 0.0138, 0.00759],
    [2513.0, 1.0, 1.0, 0.21237, 0.82286, 0.99613, 1.0, 0.04196, 0.03088, 0.04305],
    [2513.0, 1.0, 1.0, 0.36894, 1.607, 2.29686, 1.0, 0.00633, 0.01143, 0.00809],
    [5027.0, 1.0, 1.0, 0.19, 0.87, 1.0, 0.45, 0.1, 0.04, 0.025],
    [5027.0, 1.0, 1.0, 0.38401, 1.46548, 1.99395, 0.8447, 0.00865, 0.01344, 0.00803],
    [5027.0, 1.0, 1.0, 0.54458, 1.50177, 3.32916, 0.84072, 0.00544, 0.01172, 0.00579],
    [10053.0, 1.0, 1.0, 0.111, 0.832, 0.687, 0.94, 0.0432, 0.056, 0.0599],
    [20106.0, 1.0, 1.0, 0.116, 0.72, 0.717, 0.99, 0.045, 0.0545, 0.0606],
    [209.0, 0.75, 0.9, 0.2251, 1.1762, 1.2834, 0.2699, 0.241, 0.1019, 0.005],
    [212.0, 0.75, 0.9, 0.2887, 1.3183, 2.4272, 0.3165, 0.0846, 0.0102, 0.0054],
    [376.0, 0.75, 0.9, 2.364, 4.4506, 3.4827, 0.2539, 0.0412, 1.6853, 0.3033],
    [376.0, 0.75, 0.9, 1.8456, 2.3443, 2.2627, 0.189, 0.0275, 1.71, 0.4815],
    [376.0, 0.75, 0.95, 0.4899, 1.2905, 3.0012, 0.2467, 0.0634, 18.2299, 0.1395],
    [2513.0, 1.0, 0.95, 0.088, 6.5792, 2.0254, 1.0, 0.005, 0.0084, 0.02],
    [2513.0, 1.0, 0.98, 1.619, 1.2052, 4.3974, 0.238, 0.0397, 0.0191, 0.0087],
    [316.0, 0.75, 1.02, 0.5175, 0.2977, 0.3504, 0.5592, 1.888, 0.1288, 0.1825],
    [2513.0, 1.0, 1.02, 20.1738, 0.0062, 0.044, 0.03, 6.2809, 0.0229, 0.0081],
];

/// A chain that stops a landing at once and a stiff one beside it: moderate springs for any structure.
const PLAIN: [f64; 7] = [0.2, 0.92, 0.5, 1.0, 20.0, 1.0, 0.05];

/// Entries of the catalogue that are tried.
const TRIED: usize = 6;

/// Springs of structures of like Omega_n/p and m R^2/I0 that were to have a like `ratio` of restitution to equation 2, the
/// vertical chain at `hz`; the nearest first, and plain ones.
pub(super) fn near(omega_over_p: f64, mass_share: f64, ratio: f64, hz: f64) -> Vec<Springs<Design<f64>>> {
    // a quarter of I0, and 3 % of restitution, count as much as a factor e of Omega_n/p
    let distance = |entry: &[f64; 10]| {
        (entry[0] / omega_over_p).ln().abs() + 4.0 * (entry[1] - mass_share).abs() + 30.0 * (entry[2] - ratio).abs()
    };
    let mut order: Vec<&[f64; 10]> = FOUND.iter().collect();
    order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let found = order.iter().take(TRIED).map(|entry| {
        // stiffer springs follow Housner better, but lose less than he does only as stiff as they were found
        let share = if entry[2] == 1.0 { 1.0 } else { (entry[0] / omega_over_p).min(1.0) };
        (hz * share, &entry[3..])
    });
    found
        .chain([(hz, &PLAIN[..])])
        .map(|(hz, x)| Springs {
            vertical: Design::from_kc(x[2], x[0], x[1], hz),
            horizontal: Design::from_kc(x[6], x[4], x[5], hz * x[3]),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_entry_comes_first_and_keeps_its_ratios() {
        let found = near(2500.0, 1.0, 1.0, 160.0);
        assert_eq!(found.len(), TRIED + 1);
        let Springs { vertical, horizontal } = found[0];
        assert_eq!((vertical.omega_n_hz, horizontal.omega_n_hz), (160.0, 160.0 * 0.4558));
        assert!((vertical.k() - 0.3812).abs() < 1e-12 && (vertical.c() - 0.8159).abs() < 1e-12);
        // a block's springs for a block
        assert!((near(400.0, 0.75, 1.0, 160.0)[0].vertical.k() - 0.395).abs() < 1e-12);
    }
}
