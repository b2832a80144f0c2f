//! The numbers in the choice of K for elastic structures (`tuning/elastic/design`, `BALANCE`):
//! errors of piers with light to heavy footings and of a frame, on releases and motions, over both.
//!
//! ```sh
//! cargo bench --bench elastic_stance
//! ```

use cases::{Asked, Yardstick};
use dynamics::{effort::Effort, fem::Control};
use frames::{assembled::Assembled, standing::Standing, structure::ElasticStructure};
use springs::elastic::{
    design::{BALANCE, KBalance, with_k},
    landing_speed, stand,
    suite::ElasticSuite,
};

/// Factors on the scale, and values of the turn.
const FACTORS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
const TURNS: [f64; 4] = [0.0, 0.02, 0.05, 0.15];
const COMPLIANCE_RATIOS: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// Mass and footing mass (kg), frequency (Hz) and damping ratio of the piers: 12 m, 4 m wide.
const PIERS: [(f64, f64, f64, f64); 5] = [
    (600e3, 60e3, 2.0, 0.02),
    (600e3, 60e3, 1.5, 0.0),
    (600e3, 200e3, 2.0, 0.02),
    (300e3, 300e3, 3.0, 0.02),
    (200e3, 600e3, 2.0, 0.02),
];
const FRAME: &str = "kind = 'frame'\nheight_m = 8.0\nspan_m = 10.0\nfooting_width_m = 2.5\n\
                     footing_height_m = 1.0\nfooting_mass_kg = 30e3\n\
    beam_mass_kg = 200e3\ncolumn_ea_n = 3e10\ncolumn_ei_nm2 = 4e9\nbeam_ea_n = 4e10\n\
                     beam_ei_nm2 = 8e9\ndamping_ratio = 0.02\n";

/// The error over what an accuracy of 1 allows at one K, and touches a landing.
fn measure(suite: &ElasticSuite, standing: &Standing, compliance_ratio: f64, k: f64) -> (f64, f64) {
    let measured = suite.measure(&with_k(standing, compliance_ratio, k), Control::search());
    let touches = [measured.releases, measured.motions].into_iter().flatten().map(|e| e.touches);
    (
        measured.over(Asked { by: Yardstick::Histories, error: 1.0 }).unwrap_or(f64::NAN),
        touches.fold(0.0, f64::max),
    )
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pier = |(mass, footing, hz, damping): (f64, f64, f64, f64)| {
        format!(
            "kind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = {mass:?}\n\
             footing_mass_kg = {footing:?}\nfooting_height_m = 2.0\n\
             frequency_hz = {hz:?}\ndamping_ratio = {damping:?}\n"
        )
    };
    let structures = PIERS.into_iter().map(pier).chain([FRAME.to_owned()]);
    let mut logarithms = [[0.0; FACTORS.len()]; TURNS.len()];
    let mut rows = 0.0;
    for text in structures {
        let structure: ElasticStructure = toml::from_str(&text)?;
        println!("{}", text.replace('\n', "; "));
        let model = Assembled::new(structure)?;
        let standing = stand(&model).ok_or("does not stand")?;
        let suite = ElasticSuite::new(model, None, &Effort::unbounded());
        for compliance_ratio in COMPLIANCE_RATIOS {
            rows += 1.0;
            for (sums, turn) in logarithms.iter_mut().zip(TURNS) {
                let mut cells = Vec::new();
                for (sum, factor) in sums.iter_mut().zip(FACTORS) {
                    let balance = KBalance { scale: factor * BALANCE.scale, turn };
                    let k = balance.k(&standing, compliance_ratio, landing_speed(&structure));
                    let (error, touches) = measure(&suite, &standing, compliance_ratio, k);
                    *sum += f64::ln(error);
                    cells.push(format!("K {k:.4}: {error:.1e} ({touches:.1})"));
                }
                println!(
                    "  compliance ratio {compliance_ratio:.0e}, turn {turn}; error (touches a \
                     landing): {}",
                    cells.join(", ")
                );
            }
        }
    }
    for (sums, turn) in logarithms.iter().zip(TURNS) {
        let means: Vec<String> =
            sums.iter().map(|sum| format!("{:.2e}", f64::exp(sum / rows))).collect();
        println!(
            "turn {turn}: geometric means at scale {} x {FACTORS:?}: {}",
            BALANCE.scale,
            means.join(" ")
        );
    }
    Ok(())
}
