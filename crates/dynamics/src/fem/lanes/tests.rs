//! Lanes compiled for different processors give the same histories.

use std::ops::ControlFlow;

use super::*;
use crate::{
    fem::{Control, View},
    spring::{Design, Springs},
};
use rocking::structure::Structure;
use strong_motion::Record;

/// Every bit of what a history shows at its samples.
#[derive(Default, PartialEq)]
struct Bits(Vec<u64>);

impl Observer for Bits {
    fn sample(&mut self, _: usize, view: &View) -> ControlFlow<()> {
        self.0.extend(
            [view.x(), view.theta(), view.theta_rate(), view.energy.residual()].map(f64::to_bits),
        );
        ControlFlow::Continue(())
    }
}

/// A frame without rotational inertia and a block, at an error of 1e-4 and of 1e-8, with steps over
/// several samples and without.
#[test]
fn avx_512_avx_2_and_no_vectors_at_all_agree_to_the_last_bit() {
    let record = Record::el_centro().truncated(12.0);
    let frame = Structure::paper();
    let block = Structure::block(2.0, 0.5, 1e3).unwrap();
    let cases: Vec<Analysis> = (0..20)
        .map(|i| {
            let structure = if i % 2 == 0 { frame } else { block };
            let chain = Design::from_kc(0.5, 0.2, 0.92, [160.0, 40.0, 2500.0][i % 3]);
            let (body, long_steps) = (structure.body::<f64>(), i % 5 != 0);
            Analysis {
                scale: 0.7 + 0.1 * i as f64,
                control: Control {
                    tolerance: [1e-4, 1e-8][i % 2],
                    long_steps,
                    ..Control::default()
                },
                ..Analysis::new(
                    body,
                    Springs { vertical: chain, horizontal: chain }.chains(body.mass),
                    record.dt,
                    &record.accel,
                )
            }
        })
        .collect();
    let models: Vec<Model> = cases.iter().map(Analysis::model).collect();
    let followed = |step: Step| {
        let next = AtomicUsize::new(0);
        let mut batch = Batch {
            cases: &cases,
            models: &models,
            next: &next,
            observer: &|_| Bits::default(),
            done: vec![],
        };
        batch.lanes(step);
        batch.done.sort_by_key(|(index, ..)| *index);
        batch.done
    };
    let all: Vec<_> = steps().into_iter().map(followed).collect();
    let plain = all.last().unwrap();
    assert_eq!(plain.len(), cases.len());
    assert!(plain.iter().any(|(.., finish)| finish.work.events > 10));
    for other in &all {
        for ((i, bits, finish), (_, expected, plain)) in other.iter().zip(plain) {
            assert_eq!((finish.outcome, finish.work), (plain.outcome, plain.work), "{i}");
            assert!(bits == expected, "{i}");
        }
    }
}
