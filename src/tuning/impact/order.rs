//! Whether landings are in order, and stay so on springs that are a little off.
//!
//! Digits get rounded, dashpots come with tolerances, and another program's steps smear what happens in a millisecond. Springs
//! whose landings depend on a fine interplay of absorber and dashpot are perfect on paper only: 5 % more of one mass, and both
//! feet are in the air for 30 ms instead of 9. So all parameters are put off at once, in patterns in which each of the eight
//! is as often above as below.

use serde::{Deserialize, Serialize};

use super::{AIR_FREE, Impact, WEIGHT_AIR};
use crate::{
    fem::Control,
    spring::{Design, Springs},
};

/// Largest relative error of restitution of a landing that is in order.
const RESTITUTION_ERROR: f64 = 2e-3;

/// By how much parameters are put off.
pub const OFF: f64 = 0.03;
/// In which directions: Omega_n, K, C, mu of the vertical and of the horizontal chain.
const PATTERNS: [[f64; 8]; 4] = [
    [1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0],
    [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0],
    [-1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0],
];

/// What can be said of the landings from every lean, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// One misses the restitution wanted by more than 0.2 %, or keeps both feet in the air for longer than 10 ms
    /// and a period of the stiffest spring allowed.
    Missed,
    /// All are in order on just these springs.
    Exact,
    /// All are in order also with every parameter 3 % off.
    Sturdy,
}

impl Order {
    /// Of the landings on these springs.
    pub fn of(impact: &Impact, springs: &Springs<Design<f64>>, control: Control) -> Self {
        let in_order = |springs: &Springs<Design<f64>>| {
            let (error, air) =
                (RESTITUTION_ERROR * impact.weight_restitution(), (1.0 - AIR_FREE) * impact.air_s * WEIGHT_AIR);
            impact.landings(springs, control).chunks_exact(2).all(|r| r[0].abs() <= error && r[1] <= air)
        };
        if !in_order(springs) {
            return Self::Missed;
        }
        match PATTERNS.iter().all(|pattern| in_order(&off(springs, pattern))) {
            true => Self::Sturdy,
            false => Self::Exact,
        }
    }
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
    use crate::structure::Structure;

    #[test]
    fn every_parameter_is_put_off_as_often_up_as_down() {
        for i in 0..8 {
            assert_eq!(PATTERNS.iter().map(|pattern| pattern[i]).sum::<f64>(), 0.0, "{i}");
        }
        let chain = Design::from_kc(1.0, 0.5, 2.0, 80.0);
        let there = off(&Springs { vertical: chain, horizontal: chain }, &PATTERNS[0]);
        let Springs { vertical, horizontal } = there;
        let expected = [82.4, 0.515, 1.94, 1.03, 77.6, 0.485, 2.06, 0.97];
        for (x, y) in [vertical, horizontal].iter().flat_map(|d| [d.omega_n_hz, d.k(), d.c(), d.mu]).zip(expected) {
            assert!((x - y).abs() < 1e-12 * y, "{x} {y}");
        }
    }

    /// Chains found by search: one that absorbs by a light mass in resonance, a plain one, and Table 1's, which rebounds.
    #[test]
    fn a_resonant_chain_is_exact_only_and_a_plain_one_sturdy() {
        let body = Structure::paper().body::<f64>();
        let impact = Impact::new(&body, body.restitution(), 160.0);
        let order = |v: [f64; 4], h: [f64; 4]| {
            let chain = |[hz, k, c, mu]: [f64; 4]| Design::from_kc(mu, k, c, hz);
            Order::of(&impact, &Springs { vertical: chain(v), horizontal: chain(h) }, Control::search())
        };
        assert_eq!(order([160.0, 0.20539, 36.9068, 1.10888], [77.9056, 0.01895, 0.01102, 0.00566]), Order::Exact);
        assert_eq!(order([160.0, 0.13868, 0.85004, 0.50195], [160.0, 21.2428, 0.74129, 0.054]), Order::Sturdy);
        assert_eq!(order([160.0, 9.214, 4.4, 10.2], [160.0, 9.214, 4.4, 10.2]), Order::Missed);
    }
}
