//! `tune chart`: smooth enough to be read off, and springs read off it by hand hold the landings.

use std::f64::consts::TAU;

use dynamics::spring::{Design, Springs};
use rocking::structure::Structure;
use springs::landing_simulation::report::landings;

#[path = "support/program.rs"]
mod program;

/// A row of chart.csv: kind, alpha, Omega_n/p, and (K, mu, f, xi) of the vertical units,
/// Omega_h/Omega_v.
struct Row {
    kind: String,
    alpha: f64,
    stiffness: f64,
    values: [f64; 5],
}

fn chart() -> Vec<Row> {
    let folder = program::TestFolder::with(&[]);
    folder.runs("chart --out out");
    let text = folder.text("out/chart.csv");
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|x| *x == name).unwrap();
    let wanted =
        ["k", "mu_vertical", "f_vertical", "xi_vertical", "omega_h_over_omega_v"].map(column);
    let (kind, alpha, stiffness) = (column("kind"), column("alpha"), column("omega_n_over_p"));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse().unwrap();
        let values = wanted.map(number);
        Row { kind: cells[kind].into(), alpha: number(alpha), stiffness: number(stiffness), values }
    };
    text.lines().skip(1).map(row).collect()
}

/// x to three significant digits: as much as an eye reads off.
fn three_digits(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap()
}

/// The values between the two nearest of some points, straight between them; `None` off the chart.
fn between(points: &[(f64, [f64; 4])], x: f64) -> Option<[f64; 4]> {
    let i = points.windows(2).position(|pair| pair[0].0 <= x && x <= pair[1].0)?;
    let ((x0, a), (x1, b)) = (points[i], points[i + 1]);
    let w = (x - x0) / (x1 - x0);
    Some(std::array::from_fn(|k| a[k] * (1.0 - w) + b[k] * w))
}

/// Read off as an engineer would: along Omega_n/p on its logarithmic axis, then between two curves
/// of alpha.
fn read_off(rows: &[Row], kind: &str, alpha: f64, stiffness: f64) -> Option<Springs<Design<f64>>> {
    let mut alphas: Vec<f64> =
        rows.iter().filter(|row| row.kind == kind).map(|row| row.alpha).collect();
    alphas.dedup();
    let along = |alpha: f64| {
        let curve = rows.iter().filter(|row| row.kind == kind && row.alpha == alpha);
        let points: Vec<_> = curve
            .map(|row| {
                let [_, mu, f, xi, ratio] = row.values;
                (row.stiffness.ln(), [mu, f, xi, ratio])
            })
            .collect();
        between(&points, stiffness.ln()).map(|values| values.map(three_digits))
    };
    let curves: Vec<_> = alphas.iter().filter_map(|alpha| Some((*alpha, along(*alpha)?))).collect();
    let [mu, f, xi, ratio] = between(&curves, alpha)?.map(three_digits);
    Some(Springs {
        vertical: Design { mu, f, xi, omega_n_hz: 1.0 },
        horizontal: Design { mu: 0.3, f: 1.8257, xi: 3.3333, omega_n_hz: ratio },
    })
}

#[test]
fn springs_read_off_by_hand_hold_the_landings_within_a_fifth_of_a_per_cent() {
    let rows = chart();
    let mut read = 0;
    println!("kind, alpha, Omega_n/p: largest error of e");
    for kind in ["aframe", "block"] {
        for alpha in [0.06, 0.12, 0.17, 0.26, 0.35, 0.45f64] {
            for stiffness in [1.3e3, 2.2e3, 3.4e3, 7e3, 3.3e4, 1.7e5, 7e5] {
                let width = 2.0 * 10.0 * alpha.tan();
                let structure = match kind {
                    "aframe" => Structure::a_frame(10.0, width, 1e4).unwrap(),
                    _ => Structure::block(20.0, width, 1e4).unwrap(),
                };
                let body = structure.body::<f64>();
                let Some(mut springs) = read_off(&rows, kind, alpha, stiffness) else { continue };
                read += 1;
                let hz = stiffness * body.p() / TAU;
                springs.vertical.omega_n_hz *= hz;
                springs.horizontal.omega_n_hz *= hz;
                let rows = landings(&body, &springs.chains(body.mass), body.restitution());
                let worst = rows.iter().map(|row| row.restitution_error.abs()).fold(0.0, f64::max);
                println!(
                    "{kind} {alpha} {stiffness:.1e}: {:.4} % of {}",
                    100.0 * worst,
                    rows.len()
                );
                assert!(worst < 2e-3 && rows.len() == 8, "{kind} {alpha} {stiffness}: {rows:?}");
            }
        }
    }
    assert!(read > 70, "{read}");
}

/// Rows are a tenth of a decade apart; the logarithm of a value bends by less than 0.03 from row to
/// row, so that a straight line between two rows is right to half a per cent.
#[test]
fn the_curves_bend_little() {
    let rows = chart();
    for curve in rows.chunk_by(|a, b| a.kind == b.kind && a.alpha == b.alpha) {
        for three in curve.windows(3) {
            for k in 1..5 {
                let [a, b, c] = [0, 1, 2].map(|i| three[i].values[k].ln());
                let bend = (a - 2.0 * b + c).abs();
                let Row { kind, alpha, stiffness, .. } = &three[1];
                assert!(
                    bend < 0.03,
                    "{kind}, alpha {alpha}, Omega_n/p {stiffness:.2e}, value {k}: {bend}"
                );
            }
        }
    }
}
