//! How sensitive Housner's own answer is: rocking can be unpredictable.
//!
//! ```text
//! sensitivity to x = || du/dln x || / || u ||,   norms over the samples
//! ```
//!
//! for x the width 2b and the record's scale, by one run in dual numbers through uplifts and impacts. At a sensitivity of 3 a change of 0.1 % moves
//! the history by 0.3 %; at 1000 two models that differ by 0.1 % have nothing in common, and only statistics can be compared.
//! A width changes alpha, p and (unless it is given) the restitution; I_cg and the height stay.

use nalgebra::Const;
use num_dual::DualSVec64;

use crate::housner::{Options, solve};
use crate::structure::Body;

/// From this sensitivity on, histories cannot be compared one to one.
pub const ILL_CONDITIONED: f64 = 10.0;

/// Largest sensitivity that is told; beyond it not one digit of a history in double precision is certain.
pub const LARGEST: f64 = 1e15;

/// Relative change of the history u per relative change of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivity {
    /// Per relative change of the width 2b; at most [`LARGEST`].
    pub width: f64,
    /// Per relative change of the record's scale; at most [`LARGEST`].
    pub scale: f64,
}

impl Sensitivity {
    /// The larger of the two.
    pub fn worst(&self) -> f64 {
        self.width.max(self.scale)
    }

    /// Whether a comparison of histories one to one means something: the worst is below 10.
    pub fn well_conditioned(&self) -> bool {
        self.worst() < ILL_CONDITIONED
    }
}

/// The sensitivity of a history: record and options as in [`solve`]. A body that never moves has none: zero.
pub fn sensitivity(body: &Body<f64>, dt: f64, accel: &[f64], options: &Options<f64>) -> Sensitivity {
    type Dual = DualSVec64<2>;
    let real = Dual::from_re;
    let dual_body = Body {
        mass: real(body.mass),
        half_width: (real(0.0).derivative(0) + 1.0) * body.half_width,
        height: real(body.height),
        inertia: real(body.inertia),
    };
    let dual_options = Options {
        scale: (real(0.0).derivative(1) + 1.0) * options.scale,
        restitution: options.restitution.map(real),
        duration: options.duration,
        initial: options.initial.map(|(theta, rate)| (real(theta), real(rate))),
        max_work: options.max_work,
    };
    let rocking = solve(&dual_body, dt, accel, &dual_options);
    let (mut below, mut above) = (0.0, [0.0; 2]);
    for &theta in &rocking.theta {
        let u = dual_body.u(theta);
        below += u.re * u.re;
        let du = u.eps.unwrap_generic(Const::<2>, Const::<1>);
        above[0] += du[0] * du[0];
        above[1] += du[1] * du[1];
    }
    // min takes the number where the derivatives overflowed to a NaN
    let [width, scale] = above.map(|above| if above == 0.0 { 0.0 } else { (above / below).sqrt().min(LARGEST) });
    Sensitivity { width, scale }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Record;
    use crate::structure::Structure;

    fn twenty_seconds() -> Options<f64> {
        Options { duration: Some(20.0), ..Options::default() }
    }

    /// || u(x) - u(-x) || / 2x || u ||, x the relative change of one parameter.
    fn by_differences(history: impl Fn(f64) -> Vec<f64>, x: f64) -> f64 {
        let (plus, minus, middle) = (history(x), history(-x), history(0.0));
        let above: f64 = plus.iter().zip(&minus).map(|(a, b)| (a - b) * (a - b)).sum();
        let below: f64 = middle.iter().map(|u| u * u).sum();
        (above / below).sqrt() / (2.0 * x)
    }

    #[test]
    fn el_centro_agrees_with_finite_differences_and_is_well_conditioned() {
        let body = Structure::paper().body::<f64>();
        let accel = Record::el_centro().accel;
        let found = sensitivity(&body, 0.01, &accel, &twenty_seconds());
        let width = by_differences(
            |x| {
                let body = Body { half_width: body.half_width * (1.0 + x), ..body };
                solve(&body, 0.01, &accel, &twenty_seconds()).motion(&body).u
            },
            1e-6,
        );
        let scale = by_differences(
            |x| {
                let options = Options { scale: 1.0 + x, ..twenty_seconds() };
                solve(&body, 0.01, &accel, &options).motion(&body).u
            },
            1e-6,
        );
        assert!((found.width / width - 1.0).abs() < 1e-6, "{found:?} {width}");
        assert!((found.scale / scale - 1.0).abs() < 1e-6, "{found:?} {scale}");
        // 0.1 % in width moves this history by 0.2 to 0.3 %, measured by others
        assert!((1.5..3.5).contains(&found.width), "{found:?}");
        assert!(found.well_conditioned());
        assert_eq!(found.worst(), found.width.max(found.scale));
    }

    #[test]
    fn a_body_that_never_moves_is_not_sensitive() {
        let body = Structure::paper().body::<f64>();
        assert_eq!(sensitivity(&body, 0.01, &[0.1; 100], &Options::default()), Sensitivity { width: 0.0, scale: 0.0 });
    }

    /// From near balance the outcome hangs on the last digit: t = acosh(1/(1 - phi))/p to land.
    #[test]
    fn a_body_near_balance_is_ill_conditioned() {
        let body = Structure::paper().body::<f64>();
        let options = Options { initial: Some(((1.0 - 1e-4) * body.alpha(), 0.0)), ..Options::default() };
        assert!(!sensitivity(&body, 0.01, &[0.0; 3000], &options).well_conditioned());
    }
}
