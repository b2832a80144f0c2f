//! The finite element body on springs that are given, beside Housner's: histories as CSV on stdout,
//! what they say on stderr.
//!
//! ```sh
//! cargo run --release --example simulate > history.csv
//! ```

use groundspring::{Parameters, Record, compare};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // the paper's Table 1, as far as its digits survive
    let parameters =
        Parameters::parse("tuning/table_1.json", include_str!("../tuning/table_1.json"))?;
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

    let (housner, springs) = (verdict.housner, verdict.finite_elements);
    eprintln!(
        "Housner: {:?}, {:.3} of alpha; on springs: {:?}, {:.3}",
        housner.fate, housner.peak_ratio, springs.fate, springs.peak_ratio
    );
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
