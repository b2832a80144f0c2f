//! What the body's weight does to a landing: the old foot goes on pressing for a moment after the
//! new one has touched.
//!
//! ```text
//!   the new foot's spring presses with k1 v t, which lifts both feet by   y = Omega_n^2 v t^3/6
//!   the old foot's force  m g - k1 y  ends at                             Omega_n t = (6 g/(Omega_n v))^(1/3)
//!   its impulse until then                                                J_old = (3/4) m g t
//!   H_new = H_before + 2b J_old, so that                                  de/e = 3 6^(1/3) (m R^2/I0) sin^2(alpha) (g/(Omega_n v))^(4/3)
//! ```
//!
//! v is the speed with which the new foot lands. To leading order in g/(Omega_n v) and for slender
//! bodies, whose feet rise alike; the give of the absorber, of order (g/(Omega_n v))^2/K, takes
//! part of it back. No (mu, f, xi) changes it: it is what a landing errs by when all else is right,
//! and it falls with Omega_n alone. Landings of a body of alpha 0.5 err about three times as much.

/// Relative error of the restitution, above 0, of a body that falls from a lean of `lean` alpha:
/// slenderness `alpha` (rad), m R^2/I0 and Omega_n/p.
pub fn restitution_error(alpha: f64, mass_share: f64, stiffness: f64, lean: f64) -> f64 {
    factor(alpha, mass_share) / hardness(alpha, mass_share, stiffness, lean).powf(4.0 / 3.0)
}

/// Omega_n/p at which that error is `error`.
pub fn stiffness(alpha: f64, mass_share: f64, error: f64, lean: f64) -> f64 {
    (factor(alpha, mass_share) / error).powf(0.75) / hardness(alpha, mass_share, 1.0, lean)
}

fn factor(alpha: f64, mass_share: f64) -> f64 {
    3.0 * 6f64.cbrt() * mass_share * alpha.sin().powi(2)
}

/// Omega_n v/g, v = 2b p alpha sqrt(lean (2 - lean)) by the small-angle theory, g = p^2 R (I0/m
/// R^2).
fn hardness(alpha: f64, mass_share: f64, stiffness: f64, lean: f64) -> f64 {
    2.0 * mass_share * alpha.powi(2) * stiffness * (lean * (2.0 - lean)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two feet that rise alike on springs k1 = 1, mass 1, time in 1/Omega_n, followed in small
    /// steps: the old foot's impulse.
    #[test]
    fn the_impulse_of_the_old_foot_is_that_of_a_mass_on_two_springs() {
        for weight in [1e-4_f64, 1e-3] {
            let (mut y, mut speed, mut t, mut impulse) = (0.0, 0.0, 0.0, 0.0);
            let step = 1e-6;
            while y < weight {
                let (old, new) = (weight - y, t - y);
                impulse += old * step;
                speed += (old + new - weight) * step;
                y += speed * step;
                t += step;
            }
            let expected = 0.75 * weight * (6.0 * weight).cbrt();
            println!("{weight}: {impulse:.3e} {expected:.3e}");
            assert!((impulse / expected - 1.0).abs() < 0.01);
        }
    }

    #[test]
    fn stiffness_and_error_belong_together() {
        for (alpha, share, error, lean) in [(0.05, 0.75, 1e-5, 0.02), (0.4, 1.0, 1e-6, 0.5)] {
            let found = restitution_error(alpha, share, stiffness(alpha, share, error, lean), lean);
            assert!((found / error - 1.0).abs() < 1e-12);
        }
    }
}
