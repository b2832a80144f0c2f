//! How the stiffness ratio K trades the landing against the stance: what a history errs for several
//! scales K_0 of K (`K_SCALE` of the landing's design), on bodies of several slendernesses and
//! Omega_n/p. Errors are those that Omega_n is chosen by, in units of what an accuracy of 1 allows
//! (median of synthetic motions, a fifth of the 90 % quantile, and of the geometric mean of
//! earthquake-like ones with three standard errors), on motions of seeds 5, 6 and 7, which no
//! spring is chosen on.
//!
//! ```sh
//! cargo bench --bench stance
//! ```

use cases::{Asked, Yardstick};
use dynamics::{effort::Effort, fem::Control, spring::Design};
use landing::{
    design::{Geometry, springs_at_stiffness},
    universal::universal,
};
use rocking::structure::Structure;
use springs::suite::Suites;

const SCALES: [f64; 6] = [0.45, 0.9, 1.3, 1.8, 2.5, 3.6];
const STIFFNESSES: [f64; 3] = [5e3, 2e4, 8e4];
const SEEDS: [u64; 3] = [5, 6, 7];

fn geometric_mean(x: &[f64]) -> f64 {
    (x.iter().map(|x| x.ln()).sum::<f64>() / x.len() as f64).exp()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("errors for K_0 = {SCALES:?}");
    let frame =
        |height: f64, alpha: f64| Structure::a_frame(height, 2.0 * height * alpha.tan(), 1e5);
    let block =
        |height: f64, alpha: f64| Structure::block(2.0 * height, 2.0 * height * alpha.tan(), 1e3);
    let mut all = vec![Vec::new(); SCALES.len()];
    for (name, structure) in [
        ("A-frame 20 m, 0.07", frame(20.0, 0.07)?),
        ("A-frame 8 m, 0.12", frame(8.0, 0.12)?),
        ("A-frame 30 m, 0.2", frame(30.0, 0.2)?),
        ("A-frame 15 m, 0.4", frame(15.0, 0.4)?),
        ("block 3 m, 0.06", block(3.0, 0.06)?),
        ("block 1 m, 0.15", block(1.0, 0.15)?),
        ("block 0.4 m, 0.25", block(0.4, 0.25)?),
        ("block 2 m, 0.4", block(2.0, 0.4)?),
    ] {
        let mut body = structure.body::<f64>();
        body.inertia = body.inertia.max(1e-5 * body.mass * body.radius().powi(2));
        let suites = SEEDS.map(|seed| Suites::of_seed(seed, &body, body.restitution(), None));
        for stiffness in STIFFNESSES {
            let geometry = Geometry::of(&body, stiffness)?;
            let own = springs_at_stiffness(&body, stiffness).ok_or("no design")?;
            let mut line = String::new();
            for (errors, scale) in all.iter_mut().zip(SCALES) {
                let (k, m) = (geometry.k_of(scale), geometry.effective_mass());
                let chain = universal(k);
                let mut springs = own;
                springs.vertical =
                    Design::from_kc(chain.mu * m, k, chain.c * m.sqrt(), own.vertical.omega_n_hz);
                let springs = springs.chains(body.mass);
                let found: Vec<f64> = suites
                    .iter()
                    .map(|s| {
                        s.accuracy(&springs, (Control::search(), &Effort::unbounded()))
                            .over(Asked { by: Yardstick::Histories, error: 1.0 })
                    })
                    .collect();
                let error = geometric_mean(&found);
                errors.push(error);
                line += &format!("{error:9.1e}");
            }
            println!("{name}, Omega_n/p {stiffness:.0}, own K {:.4}: {line}", geometry.k());
        }
    }
    let means: Vec<String> =
        all.iter().map(|errors| format!("{:.2e}", geometric_mean(errors))).collect();
    println!("geometric means: {}", means.join(" "));
    Ok(())
}
