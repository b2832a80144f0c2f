//! Table 1 of the paper as far as its digits survive, for comparison.
//!
//! Certain: both Omega_n, both k1 (k1 = m1 Omega_n^2 gives back their digits) and the vertical k2 = 9.214 k1, which the
//! minimax puts at mu = 10.2. The horizontal k2 of 1.31e9 to 1.32e9 N/m and c of 3.34e8 N s/m have lost digits, the vertical c
//! is x.65e8; 1.165e8 is one of its readings. The horizontal mu is lost: the vertical one is taken. Any plausible c and mu
//! give much the same history.

use crate::{
    spring::{Design, Springs},
    structure::{Kind, Structure},
};

/// Omega_n/2 pi (Hz), K, C, mu.
const VERTICAL: [f64; 4] = [6.2, 9.214, 4.397, 10.2];
const HORIZONTAL: [f64; 4] = [10.0, 0.4897, 7.816, 10.2];

/// The springs of Table 1, if this is the paper's structure.
pub fn of(structure: &Structure) -> Option<Springs<Design<f64>>> {
    let paper = Structure::paper();
    let same = structure.kind == Kind::AFrame
        && (structure.height_m, structure.width_m, structure.mass_kg) == (paper.height_m, paper.width_m, paper.mass_kg);
    let design = |[hz, k, c, mu]: [f64; 4]| Design::from_kc(mu, k, c, hz);
    same.then(|| Springs { vertical: design(VERTICAL), horizontal: design(HORIZONTAL) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digits_that_survive_are_those_of_the_paper() {
        let springs = of(&Structure::paper()).unwrap().chains(680.1e3);
        assert_eq!(format!("{:.3e}", springs.vertical.k1), "1.032e9");
        assert_eq!(format!("{:.3e}", springs.horizontal.k1), "2.685e9");
        assert!(
            (springs.vertical.k2 / 9.509e9 - 1.0).abs() < 1e-4 && (springs.vertical.c / 1.165e8 - 1.0).abs() < 1e-3
        );
        assert!(
            (1.31e9..1.32e9).contains(&springs.horizontal.k2) && (springs.horizontal.c / 3.34e8 - 1.0).abs() < 1e-3
        );
        assert!(of(&Structure::a_frame(20.0, 4.0, 1e5).unwrap()).is_none());
    }
}
