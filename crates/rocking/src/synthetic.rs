//! Ground motions made from a seed, scaled to a structure, for statistics over many records.
//!
//! Record i of a suite depends on the seed, on i and on the structure's p and alpha, and on nothing
//! else: records can be made in any order, on any thread. Three kinds alternate: Ricker wavelets
//! ([`Pulse`]), Mavroeidis-Papageorgiou pulses, and filtered noise (Kanai-Tajimi). Amplitudes and
//! frequencies are drawn relative to the structure,
//!
//! ```text
//! pulses  PGA = 1.1 to 4 g tan(alpha)    omega_p = 2 to 10 p   (p from the body's p^2 = m g R/I0)
//! noise   PGA = 1.2 to 6 g tan(alpha)    omega_g = 7 to 35 p   10 to 30 s
//! ```
//!
//! because a body first lifts at g tan(alpha) and topples more easily the longer the motion pushes
//! one way, measured in 1/p: so some records hardly lift it and some, one in ten to one in four,
//! topple it. Frequencies are spread evenly in their logarithm, amplitudes evenly. A silence of 8/p
//! follows each motion, for the body to topple or to come back in.
//!
//! A second suite ([`earthquake`]) knows nothing of the structure: filtered noise of the
//! frequencies, amplitudes and lengths of real earthquakes, on which tall structures sway before
//! they lift, and small ones are hardly lifted or toppled at once.
//!
//! ```text
//! omega_g = 9 to 36 rad/s    zeta_g = 0.2 to 0.6    PGA = 0.2 to 0.9 g    20 to 60 s    dt = 0.005 or 0.01 s
//! ```
//!
//! A third ([`MotionTarget`]) is like a given motion: it has its response spectrum and its envelope
//! in time.

mod fft;
mod like;
mod noise;
mod pulse;
mod random;
mod spectrum;

pub use like::{LikeError, Likeness, MotionTarget, likeness};
pub use pulse::Pulse;
pub use spectrum::ResponseSpectrum;

use crate::scalar::GRAVITY;
use random::Random;
use strong_motion::{Record, Source, largest_magnitude};

/// The first n records of the suite of a seed, for a structure with p (1/s) and alpha (rad): see
/// [`record`].
pub fn suite(
    n: usize,
    seed: u64,
    p: f64,
    alpha: f64,
) -> impl ExactSizeIterator<Item = Record> + Clone {
    (0..n).map(move |index| record(seed, index, p, alpha))
}

/// Record `index` of the suite of a seed, for a structure with p (1/s) and alpha (rad), as a
/// checked structure has them. A p outside 0.02 to 1e4, which is no building and no block, counts
/// as the nearest of these.
///
/// The time step is the largest of the series 1, 2, 5 that is at most 1/(200 p) and 0.02 s; every
/// motion starts at rest, and its ground velocity ends at zero.
pub fn record(seed: u64, index: usize, p: f64, alpha: f64) -> Record {
    let p = if p.is_nan() { 0.02 } else { p.clamp(0.02, 1e4) };
    let dt = round_step((1.0 / (200.0 * p)).min(0.02));
    let uplift = GRAVITY * alpha.tan();
    let mut random = Random::new(seed, index as u64);

    let (kind, mut accel, pga) = match index % 3 {
        kind @ (0 | 1) => {
            let omega = p * random.log_between(2.0, 10.0);
            let pga = uplift * random.between(1.1, 4.0);
            let (name, pulse) = match (kind, (index / 3) % 2) {
                (0, 0) => ("ricker", Pulse::RickerSymmetric),
                (0, _) => ("ricker", Pulse::RickerAntisymmetric),
                _ => {
                    let (gamma, nu) =
                        (random.between(1.0, 3.0), random.between(0.0, std::f64::consts::TAU));
                    ("mavroeidis", Pulse::MavroeidisPapageorgiou { gamma, nu })
                }
            };
            (name, pulse.sampled(omega, dt), pga * random.sign())
        }
        _ => {
            let pga = uplift * random.between(1.2, 6.0);
            let motion = noise::Noise {
                omega_g: p * random.log_between(7.0, 35.0),
                zeta_g: random.between(0.2, 0.6),
                duration: random.between(10.0, 30.0),
            };
            ("noise", motion.sampled(dt, &mut random), pga)
        }
    };
    scale_to(pga, &mut accel);
    let silence = (8.0 / (p * dt)).ceil() as usize;
    accel.resize(accel.len() + silence, 0.0);
    Record {
        name: format!("{kind}-{index:04}"),
        dt,
        accel,
        vertical: None,
        source: Source::Synthetic,
        made_of: None,
    }
}

/// Numbers of this suite are drawn from streams that [`record`] does not use.
const EARTHQUAKES: u64 = 1 << 63;

/// Peak ground acceleration of an earthquake-like motion (g), from and to.
pub const EARTHQUAKE_PGA_G: (f64, f64) = (0.2, 0.9);

/// Motion `index` of the suite of earthquakes of a seed. It depends on the seed and on the index
/// alone; only the silence at its end is as long as the structure needs to topple or to come to
/// rest: 8/p, p in 1/s, at least 2 s and at most 60 s.
pub fn earthquake(seed: u64, index: usize, p: f64) -> Record {
    let mut random = Random::new(seed, EARTHQUAKES | index as u64);
    let dt = if random.sign() > 0.0 { 0.005 } else { 0.01 };
    let pga = GRAVITY * random.between(EARTHQUAKE_PGA_G.0, EARTHQUAKE_PGA_G.1);
    let motion = noise::Noise {
        omega_g: random.octaves_above(9.0, 2.0),
        zeta_g: random.between(0.2, 0.6),
        duration: random.between(20.0, 60.0),
    };
    let mut accel = motion.sampled(dt, &mut random);
    scale_to(pga, &mut accel);
    accel.resize(accel.len() + (silence_s(p) / dt).ceil() as usize, 0.0);
    Record {
        name: format!("earthquake-{index:04}"),
        dt,
        accel,
        vertical: None,
        source: Source::Earthquake,
        made_of: None,
    }
}

/// Length of the silence behind an earthquake, for a body with p (1/s) to topple or to come to
/// rest: 8/p, at least 2 s and at most 60 s.
fn silence_s(p: f64) -> f64 {
    let p = if p.is_nan() { 0.0 } else { p.max(0.0) };
    (8.0 / p).clamp(2.0, 60.0)
}

/// Scale to a peak.
fn scale_to(pga: f64, accel: &mut [f64]) {
    let peak = largest_magnitude(accel);
    for a in accel {
        *a *= pga / peak;
    }
}

/// The largest of 1, 2, 5 times a power of ten that is at most x.
fn round_step(x: f64) -> f64 {
    let decade = x.log10().floor() as i32;
    let unit = 10_f64.powi(-decade);
    let digit =
        [5.0, 2.0].into_iter().find(|digit| digit / unit <= x * (1.0 + 1e-12)).unwrap_or(1.0);
    digit / unit
}

#[cfg(test)]
mod tests;
