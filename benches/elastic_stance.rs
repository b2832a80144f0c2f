//! The number SCALE in the choice of K for elastic structures (`tuning/elastic/design`): errors of piers with light to heavy footings over
//! factors on K^3, on releases and motions.
//!
//! ```sh
//! cargo bench --bench elastic_stance
//! ```

use groundspring::{
    elastic::{
        assembled::Assembled,
        structure::{ElasticStructure, PierSpec},
    },
    fem::Control,
    tuning::elastic::{
        design::{springs, with_k},
        landing_speed, stand,
        suite::ElasticSuite,
    },
};

/// Factors on the K^3 of the design.
const FACTORS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut logarithms = [0.0; FACTORS.len()];
    let mut rows = 0.0;
    for (mass_kg, footing_mass_kg, frequency_hz) in
        [(600e3, 60e3, 2.0), (600e3, 60e3, 1.5), (600e3, 200e3, 2.0), (200e3, 600e3, 2.0)]
    {
        let pier = PierSpec {
            height_m: 12.0,
            width_m: 4.0,
            mass_kg,
            footing_mass_kg,
            footing_height_m: 2.0,
            footing_inertia_kgm2: None,
            ea_n: None,
            ei_nm2: None,
            frequency_hz: Some(frequency_hz),
            damping_ratio: 0.02,
            axial_damping_ratio: None,
            column_mass_kg: 0.0,
            elements: None,
        };
        let structure = ElasticStructure::Pier(pier).checked()?;
        let model = Assembled::new(structure)?;
        let standing = stand(&model).ok_or("does not stand")?;
        let suite = ElasticSuite::new(model, None);
        for give in [1e-3, 1e-4, 1e-5] {
            let k = springs(&standing, give, landing_speed(&structure)).k;
            let measured = FACTORS.map(|factor| {
                let measured = suite.measure(&with_k(&standing, give, k * f64::cbrt(factor)), Control::search());
                let touches = [measured.releases, measured.motions].into_iter().flatten().map(|e| e.touches);
                (measured.over(1.0).unwrap_or(f64::NAN), touches.fold(0.0, f64::max))
            });
            let all: Vec<String> =
                measured.iter().map(|(error, touches)| format!("{error:.1e} ({touches:.1})")).collect();
            logarithms.iter_mut().zip(measured).for_each(|(sum, (error, _))| *sum += error.ln());
            rows += 1.0;
            println!(
                "{mass_kg:.0e} kg on {footing_mass_kg:.0e} kg, {frequency_hz} Hz, give {give:.0e}, K {k:.4}; error (touches a landing) at K^3 x {FACTORS:?}: {}",
                all.join(" ")
            );
        }
    }
    let means: Vec<String> = logarithms.iter().map(|sum| format!("{:.1e}", f64::exp(sum / rows))).collect();
    println!("geometric means at K^3 x {FACTORS:?}: {}", means.join(" "));
    Ok(())
}
