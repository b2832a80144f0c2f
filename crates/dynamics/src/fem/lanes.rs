//! Many histories, a few at a time side by side.
//!
//! The steps of [`WIDTH`] histories are tried together, in vector registers (`kernel`); each
//! history goes its own way otherwise: its own time, step size, contacts and events. A history is
//! the same, bit for bit, whether it is followed alone or among others.

mod kernel;

use std::sync::atomic::{AtomicUsize, Ordering};

use super::{
    Analysis, Finish, control::HistoryOutcome, model::Model, observer::Observer, run::TimeLoop,
    step::Stages,
};
use kernel::{Kernel, Tried, WIDTH};

/// Follow many cases, each shown to an observer of its own, which `observer` makes for the case of
/// an index. Returned in the order of the cases.
///
/// Each history is the one that [`Analysis::observe`] gives, bit for bit, on any number of threads
/// and any processor.
pub fn histories<O: Observer + Send>(
    cases: &[Analysis<'_>],
    observer: impl Fn(usize) -> O + Sync,
) -> Vec<(O, Finish)> {
    let models: Vec<Model> = cases.iter().map(Analysis::model).collect();
    let next = AtomicUsize::new(0);
    let threads = parallel::threads().min(cases.len().div_ceil(WIDTH)).max(1);
    let done = parallel::map_range(0..threads, |_| {
        let mut batch =
            Batch { cases, models: &models, next: &next, observer: &observer, done: Vec::new() };
        batch.follow();
        batch.done
    });
    let mut done: Vec<(usize, O, Finish)> = done.into_iter().flatten().collect();
    done.sort_by_key(|(index, ..)| *index);
    done.into_iter().map(|(_, observer, finish)| (observer, finish)).collect()
}

/// What one thread follows of them.
struct Batch<'a, O, F> {
    cases: &'a [Analysis<'a>],
    models: &'a [Model],
    /// The next case that nobody follows yet.
    next: &'a AtomicUsize,
    observer: &'a F,
    done: Vec<(usize, O, Finish)>,
}

/// A history under way.
struct Lane<'a, O> {
    index: usize,
    run: TimeLoop<'a>,
    observer: O,
    /// Size of the step to try (s).
    h: f64,
    /// Whether the kernel was asked for it.
    asked: bool,
}

impl<'a, O: Observer, F: Fn(usize) -> O> Batch<'a, O, F> {
    fn follow(&mut self) {
        if let Some(step) = steps().first() {
            self.lanes(*step);
        }
    }

    fn lanes(&mut self, step: Step) {
        let mut kernel = Box::new(Kernel::new());
        let mut stages = Stages::none();
        let mut lanes: [Option<Lane<'a, O>>; WIDTH] = std::array::from_fn(|_| None);
        loop {
            for (l, lane) in lanes.iter_mut().enumerate().filter(|(_, lane)| lane.is_none()) {
                *lane = self.begin();
                match lane {
                    Some(lane) => kernel.assign(l, &lane.run),
                    None => kernel.leave(l),
                }
            }
            for (l, lane) in lanes.iter_mut().enumerate() {
                if let Some(lane) = lane.as_mut().filter(|lane| !lane.asked) {
                    lane.asked = true;
                    lane.run.submit(lane.h, |state, feet, request, rounding| {
                        kernel.submit(l, state, feet, request, rounding)
                    });
                }
            }
            match lanes.iter().flatten().count() {
                0 => return,
                // a history left over is followed faster by itself
                1 => {
                    for mut lane in lanes.iter_mut().filter_map(Option::take) {
                        let outcome = lane.run.go_on(lane.h, &mut lane.observer);
                        self.end(lane, outcome);
                    }
                    continue;
                }
                _ => step(&mut kernel),
            }
            for (l, slot) in lanes.iter_mut().enumerate() {
                let Some(lane) = slot else { continue };
                let (converged, measures) =
                    match kernel.collect_step(l, lane.run.spans(), &mut stages) {
                        Tried::Step(converged, measures) => (converged, Some(measures)),
                        Tried::GoesOn => continue,
                        Tried::Steep => (lane.run.attempt(lane.h, &mut stages), None),
                    };
                let next = match lane.run.process_step(
                    converged,
                    &mut stages,
                    measures.as_ref(),
                    &mut lane.observer,
                ) {
                    Ok(Some(h)) => Ok(h),
                    Ok(None) => lane.run.plan(&mut lane.observer),
                    Err(outcome) => Err(outcome),
                };
                match next {
                    Ok(h) => (lane.h, lane.asked) = (h, false),
                    Err(outcome) => {
                        if let Some(lane) = slot.take() {
                            self.end(lane, outcome);
                        }
                    }
                }
            }
        }
    }

    /// Set out on the next case; what cannot go side by side with others is followed here and now.
    fn begin(&mut self) -> Option<Lane<'a, O>> {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let (case, model) = (self.cases.get(index)?, &self.models[index]);
            let mut lane = Lane {
                index,
                run: case.run(model),
                observer: (self.observer)(index),
                h: 0.0,
                asked: false,
            };
            let begun = lane.run.begin(case.ground(), &mut lane.observer);
            match begun.and_then(|()| lane.run.plan(&mut lane.observer)) {
                Ok(h) if case.control.skip_open => return Some(Lane { h, ..lane }),
                Ok(h) => {
                    let outcome = lane.run.go_on(h, &mut lane.observer);
                    self.end(lane, outcome);
                }
                Err(outcome) => self.end(lane, outcome),
            }
        }
    }

    fn end(&mut self, lane: Lane<'a, O>, outcome: HistoryOutcome) {
        self.done.push((lane.index, lane.observer, lane.run.finish(outcome)));
    }
}

/// A step of all lanes, compiled for a processor.
type Step = fn(&mut Kernel);

/// Those that this processor has, the widest first.
fn steps() -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512dq")
            && std::arch::is_x86_feature_detected!("avx512vl")
        {
            // SAFETY: the processor has what the function was compiled for
            steps.push(|kernel| unsafe { step_avx512(kernel) });
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: as above
            steps.push(|kernel| unsafe { step_avx2(kernel) });
        }
    }
    steps.push(|kernel| kernel.step());
    steps
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn step_avx512(kernel: &mut Kernel) {
    kernel.step();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn step_avx2(kernel: &mut Kernel) {
    kernel.step();
}

#[cfg(test)]
mod tests;
