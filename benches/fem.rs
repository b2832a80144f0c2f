//! The finite element history, 20 s of El Centro: the springs of both procedures, and springs of any stiffness.

use std::{hint::black_box, time::Duration};

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use groundspring::fem::Control;

#[path = "compare/main.rs"]
#[cfg_attr(not(test), allow(dead_code))] // its benches alone
mod compare;

use compare::elements::BenchCase;

fn fem(c: &mut Criterion) {
    let mut group = c.benchmark_group("finite elements");
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2)).sample_size(30);
    for bench in [BenchCase::arr(), BenchCase::impact()] {
        for (name, control) in [("default", Control::default()), ("search", Control::search())] {
            group.bench_function(BenchmarkId::new(bench.name, name), |b| b.iter(|| bench.simulate(black_box(control))));
        }
    }
    for hz in [20.0, 80.0, 160.0, 320.0, 1280.0] {
        let bench = BenchCase::plain(hz);
        group.bench_function(BenchmarkId::new("stiffness", hz), |b| {
            b.iter(|| bench.simulate(black_box(Control::default())))
        });
    }
    group.finish();
}

criterion_group!(benches, fem);
criterion_main!(benches);
