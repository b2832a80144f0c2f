//! Springs softer than the landing's limit, and springs that are to have another restitution:
//! landings of the whole model.

use dynamics::{
    effort::{Effort, StopSignal},
    fem::{Analysis, Start},
    spring::{Design, Springs},
};
use landing::{
    design::{Geometry, springs_at_stiffness},
    universal::universal,
    weight,
};
use rocking::structure::{Body, Structure};
use springs::{
    capped_springs::{follow, with_restitution},
    landing_simulation::report::{LandingRow, landings},
    paper_procedure::outer::Bracket,
};

fn rows(body: &Body<f64>, ratio: f64, springs: &Springs<Design<f64>>) -> Vec<LandingRow> {
    landings(body, &springs.chains(body.mass), ratio * body.restitution())
}

fn worst(rows: &[LandingRow]) -> f64 {
    rows.iter().map(|row| row.restitution_error.abs()).fold(0.0, f64::max)
}

fn with_inertia(structure: Structure) -> Body<f64> {
    let mut body = structure.body::<f64>();
    body.inertia = body.inertia.max(1e-5 * body.mass * body.radius().powi(2));
    body
}

/// The design from the geometry, from the stiffness on at which the limit holds: no search, any
/// size, any slenderness.
#[test]
fn landings_of_the_design_from_the_geometry_have_housners_restitution() {
    println!("kind, height, alpha: largest error of e");
    for kind in ["aframe", "block"] {
        for height in [0.15, 5.0, 60.0] {
            for alpha in [0.05, 0.1, 0.2, 0.3, 0.4f64] {
                let width = 2.0 * height * alpha.tan();
                let structure = match kind {
                    "aframe" => Structure::a_frame(height, width, 1e4).unwrap(),
                    _ => Structure::block(2.0 * height, width, 1e4).unwrap(),
                };
                let body = with_inertia(structure);
                let rows = rows(&body, 1.0, &springs_at_stiffness(&body, 1e5).unwrap());
                assert_eq!(rows.len(), 8);
                println!("{kind} {height} m, {alpha}: {:.4} %", 100.0 * worst(&rows));
                assert!(worst(&rows) < 1e-4, "{structure:?} {rows:?}");
            }
        }
    }
}

/// What slender bodies err by on stiff springs is the weight on the old foot (`landing::weight`),
/// where the absorber gives little: on a large K.
#[test]
fn landings_on_stiff_springs_err_by_the_weight_on_the_old_foot() {
    for structure in [
        Structure::block(1.0, f64::tan(0.05), 1e3).unwrap(),
        Structure::block(4.0, 4.0 * f64::tan(0.03), 1e4).unwrap(),
        Structure::a_frame(8.0, 16.0 * f64::tan(0.05), 1e5).unwrap(),
    ] {
        let body = with_inertia(structure);
        for stiffness in [1e5, 3e5] {
            let geometry = Geometry::of(&body, stiffness).unwrap();
            let (k, m) = (0.25, geometry.effective_mass());
            let chain = universal(k);
            let mut springs = springs_at_stiffness(&body, stiffness).unwrap();
            springs.vertical =
                Design::from_kc(chain.mu * m, k, chain.c * m.sqrt(), springs.vertical.omega_n_hz);
            for row in rows(&body, 1.0, &springs).into_iter().filter(|row| row.lean >= 0.1) {
                let expected = weight::restitution_error(
                    geometry.alpha(),
                    geometry.mass_share(),
                    stiffness,
                    row.lean,
                );
                let ratio = row.restitution_error / expected;
                println!(
                    "{structure:?} {stiffness:.0e} {}: {:.2e}, {ratio:.2} of it",
                    row.lean, expected
                );
                assert!((0.75..1.05).contains(&ratio), "{row:?}");
            }
        }
    }
}

#[test]
fn free_rocking_on_stiff_springs_never_creates_energy() {
    let body = with_inertia(Structure::paper());
    let springs = springs_at_stiffness(&body, 4e4).unwrap().chains(body.mass);
    let accel = vec![0.0; 10001];
    let history = Analysis {
        start: Start::Leaning(0.9 * body.alpha()),
        ..Analysis::new(body, springs, 0.01, &accel)
    }
    .simulate();
    assert!(history.impacts() > 10);
    let scale = history.account.dissipated.last().unwrap();
    // a Radau step may misjudge its own dissipation by what the account allows it, 1e-9 of the
    // energy
    let least =
        history.account.dissipated.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min)
            / scale;
    let most =
        history.account.stored.windows(2).map(|w| w[1] - w[0]).fold(f64::NEG_INFINITY, f64::max)
            / scale;
    assert!(least > -1e-8 && most < 1e-8, "{least} {most}");
    assert!(history.energy_residual < 1e-6);
}

/// A search of some seconds each; other bodies and ratios end between 0.01 and 3 %, and the program
/// says so.
#[test]
fn bodies_can_be_given_another_restitution() {
    for (structure, ratio) in [
        (Structure::block(2.0, 0.5, 1e3).unwrap(), 1.02),
        (Structure::a_frame(5.0, 1.5, 1e4).unwrap(), 1.02),
    ] {
        let body = with_inertia(structure);
        let bracket = Bracket { max_hz: 160.0, max_settlement: 0.01 };
        let springs = with_restitution(
            &body,
            ratio * body.restitution(),
            bracket,
            &Effort::unbounded(),
            &|_, _, _| {},
        )
        .unwrap();
        let rows = rows(&body, ratio, &springs);
        println!("{} m, {ratio}: {:.2} %", structure.height_m, 100.0 * worst(&rows));
        let settlement = springs.settlement(body.mass);
        assert!(settlement < bracket.max_settlement * (1.0 + 2e-3), "{settlement:e}");
        assert!(worst(&rows) < 5e-3, "{structure:?} {ratio}: {rows:?}");
    }
}

/// For a restitution far below equation 2's soft springs bounce best: those of more settlement than
/// allowed are not taken, however short the search.
#[test]
fn springs_that_bounce_settle_by_no_more_than_allowed() {
    let body = with_inertia(Structure::a_frame(12.0, 3.0, 1e4).unwrap());
    for limit in [1e-2, 1e-4] {
        let bracket = Bracket { max_hz: 160.0, max_settlement: limit };
        let effort = Effort::of(2_000_000, StopSignal::default());
        let found = with_restitution(&body, 0.3, bracket, &effort, &|_, _, _| {});
        let settlement = found.unwrap().settlement(body.mass);
        assert!(settlement < limit * (1.0 + 2e-3), "{settlement:e} {limit:e}");
    }
}

/// Springs of 160 Hz settle by 4.85e-6 m (1 + 1/K), K at most 30.
#[test]
fn a_small_settlement_is_honoured() {
    let body = Structure::block(2.0, 0.5, 1e3).unwrap().body::<f64>();
    for limit in [1e-3, 1e-5] {
        for springs in follow(
            &body,
            body.restitution(),
            Bracket { max_hz: 160.0, max_settlement: limit },
            &Effort::unbounded(),
        ) {
            let settlement = springs.settlement(body.mass);
            assert!(settlement < limit * (1.0 + 2e-3), "{settlement:e} {limit:e}");
        }
    }
}
