//! Find the springs of a structure on a record, and see how well they follow Housner.
//!
//! ```sh
//! cargo run --release --example tune
//! cargo run --release --example tune -- motion.V2A      # a record of your own, in any format of docs/records.md
//! ```

use std::path::Path;

use groundspring::{Case, ReadOptions, Record, Structure, compare, tune};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let record = match std::env::args().nth(1) {
        Some(file) => Record::read(Path::new(&file), &ReadOptions::default())?,
        None => Record::el_centro(),
    };
    println!("{}: {} samples, PGA {:.3} g", record.name, record.len(), record.pga_g());

    // an A-frame: all its mass 12 m above feet 2.4 m apart
    let structure = Structure::a_frame(12.0, 2.4, 350e3)?;
    let mut case = Case::of(structure, record)?;
    // the error of the history that Omega_n is chosen for, NRMSE
    case.tuning.accuracy = 0.002;
    let springs = tune(&case)?;

    println!("unit        Omega_n [Hz]    k1 [N/m]    k2 [N/m]     m2 [kg]  c [N s/m]");
    for (name, unit) in [("vertical  ", &springs.vertical), ("horizontal", &springs.horizontal)] {
        println!(
            "{name} {:13.1} {:11.3e} {:11.3e} {:11.3e} {:10.3e}",
            unit.omega_n_hz, unit.k1_n_per_m, unit.k2_n_per_m, unit.m2_kg, unit.c_ns_per_m
        );
    }

    // what the springs reach, and on what it was measured
    if let Some(assessment) = &springs.assessment {
        println!("accuracy {} asked for, reached: {}", assessment.accuracy, assessment.reached);
        // none of a record on which the springs are not judged
        if let Some(error) = assessment.measured.record {
            println!("error of the history on this record: NRMSE {error:.1e}");
        }
    }
    // what the body does on this record, by both models
    let (_, verdict) = compare(&springs, &case.record);
    println!("Housner: {:?}; on springs: {:?}", verdict.housner.fate, verdict.finite_elements.fate);
    if let Some(error) = verdict.nrmse_horizontal {
        println!("NRMSE of u {error:.1e}, over {:.2} s", verdict.compared_s);
    }

    // the file that every command of `tune` reads, as `tune export --parameters`
    let path = std::env::temp_dir().join("parameters.json");
    std::fs::write(&path, springs.to_json())?;
    println!("written to {}", path.display());
    Ok(())
}
