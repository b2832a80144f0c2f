//! Many bodies on one record.

use std::sync::Arc;

use super::samples::WalkSamples;
use super::walk::{Setting, Walk};
use super::{Rocking, RockingOptions, RockingOutcome, lanes, setting, start};
use crate::structure::Body;

/// As many at least go in lock-step: fewer are sooner done one by one.
const FEW: usize = 3;
/// As many at most on one thread: lanes that find no more to do are then few beside the others.
const MANY: usize = 8 * lanes::WIDTH;

/// Rock many bodies on one record, or one body on many scales of it, sixteen at a time in
/// lock-step, on every thread; each result is, bit for bit, that of the body rocked alone; those
/// with a tendon or dampers are rocked one by one. The longer of the two lists decides how many
/// there are; the shorter one is repeated from its start. Without bodies, or without options, there
/// are no histories. Options with the same vertical record (clones of one `Arc`) go side by side.
pub fn solve_lanes(
    bodies: &[Body<f64>],
    dt: f64,
    accel: &[f64],
    options: &[RockingOptions<f64>],
) -> Vec<Rocking<f64>> {
    answers(bodies, dt, accel, options)
}

/// As [`solve_lanes`], for who needs no samples.
pub fn summaries(
    bodies: &[Body<f64>],
    dt: f64,
    accel: &[f64],
    options: &[RockingOptions<f64>],
) -> Vec<RockingSummary> {
    answers(bodies, dt, accel, options)
}

/// What a history came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockingSummary {
    /// How it ended.
    pub outcome: RockingOutcome,
    /// Number of its samples.
    pub samples: usize,
    /// The largest |theta| of them (rad).
    pub peak: f64,
    /// theta (rad) and theta' (rad/s) at the last of them; zero where there is none.
    pub last: (f64, f64),
    /// Number of its impacts.
    pub impacts: usize,
}

impl RockingSummary {
    /// When |theta| last grew past alpha, if the body overturned (s).
    pub fn overturned(&self) -> Option<f64> {
        self.outcome.overturned()
    }
}

/// What is made of a walk.
trait WalkAnswer: Send {
    /// Of a history of n samples at most.
    fn samples(n: usize) -> WalkSamples<f64>;
    fn of<const V: bool>(walk: Walk<'_, f64, V>) -> Self;
}

impl WalkAnswer for Rocking<f64> {
    fn samples(n: usize) -> WalkSamples<f64> {
        WalkSamples::kept(n)
    }

    fn of<const V: bool>(walk: Walk<'_, f64, V>) -> Self {
        walk.end()
    }
}

impl WalkAnswer for RockingSummary {
    fn samples(_: usize) -> WalkSamples<f64> {
        WalkSamples::looked_at()
    }

    fn of<const V: bool>(walk: Walk<'_, f64, V>) -> Self {
        let WalkSamples { count, peak, last, .. } = walk.samples;
        let Rocking { impacts, outcome, .. } = walk.end();
        Self { outcome, samples: count, peak, last, impacts: impacts.len() }
    }
}

fn answers<A: WalkAnswer>(
    bodies: &[Body<f64>],
    dt: f64,
    accel: &[f64],
    options: &[RockingOptions<f64>],
) -> Vec<A> {
    if bodies.is_empty() || options.is_empty() {
        return Vec::new();
    }
    let all: Vec<_> = (0..bodies.len().max(options.len()))
        .map(|i| (i, &bodies[i % bodies.len()], &options[i % options.len()]))
        .collect();
    let mut grounds: Vec<Option<&Arc<[f64]>>> = Vec::new();
    for (_, _, options) in &all {
        if !grounds.iter().any(|&ground| is_same(ground, options.vertical.as_ref())) {
            grounds.push(options.vertical.as_ref());
        }
    }
    let mut placed = Vec::with_capacity(all.len());
    for ground in grounds {
        let those = all
            .iter()
            .filter(|(_, _, options)| is_same(ground, options.vertical.as_ref()))
            .map(|&(i, body, options)| (i, setting(body, dt, accel, options), start(options)));
        match ground {
            None => together::<false, A>(those, &mut placed),
            Some(_) => together::<true, A>(those, &mut placed),
        }
    }
    placed.sort_by_key(|(i, _)| *i);
    placed.into_iter().map(|(_, answer)| answer).collect()
}

fn is_same(a: Option<&Arc<[f64]>>, b: Option<&Arc<[f64]>>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

/// The answers of bodies on one ground, each with its place: side by side where they take the same
/// steps.
fn together<'a, const V: bool, A: WalkAnswer>(
    those: impl Iterator<Item = (usize, Setting<'a, f64>, (f64, f64))>,
    placed: &mut Vec<(usize, A)>,
) {
    let mut walks: Vec<_> = those
        .map(|(i, set, start)| {
            let samples = A::samples(set.accel.len());
            (i, Walk::<f64, V>::new(set, start, samples))
        })
        .collect();
    let order = |walk: &Walk<f64, V>| (walk.set.restraint.is_some(), walk.pace);
    walks.sort_by_key(|(_, walk)| order(walk));
    let alike: Vec<usize> =
        walks.chunk_by(|(_, a), (_, b)| order(a) == order(b)).map(<[_]>::len).collect();
    let mut walks = walks.into_iter();
    let mut chunks = Vec::new();
    for mut left in alike {
        let share =
            left.div_ceil(parallel::idle_threads()).next_multiple_of(lanes::WIDTH).min(MANY);
        while left > 0 {
            let chunk: Vec<_> = walks.by_ref().take(left.min(share)).collect();
            left -= chunk.len();
            chunks.push(chunk);
        }
    }
    let done: Vec<Vec<_>> = parallel::map_owned(chunks, |chunk| {
        let (places, walks): (Vec<_>, Vec<_>) = chunk.into_iter().unzip();
        places.into_iter().zip(walked(walks)).map(|(i, walk)| (i, A::of(walk))).collect()
    });
    placed.extend(done.into_iter().flatten());
}

/// Walks of one pace, to their ends.
fn walked<const V: bool>(mut walks: Vec<Walk<'_, f64, V>>) -> Vec<Walk<'_, f64, V>> {
    let alone = |walk: &Walk<f64, V>| walk.set.restraint.is_some();
    if walks.len() < FEW || walks.iter().any(alone) {
        walks.iter_mut().for_each(Walk::go_to_end);
    } else {
        lanes::walk(&mut walks);
    }
    walks
}
