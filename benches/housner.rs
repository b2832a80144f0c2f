//! Housner's equation, 20 s of El Centro: one structure, many in lock-step, diffsol beside them.

use std::{hint::black_box, time::Duration};

use comparison::rigid::RockingProblem;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rocking::housner::{RockingOptions, solve, solve_lanes};

mod diffsol;

fn housner(c: &mut Criterion) {
    let problem = RockingProblem::el_centro();
    let (body, dt, accel) = (&problem.body, problem.record.dt, &problem.record.accel);
    let options = RockingOptions::default();
    let mut group = c.benchmark_group("housner");
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    group.bench_function("one", |b| b.iter(|| solve(body, dt, black_box(accel), &options)));
    let bodies = [*body; 64];
    group.throughput(Throughput::Elements(64));
    group.bench_function("64 in lock-step", |b| {
        b.iter(|| solve_lanes(&bodies, dt, black_box(accel), std::slice::from_ref(&options)))
    });
    group.finish();
}

fn peers(c: &mut Criterion) {
    let problem = RockingProblem::el_centro();
    let case = diffsol::DiffsolHistory::of(&problem);
    let error = problem.error(&case.theta(1e-9).expect("diffsol follows the record"));
    assert!(error < 1e-10, "diffsol's error is {error:e} m");
    let mut group = c.benchmark_group("housner");
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    group.bench_function("diffsol", |b| b.iter(|| black_box(&case).theta(1e-9)));
    group.finish();
}

criterion_group!(benches, housner, peers);
criterion_main!(benches);
