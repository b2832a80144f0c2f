//! Reference stories of theory.md, section 9 (V1, V2): printed by an independent program.

use frames::reference::{ElasticRocking, ReferenceOptions, ReferenceOutcome, What};
use rocking::motion::largest_magnitude;

use crate::piers::{free_rocking, heavy, light, tight};

/// Coordinate i at the samples.
fn coordinate(history: &ElasticRocking, i: usize) -> Vec<f64> {
    history.q.iter().map(|q| q[i]).collect()
}

/// What is printed of a story.
struct Printed<'a> {
    /// Times of the landings (s).
    landings: &'a [f64],
    /// theta' before and after the first (rad/s), and how many digits after the point.
    rates: [f64; 2],
    /// Energy before and after it (J).
    energy: [f64; 2],
    /// Largest and smallest theta (rad).
    theta: [f64; 2],
    /// Largest and smallest u (m).
    u: [f64; 2],
}

/// Every digit that is printed.
fn assert_printed(history: &ElasticRocking, printed: &Printed) {
    let close = |found: f64, printed: f64, digit: f64, what: &str| {
        assert!((found - printed).abs() <= 0.6 * digit, "{what}: {found} for {printed}");
    };
    assert_eq!(history.outcome, ReferenceOutcome::Completed);
    let landings: Vec<_> = history.landings().collect();
    assert_eq!(landings.len(), printed.landings.len());
    for (event, time) in landings.iter().zip(printed.landings) {
        close(event.time, *time, 1e-7, "time");
    }
    for k in 0..2 {
        close(landings[0].velocity[k][2], printed.rates[k], 1e-8, "theta'");
        close(landings[0].energy[k], printed.energy[k], 0.01, "energy");
    }
    for (i, extremes) in [(2, printed.theta), (3, printed.u)] {
        let x = coordinate(history, i);
        close(x.iter().copied().fold(f64::MIN, f64::max), extremes[0], 1e-9, "largest");
        close(x.iter().copied().fold(f64::MAX, f64::min), extremes[1], 1e-9, "smallest");
    }
}

#[test]
fn v1_a_light_footing_lands_on_both_corners_and_hops() {
    let history = free_rocking(&light(), 0.0975, 5.0, &tight());
    let printed = Printed {
        landings: &[1.4610186, 1.5597634, 4.1152838, 4.2125930],
        rates: [-0.15132406, 0.0],
        energy: [1032065.65, 996547.96],
        theta: [0.0975, -0.085968752],
        u: [0.033147477, -0.033043248],
    };
    assert_printed(&history, &printed);
    // the second landing ends a hop: no corner was on the ground
    let hop = &history.events[2];
    assert!(hop.what == What::Lift && hop.held.is_empty());
}

#[test]
fn v2_a_heavy_footing_lands_on_one_corner() {
    let history = free_rocking(&heavy(), 0.15, 6.0, &tight());
    let printed = Printed {
        landings: &[1.1914084, 2.9505034, 4.3513030, 5.5141050],
        rates: [-0.27871328, -0.17237671],
        energy: [1812940.83, 1410853.48],
        theta: [0.15, -0.100123234],
        u: [0.084968721, -0.096814759],
    };
    assert_printed(&history, &printed);
    assert!(history.landings().all(|event| event.held.len() == 1));
}

/// The default tolerance costs less and is good to 1e-7 of the peaks.
#[test]
fn the_default_tolerance_follows_the_tight_one() {
    for (pier, theta) in
        [(light(), 0.0975), (heavy(), 0.15), (light().with_axial(4e9, 0.02), 0.0975)]
    {
        let tight = free_rocking(&pier, theta, 4.0, &tight());
        let quick = free_rocking(&pier, theta, 4.0, &ReferenceOptions::default());
        for i in [2, 3] {
            let (a, b) = (coordinate(&tight, i), coordinate(&quick, i));
            let peak = largest_magnitude(&a);
            let worst = a.iter().zip(&b).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()));
            assert!(worst < 1e-7 * peak, "{worst} of {peak}");
        }
    }
}
