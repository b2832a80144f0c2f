//! The claims of section 6 and Figure 4 on our springs: those of `tune run` without arguments, 20 s
//! of El Centro.

use dynamics::compare::Match;
use std::sync::LazyLock;

use cases::Case;
use dynamics::fem::{self, History};
use springs::job::Job;

struct Tuned {
    job: Job,
    fem: History,
    matched: Match,
}

static TUNED: LazyLock<Tuned> = LazyLock::new(|| {
    let case = Case::paper().unwrap();
    let job = Job::new(&case, &|_, _, _| {}).unwrap();
    let fem = fem::Analysis::new(
        job.body,
        job.springs.chains(job.body.mass),
        job.record.dt,
        &job.record.accel,
    )
    .simulate();
    let rocking = (&job.housner, &job.rocking.impacts[..]);
    let matched = Match::new(&job.body, job.record.dt, rocking, &fem, case.restitution);
    Tuned { job, fem, matched }
});

/// Times of Housner's impacts [s].
fn impacts() -> Vec<f64> {
    TUNED.job.rocking.impacts.iter().map(|i| i.time).collect()
}

#[test]
fn the_peaks_and_the_time_history_follow_housner() {
    let m = &TUNED.matched;
    assert!(m.nrmse_horizontal < 0.002 && m.nrmse_vertical < 0.002, "{m:?}");
    assert!((m.peak_horizontal_fem_m / m.peak_horizontal_housner_m - 1.0).abs() < 0.01, "{m:?}");
    assert!((m.peak_vertical_fem_m / m.peak_vertical_housner_m - 1.0).abs() < 0.01, "{m:?}");
    // the body of the model has 1e-5 m R^2 of rotational inertia: the same peak to five digits as
    // without
    assert!((m.peak_horizontal_housner_m + 0.401181622959).abs() < 1e-4 * 0.4, "{m:?}");
}

#[test]
fn beck_and_skinners_peak_and_period_are_of_the_same_size() {
    let peak = TUNED.matched.peak_horizontal_fem_m.abs();
    assert!((0.85..1.15).contains(&(peak / 0.4445)), "{peak}");
    // the strong part of the record: successive impacts are half a period apart
    let times = impacts();
    let halves: Vec<f64> =
        times.windows(2).map(|w| w[1] - w[0]).filter(|half| *half > 1.4).collect();
    let period = 2.0 * halves.iter().sum::<f64>() / halves.len() as f64;
    assert!((3.0..3.6).contains(&period), "{period}");
}

#[test]
fn no_foot_is_ever_in_tension() {
    let weight = TUNED.job.body.mass * 9.81;
    for foot in &TUNED.fem.forces.vertical {
        // an event is located to 1e-9 of the weight's compression
        assert!(foot.iter().all(|n| *n > -1e-6 * weight));
    }
}

#[test]
fn no_bounce_lasts() {
    let fem = &TUNED.fem;
    for landing in fem.landings.iter().filter(|l| l.impact) {
        assert!(landing.airborne < 0.1, "{landing:?}");
    }
    // a quarter of a second after an impact the landed foot carries the weight until the next
    let dt = TUNED.job.record.dt;
    let times: Vec<f64> =
        fem.landings.iter().filter(|l| l.impact && l.kinetic > 1e4).map(|l| l.time).collect();
    for (k, landing) in fem.landings.iter().filter(|l| l.impact && l.kinetic > 1e4).enumerate() {
        let end = times.get(k + 1).copied().unwrap_or(20.0) - 0.05;
        let samples = ((landing.time + 0.25) / dt) as usize..(end / dt) as usize;
        assert!(samples.clone().all(|i| fem.forces.vertical[landing.foot][i] > 0.0), "{landing:?}");
    }
}

#[test]
fn vertical_ringing_is_gone_before_the_next_impact() {
    let fem = &TUNED.fem;
    let weight = TUNED.job.body.mass * 9.81;
    let impacts: Vec<f64> = fem.landings.iter().filter(|l| l.impact).map(|l| l.time).collect();
    assert!(impacts.len() > 10);
    for time in &impacts[1..] {
        let last = (time / TUNED.job.record.dt) as usize - 2;
        let force = |i: usize| fem.forces.vertical[0][i] + fem.forces.vertical[1][i];
        // rocking itself changes the force slowly; ringing would change it from sample to sample
        for i in last - 5..last {
            let ringing = (force(i + 1) - 2.0 * force(i) + force(i - 1)).abs() / 4.0;
            assert!(ringing < 0.01 * weight, "{time}: {}", ringing / weight);
        }
    }
}

#[test]
fn nothing_is_dissipated_while_uplifted() {
    let fem = &TUNED.fem;
    let dt = TUNED.job.record.dt;
    let all = fem.account.dissipated.last().unwrap();
    let times = impacts();
    let quiet: f64 = times
        .windows(2)
        .map(|w| {
            let (from, to) = (((w[0] + 0.5) / dt) as usize, ((w[1] - 0.1) / dt) as usize);
            if to > from { fem.account.dissipated[to] - fem.account.dissipated[from] } else { 0.0 }
        })
        .sum();
    assert!(quiet.abs() < 2e-3 * all, "{quiet} of {all} J");
}

#[test]
fn the_energy_account_closes() {
    assert!(TUNED.matched.energy_residual < 1e-6, "{:?}", TUNED.matched);
}

#[test]
fn the_same_case_gives_the_same_springs() {
    let again = Job::new(&Case::paper().unwrap(), &|_, _, _| {}).unwrap();
    assert_eq!(again.springs, TUNED.job.springs);
}
