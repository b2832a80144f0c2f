//! The inner fit with its certificate, and the whole job of `tune run` without its figures.

use std::{hint::black_box, time::Duration};

use cases::Case;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use frequency_response::{bounds::Bounds, inner::fit, target::Target};
use springs::job::Job;

fn inner(c: &mut Criterion) {
    let mut group = c.benchmark_group("inner fit");
    group
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(30);
    let (target, bounds) = (Target::default(), Bounds::default());
    for mu in [0.1, 1.0, 10.0] {
        group.bench_function(BenchmarkId::from_parameter(mu), |b| {
            b.iter(|| fit(black_box(mu), &target, &bounds))
        });
    }
    group.finish();
}

fn job(c: &mut Criterion) {
    let case = Case::paper().expect("the paper's case is whole");
    let mut group = c.benchmark_group("job");
    group.measurement_time(Duration::from_secs(10)).sample_size(10);
    group.bench_function("paper", |b| b.iter(|| Job::new(black_box(&case), &|_, _, _| ())));
    group.finish();
}

criterion_group!(benches, inner, job);
criterion_main!(benches);
