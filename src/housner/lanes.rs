//! Eight structures in lock-step on one record.
//!
//! A plain step is the same operations for every lane, so that they run side by side in vector registers; a lane whose interval holds
//! an event, or that rests, takes that interval by itself. No operation is contracted or reordered, so a lane's result is that of the single
//! walk, bit for bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use std::array;

use super::Rocking;
use super::series::{SHORT, Start, change, coefficients, end_slope, is_plain, turned};
use super::walk::{Walk, turns_well};

/// Structures in lock-step.
pub const WIDTH: usize = 16;

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
    let Some(longest) = walks.iter().max_by_key(|walk| walk.set.accel.len()) else { return Vec::new() };
    let (accel, dt) = (longest.set.accel, longest.set.dt);
    let fixed = Fixed {
        dt,
        unit: gather(&walks, |walk| walk.set.unit),
        alpha: gather(&walks, |walk| walk.set.alpha),
        q: gather(&walks, |walk| walk.q),
    };
    let mut at = Joined { side: [1.0; WIDTH], ..Joined::default() };
    let mut to = Step::default();
    // the lane's state stands in `at`, not in its walk
    let mut joined = [false; WIDTH];
    let mut running = [false; WIDTH];
    running[..walks.len()].fill(true);
    let full = running;
    let shortest = walks.iter().map(|walk| walk.set.accel.len()).min().unwrap_or(0);
    for (i, &now) in accel.iter().enumerate() {
        let next = accel.get(i + 1).copied().unwrap_or(0.0);
        let (theta, rate) = (times(&at.w, &at.side), times(&at.rate, &at.side));
        if joined != [false; WIDTH] {
            step(&fixed, &at, now, next, &mut to);
        }
        if joined == full && i + 1 < shortest && at.all_take(&to) {
            for (l, walk) in walks.iter_mut().enumerate() {
                walk.note(theta[l], rate[l]);
            }
            continue;
        }
        for (l, walk) in walks.iter_mut().enumerate() {
            if !running[l] {
                continue;
            }
            let last = i + 1 >= walk.set.accel.len();
            if joined[l] {
                walk.note(theta[l], rate[l]);
                if to.plain[l] != 0.0 && !last {
                    at.take(l, &to, fixed.alpha[l]);
                    continue;
                }
                at.leave(l, walk);
                joined[l] = false;
            } else {
                running[l] = walk.arrive(i);
            }
            // what does not step with the others goes on by itself
            running[l] &= !last;
            let lies = !walk.state.rocking && now.abs() <= walk.quiet && next.abs() <= walk.quiet;
            if running[l] && !lies {
                running[l] = walk.advance(i, fixed.unit[l] * now, fixed.unit[l] * next);
                joined[l] = running[l] && walk.state.rocking && !walk.fast && walk.is_up();
                if joined[l] {
                    at.join(l, walk);
                }
            }
        }
        if running == [false; WIDTH] {
            break;
        }
    }
    walks.into_iter().map(Walk::end).collect()
}

/// What does not change along the walk.
struct Fixed {
    dt: f64,
    unit: Lanes,
    alpha: Lanes,
    q: Lanes,
}

/// Where the joined lanes are.
#[derive(Default)]
struct Joined {
    w: Lanes,
    rate: Lanes,
    sin: Lanes,
    cos: Lanes,
    side: Lanes,
    age: [u32; WIDTH],
}

/// Where a step takes them.
#[derive(Default)]
struct Step {
    w: Lanes,
    rate: Lanes,
    sin: Lanes,
    cos: Lanes,
    /// Change of the lean.
    change: Lanes,
    /// Not zero if one step takes the whole interval.
    plain: Lanes,
}

/// One interval of the record for all lanes.
#[inline(always)]
fn step(fixed: &Fixed, at: &Joined, now: f64, next: f64, to: &mut Step) {
    // one loop of straight arithmetic, which the compiler turns into vector operations
    for l in 0..WIDTH {
        let start = Start { w: at.w[l], rate: at.rate[l], sin: at.sin[l], cos: at.cos[l] };
        let (a0, a1) = (fixed.unit[l] * now, fixed.unit[l] * next);
        let (b0, db) = (a0 * at.side[l], (a1 - a0) * at.side[l]);
        let c: [f64; SHORT] = coefficients(&start, fixed.dt, b0, db, fixed.q[l]);
        let change = change(&c);
        let w = start.w + change;
        let (sin, cos) = turned(start.sin, start.cos, change);
        to.w[l] = w;
        to.rate[l] = end_slope(&c) * (1.0 / fixed.dt);
        to.sin[l] = sin;
        to.cos[l] = cos;
        to.change[l] = change;
        to.plain[l] = if is_plain(&c, b0, db, fixed.q[l], w, fixed.alpha[l]) { 1.0 } else { 0.0 };
    }
}

impl Joined {
    /// All lanes make the step, if it is plain for all and none needs new sines.
    #[inline(always)]
    fn all_take(&mut self, to: &Step) -> bool {
        let mut easy = 0.0;
        for l in 0..WIDTH {
            easy += if turns_well(self.age[l] + 1, to.change[l]) { to.plain[l] } else { 0.0 };
        }
        if easy < WIDTH as f64 {
            return false;
        }
        (self.w, self.rate, self.sin, self.cos) = (to.w, to.rate, to.sin, to.cos);
        self.age = self.age.map(|age| age + 1);
        true
    }

    /// Lane l makes the step.
    #[inline(always)]
    fn take(&mut self, l: usize, to: &Step, alpha: f64) {
        self.w[l] = to.w[l];
        self.rate[l] = to.rate[l];
        self.age[l] += 1;
        if turns_well(self.age[l], to.change[l]) {
            self.sin[l] = to.sin[l];
            self.cos[l] = to.cos[l];
        } else {
            (self.sin[l], self.cos[l]) = (alpha - to.w[l]).sin_cos();
            self.age[l] = 0;
        }
    }

    fn join(&mut self, l: usize, walk: &Walk<f64>) {
        let state = &walk.state;
        (self.w[l], self.rate[l]) = (state.at.w, state.at.rate);
        (self.sin[l], self.cos[l]) = (state.at.sin, state.at.cos);
        (self.side[l], self.age[l]) = (state.side, state.age);
    }

    fn leave(&self, l: usize, walk: &mut Walk<f64>) {
        let state = &mut walk.state;
        state.at = Start { w: self.w[l], rate: self.rate[l], sin: self.sin[l], cos: self.cos[l] };
        (state.side, state.age) = (self.side[l], self.age[l]);
    }
}

#[inline(always)]
fn times(x: &Lanes, y: &Lanes) -> Lanes {
    array::from_fn(|l| x[l] * y[l])
}

/// A number of each walk; an empty lane computes what the last walk computes, to no effect.
fn gather(walks: &[Walk<f64>], f: impl Fn(&Walk<f64>) -> f64) -> Lanes {
    array::from_fn(|l| f(&walks[l.min(walks.len() - 1)]))
}
