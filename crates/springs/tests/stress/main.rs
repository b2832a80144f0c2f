//! Random cases of every kind: no panic, no NaN, no hang; every history ends in motion or in a said
//! outcome, its energy account within its bound.
//!
//! `STRESS=100000 cargo test --release --test stress` runs more of them, `STRESS_SEED=7` that one
//! alone.

#![allow(clippy::print_stderr)]

mod draw;

use std::{
    collections::BTreeMap,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

use draw::Draw;
use dynamics::compare::Match;
use dynamics::fem::{self, Analysis, Control, Start};
use rayon::prelude::*;
use rocking::{
    housner::{self, RockingOptions},
    motion::Motion,
};

/// Steps allowed to one finite element history. A user's may take a hundred times as many; here it
/// is the bound itself that is under test, and springs of 2 kHz without damping do meet it.
const MOST_STEPS: usize = 20_000;

/// Seeds that once created energy: a foot passed the ground while the other one trailed.
const ONCE_WRONG: [u64; 8] = [18_478, 25_387, 29_730, 53_921, 64_143, 70_467, 70_907, 92_058];

/// Seeds asked for.
fn seeds() -> Vec<u64> {
    let number = |name| std::env::var(name).ok().and_then(|text| text.parse().ok());
    match number("STRESS_SEED") {
        Some(seed) => vec![seed],
        None => (0..number("STRESS").unwrap_or(2000)).chain(ONCE_WRONG).collect(),
    }
}

/// Run `case` on every seed in parallel; it returns a word for what happened, or what is wrong.
fn all(case: impl Fn(u64) -> Result<&'static str, String> + Sync) -> BTreeMap<&'static str, usize> {
    let (words, faults) = (Mutex::new(BTreeMap::new()), AtomicUsize::new(0));
    seeds().into_par_iter().for_each(|seed| match case(seed) {
        Ok(word) => *words.lock().unwrap().entry(word).or_insert(0) += 1,
        Err(fault) => {
            // the first few tell enough
            if faults.fetch_add(1, Ordering::Relaxed) < 40 {
                eprintln!("seed {seed}: {fault}");
            }
        }
    });
    let (words, faults) = (words.into_inner().unwrap(), faults.into_inner());
    eprintln!("{words:?}, {faults} faults");
    assert_eq!(faults, 0, "see above");
    words
}

fn finite(motion: &Motion) -> bool {
    [&motion.u, &motion.v, &motion.theta].into_iter().flatten().all(|x| x.is_finite())
}

fn require(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}

#[test]
fn finite_element_histories_are_finite_close_their_account_and_say_how_they_ended() {
    let words = all(|seed| {
        let mut draw = Draw::new(seed);
        let structure = draw.structure();
        let springs = draw.springs().chains(structure.mass_kg);
        let (dt, accel) = draw.record();
        let body = structure.body::<f64>();
        let start = if draw.one_in(3) {
            Start::Leaning(body.alpha() * draw.between(-1.2, 1.2))
        } else {
            Start::Settled
        };
        let control = Control { most_steps: MOST_STEPS, ..Control::default() };
        let history =
            Analysis { start, control, ..Analysis::new(body, springs, dt, &accel) }.simulate();

        let (outcome, motion, account) = (history.outcome, &history.motion, &history.account);
        require(finite(motion), || format!("not finite, {outcome:?}"))?;
        let residual = history.energy_residual;
        require(residual < 1e-6, || format!("residual {residual:e}, {outcome:?}"))?;
        let largest =
            account.stored.iter().chain(&account.input).fold(0.0_f64, |m, e| m.max(e.abs()));
        let fell = account.dissipated.windows(2).map(|w| w[0] - w[1]).fold(0.0, f64::max);
        require(fell <= 1e-6 * largest, || {
            format!("energy created: {:e}, {outcome:?}", fell / largest)
        })?;
        let steps = history.work.steps + history.work.rejected;
        require(steps <= MOST_STEPS, || format!("{steps} steps"))?;
        let rocking = housner::history(&body, dt, &accel);
        let matched = Match::new(
            &body,
            dt,
            (&rocking.motion(&body), &rocking.impacts[..]),
            &history,
            body.restitution(),
        );
        require(!matched.nrmse_horizontal.is_nan() && !matched.nrmse_vertical.is_nan(), || {
            format!("{matched:?}")
        })?;
        require(matched.restitution_error_max.is_finite(), || format!("{matched:?}"))?;
        Ok(match outcome {
            fem::HistoryOutcome::Completed if motion.len() != accel.len() => {
                return Err("samples missing".into());
            }
            fem::HistoryOutcome::Completed => "completed",
            fem::HistoryOutcome::Overturned { .. } => "overturned",
            fem::HistoryOutcome::Stopped { .. } => return Err("nobody asked to stop".into()),
            fem::HistoryOutcome::WorkBound { .. } => "work bound",
            fem::HistoryOutcome::Unstable { .. } => "unstable",
        })
    });
    let (bound, count) =
        (words.get("work bound").copied().unwrap_or(0), words.values().sum::<usize>());
    assert!(count < 100 || bound * 10 < count, "{bound} of {count} reached the bound on steps");
}

#[test]
fn rigid_histories_are_finite_and_say_how_they_ended_alone_and_in_lock_step() {
    all(|seed| {
        let mut draw = Draw::new(seed);
        let (dt, accel) = draw.record();
        let cases: Vec<_> = (0..3)
            .map(|_| {
                let body = draw.structure().body::<f64>();
                let restitution = match draw.between(0.0, 6.0) as u32 {
                    0 => Some(0.0),
                    1 => Some(1.0),
                    2 => Some(draw.between(0.0, 1.0)),
                    _ => None,
                };
                let barrier = (body.p_squared() * 2.0 * (1.0 - body.alpha().cos())).sqrt();
                let initial = draw.one_in(3).then(|| {
                    (body.alpha() * draw.between(-1.2, 1.2), barrier * draw.between(-1.2, 1.2))
                });
                let vertical = draw.one_in(2).then(|| draw.log(1e-3, 3.0)).map(|factor| {
                    accel.iter().rev().map(|a| factor * a).collect::<Vec<f64>>().into()
                });
                (
                    body,
                    RockingOptions {
                        restitution,
                        initial,
                        vertical,
                        max_work: MOST_STEPS,
                        ..RockingOptions::default()
                    },
                )
            })
            .collect();
        let (bodies, options): (Vec<_>, Vec<_>) = cases.into_iter().unzip();
        let together = housner::solve_lanes(&bodies, dt, &accel, &options);
        let mut word = "never moved";
        for ((body, options), lane) in bodies.iter().zip(&options).zip(&together) {
            let alone = housner::solve(body, dt, &accel, options);
            require(alone == *lane, || "lock-step differs".into())?;
            let motion = alone.motion(body);
            require(finite(&motion) && alone.rate.iter().all(|x| x.is_finite()), || {
                "not finite".into()
            })?;
            require(motion.len() <= accel.len() && alone.rate.len() == motion.len(), || {
                "samples".into()
            })?;
            let whole = motion.len() == accel.len();
            word = match alone.outcome {
                housner::RockingOutcome::NeverMoved | housner::RockingOutcome::Rocked if !whole => {
                    return Err(format!(
                        "{} of {} samples, {:?}",
                        motion.len(),
                        accel.len(),
                        alone.outcome
                    ));
                }
                housner::RockingOutcome::NeverMoved => word,
                housner::RockingOutcome::Rocked => "rocked",
                housner::RockingOutcome::Overturned { .. } => "overturned",
                housner::RockingOutcome::LeavesGround { time }
                    if !(0.0..accel.len() as f64 * dt).contains(&time) =>
                {
                    return Err(format!("leaves the ground at {time} s"));
                }
                housner::RockingOutcome::LeavesGround { .. } => "leaves the ground",
                housner::RockingOutcome::WorkBound { .. } => "work bound",
                other @ housner::RockingOutcome::NotFinite { .. } => {
                    return Err(format!("{other:?}"));
                }
            };
            // a rate that grows over an impact, or impacts out of order
            let mut last = 0.0;
            for impact in &alone.impacts {
                let gained = impact.rate_after.abs() > impact.rate_before.abs() * (1.0 + 1e-15);
                require(impact.time >= last && !gained, || format!("{impact:?} after {last}"))?;
                last = impact.time;
            }
        }
        Ok(word)
    });
}
