//! The finite element history, 20 s of El Centro: the springs of both procedures, and springs of
//! any stiffness.

use std::{
    hint::black_box,
    ops::ControlFlow,
    time::{Duration, Instant},
};

use comparison::elements::BenchCase;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use dynamics::fem::{Analysis, Control, Observer, View, histories};

fn fem(c: &mut Criterion) {
    let mut group = c.benchmark_group("finite elements");
    group
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(30);
    for bench in [BenchCase::arr(), BenchCase::damped()] {
        for (name, control) in [("default", Control::default()), ("search", Control::search())] {
            group.bench_function(BenchmarkId::new(bench.name, name), |b| {
                b.iter(|| bench.simulate(black_box(control)))
            });
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

/// 64 histories of 20 s of El Centro at scales of 0.8 to 1.3, at an error of 1e-4: one after the
/// other, and in lanes on one thread.
fn lanes(c: &mut Criterion) {
    let mut group = c.benchmark_group("lanes");
    group
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3))
        .sample_size(20);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for bench in [BenchCase::arr(), BenchCase::plain(160.0), BenchCase::plain(10_240.0)] {
        let control = Control { tolerance: 1e-4, long_steps: true, ..Control::default() };
        let cases: Vec<Analysis> =
            (0..64).map(|i| bench.case(0.8 + f64::from(i) / 128.0, control)).collect();
        ratio(&bench, &cases, &threads);
        group.throughput(Throughput::Elements(64));
        let name = format!("{}, {} Hz", bench.name, bench.springs.vertical.omega_n_hz);
        group.bench_function(BenchmarkId::new(&name, "every sample"), |b| {
            let control = Control { long_steps: false, ..control };
            b.iter(|| cases.iter().map(|case| peak(&Analysis { control, ..*case })).sum::<f64>())
        });
        group.bench_function(BenchmarkId::new(&name, "one by one"), |b| {
            b.iter(|| cases.iter().map(peak).sum::<f64>())
        });
        group.bench_function(BenchmarkId::new(&name, "side by side"), |b| {
            b.iter(|| threads.install(|| histories(black_box(&cases), |_| Peak(0.0))))
        });
    }
    group.finish();
}

/// Rounds of either in turn, so that whatever else the machine does slows all.
const ROUNDS: usize = 15;

/// Print what a history costs one by one, with steps that end at every sample and with those over
/// several, and side by side; and the ratios: medians over the rounds.
fn ratio(bench: &BenchCase, cases: &[Analysis], threads: &rayon::ThreadPool) {
    let seconds = |work: &dyn Fn() -> f64| {
        let began = Instant::now();
        black_box(work());
        began.elapsed().as_secs_f64() / cases.len() as f64
    };
    let every = |case: &Analysis| {
        peak(&Analysis { control: Control { long_steps: false, ..case.control }, ..*case })
    };
    let samples = || cases.iter().map(every).sum();
    let alone = || cases.iter().map(peak).sum();
    let lanes = || {
        threads
            .install(|| histories(black_box(cases), |_| Peak(0.0)))
            .iter()
            .map(|(peak, _)| peak.0)
            .sum()
    };
    let rounds: Vec<[f64; 3]> =
        (0..ROUNDS).map(|_| [seconds(&samples), seconds(&alone), seconds(&lanes)]).collect();
    let median = |of: &dyn Fn(&[f64; 3]) -> f64| {
        let mut all: Vec<f64> = rounds.iter().map(of).collect();
        all.sort_by(f64::total_cmp);
        all[ROUNDS / 2]
    };
    println!(
        "{}, {} Hz: one by one {:.3} ms, with long steps {:.3} ms; side by side {:.3} ms a \
         history, {:.2} and {:.2} times cheaper",
        bench.name,
        bench.springs.vertical.omega_n_hz,
        1e3 * median(&|s| s[0]),
        1e3 * median(&|s| s[1]),
        1e3 * median(&|s| s[2]),
        median(&|s| s[0] / s[2]),
        median(&|s| s[1] / s[2])
    );
}

/// Largest rotation at a sample (rad).
struct Peak(f64);

impl Observer for Peak {
    fn sample(&mut self, _: usize, view: &View) -> ControlFlow<()> {
        self.0 = self.0.max(view.theta().abs());
        ControlFlow::Continue(())
    }
}

fn peak(case: &Analysis) -> f64 {
    let mut peak = Peak(0.0);
    case.observe(&mut peak);
    peak.0
}

criterion_group!(benches, fem, lanes);
criterion_main!(benches);
