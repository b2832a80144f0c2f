//! The ladder energy -> force -> tangent, and the power taken, for every element.

use num_dual::Dual64;

use super::*;
use crate::fem::model::N;
use rocking::structure::Body;

const Q: Vector<f64> = [0.4, 0.03, 0.07, 0.0, 0.0, 0.0, 0.0];
const V: Vector<f64> = [0.5, -0.2, 0.3, 0.0, 0.0, 0.0, 0.0];

fn body<S: Scalar>() -> Body<S> {
    Body {
        mass: S::from(1e5),
        half_width: S::from(1.05),
        height: S::from(9.0),
        inertia: S::from(2e5),
    }
}

/// Every element, by name.
fn all<S: Scalar>() -> Vec<(&'static str, Box<dyn Element<S>>)> {
    let tendon = |slack: f64| TendonElement {
        stiffness: S::from(4e6),
        slack: S::from(slack),
        height: S::from(9.0),
        pretension: S::zero(),
    };
    vec![
        ("dampers", Box::new(Dampers::new(S::from(3e4), &body()))),
        ("tendon", Box::new(tendon(8.9))),
        ("slack tendon", Box::new(tendon(9.9))),
    ]
}

fn seeded(x: &Vector<f64>, j: usize) -> Vector<Dual64> {
    std::array::from_fn(|k| Dual64::new(x[k], if k == j { 1.0 } else { 0.0 }))
}

/// Forces scale with the largest stiffness times a metre: 4e6 N.
const SCALE: f64 = 4e6;

#[test]
fn forces_at_rest_are_minus_the_slope_of_the_energy() {
    for ((name, real), (_, dual)) in all::<f64>().iter().zip(all::<Dual64>()) {
        let force = real.force(&Q, &[0.0; N]);
        for (k, f) in force.iter().enumerate() {
            let slope = dual.energy(&seeded(&Q, k)).eps;
            assert!((f + slope).abs() < 1e-12 * SCALE, "{name}, {k}: {f}, {slope}");
        }
    }
}

#[test]
fn tangents_are_minus_the_slopes_of_the_force() {
    for ((name, real), (_, dual)) in all::<f64>().iter().zip(all::<Dual64>()) {
        let tangent = real.tangent(&Q, &V);
        for j in 0..3 {
            let by_place = dual.force(&seeded(&Q, j), &V.map(Dual64::from_re));
            let by_rate = dual.force(&Q.map(Dual64::from_re), &seeded(&V, j));
            for i in 0..3 {
                let (k, c) = (tangent.stiffness[i][j], tangent.damping[i][j]);
                assert!(
                    (k + by_place[i].eps).abs() < 1e-12 * SCALE,
                    "{name}, K {i} {j}: {k}, {}",
                    by_place[i].eps
                );
                assert!(
                    (c + by_rate[i].eps).abs() < 1e-12 * SCALE,
                    "{name}, C {i} {j}: {c}, {}",
                    by_rate[i].eps
                );
            }
        }
    }
}

#[test]
fn the_power_taken_is_that_of_the_force_beyond_its_potential() {
    for (name, element) in all::<f64>() {
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
    let tendon = TendonElement { stiffness: 4e6, slack: 8.9, height: 9.0, pretension: 0.0 };
    let still = [0.0; N];
    // 0.1 m of stretch, upright
    assert!(
        (tendon.tension(&still) - 4e5).abs() < 1e-6 && (tendon.energy(&still) - 2e4).abs() < 1e-6
    );
    assert_eq!(tendon.force(&still, &still)[0], 0.0);
    let slack = TendonElement { slack: 9.9, ..tendon };
    assert_eq!((slack.tension(&Q), slack.energy(&Q), slack.force(&Q, &V)), (0.0, 0.0, [0.0; 3]));
}
