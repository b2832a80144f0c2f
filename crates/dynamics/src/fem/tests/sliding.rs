//! Blocks that slide and do not rock, beside Coulomb's law alone.

use std::f64::consts::TAU;

use super::friction::{block, members};
use crate::{
    fem::{Analysis, HistoryOutcome},
    spring::{Chain, Springs},
};
use rocking::{motion::largest_magnitude, scalar::GRAVITY};

const DT: f64 = 0.005;
/// Parts of an interval between two samples.
const PARTS: usize = 100;

/// Displacement, relative to the ground, of a rigid block on a plane with friction, at the samples
/// (m): x'' = -a -+ mu (g + a_z) while it slides, and it stops where its speed passes zero.
fn coulomb(mu: f64, accel: &[f64], up: &[f64]) -> Vec<f64> {
    let (mut x, mut speed) = (0.0, 0.0_f64);
    let h = DT / PARTS as f64;
    let mut all = vec![0.0];
    for (i, pair) in accel.windows(2).enumerate() {
        for part in 0..PARTS {
            let at = (part as f64 + 0.5) / PARTS as f64;
            let within = |a: f64, b: f64| a + (b - a) * at;
            let a = within(pair[0], pair[1]);
            let lifts = up.get(i..i + 2).map_or(0.0, |up| within(up[0], up[1]));
            let holds = mu * (GRAVITY + lifts);
            if speed == 0.0 && a.abs() <= holds {
                continue;
            }
            let side = if speed == 0.0 { -a.signum() } else { speed.signum() };
            let gains = -a - side * holds;
            let stops = if speed * gains < 0.0 { -speed / gains } else { f64::INFINITY };
            let time = h.min(stops);
            x += speed * time + 0.5 * gains * time * time;
            speed = if stops <= h { 0.0 } else { speed + gains * time };
        }
        all.push(x);
    }
    all
}

/// Sine waves of a frequency each, with an envelope; the peak is some `scale` m/s2.
fn shaking(hz: &[f64], scale: f64) -> Vec<f64> {
    let wave = |t: f64| -> f64 {
        let sum = |(k, hz): (usize, &f64)| (TAU * hz * t + 1.7 * k as f64).sin();
        hz.iter().enumerate().map(sum).sum::<f64>() / hz.len() as f64
    };
    let envelope = |t: f64| (t / 2.0).min(1.0).min((12.0 - t) / 4.0).max(0.0);
    (0..2400).map(|i| i as f64 * DT).map(|t| scale * envelope(t) * wave(t)).collect()
}

/// The same under springs as a low block asks for: the last digit of a place of 0.1 m is worth 3 N
/// and more across.
fn stiff(mass: f64, softer: f64) -> Springs<Chain> {
    let chain = |k1: f64, k2: f64, c: f64| Chain {
        k1: k1 * softer * mass,
        k2: k2 * softer * mass,
        m2: 0.3 * mass,
        c: c * softer.sqrt() * mass,
    };
    Springs { vertical: chain(1.3e11, 4e8, 1.4e5), horizontal: chain(1.6e14, 1.6e14, 2.5e7) }
}

#[test]
fn sliding_blocks_follow_coulombs_law() {
    let across = [shaking(&[0.7, 1.1, 2.3, 4.9], 16.0), shaking(&[0.4, 1.9, 7.0], 14.0)];
    let up = shaking(&[3.1, 5.3, 8.7], 5.0);
    for (i, (height, width, mu)) in
        [(0.6, 1.4, 0.2), (0.6, 1.6, 0.3), (0.25, 2.0, 0.25), (1.5, 3.5, 0.1)]
            .into_iter()
            .enumerate()
    {
        let body = block(height, width);
        for (accel, up) in across.iter().flat_map(|a| [(a, &[][..]), (a, &up[..])]) {
            for softer in [1.0, 1e-3] {
                let springs = stiff(body.mass, softer);
                let analysis = Analysis { vertical: up, ..Analysis::new(body, springs, DT, accel) };
                let history = analysis.simulate_with(&members(mu)).0;
                let case = format!("{i} {} {softer}: {:?}", up.len(), history.work);

                assert_eq!(history.outcome, HistoryOutcome::Completed, "{case}");
                let theirs = coulomb(mu, accel, up);
                let most = largest_magnitude(&theirs);
                assert!(most > 0.05, "{most}");
                let apart = history.motion.u.iter().zip(&theirs).map(|(a, b)| (a - b).abs());
                let worst = apart.fold(0.0, f64::max);

                assert!(worst < 2e-3 * most, "{case}: {worst} of {most}");
            }
        }
    }
}
