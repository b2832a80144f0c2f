//! How the stiffness ratio K trades the landing against the stance: errors of histories over K, for bodies of several slendernesses
//! and Omega_n/p, beside the K that the design takes. 60 synthetic motions of seed 5 each, the well-conditioned ones counted.
//!
//! ```sh
//! cargo bench --bench stance
//! ```

use groundspring::{
    conditioning::Conditioning,
    fem::Control,
    housner::RockingOptions,
    spring::Design,
    structure::Structure,
    synthetic,
    tuning::{
        job::at,
        landing::{design::Geometry, universal::universal},
    },
    validate::Judge,
};
use rayon::prelude::*;

const KS: [f64; 7] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("median NRMSE of u for K = {KS:?}, and for the design's own K");
    for (name, structure) in [
        ("A-frame 0.1", Structure::a_frame(20.0, 40.0 * 0.1f64.tan(), 1e5)?),
        ("A-frame 0.3", Structure::a_frame(20.0, 40.0 * 0.3f64.tan(), 1e5)?),
        ("block 0.2", Structure::block(2.0, 2.0 * 0.2f64.tan(), 1e3)?),
        ("block 0.4", Structure::block(2.0, 2.0 * 0.4f64.tan(), 1e3)?),
    ] {
        let mut body = structure.body::<f64>();
        body.inertia = body.inertia.max(1e-5 * body.mass * body.radius().powi(2));
        let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
        let motions: Vec<_> = (0..60)
            .into_par_iter()
            .map(|i| synthetic::record(5, i, p, alpha))
            .filter(|r| Conditioning::new(&body, r.dt, &r.accel, &RockingOptions::default()).well_conditioned())
            .collect();
        for stiffness in [5e3, 2e4, 8e4] {
            let geometry = Geometry::of(&body, stiffness)?;
            let own = at(&body, stiffness).ok_or("no design")?;
            let median = |k: f64| {
                let (chain, m) = (universal(k), geometry.effective_mass());
                let mut springs = own;
                springs.vertical = Design::from_kc(chain.mu * m, k, chain.c * m.sqrt(), own.vertical.omega_n_hz);
                let springs = springs.chains(body.mass);
                let judge = Judge {
                    body,
                    restitution: body.restitution(),
                    springs,
                    duration_s: None,
                    control: Control::search(),
                };
                let found = judge.judge(&motions).into_iter().filter_map(|row| row.nrmse_horizontal);
                let mut errors: Vec<f64> = found.collect();
                errors.sort_by(f64::total_cmp);
                errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN)
            };
            let all: Vec<String> = KS.iter().map(|&k| format!("{:.1e}", median(k))).collect();
            let k = geometry.k();
            println!("{name}, Omega_n/p {stiffness:.0}: {}; K {k:.4}: {:.1e}", all.join(" "), median(k));
        }
    }
    Ok(())
}
