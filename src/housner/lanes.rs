//! Eight structures in lock-step on one record.
//!
//! A plain step is the same operations for every lane, so that they run side by side in vector registers; a lane whose interval holds
//! an event, or that rests, takes that interval by itself. No operation is contracted or reordered, so a lane's result is that of the single
//! walk, bit for bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use std::array;

use super::Rocking;
use super::series::{SHORT, Start, change, coefficients, end_slope, is_plain, turned};
use super::walk::Walk;

/// Structures in lock-step.
pub const WIDTH: usize = 8;

/// A number for each lane.
type Lanes = [f64; WIDTH];

/// The walks of at most [`WIDTH`] structures on one record, to their ends.
pub fn walk(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512dq") {
            // SAFETY: the processor has what the function was compiled for
            return unsafe { walk_avx512(walks) };
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: as above
            return unsafe { walk_avx2(walks) };
        }
    }
    lock_step(walks)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn walk_avx512(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    lock_step(walks)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    lock_step(walks)
}

#[inline(always)]
fn lock_step(mut walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    let Some(longest) = walks.iter().max_by_key(|walk| walk.set.accel.len()) else { return walks_end(walks) };
    let (accel, dt) = (longest.set.accel, longest.set.dt);
    let fixed = Fixed {
        dt,
        unit: gather(&walks, |walk| walk.set.unit),
        alpha: gather(&walks, |walk| walk.set.alpha),
        q: gather(&walks, |walk| walk.q),
    };
    let mut running = [false; WIDTH];
    running[..walks.len()].fill(true);
    for i in 0..accel.len() {
        let mut rocking = [false; WIDTH];
        for (l, walk) in walks.iter_mut().enumerate() {
            running[l] = running[l] && walk.arrive(i) && i + 1 < walk.set.accel.len();
            rocking[l] = running[l] && walk.state.rocking && !walk.fast;
        }
        if running == [false; WIDTH] {
            break;
        }
        let next = accel.get(i + 1).copied().unwrap_or(0.0);
        if rocking != [false; WIDTH] {
            step(&mut walks, &mut rocking, &fixed, accel[i], next);
        }
        for (l, walk) in walks.iter_mut().enumerate() {
            // what has not stepped with the others goes on by itself
            let lies = !walk.state.rocking && accel[i].abs() <= walk.quiet && next.abs() <= walk.quiet;
            if running[l] && !rocking[l] && !lies {
                running[l] = walk.advance(i, fixed.unit[l] * accel[i], fixed.unit[l] * next);
            }
        }
    }
    walks_end(walks)
}

/// What does not change along the walk.
struct Fixed {
    dt: f64,
    unit: Lanes,
    alpha: Lanes,
    q: Lanes,
}

/// Step the lanes that are rocking over an interval of the record, and note which of them could not.
#[inline(always)]
fn step(walks: &mut [Walk<f64>], rocking: &mut [bool; WIDTH], fixed: &Fixed, now: f64, next: f64) {
    let Fixed { dt, unit, alpha, q } = fixed;
    let side = gather(walks, |walk| walk.state.side);
    let w0 = gather(walks, |walk| walk.state.at.w);
    let rate0 = gather(walks, |walk| walk.state.at.rate);
    let sin0 = gather(walks, |walk| walk.state.at.sin);
    let cos0 = gather(walks, |walk| walk.state.at.cos);
    let zero = [0.0; WIDTH];
    let (mut w, mut rate, mut sin, mut cos, mut turn, mut plain) = (zero, zero, zero, zero, zero, zero);
    // one loop of straight arithmetic, which the compiler turns into vector operations
    for l in 0..WIDTH {
        let at = Start { w: w0[l], rate: rate0[l], sin: sin0[l], cos: cos0[l] };
        let (a0, a1) = (unit[l] * now, unit[l] * next);
        let (b0, db) = (a0 * side[l], (a1 - a0) * side[l]);
        let c: [f64; SHORT] = coefficients(&at, *dt, b0, db, q[l]);
        turn[l] = change(&c);
        w[l] = at.w + turn[l];
        rate[l] = end_slope(&c) * (1.0 / dt);
        (sin[l], cos[l]) = turned(at.sin, at.cos, turn[l]);
        plain[l] = if is_plain(&c, b0, db, q[l], w[l], alpha[l]) { 1.0 } else { 0.0 };
    }
    for (l, walk) in walks.iter_mut().enumerate() {
        rocking[l] &= plain[l] != 0.0;
        if rocking[l] {
            let at = &mut walk.state.at;
            (at.w, at.rate) = (w[l], rate[l]);
            walk.set.turn_to(&mut walk.state, turn[l], (sin[l], cos[l]));
        }
    }
}

/// A number of each walk; an empty lane computes what the last walk computes, to no effect.
#[inline(always)]
fn gather(walks: &[Walk<f64>], f: impl Fn(&Walk<f64>) -> f64) -> Lanes {
    array::from_fn(|l| f(&walks[l.min(walks.len() - 1)]))
}

fn walks_end(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    walks.into_iter().map(Walk::end).collect()
}
