//! The digits of Table 1, and what follows from them in closed form. No history is computed here.

use std::f64::consts::TAU;

use dynamics::spring::Springs;
use frequency_response::{
    Response,
    bounds::Bounds,
    inner::{Fit, FitOutcome, fit},
    target::Target,
};
use landing::chain::land;
use rocking::structure::Structure;

/// Mass at the apex, section 4 [kg].
const M1: f64 = 680.1e3;

/// Table 1, rows Omega_n and k1: k1 = m1 Omega_n^2 gives back every printed digit of both, and so
/// fixes m1.
///
/// 6.2 Hz and 680.1 t give 1.032e9 N/m; 10 Hz gives 2.685e9 N/m.
#[test]
fn both_k1_follow_from_omega_n() {
    let springs = Springs::table_1();
    assert_eq!((springs.vertical.omega_n_hz, springs.horizontal.omega_n_hz), (6.2, 10.0));
    let chains = springs.chains(M1);
    assert_eq!(format!("{:.3e}", chains.vertical.k1), "1.032e9");
    assert_eq!(format!("{:.3e}", chains.horizontal.k1), "2.685e9");
    // a tonne more or less changes the last digit of the horizontal k1
    for m1 in [M1 - 1e3, M1 + 1e3] {
        assert_ne!(format!("{:.3e}", springs.chains(m1).horizontal.k1), "2.685e9");
    }
}

/// Table 1, row k2, and section 3: k2 = mu f^2 k1. The printed vertical k2 = 9.509e9 is 9.214 times
/// the printed k1; from the k1 that is not rounded it is 9.5096e9, half a unit of the last digit of
/// mu f^2 away.
#[test]
fn the_vertical_k2_follows_from_mu_f_squared() {
    let springs = Springs::table_1();
    assert_eq!(format!("{:.3e}", springs.vertical.k() * 1.032e9), "9.509e9");
    assert!((springs.chains(M1).vertical.k2 / 9.509e9 - 1.0).abs() < 1e-4);
}

/// Table 1, rows k2 and c, as far as digits survive: horizontal k2 1.31e9 to 1.32e9 N/m (or 2.1e9
/// to 2.3e9), c 3.34e8 N s/m, vertical c x.65e8 N s/m. In no reading is the horizontal k2 larger
/// than k1: a ratio of 9.214 there would be 2.474e10 N/m.
#[test]
fn what_survives_of_the_horizontal_k2_and_of_both_c_is_kept() {
    let chains = Springs::table_1().chains(M1);
    assert!((1.31e9..1.32e9).contains(&chains.horizontal.k2), "{:e}", chains.horizontal.k2);
    assert!((chains.vertical.c / 1.165e8 - 1.0).abs() < 1e-3, "{:e}", chains.vertical.c);
    assert!((chains.horizontal.c / 3.34e8 - 1.0).abs() < 1e-3, "{:e}", chains.horizontal.c);
}

/// Section 5.1 and equation 7: the vertical k2/k1 = 9.509e9/1.032e9 = 9.214 is the design of the
/// smallest largest ARR for the mass ratio mu = 10.2. So the lost mu of Table 1 is 10.2.
#[test]
fn the_vertical_stiffness_ratio_is_the_minimax_design_of_mu_10_2() {
    let minimax = |mu: f64| -> Fit { fit(mu, &Target::default(), &Bounds::default()).unwrap() };
    let (mut low, mut high) = (9.0, 12.0);
    for _ in 0..40 {
        let mu = 0.5 * (low + high);
        if minimax(mu).k < 9.214 { low = mu } else { high = mu }
    }
    assert_eq!(format!("{low:.1}"), "10.2", "{low}");
    let fit = minimax(low);
    assert!((fit.k - 9.214).abs() < 1e-9);
    // its certificate: no other f and xi has a smaller peak nearby
    let certificate = &fit.certificate;
    assert_eq!(fit.outcome, FitOutcome::Converged, "{fit:?}");
    assert!(certificate.residual < 1e-7 && certificate.spread < 1e-9, "{fit:?}");
    let sum: f64 = certificate.active.iter().map(|active| active.multiplier).sum();
    assert!(
        (sum - 1.0).abs() < 1e-12
            && certificate.active.iter().all(|active| active.multiplier >= 0.0),
        "{fit:?}"
    );
    assert!(certificate.bounds.iter().all(|bound| bound.multiplier > 0.0), "{fit:?}");
    // large mu in closed form: f^2 = (mu - 1)/mu, K = mu - 1
    assert!((fit.k / (low - 1.0) - 1.0).abs() < 2e-3, "{fit:?}");
}

/// Section 5.1: the response is to be uniform at the low frequencies of rocking, low elsewhere, and
/// high frequencies are to be damped out. Equation 7: ARR(0) = 1 + 1/K, and ARR tends to 1/g^2.
#[test]
fn the_vertical_response_is_uniform_below_and_falls_above() {
    let design = Springs::table_1().vertical;
    let response = Response { mu: design.mu, k: design.k(), c: design.c() };
    let at_zero = 1.0 + 1.0 / 9.214;
    assert!((response.at_zero() - at_zero).abs() < 1e-12);
    // rocking has a period of 3.5 s: 0.29 Hz, g = 0.046 of 6.2 Hz
    assert!((response.arr(1.0 / 3.5 / 6.2) / at_zero - 1.0).abs() < 3e-3);
    assert!((response.arr(1e3) * 1e6 - 1.0).abs() < 1e-4);
}

/// Weight m1 g/2 on k1 and k2 in series: the frame sinks 3.58 mm under its own weight, 8 % of the
/// vertical peak of Figure 4.
#[test]
fn the_frame_settles_by_3_58_mm() {
    let by_hand = 0.5 * M1 * 9.81 * (1.0 / 1.032e9 + 1.0 / 9.509e9);
    assert_eq!(format!("{:.2}", by_hand * 1e3), "3.58");
    assert_eq!(format!("{:.2}", Springs::table_1().settlement(M1) * 1e3), "3.58");
}

/// Before it lifts the frame sways on its vertical springs with f = Omega_n/(2 pi) sqrt(2K/(1 + K))
/// b/R: 0.83 Hz. Housner's frame does not move before it lifts.
#[test]
fn the_standing_frame_sways_at_0_83_hz() {
    let by_hand = 6.2 * (2.0 * 9.214 / 10.214_f64).sqrt() * 6.1 / 61.0_f64.hypot(6.1);
    assert_eq!(format!("{by_hand:.2}"), "0.83");
    // the same from k1 and k2 in newtons per metre: two feet 2b apart turn the frame, k_theta = 2
    // b^2 k, about m1 R^2
    let chain = Springs::table_1().chains(M1).vertical;
    let k_theta = 2.0 * 6.1_f64.powi(2) * chain.in_series();
    let sway = (k_theta / (M1 * (61.0_f64.powi(2) + 6.1_f64.powi(2)))).sqrt() / TAU;
    assert!((sway / by_hand - 1.0).abs() < 1e-4, "{sway} {by_hand}");
}

/// Along the landing leg: a mass that comes down on Table 1's vertical unit, without gravity,
/// leaves it with 0.907 to 0.924 of its speed, for every reading of the lost digits of c. Figures
/// of an independent program (matrix exponentials, numpy and scipy).
#[test]
fn a_landing_gives_nine_tenths_of_its_speed_back() {
    for (c, rebound) in [
        (1.165e8, 0.90676),
        (1.265e8, 0.90865),
        (1.655e8, 0.91538),
        (2.165e8, 0.92294),
        (2.265e8, 0.92428),
    ] {
        let landing = land(9.214, c / (M1 * TAU * 6.2), 10.2).unwrap();
        // five digits are printed; the program's steps are 1e-4/Omega_n long
        assert!((landing.rebound - rebound).abs() < 1e-4, "c = {c:e}: {landing:?}");
    }
}

/// Equations 2 and 4: r = (1 - 2 sin^2 alpha)^2 is a ratio of energies, 0.961 for 61 x 12.2 m; the
/// ratio of velocities is its root, 0.980.
#[test]
fn r_of_equation_4_is_a_ratio_of_energies() {
    let alpha = (6.1_f64 / 61.0).atan();
    let r = (1.0 - 2.0 * alpha.sin().powi(2)).powi(2);
    assert_eq!(
        (format!("{r:.5}"), format!("{:.4}", r.sqrt())),
        ("0.96079".into(), "0.9802".into())
    );
    let e = Structure::paper().body::<f64>().restitution();
    assert!((e * e - r).abs() < 1e-12, "{e} {r}");
}
