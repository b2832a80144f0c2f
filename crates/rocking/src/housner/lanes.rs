//! Many structures in lock-step on one record.
//!
//! A plain step is the same operations for every lane, so that they run side by side in vector
//! registers. Each lane is at a sample of its own: a body that rests, or whose interval holds an
//! event, goes on alone to where it rocks freely again, and where a history ends the lane takes
//! the next one. No operation is contracted or reordered, so a lane's result is that of the single
//! walk, bit for bit, on any machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use std::{array, mem::swap, ops::Range};

use super::contact;
use super::numbers::LaneNumbers;
pub(crate) use super::numbers::WIDTH;
use super::series::{
    LEAST, LONG, SHORT, StepGround, StepStart, change, coefficients, end_slope, is_plain, pulls,
    turned,
};
use super::walk::{Pace, Sample, Walk, turns_well};

/// A number for each lane.
type PerLane = [f64; WIDTH];

/// A bit for each lane, as wide as a number.
type Mask = u64;

/// Take structures of one pace on one record to the ends of their histories.
pub(crate) fn walk<const V: bool>(walks: &mut [Walk<f64, V>]) {
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
    at_pace(walks);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn walk_avx512<const V: bool>(walks: &mut [Walk<f64, V>]) {
    at_pace(walks);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2<const V: bool>(walks: &mut [Walk<f64, V>]) {
    at_pace(walks);
}

#[inline(always)]
fn at_pace<const V: bool>(walks: &mut [Walk<f64, V>]) {
    match walks.first().map(|walk| walk.pace) {
        None => (),
        Some(Pace::Slow) => lock_step::<V, LEAST>(walks),
        Some(Pace::Walk) => lock_step::<V, SHORT>(walks),
        Some(Pace::Fast) => lock_step::<V, LONG>(walks),
    }
}

#[inline(always)]
fn lock_step<const V: bool, const N: usize>(walks: &mut [Walk<f64, V>]) {
    let Some(longest) = walks.iter().max_by_key(|walk| walk.set.accel.len()) else { return };
    let mut lane = LaneWalks::new(longest.set.accel, longest.set.vertical);
    let mut fixed = Fixed::<N> { dt: longest.set.dt, ..Fixed::default() };
    let (mut at, mut to) = (&mut LanePlaces::default(), &mut LanePlaces::default());
    let mut kept = Kept::default();
    let mut waiting = 0..walks.len();
    let mut joined = 0;
    for l in 0..WIDTH {
        if lane.take::<V, N>(l, walks, &mut waiting, &mut fixed) {
            at.join(l, &walks[lane.walk[l]]);
            joined |= 1 << l;
        }
    }
    let mut steps = 0;
    while joined != 0 {
        if steps % KEPT == 0 {
            for l in lanes(joined) {
                kept.hand_over(l, &mut walks[lane.walk[l]], steps);
            }
        }
        kept.theta[steps % KEPT] = array::from_fn(|l| turned_by(at.w[l], at.sign[l]));
        kept.rate[steps % KEPT] = array::from_fn(|l| turned_by(at.rate[l], at.sign[l]));
        let next = lane.next_ground::<V>();
        let (taken, old) = step::<V, N>(&fixed, at, &lane.ground, &next, to);
        let plain = taken & joined & lane.goes_on();
        for l in lanes(old & plain) {
            to.turn(l, fixed.alpha[l]);
        }
        lane.move_on(next);
        steps += 1;
        // the lane's state stands in `at`, its last samples in `kept`, not in its walk
        for l in lanes(joined & !plain) {
            let (walk, i) = (&mut walks[lane.walk[l]], lane.sample[l]);
            at.leave(l, walk);
            let runs = i < walk.set.accel.len()
                && walk.advance(i - 1, walk.ground(i - 1), walk.ground(i), true);
            if !(runs && walk.rocks()) {
                kept.hand_over(l, walk, steps);
                let later = if runs { alone(walk, i) } else { None };
                match later {
                    Some(i) => lane.is_at::<V>(l, i),
                    None if lane.take::<V, N>(l, walks, &mut waiting, &mut fixed) => (),
                    None => {
                        joined &= !(1 << l);
                        continue;
                    }
                }
            }
            to.join(l, &walks[lane.walk[l]]);
        }
        swap(&mut at, &mut to);
    }
}

/// Take a walk that is not with the others on from sample i, which is not noted yet, to the sample
/// from which it can step with them; none if its history ends before.
fn alone<const V: bool>(walk: &mut Walk<f64, V>, mut i: usize) -> Option<usize> {
    let samples = walk.set.accel.len();
    loop {
        if i < samples && walk.rocks() {
            return Some(i);
        }
        if !walk.arrive(i) {
            return None;
        }
        i = walk.lie(i);
        if i + 1 >= samples || !walk.advance(i, walk.ground(i), walk.ground(i + 1), false) {
            return None;
        }
        i += 1;
    }
}

/// What each lane follows, and where in the record it is.
struct LaneWalks<'a> {
    accel: &'a [f64],
    vertical: &'a [f64],
    walk: [usize; WIDTH],
    sample: [usize; WIDTH],
    /// The last sample of the lane's history.
    last: [usize; WIDTH],
    /// The ground's acceleration at the sample (m/s2): horizontal, vertical.
    ground: [PerLane; 2],
}

impl<'a> LaneWalks<'a> {
    fn new(accel: &'a [f64], vertical: &'a [f64]) -> Self {
        let (none, ground) = ([0; WIDTH], [[0.0; WIDTH]; 2]);
        Self { accel, vertical, walk: none, sample: none, last: none, ground }
    }

    /// Lane l takes the next walk that comes to where it rocks; false if none is left.
    fn take<const V: bool, const N: usize>(
        &mut self,
        l: usize,
        walks: &mut [Walk<f64, V>],
        waiting: &mut Range<usize>,
        fixed: &mut Fixed<N>,
    ) -> bool {
        for next in waiting {
            let walk = &mut walks[next];
            if let Some(i) = alone(walk, 0) {
                (self.walk[l], self.last[l]) = (next, walk.set.accel.len() - 1);
                self.is_at::<V>(l, i);
                fixed.set(l, walk);
                return true;
            }
        }
        false
    }

    /// Lane l is at sample i.
    fn is_at<const V: bool>(&mut self, l: usize, i: usize) {
        self.sample[l] = i;
        self.ground[0][l] = self.accel[i];
        self.ground[1][l] = self.up::<V>(i);
    }

    fn up<const V: bool>(&self, i: usize) -> f64 {
        if V { self.vertical.get(i).copied().unwrap_or(0.0) } else { 0.0 }
    }

    /// The ground at the lanes' next samples; at rest beyond the record.
    #[inline(always)]
    fn next_ground<const V: bool>(&self) -> [PerLane; 2] {
        let at = |samples: &[f64], i: usize| samples.get(i).copied().unwrap_or(0.0);
        let next = self.sample.map(|i| i + 1);
        let up = if V { next.map(|i| at(self.vertical, i)) } else { [0.0; WIDTH] };
        [next.map(|i| at(self.accel, i)), up]
    }

    /// The lanes whose histories have a next sample.
    #[inline(always)]
    fn goes_on(&self) -> Mask {
        (0..WIDTH).fold(0, |mask, l| mask | Mask::from(self.sample[l] < self.last[l]) << l)
    }

    /// All lanes are at their next samples, with this ground.
    #[inline(always)]
    fn move_on(&mut self, ground: [PerLane; 2]) {
        self.ground = ground;
        for sample in &mut self.sample {
            *sample += 1;
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
        let theta = self.theta[kept.clone()].iter().map(|lanes| lanes[l]);
        walk.samples.extend(theta, self.rate[kept].iter().map(|lanes| lanes[l]));
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
    pulls: [LaneNumbers; N],
    /// m R^2/I0, and R/(g dt^2).
    share: PerLane,
    arm: PerLane,
}

impl<const N: usize> Default for Fixed<N> {
    fn default() -> Self {
        let none = [0.0; WIDTH];
        let pulls = [LaneNumbers(none); N];
        Self {
            dt: 0.0,
            unit: none,
            alpha: none,
            q: none,
            root: none,
            pulls,
            share: none,
            arm: none,
        }
    }
}

impl<const N: usize> Fixed<N> {
    /// Lane l follows this walk.
    fn set<const V: bool>(&mut self, l: usize, walk: &Walk<f64, V>) {
        (self.unit[l], self.alpha[l]) = (walk.set.unit, walk.set.alpha);
        (self.q[l], self.root[l]) = (walk.q, walk.q.sqrt());
        for (all, pull) in self.pulls.iter_mut().zip(pulls::<_, N>(walk.q)) {
            all.0[l] = pull;
        }
        (self.share[l], self.arm[l]) = (walk.set.share(), walk.set.arm_of(self.dt));
    }

    /// The ground as each lane has it, from the record's numbers: horizontal, vertical (m/s2).
    #[inline(always)]
    fn ground<const V: bool>(&self, [accel, vertical]: &[PerLane; 2]) -> Sample<LaneNumbers> {
        let unit = LaneNumbers(self.unit);
        Sample {
            a: unit * LaneNumbers(*accel),
            gamma: if V { unit * LaneNumbers(*vertical) + 1.0 } else { LaneNumbers([1.0; WIDTH]) },
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
    now: &[PerLane; 2],
    next: &[PerLane; 2],
    to: &mut LanePlaces,
) -> (Mask, Mask) {
    let [now, next] = [now, next].map(|ground| fixed.ground::<V>(ground));
    let side = |x: LaneNumbers| LaneNumbers(array::from_fn(|l| turned_by(x.0[l], at.sign[l])));
    let [w, rate, sin, cos] = [at.w, at.rate, at.sin, at.cos].map(LaneNumbers);
    let start = StepStart { w, rate, sin, cos };
    let ground = StepGround {
        b: side(now.a),
        db: side(next.a - now.a),
        gamma: now.gamma,
        dgamma: next.gamma - now.gamma,
    };
    let c = coefficients::<_, V, N>(&start, LaneNumbers([fixed.dt; WIDTH]), &ground, &fixed.pulls);
    let change = change(&c);
    let w = start.w + change;
    let (sin, cos) = turned(start.sin, start.cos, change);
    let rate = end_slope(&c) * (1.0 / fixed.dt);
    (to.w, to.rate, to.sin, to.cos) = (w.0, rate.0, sin.0, cos.0);
    (to.sign, to.age) = (at.sign, at.age.map(|age| age + 1));
    let mut bits = [0; WIDTH];
    for l in 0..WIDTH {
        let c = array::from_fn(|k| c[k].0[l]);
        let ground = StepGround {
            b: ground.b.0[l],
            db: ground.db.0[l],
            gamma: ground.gamma.0[l],
            dgamma: ground.dgamma.0[l],
        };
        let mut plain =
            is_plain::<V, N>(&c, &ground, (fixed.q[l], fixed.root[l]), w.0[l], fixed.alpha[l]);
        if V {
            plain &= contact::surely_presses(&c, at.sin[l], &ground, fixed.share[l], fixed.arm[l]);
        }
        let old = !turns_well(to.age[l], change.0[l]);
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

const SIGN: u64 = 1 << 63;

/// x times the side of which that is the sign bit: what a multiplication gives, for less.
#[inline(always)]
fn turned_by(x: f64, sign: u64) -> f64 {
    f64::from_bits(x.to_bits() ^ sign)
}
