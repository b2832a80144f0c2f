//! Structures in lock-step against the same structures one by one: bit for bit.

use rocking::housner::{
    RockingOptions, RockingOutcome, RockingSummary, solve, solve_lanes, summaries,
};
use rocking::structure::{Body, Structure};
use strong_motion::Record;

use super::{block, scaled};

/// Tall and small, frames and blocks: some never move, some rest and lift again, some overturn.
fn bodies() -> Vec<Body<f64>> {
    let mut bodies = vec![Structure::paper().body()];
    for i in 1..20 {
        let height = 0.3 * 1.4_f64.powi(i);
        let alpha = 0.06 + 0.013 * f64::from(i);
        bodies.push(block(height, height * alpha.tan()));
        bodies.push(Structure::a_frame(height, height * alpha.tan(), 1.0).unwrap().body());
    }
    bodies
}

#[test]
fn lanes_give_what_single_walks_give_bit_for_bit() {
    let accel = Record::el_centro().accel;
    let options = [0.6, 1.0, 2.5].map(scaled);
    let bodies = bodies();
    let together = solve_lanes(&bodies, 0.01, &accel, &options);
    assert_eq!(together.len(), bodies.len());
    let mut outcomes = [0; 3];
    for (i, lane) in together.iter().enumerate() {
        let single = solve(&bodies[i], 0.01, &accel, &options[i % 3]);
        assert_eq!(*lane, single, "lane {i}");
        outcomes[match lane.outcome {
            RockingOutcome::Rocked => 0,
            RockingOutcome::NeverMoved => 1,
            _ => 2,
        }] += 1;
    }
    assert!(outcomes.iter().all(|&count| count > 0), "{outcomes:?}");
}

#[test]
fn one_body_on_many_scales_and_durations() {
    let accel = Record::el_centro().accel;
    let options: Vec<RockingOptions<f64>> = (0..11)
        .map(|i| RockingOptions {
            scale: 0.5 + 0.2 * f64::from(i),
            duration: Some(3.0 * f64::from(i)),
            ..RockingOptions::default()
        })
        .collect();
    let body = Structure::paper().body::<f64>();
    for (lane, options) in solve_lanes(&[body], 0.01, &accel, &options).iter().zip(&options) {
        assert_eq!(*lane, solve(&body, 0.01, &accel, options));
    }
}

/// More of one pace than go on one thread, so that lanes take up one history after the other; with
/// vertical motion and without, of other durations, some of them released.
#[test]
fn lanes_that_are_taken_again_give_what_single_walks_give_bit_for_bit() {
    let record = Record::el_centro();
    let up: std::sync::Arc<[f64]> = record.accel.iter().map(|a| 0.6 * a).rev().collect();
    for vertical in [None, Some(up)] {
        let options: Vec<RockingOptions<f64>> = (0..700)
            .map(|i| RockingOptions {
                scale: 0.4 + 0.005 * f64::from(i),
                duration: Some(0.02 * f64::from(i)),
                initial: (i % 7 == 0).then_some((1e-4 * f64::from(i), -0.01)),
                vertical: vertical.clone(),
                ..RockingOptions::default()
            })
            .collect();
        let bodies = bodies();
        let together = solve_lanes(&bodies, 0.01, &record.accel, &options);
        let summed = summaries(&bodies, 0.01, &record.accel, &options);
        assert_eq!((together.len(), summed.len()), (700, 700));
        for (i, (lane, summary)) in together.iter().zip(&summed).enumerate() {
            let single = solve(&bodies[i % bodies.len()], 0.01, &record.accel, &options[i]);
            assert_eq!(*lane, single, "lane {i}");
            assert_eq!(*summary, single.summary(), "lane {i}");
        }
        assert!(summed.iter().any(|summary| summary.overturned().is_some()));
    }
}

#[test]
fn a_summary_is_what_the_samples_say() {
    let accel = Record::el_centro().accel;
    for body in bodies() {
        let single = solve(&body, 0.01, &accel, &scaled(1.0));
        let largest = single.theta.iter().fold(0.0, |most: f64, theta| most.max(theta.abs()));
        let expected = RockingSummary {
            outcome: single.outcome,
            samples: single.theta.len(),
            peak: largest,
            last: (*single.theta.last().unwrap(), *single.rate.last().unwrap()),
            impacts: single.impacts.len(),
        };
        let all = [scaled(1.0), scaled(1.0), scaled(1.0), scaled(1.0)];
        assert_eq!(summaries(&[body], 0.01, &accel, &all), vec![expected; 4]);
    }
}

#[test]
fn no_body_or_no_sample_gives_nothing() {
    assert!(solve_lanes(&[], 0.01, &[1.0], &[RockingOptions::default()]).is_empty());
    let rocking =
        solve_lanes(&[Structure::paper().body()], 0.01, &[], &[RockingOptions::default()]);
    assert_eq!((rocking.len(), rocking[0].theta.len()), (1, 0));
}
