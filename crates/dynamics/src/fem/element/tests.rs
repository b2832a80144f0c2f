//! The ladder energy -> force -> tangent, and the power taken, for every element.

use super::*;
use crate::fem::{
    model::N,
    tests::{moved, slopes},
};
use rocking::structure::Body;

const Q: Vector = [0.4, 0.03, 0.07, 0.0, 0.0, 0.0, 0.0];
const V: Vector = [0.5, -0.2, 0.3, 0.0, 0.0, 0.0, 0.0];

const TENDON: TendonElement =
    TendonElement { stiffness: 4e6, elongation: 0.0, settled: 0.0, height: 9.0, pretension: 0.0 };

fn body() -> Body<f64> {
    Body { mass: 1e5, half_width: 1.05, height: 9.0, inertia: 2e5 }
}

/// Every element, by name.
fn all() -> Vec<(&'static str, Box<dyn Element>)> {
    let tendon = |slack: f64| TendonElement { elongation: 9.0 - slack, ..TENDON };
    vec![
        ("dampers", Box::new(Dampers::new(3e4, &body()))),
        ("dampers aloft", Box::new(Dampers::new(3e4, &body()).aloft())),
        ("tendon", Box::new(tendon(8.9))),
        ("slack tendon", Box::new(tendon(9.9))),
    ]
}

/// Forces scale with the largest stiffness times a metre: 4e6 N.
const SCALE: f64 = 4e6;

#[test]
fn forces_at_rest_are_minus_the_slope_of_the_energy() {
    for (name, element) in all() {
        let force = element.force(&Q, &[0.0; N]);
        for (k, f) in force.iter().enumerate() {
            let [slope] = slopes(2e-3, |t| [element.energy(&moved(&Q, k, t))]);
            assert!((f + slope).abs() < 1e-12 * SCALE, "{name}, {k}: {f}, {slope}");
        }
    }
}

#[test]
fn tangents_are_minus_the_slopes_of_the_force() {
    for (name, element) in all() {
        let tangent = element.tangent(&Q, &V);
        for j in 0..3 {
            let by_place = slopes(2e-3, |t| element.force(&moved(&Q, j, t), &V));
            let by_rate = slopes(2e-3, |t| element.force(&Q, &moved(&V, j, t)));
            for i in 0..3 {
                let (k, c) = (tangent.stiffness[i][j], tangent.damping[i][j]);
                let (by_place, by_rate) = (by_place[i], by_rate[i]);
                assert!((k + by_place).abs() < 1e-12 * SCALE, "{name}, K {i} {j}: {k} {by_place}");
                assert!((c + by_rate).abs() < 1e-12 * SCALE, "{name}, C {i} {j}: {c} {by_rate}");
            }
        }
    }
}

#[test]
fn the_power_taken_is_that_of_the_force_beyond_its_potential() {
    for (name, element) in all() {
        let (moving, resting) = (element.force(&Q, &V), element.force(&Q, &[0.0; N]));
        let power: f64 = (0..3).map(|k| (resting[k] - moving[k]) * V[k]).sum();
        assert!(
            (element.dissipation(&Q, &V) - power).abs() < 1e-12 * SCALE && power >= 0.0,
            "{name}: {power}"
        );
    }
}

#[test]
fn a_slack_tendon_does_nothing_and_an_upright_one_pulls_by_its_stretch() {
    let tendon = TendonElement { elongation: 0.1, ..TENDON };
    let still = [0.0; N];
    // 0.1 m of stretch, upright
    assert!((tendon.tension(&still) - 4e5).abs() < 1e-6 && tendon.energy(&still) == 0.0);
    // lowered by more than that it has given 20 kJ
    let lowered = moved(&still, Z, -0.2);
    assert!((tendon.energy(&lowered) + 2e4).abs() < 1e-6 && tendon.tension(&lowered) == 0.0);
    // a stretch far below what rounding makes of the height
    let hardly = moved(&still, Z, 1e-20);
    assert!((tendon.energy(&hardly) / 4e-15 - 1.0).abs() < 1e-12, "{}", tendon.energy(&hardly));
    assert_eq!(tendon.force(&still, &still)[0], 0.0);
    let slack = TendonElement { elongation: -0.9, ..tendon };
    assert_eq!((slack.tension(&Q), slack.energy(&Q), slack.force(&Q, &V)), (0.0, 0.0, [0.0; 3]));
}
