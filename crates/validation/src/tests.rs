use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use dynamics::compare::Match;
use dynamics::{fem, spring::Design};
use fixed_steps::{FixedStepAnalysis, FixedStepSprings, Integrator};
use rocking::{
    housner,
    motion::{largest_magnitude, nrmse},
    structure::Structure,
    synthetic,
};

/// Springs that absorb a landing along the leg: rebound 0.12 of the landing velocity for the chain
/// alone.
fn springs(structure: &Structure) -> Springs<Chain> {
    let springs = Springs {
        vertical: Design::from_kc(0.3, 0.1, 0.75, 160.0),
        horizontal: Design::from_kc(0.3, 0.57, 1.86, 160.0),
    };
    springs.chains(structure.mass_kg)
}

fn judge_model(structure: &Structure, model: JudgedModel) -> Validator {
    let body = structure.body::<f64>();
    Validator { body, restitution: body.restitution(), duration_s: None, model }
}

fn judge_with(structure: &Structure, control: Control) -> Validator {
    judge_model(structure, JudgedModel::Events { springs: springs(structure), control })
}

fn judge(structure: &Structure) -> Validator {
    judge_with(structure, Control::default())
}

fn frame() -> Structure {
    let mut structure = Structure::paper();
    structure.rotational_inertia_kgm2 = 1e-5 * structure.mass_kg * structure.height_m.powi(2);
    structure
}

#[test]
fn a_row_says_what_the_whole_histories_say() {
    let judge = Validator { duration_s: Some(10.0), ..judge(&frame()) };
    let record = Record::el_centro();
    let row = judge.judge(std::slice::from_ref(&record)).remove(0);

    let short = record.truncated(10.0);
    let rocking = housner::history(&judge.body, short.dt, &short.accel);
    let motion = rocking.motion(&judge.body);
    let history =
        fem::Analysis::new(judge.body, springs(&frame()), short.dt, &short.accel).simulate();
    let found =
        Match::new(&judge.body, short.dt, (&motion, &rocking.impacts), &history, judge.restitution);
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    assert!(close(row.nrmse_horizontal.unwrap(), found.nrmse_horizontal), "{row:?} {found:?}");
    assert!(close(row.nrmse_vertical.unwrap(), found.nrmse_vertical), "{row:?} {found:?}");
    assert!(close(row.energy_residual.unwrap(), found.energy_residual), "{row:?} {found:?}");
    assert_eq!((row.duration_s, row.impacts), (found.duration_s, found.impacts_housner));
    let peak = |theta: &[f64]| largest_magnitude(theta) / judge.body.alpha();
    assert!(close(row.peak_ratio_housner, peak(&motion.theta)));
    assert!(close(row.peak_ratio_fem.unwrap(), peak(&history.motion.theta)));
    assert!(row.comparable() && row.agrees());
}

/// A constant push of 0.15 g, held, is more than g tan alpha = 0.1 g: the body topples whatever the
/// springs.
#[test]
fn a_body_that_topples_has_the_peak_of_one_that_lies_flat() {
    let judge = judge(&frame());
    let flat = std::f64::consts::FRAC_PI_2 / judge.body.alpha();
    // it passes alpha at acosh(3)/p = 4.4 s, cannot come back from 6.2 s on and would lie on the
    // ground after some 11 s
    for duration in [5.0, 20.0] {
        let record =
            Record::new("push", 0.01, vec![0.15 * 9.81; (100.0 * duration) as usize]).unwrap();
        let row = judge.judge(std::slice::from_ref(&record)).remove(0);
        assert!(row.overturned_housner, "{row:?}");
        assert_eq!(
            (row.outcome, row.overturned_fem, row.peak_ratio_housner),
            (RecordOutcome::Overturned, Some(true), flat)
        );
        assert_eq!(row.peak_ratio_fem, Some(flat));
        assert!(row.agrees() && !row.comparable());
    }
}

#[test]
fn a_record_that_never_lifts_the_body_has_no_peak_and_no_error() {
    let judge = judge(&frame());
    let record = Record::new("weak", 0.01, vec![0.02 * 9.81; 300]).unwrap();
    let row = judge.judge(std::slice::from_ref(&record)).remove(0);
    assert_eq!(
        (row.outcome, row.nrmse_horizontal, row.nrmse_vertical),
        (RecordOutcome::NeverLifted, None, None)
    );
    assert_eq!(
        (row.peak_ratio_housner, row.peak_ratio_fem, row.sensitivity),
        (0.0, Some(0.0), 0.0)
    );
    assert!(row.agrees() && !row.comparable());
}

/// The body leans to the right, its mass still left of the right foot, as the ground goes off to
/// the right with 3 g. Beyond g/tan(0.6) = 1.46 g only a pivot that pulls could take the mass
/// along.
#[test]
fn a_pivot_that_would_have_to_pull_is_told_and_its_history_not_compared() {
    let judge = judge(&Structure::a_frame(20.0, 40.0 * 0.6f64.tan(), 1e5).unwrap());
    let push = |samples: usize, g: f64| vec![g * 9.81; samples];
    let accel = [push(20, -1.0), push(4, 3.0), push(200, 0.0)].concat();
    let row = judge.judge(&[Record::new("jerk", 0.01, accel).unwrap()]).remove(0);
    assert!(row.pivot_pulls_s.is_some_and(|time| (time - 0.20).abs() < 1e-9), "{row:?}");
    assert!(!row.overturned_housner && !row.rocked() && !row.comparable(), "{row:?}");
    let weaker = [push(20, -1.0), push(4, 1.0), push(200, 0.0)].concat();
    let row = judge.judge(&[Record::new("jerk", 0.01, weaker).unwrap()]).remove(0);
    assert!(row.pivot_pulls_s.is_none() && row.rocked(), "{row:?}");
}

#[test]
fn a_history_that_meets_its_bound_on_work_is_listed_as_failed() {
    let control = Control { most_steps: 300, ..Control::default() };
    let judge = Validator { duration_s: Some(5.0), ..judge_with(&frame(), control) };
    let found = judge.judge_all(1, |_| Ok::<_, ()>(Record::el_centro()), |_| {}).unwrap();
    let row = &found.records[0];
    assert_eq!(
        (row.outcome, row.overturned_fem, row.peak_ratio_fem),
        (RecordOutcome::FemFailed, None, None)
    );
    let all = found.all;
    assert_eq!(
        (all.failed, all.overturning_agreement, all.ks_distance),
        (vec!["IELC180".to_string()], 0.0, 1.0)
    );
}

#[test]
fn every_record_is_asked_for_once_and_rows_keep_their_order() {
    let judge = judge(&Structure::block(2.0, 0.5, 1000.0).unwrap());
    let (p, alpha) = (judge.body.p(), judge.body.alpha());
    let asked: Vec<AtomicUsize> = (0..6).map(|_| AtomicUsize::new(0)).collect();
    let last = AtomicUsize::new(0);
    let record = |i: usize| {
        asked[i].fetch_add(1, Ordering::Relaxed);
        Ok::<_, ()>(synthetic::record(1, i, p, alpha))
    };
    let all = judge.judge_all(6, record, |n| _ = last.fetch_max(n, Ordering::Relaxed)).unwrap();
    assert!(asked.iter().all(|n| n.load(Ordering::Relaxed) == 1));
    assert_eq!(last.load(Ordering::Relaxed), 6);
    for (i, row) in all.records.iter().enumerate() {
        assert_eq!(*row, judge.judge(&[synthetic::record(1, i, p, alpha)])[0]);
    }
}

#[test]
fn the_first_of_several_errors_is_reported() {
    let judge = judge(&frame());
    let record = |i: usize| {
        if i == 0 { Record::new("one", 0.01, vec![0.0; 10]).map_err(|_| 0) } else { Err(i) }
    };
    assert_eq!(judge.judge_all(8, record, |_| {}).unwrap_err(), 1);
}

/// Of steps of one size: what the whole history of such a program says beside Housner's, and no
/// forces.
#[test]
fn a_row_of_even_steps_says_what_the_program_s_history_says() {
    let (structure, dt) = (Structure::block(2.0, 0.6, 1e3).unwrap(), 1e-3);
    let body = structure.body::<f64>();
    let springs = FixedStepSprings::of(&body, dt, Integrator::Trbdf2).unwrap();
    let model = FixedStepBody::new(&springs.body, &springs.chains());
    let settings = springs.settings();
    let judge = judge_model(&structure, JudgedModel::Even { model, settings });
    let p = body.p();
    let records: Vec<Record> = (0..30).map(|i| synthetic::record(1, i, p, body.alpha())).collect();
    let rows = judge.judge(&records);
    let rocked = rows.iter().zip(&records).filter(|(row, _)| row.comparable() && !row.failed());
    assert!(rocked.clone().count() > 3, "{rows:?}");
    for (row, record) in rocked {
        let history = FixedStepAnalysis::new(&model, settings, record.dt, &record.accel).history();
        let motion = housner::history(&body, record.dt, &record.accel).motion(&body);
        let displacement =
            (largest_magnitude(&history.motion.u) / largest_magnitude(&motion.u) - 1.0).abs();
        let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() <= 1e-9 * b.abs().max(1e-3);
        assert!(close(row.nrmse_horizontal, nrmse(&history.motion.u, &motion.u)), "{row:?}");
        assert!(close(row.displacement_error, displacement), "{row:?} {displacement}");
        assert!(close(row.peak_ratio_fem, largest_magnitude(&history.motion.theta) / body.alpha()));
        assert!(row.uplift_error.is_some() && row.overturned_fem == Some(false), "{row:?}");
        assert_eq!(
            (row.base_shear_error, row.axial_error, row.energy_residual),
            (None, None, None)
        );
    }
    let all = Validation::new(rows).all;
    assert!(all.peaks_well_conditioned.median.is_some() && all.energy_residual_max.is_none());
}

/// A program that gives up is a history that failed; a body that it topples has toppled.
#[test]
fn what_a_program_gives_up_or_topples_is_told() {
    let structure = Structure::block(2.0, 0.6, 1e3).unwrap();
    let body = structure.body::<f64>();
    let springs = FixedStepSprings::of(&body, 1e-3, Integrator::Trbdf2).unwrap();
    let model = FixedStepBody::new(&springs.body, &springs.chains());
    let of = |newton: usize, scale: f64| {
        let mut settings = springs.settings();
        settings.iteration.newton = newton;
        let model = JudgedModel::Even { model, settings };
        let record = Record::el_centro().scaled(scale).unwrap();
        judge_model(&structure, model).judge(&[record]).remove(0)
    };
    let lost = of(1, 2.0);
    assert_eq!((lost.outcome, lost.overturned_fem), (RecordOutcome::FemFailed, None));
    let toppled = of(30, 20.0);
    assert_eq!((toppled.overturned_housner, toppled.overturned_fem), (true, Some(true)));
}

/// Displacement and uplift by the whole histories; the base shear by the springs' own forces
/// between landings at every step, and by equation (1) at the samples instead of the momentum
/// between them: for a body at rest a_g, and on a foot R (cos(phi) theta'' + sin(phi) theta'^2) +
/// a_g.
#[test]
fn errors_of_peaks_are_those_of_an_independent_calculation() {
    for (control, width) in
        [(Control::default(), 0.6), (Control { long_steps: true, ..Control::search() }, 0.6)]
    {
        let structure = Structure::block(2.0, width, 1e3).unwrap();
        let judge = judge_with(&structure, control);
        let body = &judge.body;
        let p = body.p();
        let record = synthetic::record(1, 4, p, body.alpha());
        let row = judge.judge(std::slice::from_ref(&record)).remove(0);
        let rocking = housner::history(body, record.dt, &record.accel);
        let (mut history, mut demands) =
            fem::Analysis::new(*body, springs(&structure), record.dt, &record.accel)
                .simulate_with(&rocking::members::Members::default());
        let motion = rocking.motion(body);
        let displacement =
            (largest_magnitude(&history.motion.u) / largest_magnitude(&motion.u) - 1.0).abs();
        let uplift = (largest_magnitude(&history.motion.theta).sin()
            / largest_magnitude(&motion.theta).sin()
            - 1.0)
            .abs();
        let n = history.motion.len();
        demands.separate(body, record.dt, &std::mem::take(&mut history.landings), n);
        let landed = |t: f64| {
            let since = |i: &housner::Impact<f64>| i.time <= t && i.time >= t - record.dt - 0.1 / p;
            rocking.impacts.iter().any(since)
        };
        let shear = |i: usize| {
            let (theta, rate, ground) = (rocking.theta[i], rocking.rate[i], record.accel[i]);
            if theta == 0.0 && rate == 0.0 {
                return ground;
            }
            let phi = body.alpha() * theta.signum() - theta;
            let turn = -p * p * (phi.sin() + ground / 9.81 * phi.cos());
            body.radius() * (phi.cos() * turn + phi.sin() * rate * rate) + ground
        };
        let free = (0..n).filter(|i| !landed(*i as f64 * record.dt));
        let housner = free.fold(0.0, |peak: f64, i| peak.max(shear(i).abs())) * body.mass;
        let base_shear = (demands.between[0].value.abs() / housner - 1.0).abs();
        println!("{row:?}\n{displacement} {uplift} {base_shear}");
        let tolerance = if control.long_steps { 1e-3 } else { 1e-9 };
        assert!((row.displacement_error.unwrap() - displacement).abs() < tolerance, "{row:?}");
        assert!((row.uplift_error.unwrap() - uplift).abs() < tolerance, "{row:?}");
        // means over a sample's interval beside the largest instant in it
        assert!((row.base_shear_error.unwrap() - base_shear).abs() < 0.02, "{row:?} {base_shear}");
    }
}

/// Peaks of motions whose steps go over several samples, beside those whose steps end at every
/// sample: what springs cannot change. With the slope of the places for a velocity, which is a
/// parabola and not the cubic that it should be, base shears differed by 0.5 to 1.4 %.
#[test]
fn long_steps_know_forces_as_well_as_short_ones() {
    let block = |height: f64, width: f64| Structure::block(height, width, 1e3).unwrap();
    for structure in
        [frame(), Structure::a_frame(12.0, 2.2, 1e5).unwrap(), block(2.6, 0.7), block(0.3, 0.1)]
    {
        let body = structure.body::<f64>();
        let p = body.p();
        let hz = 4e4 * p / std::f64::consts::TAU;
        let design = |m2: f64, k: f64, c: f64| Design::from_kc(m2, k, c, hz);
        let springs =
            Springs { vertical: design(0.3, 0.1, 0.75), horizontal: design(0.3, 0.57, 1.86) };
        let springs = springs.chains(structure.mass_kg);
        let records: Vec<Record> =
            (0..40).map(|i| synthetic::record(7, i, p, body.alpha())).collect();
        let forces = |long_steps: bool| {
            let control = Control { long_steps, ..Control::search() };
            let model = JudgedModel::Events { springs, control };
            let rows = judge_model(&structure, model).judge(&records);
            rows.into_iter()
                .map(|row| row.base_shear_error.zip(row.axial_error))
                .collect::<Vec<_>>()
        };
        let pairs = forces(true).into_iter().zip(forces(false));
        let mut differences: Vec<f64> = pairs
            .filter_map(|(a, b)| a.zip(b))
            .map(|(a, b)| (a.0 - b.0).abs().max((a.1 - b.1).abs()))
            .collect();
        differences.sort_by(f64::total_cmp);
        let count = differences.len();
        assert!(count > 20, "{count}");
        let [median, most] = [differences[count / 2], differences[count * 9 / 10]];
        // measured: up to 3e-5 and 1.5e-4
        assert!(median < 1e-4 && most < 5e-4, "{structure:?}: {median} {most}");
    }
}
