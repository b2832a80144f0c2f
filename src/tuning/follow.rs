//! Springs softer than the landing's limit: the design followed down in Omega_n/p, on landings and uplifts of the whole model.
//!
//! Where a cap keeps Omega_n v_n/g small, gravity takes part in the landing and the stance gives way before it lifts. So the
//! design from the geometry is only where to begin: it is taken at a stiffness at which it holds, and with every step down,
//! by a factor of two, all eight parameters are tuned again on the whole model (`whole_model`), from what they were. No record.

use std::f64::consts::TAU;

use nalgebra::SVector;
use num_dual::{Derivative, DualNum, DualSVec64};
use rayon::prelude::*;

use super::{
    arr::outer::Bracket,
    descent::{LeastSquares, descend},
    landing::design::Geometry,
    whole_model::WholeModel,
};
use crate::{
    fem::Control,
    scalar::{GRAVITY, Scalar, real},
    spring::{Design, Springs},
    structure::Body,
};

type Dual = DualSVec64<8>;

/// Stiffness ratio K, damping number C, mass ratio mu: least and largest.
const K: (f64, f64) = (0.001, LARGEST_K);
/// The largest K that is tried: it settles least.
pub const LARGEST_K: f64 = 30.0;
const C: (f64, f64) = (0.005, 40.0);
const MU: (f64, f64) = (0.0025, 40.0);
/// Least Omega_n, as a share of the largest.
const SOFTEST: f64 = 0.1;

/// The eight logarithms: Omega_n [Hz], K, C, mu of the vertical and of the horizontal units.
fn springs<S: Scalar>(z: &[S]) -> Springs<Design<S>> {
    let design = |z: &[S]| Design::from_kc(z[3].exp(), z[1].exp(), z[2].exp(), z[0].exp());
    Springs { vertical: design(&z[..4]), horizontal: design(&z[4..]) }
}

fn logarithms(s: &Springs<Design<f64>>) -> Vec<f64> {
    let (v, h) = (&s.vertical, &s.horizontal);
    [v.omega_n_hz, v.k(), v.c(), v.mu, h.omega_n_hz, h.k(), h.c(), h.mu].map(f64::ln).to_vec()
}

/// Landings and uplifts of a body on springs within a bracket.
struct Objective {
    whole: WholeModel,
    bracket: Bracket,
    control: Control,
}

impl Objective {
    /// It depends on the mass only through I_cg/m, so it is that of a body of 1 kg: in whatever unit a mass is given, the same
    /// springs are found.
    fn new(body: &Body<f64>, restitution: f64, bracket: Bracket) -> Self {
        let control = Control { tolerance: 1e-6, most_steps: 8_000, ..Control::default() };
        let body = &Body { mass: 1.0, inertia: body.inertia / body.mass, ..*body };
        Self { whole: WholeModel::new(body, restitution, bracket.max_hz), bracket, control }
    }
}

impl LeastSquares for Objective {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.whole.residuals(&springs(z), self.control)
    }

    fn gradients(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let duals: Vec<Dual> = z
            .iter()
            .enumerate()
            .map(|(i, &z)| Dual::new(z, Derivative::derivative_generic(nalgebra::Const::<8>, nalgebra::U1, i)))
            .collect();
        // one iteration more leaves the gradients good to the square of the iteration's rate, about 1e-4: enough for a step
        let control = Control { extra_iterations: 1, tolerance: 1e-5, ..self.control };
        let found = self.whole.residuals(&springs(&duals), control);
        let rows = found.iter().map(|r| row(r)).collect();
        (found.iter().map(|r| r.re).collect(), rows)
    }

    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let hz = (SOFTEST * self.bracket.max_hz, self.bracket.max_hz);
        let pairs = [hz, K, C, MU, hz, K, C, MU];
        (pairs.iter().map(|p| p.0.ln()).collect(), pairs.iter().map(|p| p.1.ln()).collect())
    }

    fn inequality(&self, z: &[f64]) -> Option<(f64, Vec<f64>)> {
        // ln of g/2 (1 + 1/K) / Omega_n^2 over the largest settlement
        let settlement = |omega: Dual, k: Dual| {
            ((k.exp().recip() + 1.0) * (0.5 * GRAVITY) / ((omega.exp() * TAU) * (omega.exp() * TAU))).ln()
        };
        let seed =
            |i: usize, x: f64| Dual::new(x, Derivative::derivative_generic(nalgebra::Const::<8>, nalgebra::U1, i));
        let value = settlement(seed(0, z[0]), seed(1, z[1])) - real::<Dual>(self.bracket.max_settlement.ln());
        Some((value.re, row(&value)))
    }
}

fn row(x: &Dual) -> Vec<f64> {
    let row: SVector<f64, 8> = x.eps.unwrap_generic(nalgebra::Const::<8>, nalgebra::U1);
    row.iter().copied().collect()
}

/// Omega_h/Omega_v from which the way down begins: what the stiff limit likes, and softer verticals that a cap asks for.
const RATIOS: [f64; 3] = [1.0, 2.0, 4.0];
/// Halvings of the stiffness on the way down.
const HALVINGS: i32 = 3;
/// Steps of the descent at every stiffness, and at the last.
const STEPS: (u64, u64) = (4, 15);

/// What was found, and its error by the whole model: sqrt of the sum of squares of its residuals.
#[derive(Clone, Copy, Debug)]
pub struct Followed {
    pub springs: Springs<Design<f64>>,
    pub error: f64,
}

/// Springs of at most `bracket.max_hz` for a body that lands with velocity restitution `restitution`, followed down from the
/// design that its geometry gives.
pub fn follow(body: &Body<f64>, restitution: f64, bracket: Bracket) -> Option<Followed> {
    let paths: Vec<Option<Followed>> = RATIOS.par_iter().map(|&ratio| path(body, restitution, bracket, ratio)).collect();
    paths.into_iter().flatten().min_by(|a, b| a.error.total_cmp(&b.error))
}

fn path(body: &Body<f64>, restitution: f64, bracket: Bracket, ratio: f64) -> Option<Followed> {
    let stiffest = bracket.max_hz * 2f64.powi(HALVINGS);
    let stiffness = TAU * stiffest / ratio / body.p_squared().sqrt();
    let mut found = Geometry::of(body, stiffness).ok()?.springs();
    found.vertical.omega_n_hz = stiffest / ratio;
    found.horizontal.omega_n_hz = stiffest;
    let mut error = f64::INFINITY;
    for halving in (0..=HALVINGS).rev() {
        let here = Bracket { max_hz: bracket.max_hz * 2f64.powi(halving), ..bracket };
        let scale = if halving == HALVINGS { 1.0 } else { 0.5 };
        found.vertical.omega_n_hz *= scale;
        found.horizontal.omega_n_hz *= scale;
        let objective = Objective::new(body, restitution, here);
        let steps = if halving == 0 { STEPS.1 } else { STEPS.0 };
        let end = descend(&objective, &logarithms(&found), 0.3, steps);
        (found, error) = (springs(&end.z), end.error);
    }
    (error.is_finite() && found.settlement(1.0) <= bracket.max_settlement * (1.0 + 1e-9)).then_some(Followed { springs: found, error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Structure;

    #[test]
    fn scan() {
        for (name, s) in [
            ("61", Structure::paper()),
            ("20", Structure::a_frame(20.0, 4.0, 1e5).unwrap()),
            ("5", Structure::a_frame(5.0, 1.5, 1e4).unwrap()),
            ("b2", Structure::block(2.0, 0.5, 1e3).unwrap()),
            ("b06", Structure::block(0.6, 0.2, 100.0).unwrap()),
        ] {
            let mut body = s.body::<f64>();
            body.inertia = body.inertia.max(1e-5 * body.mass * body.radius().powi(2));
            let bracket = Bracket { max_hz: 160.0, max_settlement: 0.01 };
            for ratio in RATIOS {
                let begin = std::time::Instant::now();
                let found = path(&body, body.restitution(), bracket, ratio);
                if let Some(f) = found {
                    let r = |d: &Design<f64>| format!("[{:.4},{:.5},{:.5},{:.5}]", d.omega_n_hz, d.k(), d.c(), d.mu);
                    println!("SCAN {name} {ratio} {:.4} {} {} # {:?}", f.error, r(&f.springs.vertical), r(&f.springs.horizontal), begin.elapsed());
                }
            }
        }
    }
}
