//! When a body overturned, told in the same way from the rotations of either model.

use crate::{housner::topples_with, members::Members, structure::Body};

/// When |theta| last grew past alpha (s), linear between the samples of theta (rad) at t = i dt, if
/// the body lies flat at the last of them, or leans beyond alpha and would fall if the ground
/// stopped there.
///
/// ```
/// use rocking::{overturning::overturned, structure::Structure};
/// let body = Structure::paper().body::<f64>(); // alpha = 0.0997
/// assert_eq!(overturned(&body, 0.5, &[0.0, 0.12, 0.08]), None);
/// let time = overturned(&body, 0.5, &[0.0, 0.12, 0.05, 0.15, 0.4]).unwrap();
/// assert!((time - 0.5 * (2.0 + (body.alpha() - 0.05) / 0.1)).abs() < 1e-15);
/// ```
pub fn overturned(body: &Body<f64>, dt: f64, theta: &[f64]) -> Option<f64> {
    overturned_with(body, Members::default(), dt, theta)
}

/// The same of a body with members, which a tendon may bring back from beyond alpha.
pub fn overturned_with(body: &Body<f64>, members: Members, dt: f64, theta: &[f64]) -> Option<f64> {
    let (&last, before) = theta.split_last()?;
    let alpha = body.alpha();
    let rate = (last - before.last().unwrap_or(&last)) / dt;
    if last.abs() <= alpha || !topples_with(body, members, last, rate) {
        return None;
    }
    let lean = |theta: f64| theta * last.signum();
    let Some(i) = theta.iter().rposition(|&theta| lean(theta) <= alpha) else { return Some(0.0) };
    let (from, to) = (lean(theta[i]), lean(theta[i + 1]));
    Some((i as f64 + (alpha - from) / (to - from)) * dt)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{housner::history, members::Tendon, structure::Structure};

    /// Two ways to the same time: the sampled history, and Housner's solution that located it.
    #[test]
    fn a_housner_history_overturned_when_its_solution_says() {
        let body = Structure::paper().body::<f64>();
        for duration in [7.0, 20.0] {
            let accel = vec![1.5; (100.0 * duration) as usize];
            let rocking = history(&body, 0.01, &accel);
            let (found, exact) =
                (overturned(&body, 0.01, &rocking.theta).unwrap(), rocking.overturned().unwrap());
            assert!((found - exact).abs() < 1e-4, "{found} {exact}");
        }
    }

    #[test]
    fn a_body_that_comes_back_has_not_overturned() {
        let body = Structure::paper().body::<f64>();
        let alpha = body.alpha();
        // beyond alpha, but fast on its way back: theta' = -0.1 rad/s against p (theta - alpha) =
        // 0.004
        assert_eq!(overturned(&body, 0.01, &[0.0, 1.1 * alpha + 1e-3, 1.1 * alpha]), None);
        assert!(overturned(&body, 0.01, &[0.0, 1.1 * alpha + 1e-5, 1.1 * alpha]).is_some());
        assert_eq!(overturned(&body, 0.01, &[]), None);
        assert_eq!(overturned(&body, 0.01, &[2.0 * alpha]), Some(0.0));
    }

    /// 4 times the tension that balances the weight at twice alpha brings it back from there.
    #[test]
    fn a_body_that_a_tendon_pulls_back_has_not_overturned() {
        let body = Structure::paper().body::<f64>();
        let (theta, radius) = (2.0 * body.alpha(), body.radius());
        let theta = [0.0, 0.99 * theta, theta];
        let weight = body.mass * crate::scalar::GRAVITY;
        // m g R sin(theta - alpha) against k (l - h) at about the arm b, l - h about b theta
        let stiffness = 4.0 * weight * radius * body.alpha() / (body.half_width.powi(2) * theta[2]);
        let held = |stiffness| {
            let tendon = Some(Tendon { stiffness, pretension: 0.0 });
            overturned_with(&body, Members { tendon, ..Members::default() }, 0.01, &theta)
        };
        assert_eq!(held(stiffness), None);
        assert!(held(0.1 * stiffness).is_some() && overturned(&body, 0.01, &theta).is_some());
    }
}
