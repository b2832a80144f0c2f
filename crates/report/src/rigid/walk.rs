//! How far feet on springs walk, which Housner's stay where they are.
//!
//! ```text
//!   walked = u - u(theta)      what the centre of mass moves besides what its rotation does
//! ```

use parameters::answers::ModelComparison;
use results::Finding;
use rocking::{
    motion::{largest_magnitude, samples_until},
    structure::Body,
};

/// Share of the largest displacement of the centre of mass, and of the half width, above which it
/// is said: below, it is the sway of the springs.
const LEAST: (f64, f64) = (0.02, 1e-3);

/// That they walk, of a body whose feet shall not slide; `dt` is that of the record (s).
pub(super) fn finding(body: &Body<f64>, dt: f64, both: &ModelComparison) -> Option<Finding> {
    let friction = both.with.as_ref().is_some_and(|with| with.members.friction.is_some());
    let fell = both.with.as_ref().map_or(&both.matched, |with| &with.matched).overturned_fem_s;
    let motion = &both.answer().motion;
    let standing = samples_until(fell, dt).min(motion.len());
    walked(body, &motion.u[..standing], &motion.theta[..standing]).filter(|_| !friction)
}

/// The same of displacements of the centre of mass (m) and rotations (rad).
fn walked(body: &Body<f64>, u: &[f64], theta: &[f64]) -> Option<Finding> {
    let walked: Vec<f64> = u.iter().zip(theta).map(|(u, theta)| u - body.u(*theta)).collect();
    let (largest_m, end_m) = (largest_magnitude(&walked), walked.last()?.abs());
    let least = (LEAST.0 * largest_magnitude(u)).max(LEAST.1 * body.half_width);
    (largest_m > least).then_some(Finding::WalksOnSprings { largest_m, end_m })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::structure::Structure;

    /// A body that leans without walking, and one whose feet stand 5 mm and then 3 mm aside.
    #[test]
    fn what_rotation_does_not_move_is_walked() {
        let body = Structure::block(2.0, 0.5, 1e3).unwrap().body::<f64>();
        let theta = [0.0, 0.1, -0.05];
        let u = theta.map(|theta| body.u(theta));
        assert_eq!(walked(&body, &u, &theta), None);
        let aside = [u[0], u[1] + 0.005, u[2] + 0.003];
        let Some(Finding::WalksOnSprings { largest_m, end_m }) = walked(&body, &aside, &theta)
        else {
            panic!("5 mm of {u:?} are not told")
        };
        assert!((largest_m - 0.005).abs() < 1e-12 && (end_m - 0.003).abs() < 1e-12);
        assert_eq!(walked(&body, &[], &[]), None);
    }
}
