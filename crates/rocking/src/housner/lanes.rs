//! Many structures in lock-step on one record.
//!
//! A plain step is the same operations for every lane, so that they run side by side in vector
//! registers; a lane whose interval holds an event, or that rests, takes that interval by itself.
//! No operation is contracted or reordered, so a lane's result is that of the single walk, bit for
//! bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use std::{array, mem::swap};

use super::series::{
    LEAST, SHORT, StepGround, StepStart, change, coefficients, end_slope, is_plain, pulls, turned,
};
use super::walk::{Pace, Sample, Walk, turns_well};
use super::{Rocking, contact};

/// Structures in lock-step.
pub(crate) const WIDTH: usize = 16;

/// A number for each lane.
type PerLane = [f64; WIDTH];

/// A bit for each lane, as wide as a number.
type Mask = u64;

/// The walks of at most [`WIDTH`] structures on one record, to their ends.
pub(crate) fn walk<const V: bool>(walks: Vec<Walk<f64, V>>) -> Vec<Rocking<f64>> {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512dq")
        {
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
fn walk_avx512<const V: bool>(walks: Vec<Walk<f64, V>>) -> Vec<Rocking<f64>> {
    at_pace(walks)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2<const V: bool>(walks: Vec<Walk<f64, V>>) -> Vec<Rocking<f64>> {
    at_pace(walks)
}

#[inline(always)]
fn at_pace<const V: bool>(walks: Vec<Walk<f64, V>>) -> Vec<Rocking<f64>> {
    match walks.first().map(|walk| walk.pace) {
        Some(Pace::Slow) => lock_step::<V, LEAST>(Pace::Slow, walks),
        _ => lock_step::<V, SHORT>(Pace::Walk, walks),
    }
}

/// Lanes of another pace go by themselves.
#[inline(always)]
fn lock_step<const V: bool, const N: usize>(
    pace: Pace,
    mut walks: Vec<Walk<f64, V>>,
) -> Vec<Rocking<f64>> {
    let Some(longest) = walks.iter().max_by_key(|walk| walk.set.accel.len()) else {
        return Vec::new();
    };
    let (accel, vertical, dt) = (longest.set.accel, longest.set.vertical, longest.set.dt);
    let up = |i: usize| if V { vertical.get(i).copied().unwrap_or(0.0) } else { 0.0 };
    let shortest = walks.iter().map(|walk| walk.set.accel.len()).min().unwrap_or(0);
    let fixed = Fixed::<N>::new(&walks, dt);
    let (mut at, mut to) = (&mut LanePlaces::default(), &mut LanePlaces::default());
    let mut kept = Kept::default();
    let mut running = (1 << walks.len()) - 1;
    // the lane's state stands in `at`, its last samples in `kept`, not in its walk
    let mut joined = 0;
    for (i, &now) in accel.iter().enumerate() {
        let next = accel.get(i + 1).copied().unwrap_or(0.0);
        let (now, next) = ((now, up(i)), (next, up(i + 1)));
        if i.is_multiple_of(KEPT) {
            for l in lanes(joined) {
                kept.hand_over(l, &mut walks[l], i);
            }
        }
        let mut plain = 0;
        if joined != 0 {
            kept.theta[i % KEPT] = array::from_fn(|l| turned_by(at.w[l], at.sign[l]));
            kept.rate[i % KEPT] = array::from_fn(|l| turned_by(at.rate[l], at.sign[l]));
            let (steps, ages) = step::<V, N>(&fixed, at, now, next, to);
            plain = steps & joined;
            if i + 1 >= shortest {
                plain &= !ended(&walks, i + 1);
            }
            for l in lanes(ages & plain) {
                to.turn(l, fixed.alpha[l]);
            }
        }
        for l in lanes(running & !plain) {
            let (walk, lane) = (&mut walks[l], 1 << l);
            let tried = joined & lane != 0;
            let mut runs = true;
            if tried {
                at.leave(l, walk);
            } else if walk.out.theta.len() <= i {
                runs = walk.arrive(i);
                if runs && !walk.state.rocking {
                    walk.lie(i);
                }
            }
            // its history goes on: it lies
            if walk.out.theta.len() > i + 1 {
                continue;
            }
            // what does not step with the others goes on by itself
            runs = runs
                && i + 1 < walk.set.accel.len()
                && walk.advance(i, fixed.sample::<V>(l, now), fixed.sample::<V>(l, next), tried);
            if runs && walk.state.rocking && walk.pace == pace && walk.is_up() {
                to.join(l, walk);
                if !tried {
                    kept.since[l] = i + 1;
                }
                joined |= lane;
            } else {
                if tried {
                    kept.hand_over(l, walk, i + 1);
                }
                joined &= !lane;
            }
            if !runs {
                running &= !lane;
            }
        }
        if running == 0 {
            break;
        }
        swap(&mut at, &mut to);
    }
    walks.into_iter().map(Walk::end).collect()
}

impl<const N: usize> Fixed<N> {
    #[inline(always)]
    fn new<const V: bool>(walks: &[Walk<f64, V>], dt: f64) -> Self {
        Self {
            dt,
            unit: gather(walks, |walk| walk.set.unit),
            alpha: gather(walks, |walk| walk.set.alpha),
            q: gather(walks, |walk| walk.q),
            root: gather(walks, |walk| walk.q.sqrt()),
            pulls: array::from_fn(|k| gather(walks, |walk| pulls::<_, N>(walk.q)[k])),
            share: gather(walks, |walk| walk.set.share()),
            arm: gather(walks, |walk| walk.set.arm_of(dt)),
        }
    }
}

/// Samples of the joined lanes that are kept until handed over to their walks together.
const KEPT: usize = 32;

#[derive(Default)]
struct Kept {
    theta: [PerLane; KEPT],
    rate: [PerLane; KEPT],
    /// The first sample kept of each lane.
    since: [usize; WIDTH],
}

impl Kept {
    /// Lane l's samples before `until`, none of them handed over before. Not in line: as vector
    /// code it would gather numbers from far apart, which is slower than one load after the other.
    #[inline(never)]
    fn hand_over<const V: bool>(&mut self, l: usize, walk: &mut Walk<f64, V>, until: usize) {
        let first = self.since[l] % KEPT;
        let kept = first..first + (until - self.since[l]);
        walk.out.theta.extend(self.theta[kept.clone()].iter().map(|lanes| lanes[l]));
        walk.out.rate.extend(self.rate[kept].iter().map(|lanes| lanes[l]));
        self.since[l] = until;
    }
}

/// What does not change along the walk.
struct Fixed<const N: usize> {
    dt: f64,
    unit: PerLane,
    alpha: PerLane,
    q: PerLane,
    /// p dt.
    root: PerLane,
    pulls: [PerLane; N],
    /// m R^2/I0, and R/(g dt^2).
    share: PerLane,
    arm: PerLane,
}

impl<const N: usize> Fixed<N> {
    /// The ground as lane l has it, from the record's numbers: horizontal, vertical (m/s2).
    #[inline(always)]
    fn sample<const V: bool>(&self, l: usize, (accel, vertical): (f64, f64)) -> Sample<f64> {
        Sample {
            a: self.unit[l] * accel,
            gamma: if V { self.unit[l] * vertical + 1.0 } else { 1.0 },
        }
    }
}

/// Where the joined lanes are; what the others have here is of no effect.
#[derive(Default)]
struct LanePlaces {
    w: PerLane,
    rate: PerLane,
    sin: PerLane,
    cos: PerLane,
    /// The sign bit of the side.
    sign: [u64; WIDTH],
    age: [u64; WIDTH],
}

/// One interval of the record for all lanes: those of which one step takes the whole interval, and
/// those that need new sines after it.
#[inline(always)]
fn step<const V: bool, const N: usize>(
    fixed: &Fixed<N>,
    at: &LanePlaces,
    now: (f64, f64),
    next: (f64, f64),
    to: &mut LanePlaces,
) -> (Mask, Mask) {
    let mut bits = [0; WIDTH];
    // one loop of straight arithmetic, which the compiler turns into vector operations
    for l in 0..WIDTH {
        let start = StepStart { w: at.w[l], rate: at.rate[l], sin: at.sin[l], cos: at.cos[l] };
        let (now, next) = (fixed.sample::<V>(l, now), fixed.sample::<V>(l, next));
        let ground = StepGround {
            b: turned_by(now.a, at.sign[l]),
            db: turned_by(next.a - now.a, at.sign[l]),
            gamma: now.gamma,
            dgamma: next.gamma - now.gamma,
        };
        let c = coefficients::<_, V, N>(
            &start,
            fixed.dt,
            &ground,
            &array::from_fn(|k| fixed.pulls[k][l]),
        );
        let change = change(&c);
        let w = start.w + change;
        let (sin, cos) = turned(start.sin, start.cos, change);
        to.w[l] = w;
        to.rate[l] = end_slope(&c) * (1.0 / fixed.dt);
        to.sin[l] = sin;
        to.cos[l] = cos;
        to.sign[l] = at.sign[l];
        to.age[l] = at.age[l] + 1;
        let mut plain =
            is_plain::<V, N>(&c, &ground, (fixed.q[l], fixed.root[l]), w, fixed.alpha[l]);
        if V {
            plain &= contact::surely_presses(&c, start.sin, &ground, fixed.share[l], fixed.arm[l]);
        }
        let old = !turns_well(to.age[l], change);
        bits[l] = if plain { 1 << l } else { 0 } | if old { 1 << (l + WIDTH) } else { 0 };
    }
    let all = bits.iter().fold(0, |all, bits| all | bits);
    (all & ((1 << WIDTH) - 1), all >> WIDTH)
}

impl LanePlaces {
    /// Lane l takes new sines.
    #[inline(always)]
    fn turn(&mut self, l: usize, alpha: f64) {
        (self.sin[l], self.cos[l]) = (alpha - self.w[l]).sin_cos();
        self.age[l] = 0;
    }

    fn join<const V: bool>(&mut self, l: usize, walk: &Walk<f64, V>) {
        let state = &walk.state;
        (self.w[l], self.rate[l]) = (state.at.w, state.at.rate);
        (self.sin[l], self.cos[l]) = (state.at.sin, state.at.cos);
        (self.sign[l], self.age[l]) = (state.side.to_bits() & SIGN, state.age);
    }

    fn leave<const V: bool>(&self, l: usize, walk: &mut Walk<f64, V>) {
        let state = &mut walk.state;
        state.at =
            StepStart { w: self.w[l], rate: self.rate[l], sin: self.sin[l], cos: self.cos[l] };
        state.age = self.age[l];
    }
}

/// The lanes of a mask, one after the other.
#[inline(always)]
fn lanes(mut mask: Mask) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let l = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (l < WIDTH).then_some(l)
    })
}

/// The lanes whose records end before sample i.
fn ended<const V: bool>(walks: &[Walk<f64, V>], i: usize) -> Mask {
    (0..).zip(walks).fold(0, |mask, (l, walk)| mask | Mask::from(i >= walk.set.accel.len()) << l)
}

const SIGN: u64 = 1 << 63;

/// x times the side of which that is the sign bit: what a multiplication gives, for less.
#[inline(always)]
fn turned_by(x: f64, sign: u64) -> f64 {
    f64::from_bits(x.to_bits() ^ sign)
}

/// A number of each walk; an empty lane computes what the last walk computes, to no effect.
fn gather<const V: bool>(walks: &[Walk<f64, V>], f: impl Fn(&Walk<f64, V>) -> f64) -> PerLane {
    array::from_fn(|l| f(&walks[l.min(walks.len() - 1)]))
}
