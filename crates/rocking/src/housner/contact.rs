//! Loss of contact: where the pivot would have to hold the body down.
//!
//! The pivot's normal force over the weight, with psi = alpha - w and w'' by Housner's equation, is
//!
//! ```text
//! N/(m g) = gamma + (R/g) ( w'' sin psi - w'^2 cos psi ),   gamma = 1 + a_v/g
//! ```
//!
//! (at rest on both feet: gamma). Within a step it is a power series, as the lean is. Where it
//! falls to zero the equation ends: real ground does not pull.

#![allow(clippy::needless_range_loop)] // as in `series`

use super::root::first_root;
use super::series::{StepGround, StepStart, value_and_slope};

/// N/(m g) at a point of the motion; `arm` = R/g (s2).
pub(crate) fn pressure(at: &StepStart<f64>, ground: &StepGround<f64>, p2: f64, arm: f64) -> f64 {
    let second = -p2 * (ground.gamma * at.sin + ground.b * at.cos); // (1), (3)
    ground.gamma + arm * (second * at.sin - at.rate * at.rate * at.cos)
}

/// Whether the pivot is pressed throughout a step, by bounds that cost little: |sin psi| <= s =
/// |sin psi_0| + sum |c_k|, so that N/(m g) >= gamma (1 - share s^2) - share |b| s - arm w'^2.
/// `share` = m R^2/I0 and `arm` = R/(g h^2), w' being per step. It may say no where [`loss`] finds
/// nothing.
#[inline(always)]
pub(crate) fn surely_presses<const N: usize>(
    c: &[f64; N],
    sin: f64,
    ground: &StepGround<f64>,
    share: f64,
    arm: f64,
) -> bool {
    let (mut turn, mut slope) = (0.0, 0.0);
    for k in 1..N {
        turn += c[k].abs();
        slope += c[k].abs() * k as f64;
    }
    let ends = |x: f64, dx: f64| (x, x + dx);
    let ((g0, g1), (b0, b1)) = (ends(ground.gamma, ground.dgamma), ends(ground.b, ground.db));
    let gamma = if g0 < g1 { g0 } else { g1 };
    let b = if b0.abs() > b1.abs() { b0.abs() } else { b1.abs() };
    let s = sin.abs() + turn;
    (gamma > 0.0) & (gamma * (1.0 - share * s * s) - share * b * s > arm * slope * slope)
}

/// Where in a step, x in [0, 1], a pressed pivot's force falls to zero; `c` is the lean's series,
/// `arm` = R/(g h^2), `press` what members press over the weight.
pub(crate) fn loss<const N: usize>(
    c: &[f64; N],
    at: &StepStart<f64>,
    ground: &StepGround<f64>,
    arm: f64,
    press: Option<&[f64; N]>,
) -> Option<f64> {
    let mut n = series(c, at, ground, arm);
    // the force's series has two terms fewer than the lean's
    for (n, press) in n.iter_mut().zip(press.into_iter().flatten()).take(N - 2) {
        *n += press;
    }
    let mut x = first_root(&n)?;
    for _ in 0..2 {
        let (value, slope) = value_and_slope(&n, x);
        if slope < 0.0 {
            x = (x - value / slope).clamp(0.0, 1.0);
        }
    }
    Some(x)
}

/// N/(m g) over the step as a power series.
fn series<const N: usize>(
    c: &[f64; N],
    at: &StepStart<f64>,
    ground: &StepGround<f64>,
    arm: f64,
) -> [f64; N] {
    // k S_k = -sum j c_j C_{k-j}, k C_k = sum j c_j S_{k-j}, as F and G of the lean's series
    let (mut sin, mut cos) = ([at.sin; N], [at.cos; N]);
    for k in 1..N {
        let (mut s, mut c_) = (0.0, 0.0);
        for j in 1..=k {
            s -= j as f64 * c[j] * cos[k - j];
            c_ += j as f64 * c[j] * sin[k - j];
        }
        (sin[k], cos[k]) = (s / k as f64, c_ / k as f64);
    }
    let rate = |k: usize| (k + 1) as f64 * c[k + 1];
    let second = |k: usize| ((k + 2) * (k + 1)) as f64 * c[k + 2];
    let mut n = [0.0; N];
    let mut square = [0.0; N];
    for k in 0..N - 2 {
        square[k] = (0..=k).map(|j| rate(j) * rate(k - j)).sum();
        n[k] = arm * (0..=k).map(|j| second(j) * sin[k - j] - square[j] * cos[k - j]).sum::<f64>();
    }
    n[0] += ground.gamma;
    n[1] += ground.dgamma;
    n
}

#[cfg(test)]
mod tests {
    use super::super::series::{LONG, PowerSeries};
    use super::*;

    const P2: f64 = 3.0;
    const ARM: f64 = 0.2;

    fn step(
        ground: &StepGround<f64>,
        rate: f64,
        h: f64,
    ) -> (StepStart<f64>, PowerSeries<f64, LONG>) {
        let (sin, cos) = 0.13_f64.sin_cos();
        let at = StepStart { w: 0.07, rate, sin, cos };
        (at, PowerSeries::new::<true>(&at, h, ground, P2 * h * h))
    }

    #[test]
    fn the_forces_series_is_the_force_along_the_step() {
        let h = 0.05;
        let ground = StepGround { b: -0.3, db: 0.2, gamma: 0.6, dgamma: -0.5 };
        let (at, lean) = step(&ground, 1.5, h);
        let n = series(&lean.c, &at, &ground, ARM / (h * h));
        for x in [0.0, 0.3, 0.7, 1.0] {
            let (w, slope) = lean.at(x);
            let (sin, cos) = (0.2 - w).sin_cos();
            let here = StepGround {
                b: ground.b + ground.db * x,
                gamma: ground.gamma + ground.dgamma * x,
                ..ground
            };
            let expected = pressure(&StepStart { w, rate: slope / h, sin, cos }, &here, P2, ARM);
            assert!((value_and_slope(&n, x).0 - expected).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn where_the_force_falls_to_zero_is_located_and_bounds_are_on_the_safe_side() {
        let h = 0.05;
        let mut lost = 0;
        for i in 0..40 {
            let ground = StepGround { b: -0.3, db: 0.4, gamma: 0.6, dgamma: -0.02 * f64::from(i) };
            let (at, lean) = step(&ground, 1.0, h);
            let found = loss(&lean.c, &at, &ground, ARM / (h * h), None);
            // share = p^2 R/g
            let sure = surely_presses(&lean.c, at.sin, &ground, P2 * ARM, ARM / (h * h));
            assert!(!(sure && found.is_some()), "{i}");
            if let Some(x) = found {
                let (value, slope) =
                    value_and_slope(&series(&lean.c, &at, &ground, ARM / (h * h)), x);
                assert!(value.abs() < 1e-14 && slope < 0.0, "{x} {value:e}");
                lost += 1;
            }
        }
        assert!((1..39).contains(&lost), "{lost}");
    }
}
