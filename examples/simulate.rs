//! The finite element body on springs that are given, beside Housner's: histories as CSV on stdout, what they say on stderr.
//!
//! ```sh
//! cargo run --release --example simulate > history.csv
//! ```

use groundspring::{Design, Parameters, Record, Springs, Structure, compare};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let structure = Structure::paper();
    // the paper's Table 1, as far as its digits survive: mu, K = k2/k1, C = c/(m1 Omega_n), Omega_n / 2 pi (Hz)
    let springs = Springs {
        vertical: Design::from_kc(10.2, 9.214, 4.397, 6.2),
        horizontal: Design::from_kc(10.2, 0.4897, 7.816, 10.0),
    };
    let parameters = Parameters::new(structure, &springs);
    let record = Record::el_centro().truncated(20.0);

    let (both, verdict) = compare(&parameters, &record);
    println!("t_s,u_housner_m,u_fem_m,v_fem_m,vertical_force_left_n");
    let samples = both.housner.u.len().min(both.fem.motion.u.len());
    for i in 0..samples {
        println!(
            "{:.3},{:.6e},{:.6e},{:.6e},{:.6e}",
            i as f64 * record.dt,
            both.housner.u[i],
            both.fem.motion.u[i],
            both.fem.motion.v[i],
            both.fem.forces.vertical[0][i]
        );
    }

    verdict.lines().iter().for_each(|line| eprintln!("{line}"));
    let found = &both.matched;
    eprintln!(
        "impacts {} (Housner {}), bounces {}, settlement {:.2} mm, energy account closed to {:.1e}",
        found.impacts_fem,
        found.impacts_housner,
        found.bounces,
        found.settlement_m * 1e3,
        found.energy_residual
    );
    Ok(())
}
