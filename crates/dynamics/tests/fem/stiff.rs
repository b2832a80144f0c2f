//! Very stiff springs under bodies slender and stocky: every history finishes, whatever the springs
//! do in a landing.

use dynamics::{
    fem::{Analysis, Control, History, HistoryOutcome},
    spring::{Chain, Design, Springs},
};
use rocking::{
    housner,
    motion::nrmse,
    structure::{Kind, Structure},
};
use rocking::{regime, synthetic};

use crate::common::{Ratios, plastic};

/// Hardly rebounds: 0.8 % of the landing speed.
const DEAD: Ratios = (0.66, 0.005, 0.5);
/// Rebounds by 14 %.
const LIVE: Ratios = (0.77, 0.2, 0.647);

/// A frame of this alpha, its mass 20 m from the feet, I_cg a share of m R^2.
fn frame(alpha: f64, share: f64) -> Structure {
    let (radius, mass_kg) = (20.0, 1e5);
    Structure {
        kind: Kind::AFrame,
        height_m: radius * alpha.cos(),
        width_m: 2.0 * radius * alpha.sin(),
        mass_kg,
        rotational_inertia_kgm2: share * mass_kg * radius * radius,
    }
}

/// One vertical chain for every body, scaled by the mass that lands, M = 1 - (m R^2/I0) sin^2
/// alpha, under horizontals `rho` times as stiff.
fn landing(structure: &Structure, (mu, k, c): Ratios, rho: f64, hz: f64) -> Springs<Chain> {
    let body = structure.body::<f64>();
    let point = body.mass * body.radius().powi(2);
    let landing = 1.0 - point / (point + body.inertia) * body.alpha().sin().powi(2);
    let vertical = Design::from_kc(mu * landing, k, c * landing.sqrt(), hz);
    Springs { vertical, horizontal: Design::from_kc(0.3, 1.0, 2.0, rho * hz) }.chains(body.mass)
}

/// Histories of the first n motions of a suite, with Housner's NRMSE where that body neither rests
/// nor overturns.
fn suite(structure: &Structure, springs: Springs<Chain>, n: usize) -> Vec<(History, Option<f64>)> {
    let body = structure.body::<f64>();
    let records = synthetic::suite(n, 1, body.p(), body.alpha());
    let run = |record: strong_motion::Record| {
        let control = Control { most_steps: 500_000, ..Control::default() };
        let (dt, accel) = (record.dt, &record.accel[..]);
        let history = Analysis { control, ..Analysis::new(body, springs, dt, accel) }.simulate();
        let rocking = housner::history(&body, dt, accel);
        let rocked = rocking.outcome == housner::RockingOutcome::Rocked
            && history.outcome == HistoryOutcome::Completed;
        let error = rocked.then(|| nrmse(&history.motion.u, &rocking.motion(&body).u));
        (history, error)
    };
    records.map(run).collect()
}

#[test]
fn frames_slender_and_stocky_finish_on_springs_of_10_khz() {
    frames_finish_on(1e4);
}

#[test]
fn frames_slender_and_stocky_finish_on_springs_of_200_khz() {
    frames_finish_on(2e5);
}

fn frames_finish_on(hz: f64) {
    for alpha in [0.1, 0.4, 0.5, 0.6] {
        for share in [0.0, 1e-3, 1e-2] {
            let structure = frame(alpha, share);
            let all = [
                plastic(hz, structure.mass_kg),
                landing(&structure, DEAD, 20.0, hz),
                landing(&structure, LIVE, 2.0, hz),
            ];
            for springs in all {
                for (i, (history, _)) in suite(&structure, springs, 12).into_iter().enumerate() {
                    let ended = matches!(
                        history.outcome,
                        HistoryOutcome::Completed | HistoryOutcome::Overturned { .. }
                    );
                    assert!(
                        ended,
                        "alpha {alpha}, I_cg {share}, {hz} Hz, motion {i}: {:?}",
                        history.outcome
                    );
                    assert!(
                        history.energy_residual < 1e-6,
                        "{alpha} {share} {hz} {i} {:?} {:e}",
                        history.outcome,
                        history.energy_residual
                    );
                }
            }
        }
    }
}

/// The landing's rule needs no slenderness: on a chain that hardly rebounds a frame of 0.4 follows
/// Housner.
#[test]
fn a_stocky_frame_on_a_chain_that_hardly_rebounds_follows_housner() {
    let structure = frame(0.4, 0.0);
    let rocked = suite(&structure, landing(&structure, DEAD, 20.0, 1e4), 30);
    let mut errors: Vec<f64> = rocked.into_iter().filter_map(|(_, error)| error).collect();
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];
    assert!(errors.len() >= 10 && median < 1e-3, "{errors:?}");
}

/// Under more than g/tan(alpha) the ground pulls a stocky frame's foot away from under it:
/// Housner's pivot would have to hold the body down. Up to that instant the histories are the same,
/// not after it.
#[test]
fn a_stocky_frame_follows_housner_until_his_pivot_would_have_to_pull() {
    let structure = frame(0.6, 0.0);
    let (body, springs) = (structure.body::<f64>(), landing(&structure, DEAD, 20.0, 1e4));
    let (mut before, mut whole) = (Vec::new(), Vec::new());
    for record in synthetic::suite(60, 1, body.p(), body.alpha()) {
        let (dt, accel) = (record.dt, &record.accel[..]);
        let rocking = housner::history(&body, dt, accel);
        let Some(time) = regime::pivot_pulls(&body, dt, accel, &rocking) else { continue };
        let history = Analysis::new(body, springs, dt, accel).simulate();
        let (u, reference) = (&history.motion.u, &rocking.motion(&body).u);
        let until = (time / dt) as usize + 1;
        before.push(nrmse(&u[..until], &reference[..until]));
        if rocking.outcome == housner::RockingOutcome::Rocked
            && history.outcome == HistoryOutcome::Completed
        {
            whole.push(nrmse(u, reference));
        }
    }
    before.sort_by(f64::total_cmp);
    whole.sort_by(f64::total_cmp);
    assert!(before.len() >= 10 && before[before.len() * 9 / 10] < 2e-3, "{before:?}");
    assert!(whole[whole.len() / 2] > 0.1, "{whole:?}");
}
