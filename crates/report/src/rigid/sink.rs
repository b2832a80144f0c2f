//! How far a body at rest presses its springs down, and what tilt lifts a foot off them.
//!
//! ```text
//!   k s = m g/2,   k b theta = m g/2      theta = s/b      k: k1 and k2 in series
//! ```

use results::Finding;
use rocking::structure::Body;

/// Share of the distance between the feet from which it is said.
const LEAST: f64 = 0.01;

/// That it sinks so far, of its settlement at rest (m).
pub(super) fn finding(body: &Body<f64>, settlement_m: f64) -> Option<Finding> {
    let share_of_width = settlement_m / (2.0 * body.half_width);
    let lifts_at_share = settlement_m / (body.half_width * body.alpha());
    (share_of_width > LEAST).then_some(Finding::SinksOnSprings {
        settlement_m,
        share_of_width,
        lifts_at_share,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::structure::Structure;

    /// Springs of a body that weighs 981 N, 0.5 m wide and 2 m high: of 49.05 kN/m each they are
    /// pressed down by 10 mm, and a tilt of 10 mm in 0.25 m takes that from one of them.
    #[test]
    fn a_foot_lifts_when_its_spring_is_free() {
        let body = Structure::block(2.0, 0.5, 100.0).unwrap().body::<f64>();
        let sinks = 0.5 * 100.0 * 9.81 / 49.05e3;
        let Some(Finding::SinksOnSprings { share_of_width, lifts_at_share, .. }) =
            finding(&body, sinks)
        else {
            panic!("{sinks} m is not told")
        };
        assert!((share_of_width - 0.02).abs() < 1e-12);
        let tilt = lifts_at_share * 0.25_f64.atan();
        // the force that is left on the lifting foot
        assert!((0.5 * 981.0 - 49.05e3 * 0.25 * tilt).abs() < 1e-9);
        assert_eq!(finding(&body, 0.4 * sinks), None);
    }
}
