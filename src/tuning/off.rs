//! Springs a little off: digits get rounded on their way into another program, and its steps smear what happens in a
//! millisecond. Springs that are good only as they are, by a fine interplay of absorber and dashpot, are good on paper.

use crate::spring::{Design, Springs};

/// By how much all parameters are put off at once: they may be copied with two digits.
const OFF: f64 = 0.01;
/// In which directions: Omega_n, K, C, mu of the vertical and of the horizontal chain.
const PATTERN: [f64; 8] = [1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0];

/// The springs as they are, and with all parameters 1 % off: in a pattern of ups and downs, and in the opposite one.
pub(super) fn variants(springs: &Springs<Design<f64>>) -> [Springs<Design<f64>>; 3] {
    [*springs, off(springs, &PATTERN), off(springs, &PATTERN.map(|sign| -sign))]
}

fn off(springs: &Springs<Design<f64>>, pattern: &[f64; 8]) -> Springs<Design<f64>> {
    let chain = |design: &Design<f64>, signs: &[f64]| {
        let by = |i: usize| 1.0 + OFF * signs[i];
        Design::from_kc(design.mu * by(3), design.k() * by(1), design.c() * by(2), design.omega_n_hz * by(0))
    };
    Springs { vertical: chain(&springs.vertical, &pattern[..4]), horizontal: chain(&springs.horizontal, &pattern[4..]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_put_off_once_up_and_once_down() {
        let chain = Design::from_kc(1.0, 0.5, 2.0, 80.0);
        let all = variants(&Springs { vertical: chain, horizontal: chain });
        assert_eq!(all[0].vertical, chain);
        let up = [80.8, 0.505, 1.98, 1.01, 79.2, 0.495, 2.02, 0.99];
        let down = [79.2, 0.495, 2.02, 0.99, 80.8, 0.505, 1.98, 1.01];
        for (Springs { vertical, horizontal }, expected) in all[1..].iter().zip([up, down]) {
            for (x, y) in [vertical, horizontal].iter().flat_map(|d| [d.omega_n_hz, d.k(), d.c(), d.mu]).zip(expected) {
                assert!((x - y).abs() < 1e-12 * y, "{x} {y}");
            }
        }
    }
}
