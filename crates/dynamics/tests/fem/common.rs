//! Cases that the stories share.

use dynamics::{
    fem::{Analysis, Control, History, HistoryOutcome, Start},
    spring::{Chain, Design, Springs},
};
use rocking::structure::Structure;
use strong_motion::Record;

/// 20 s of El Centro at its 0.01 s.
pub const SAMPLES: usize = 2001;

/// The paper's structure with I_cg as a share of m R^2.
pub fn paper(share: f64) -> Structure {
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 =
        share * structure.mass_kg * structure.body::<f64>().radius().powi(2);
    structure
}

/// (mu, K, C) of a chain.
pub type Ratios = (f64, f64, f64);

/// Chains of the given ratios at one Omega_n (Hz) for a mass (kg).
pub fn chains(vertical: Ratios, horizontal: Ratios, hz: f64, mass: f64) -> Springs<Chain> {
    let design = |(mu, k, c)| Design::from_kc(mu, k, c, hz);
    Springs { vertical: design(vertical), horizontal: design(horizontal) }.chains(mass)
}

/// Springs that land without rebound.
pub fn plastic(hz: f64, mass: f64) -> Springs<Chain> {
    chains((0.3, 0.1, 0.75), (0.3, 0.57, 1.86), hz, mass)
}

/// The ratios of the paper's Table 1 as recovered at one Omega_n (Hz) for a mass (kg): they bounce
/// a lot.
pub fn table_1(hz: f64, mass: f64) -> Springs<Chain> {
    let Springs { vertical, horizontal } = Springs::table_1();
    let at = |design: Design<f64>| Design { omega_n_hz: hz, ..design };
    Springs { vertical: at(vertical), horizontal: at(horizontal) }.chains(mass)
}

/// Springs that bounce a little.
pub fn lively(hz: f64, mass: f64) -> Springs<Chain> {
    chains((0.06, 0.41, 1.0), (0.18, 0.86, 6.2), hz, mass)
}

/// El Centro, 20 s.
pub fn el_centro() -> Record {
    let mut record = Record::el_centro();
    record.accel.truncate(SAMPLES);
    record
}

/// A history from rest.
pub fn settled(structure: &Structure, springs: Springs<Chain>, record: &Record) -> History {
    settled_with(structure, springs, record, Control::default())
}

/// The same, its steps so controlled.
pub fn settled_with(
    structure: &Structure,
    springs: Springs<Chain>,
    record: &Record,
    control: Control,
) -> History {
    Analysis { control, ..Analysis::new(structure.body(), springs, record.dt, &record.accel) }
        .simulate()
}

/// Free rocking from a lean (rad) for n samples of dt (s).
pub fn free(
    structure: &Structure,
    springs: Springs<Chain>,
    lean: f64,
    dt: f64,
    n: usize,
) -> History {
    let (start, accel) = (Start::Leaning(lean), &vec![0.0; n][..]);
    Analysis { start, ..Analysis::new(structure.body(), springs, dt, accel) }.simulate()
}

/// The account closes to 1e-6 of the largest energy, and dissipation never runs backwards.
pub fn assert_closes(history: &History, what: &str) {
    assert!(history.energy_residual < 1e-6, "{what}: residual {:e}", history.energy_residual);
    let account = &history.account;
    let largest = account.stored.iter().chain(&account.input).fold(0.0_f64, |m, e| m.max(e.abs()));
    let falls = account.dissipated.windows(2).any(|w| w[1] < w[0] - 1e-9 * largest);
    assert!(!falls, "{what}: dissipation fell");
    // what is stored beyond the start came from the ground
    let created = account.stored.iter().zip(&account.input).map(|(s, i)| s - i).fold(0.0, f64::max);
    assert!(created <= 1e-6 * largest, "{what}: {created} J created of {largest}");
}

/// What every history promises: numbers, all samples, a closed energy account, no energy from
/// nowhere.
pub fn assert_sound(history: &History, samples: usize) {
    let motion = &history.motion;
    assert_eq!((history.outcome, motion.len()), (HistoryOutcome::Completed, samples));
    assert!([&motion.u, &motion.v, &motion.theta].into_iter().flatten().all(|x| x.is_finite()));
    assert_closes(history, "");
}
