//! What the impact objective's springs promise without any record: landings that lose what equation (2) says, or what the
//! user asks for, without creating energy.

use groundspring::{
    fem::{Case, Control, Start},
    spring::{Design, Springs},
    structure::{Body, Structure},
    tuning::{
        descent::LeastSquares,
        impact::report::{LandingRow, landings},
        impulse::{self, Effort, Objective},
        arr::inner::families,
        outer::Bracket,
    },
};

const EFFORT: Effort = Effort { tried: 6, followed: 2, iterations: 15, content: false };

fn tune(body: &Body<f64>, ratio: f64, max_hz: f64) -> Springs<Design<f64>> {
    let bracket = Bracket { max_hz, max_settlement: 0.01 };
    let objective = Objective::new(body, ratio * body.restitution(), bracket);
    impulse::tune(&objective, &families(&[0.1, 1.0]).unwrap(), EFFORT).unwrap().springs
}

fn rows(body: &Body<f64>, ratio: f64, springs: &Springs<Design<f64>>) -> Vec<LandingRow> {
    landings(body, &springs.chains(body.mass), ratio * body.restitution())
}

fn with_inertia(structure: Structure) -> Body<f64> {
    let mut body = structure.body::<f64>();
    body.inertia = body.inertia.max(1e-5 * body.mass * body.radius().powi(2));
    body
}

#[test]
fn landings_from_large_to_small_leans_have_housners_restitution_and_hardly_leave_the_ground() {
    for structure in [
        Structure::paper(),
        Structure::a_frame(20.0, 4.0, 1e5).unwrap(),
        Structure::a_frame(5.0, 1.5, 1e4).unwrap(),
        Structure::block(2.0, 0.5, 1e3).unwrap(),
        Structure::block(0.6, 0.2, 100.0).unwrap(),
    ] {
        let body = with_inertia(structure);
        let rows = rows(&body, 1.0, &tune(&body, 1.0, 160.0));
        assert_eq!(rows.len(), 8);
        for row in &rows {
            assert!(row.restitution_error.abs() < 2e-3, "{structure:?} {row:?}");
            assert!(row.air_s < 0.010, "{structure:?} {row:?}");
            assert!(row.ringing < 1e-3, "{structure:?} {row:?}");
        }
    }
}

/// Sizes and slendernesses between those that springs were searched for.
#[test]
fn landings_are_in_order_for_frames_and_blocks_of_any_slenderness() {
    println!("half-slenderness alpha, height of the mass: largest error of e, longest time in the air");
    for kind in ["aframe", "block"] {
        for height in [5.0, 20.0, 60.0] {
            for alpha in [0.06, 0.1, 0.14, 0.2, 0.28, 0.36f64] {
                let width = 2.0 * height * alpha.tan();
                let structure = match kind {
                    "aframe" => Structure::a_frame(height, width, 1e4).unwrap(),
                    _ => Structure::block(2.0 * height, width, 1e4).unwrap(),
                };
                let body = with_inertia(structure);
                let rows = rows(&body, 1.0, &tune(&body, 1.0, 160.0));
                assert_eq!(rows.len(), 8);
                let error = rows.iter().map(|row| row.restitution_error.abs()).fold(0.0, f64::max);
                let air_s = rows.iter().map(|row| row.air_s).fold(0.0, f64::max);
                println!("{kind} alpha {alpha}, {height} m: {:.3} %, {:.1} ms", 100.0 * error, 1e3 * air_s);
                assert!(error < 2e-3 && air_s < 0.010, "{structure:?} {error} {air_s}");
            }
        }
    }
}

#[test]
fn free_rocking_on_tuned_springs_never_creates_energy() {
    let body = with_inertia(Structure::paper());
    let springs = tune(&body, 1.0, 160.0).chains(body.mass);
    let accel = vec![0.0; 10001];
    let (start, control) = (Start::Leaning(0.9 * body.alpha()), Control::default());
    let history = Case { body, springs, start, dt: 0.01, accel: &accel, scale: 1.0, control }.simulate();
    assert!(history.impacts() > 10);
    let scale = history.account.dissipated.last().unwrap();
    // a Radau step may misjudge its own dissipation by what the account allows it, 1e-9 of the energy
    let least = history.account.dissipated.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min) / scale;
    let most = history.account.stored.windows(2).map(|w| w[1] - w[0]).fold(f64::NEG_INFINITY, f64::max) / scale;
    assert!(least > -1e-8 && most < 1e-8, "{least} {most}");
    assert!(history.energy_residual < 1e-6);
}

#[test]
fn blocks_can_be_given_another_restitution() {
    for structure in [Structure::block(2.0, 0.5, 1e3).unwrap(), Structure::block(0.6, 0.2, 100.0).unwrap()] {
        let body = structure.body::<f64>();
        for ratio in [0.9, 0.95, 1.02] {
            for row in rows(&body, ratio, &tune(&body, ratio, 160.0)) {
                assert!(row.restitution_error.abs() < 5e-3, "{structure:?} {ratio}: {row:?}");
            }
        }
    }
}

/// Springs of 160 Hz settle by 4.85e-6 m (1 + 1/K), K at most 30.
#[test]
fn a_small_settlement_is_honoured_and_one_too_small_is_refused() {
    let body = Structure::block(2.0, 0.5, 1e3).unwrap().body::<f64>();
    let tune = |max_settlement: f64| {
        let objective = Objective::new(&body, body.restitution(), Bracket { max_hz: 160.0, max_settlement });
        impulse::tune(&objective, &families(&[0.1, 1.0]).unwrap(), EFFORT)
    };
    for limit in [1e-3, 1e-5, 6e-6, 5.1e-6] {
        let settlement = tune(limit).unwrap().springs.settlement(body.mass);
        assert!(settlement < limit * (1.0 + 1e-12), "{settlement:e} {limit:e}");
    }
    assert!(tune(5.0e-6).is_none());
}

/// At the price of bounces, for their mass is all in one point: up to 0.5 s in the air a landing.
#[test]
fn frames_can_be_given_another_restitution() {
    for structure in
        [Structure::paper(), Structure::a_frame(20.0, 4.0, 1e5).unwrap(), Structure::a_frame(5.0, 1.5, 1e4).unwrap()]
    {
        let body = with_inertia(structure);
        for ratio in [0.9, 0.95, 1.02] {
            for row in rows(&body, ratio, &tune(&body, ratio, 160.0)) {
                println!(
                    "{} m, {ratio}: {:+.2e}, {:.0} ms",
                    structure.height_m,
                    row.restitution_error,
                    1e3 * row.air_s
                );
                assert!(row.restitution_error.abs() < 5e-3, "{structure:?} {ratio}: {row:?}");
            }
        }
    }
}

#[test]
fn gradients_of_the_objective_agree_with_finite_differences() {
    let body = with_inertia(Structure::paper());
    let objective = Objective::new(&body, body.restitution(), Bracket { max_hz: 160.0, max_settlement: 0.01 });
    // a plastic chain: no bounces, smooth
    let z: Vec<f64> = [160.0, 0.2, 0.92, 0.5, 160.0, 20.0, 1.0, 0.05].map(f64::ln).to_vec();
    let (_, exact) = objective.gradients(&z);
    let scale = exact.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    for i in 0..8 {
        let at = |d: f64| {
            let mut z = z.clone();
            z[i] += d;
            objective.residuals(&z)
        };
        let (up, down) = (at(0.01), at(-0.01));
        for (k, row) in exact.iter().enumerate() {
            let slope = (up[k] - down[k]) / 0.02;
            // the search's step control leaves 1e-4 of an error of restitution, several times that in a residual
            assert!((slope - row[i]).abs() < 0.05 * scale, "residual {k}, parameter {i}: {slope} {}", row[i]);
        }
    }
}
