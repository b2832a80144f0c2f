//! Housner's rigid body on El Centro: one history, and the scale of the record that overturns it.
//!
//! ```sh
//! cargo run --release --example rigid_rocking
//! ```

use groundspring::{
    Body, Conditioning, Record, RockingOptions, RockingOutcome, Structure, rock, rock_many,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // a solid block, by its whole height and width
    let body: Body<f64> = Structure::block(2.0, 0.5, 1000.0)?.body();
    let record = Record::el_centro();
    println!(
        "alpha {:.4} rad, p {:.3} 1/s, restitution by equation 2 {:.4}",
        body.alpha(),
        body.p(),
        body.restitution()
    );

    let options = RockingOptions::default();
    let rocking = rock(&body, record.dt, &record.accel, &options);
    match rocking.outcome {
        RockingOutcome::NeverMoved => println!("{:.3} g does not lift it", record.pga_g()),
        RockingOutcome::Overturned { time } => println!("it overturns at t = {time:.2} s"),
        _ => {
            let peak = rocking.theta.iter().fold(0.0, |peak: f64, theta| peak.max(theta.abs()));
            println!(
                "it rocks: {} impacts, largest theta/alpha {:.3}",
                rocking.impacts.len(),
                peak / body.alpha()
            );
        }
    }
    // how much of that hangs on the width and the scale, before a history is compared with another
    let conditioning = Conditioning::new(&body, record.dt, &record.accel, &options);
    println!("well conditioned: {}", conditioning.well_conditioned());

    // many scales at once, sixteen in lock-step, on all cores
    let scales: Vec<f64> = (1..=300).map(|i| f64::from(i) / 100.0).collect();
    let options: Vec<_> =
        scales.iter().map(|&scale| RockingOptions { scale, ..Default::default() }).collect();
    let histories = rock_many(&[body], record.dt, &record.accel, &options);
    let overturning: Vec<f64> = scales
        .iter()
        .zip(&histories)
        .filter(|(_, history)| history.overturned().is_some())
        .map(|(x, _)| *x)
        .collect();
    match overturning.first() {
        Some(least) => println!(
            "least scale that overturns it, in steps of 0.01: {least} ({} of {}; narrower bands \
             may be missed)",
            overturning.len(),
            scales.len()
        ),
        None => println!("no scale up to 3 overturns it"),
    }
    Ok(())
}
