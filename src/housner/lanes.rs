//! Many structures in lock-step on one record.
//!
//! A plain step is the same operations for every lane, so that they run side by side in vector registers; a lane whose interval holds
//! an event, or that rests, takes that interval by itself. No operation is contracted or reordered, so a lane's result is that of the single
//! walk, bit for bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use std::array;

use super::Rocking;
use super::series::{LEAST, SHORT, Start, change, coefficients, end_slope, is_plain, turned};
use super::walk::{Pace, Walk, turns_well};

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
    at_pace(walks)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn walk_avx512(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    at_pace(walks)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    at_pace(walks)
}

#[inline(always)]
fn at_pace(walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
    match walks.first().map(|walk| walk.pace) {
        Some(Pace::Slow) => lock_step::<LEAST>(Pace::Slow, walks),
        _ => lock_step::<SHORT>(Pace::Walk, walks),
    }
}

/// Lanes of another pace go by themselves.
#[inline(always)]
fn lock_step<const N: usize>(pace: Pace, mut walks: Vec<Walk<f64>>) -> Vec<Rocking<f64>> {
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
    let mut kept = Kept::default();
    // the lane's state stands in `at`, its last samples in `kept`, not in its walk
    let mut joined = [false; WIDTH];
    let mut running = [false; WIDTH];
    running[..walks.len()].fill(true);
    let full = running;
    let shortest = walks.iter().map(|walk| walk.set.accel.len()).min().unwrap_or(0);
    for (i, &now) in accel.iter().enumerate() {
        let next = accel.get(i + 1).copied().unwrap_or(0.0);
        if i.is_multiple_of(KEPT) {
            for l in (0..walks.len()).filter(|&l| joined[l]) {
                kept.hand_over(l, &mut walks[l], i);
            }
        }
        if joined != [false; WIDTH] {
            kept.theta[i % KEPT] = times(&at.w, &at.side);
            kept.rate[i % KEPT] = times(&at.rate, &at.side);
            step::<N>(&fixed, &at, now, next, &mut to);
        }
        let plain = to.plain.map(|plain| plain != 0.0);
        let well = at.turns_well(&to);
        if joined == full && i + 1 < shortest && plain == [true; WIDTH] {
            at.all_take(&to);
            for l in chosen(well.map(|well| !well)) {
                at.turn(l, &to, fixed.alpha[l]);
            }
            continue;
        }
        let mut who: [bool; WIDTH] = array::from_fn(|l| plain[l] & joined[l]);
        if i + 1 >= shortest {
            for l in (0..walks.len()).filter(|&l| i + 1 >= walks[l].set.accel.len()) {
                who[l] = false;
            }
        }
        at.some_take(&to, &who);
        for l in chosen(array::from_fn(|l| who[l] & !well[l])) {
            at.turn(l, &to, fixed.alpha[l]);
        }
        for l in chosen(array::from_fn(|l| running[l] & !who[l])) {
            let walk = &mut walks[l];
            let last = i + 1 >= walk.set.accel.len();
            let tried = joined[l];
            if tried {
                kept.hand_over(l, walk, i + 1);
                at.leave(l, walk);
                joined[l] = false;
            } else {
                running[l] = walk.arrive(i);
            }
            // what does not step with the others goes on by itself
            running[l] &= !last;
            let lies = !walk.state.rocking && now.abs() <= walk.quiet && next.abs() <= walk.quiet;
            if running[l] && !lies {
                running[l] = walk.advance(i, fixed.unit[l] * now, fixed.unit[l] * next, tried);
                joined[l] = running[l] && walk.state.rocking && walk.pace == pace && walk.is_up();
                if joined[l] {
                    at.join(l, walk);
                    kept.since[l] = i + 1;
                }
            }
        }
        if running == [false; WIDTH] {
            break;
        }
    }
    walks.into_iter().map(Walk::end).collect()
}

/// Samples of the joined lanes that are kept until handed over to their walks together.
const KEPT: usize = 32;

#[derive(Default)]
struct Kept {
    theta: [Lanes; KEPT],
    rate: [Lanes; KEPT],
    /// The first sample kept of each lane.
    since: [usize; WIDTH],
}

impl Kept {
    /// Lane l's samples before `until`.
    #[inline(always)]
    fn hand_over(&mut self, l: usize, walk: &mut Walk<f64>, until: usize) {
        let kept = self.since[l]..until;
        walk.out.theta.extend(kept.clone().map(|i| self.theta[i % KEPT][l]));
        walk.out.rate.extend(kept.map(|i| self.rate[i % KEPT][l]));
        self.since[l] = until;
    }
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
fn step<const N: usize>(fixed: &Fixed, at: &Joined, now: f64, next: f64, to: &mut Step) {
    // one loop of straight arithmetic, which the compiler turns into vector operations
    for l in 0..WIDTH {
        let start = Start { w: at.w[l], rate: at.rate[l], sin: at.sin[l], cos: at.cos[l] };
        let (a0, a1) = (fixed.unit[l] * now, fixed.unit[l] * next);
        let (b0, db) = (a0 * at.side[l], (a1 - a0) * at.side[l]);
        let c: [f64; N] = coefficients(&start, fixed.dt, b0, db, fixed.q[l]);
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
    /// Whose step needs no new sines.
    #[inline(always)]
    fn turns_well(&self, to: &Step) -> [bool; WIDTH] {
        array::from_fn(|l| turns_well(self.age[l] + 1, to.change[l]))
    }

    /// All lanes make the step.
    #[inline(always)]
    fn all_take(&mut self, to: &Step) {
        (self.w, self.rate, self.sin, self.cos) = (to.w, to.rate, to.sin, to.cos);
        self.age = self.age.map(|age| age + 1);
    }

    /// Some lanes make the step.
    #[inline(always)]
    fn some_take(&mut self, to: &Step, who: &[bool; WIDTH]) {
        let select = |new: &Lanes, old: &Lanes| array::from_fn(|l| if who[l] { new[l] } else { old[l] });
        self.w = select(&to.w, &self.w);
        self.rate = select(&to.rate, &self.rate);
        self.sin = select(&to.sin, &self.sin);
        self.cos = select(&to.cos, &self.cos);
        self.age = array::from_fn(|l| self.age[l] + u32::from(who[l]));
    }

    /// Lane l, which made the step, takes new sines.
    #[inline(always)]
    fn turn(&mut self, l: usize, to: &Step, alpha: f64) {
        (self.sin[l], self.cos[l]) = (alpha - to.w[l]).sin_cos();
        self.age[l] = 0;
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

/// The lanes of which it is true, one after the other.
#[inline(always)]
fn chosen(which: [bool; WIDTH]) -> impl Iterator<Item = usize> {
    let mut left = (0..WIDTH).fold(0_u32, |bits, l| bits | (u32::from(which[l]) << l));
    std::iter::from_fn(move || {
        let l = left.trailing_zeros();
        left &= left.wrapping_sub(1);
        (l < WIDTH as u32).then_some(l as usize)
    })
}

#[inline(always)]
fn times(x: &Lanes, y: &Lanes) -> Lanes {
    array::from_fn(|l| x[l] * y[l])
}

/// A number of each walk; an empty lane computes what the last walk computes, to no effect.
fn gather(walks: &[Walk<f64>], f: impl Fn(&Walk<f64>) -> f64) -> Lanes {
    array::from_fn(|l| f(&walks[l.min(walks.len() - 1)]))
}
