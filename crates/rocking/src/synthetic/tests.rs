use super::*;
use crate::housner;
use crate::structure::{Body, Structure};

/// The bodies that a suite of records must exercise: A-frames and blocks from 61 m to 0.6 m.
fn bodies() -> Vec<(&'static str, Body<f64>)> {
    [
        ("61 x 12.2 m A-frame", Structure::a_frame(61.0, 12.2, 1e5)),
        ("20 x 4 m A-frame", Structure::a_frame(20.0, 4.0, 1e5)),
        ("5 x 1.5 m A-frame", Structure::a_frame(5.0, 1.5, 1e5)),
        ("2 x 0.5 m block", Structure::block(2.0, 0.5, 1e3)),
        ("0.6 x 0.2 m block", Structure::block(0.6, 0.2, 100.0)),
    ]
    .map(|(name, structure)| (name, structure.unwrap().body()))
    .to_vec()
}

/// Largest |theta|/alpha of Housner's rocking by Runge-Kutta steps, four to a sample, impacts to
/// the nearest step; a body that leans beyond alpha at the end has toppled: infinite.
fn peak_rocking(body: &Body<f64>, record: &Record) -> f64 {
    let (p2, alpha, e) = (body.p_squared(), body.alpha(), body.restitution());
    let (mut theta, mut rate, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    let h = record.dt / 4.0;
    for pair in record.accel.windows(2) {
        let ground = |step: f64| pair[0] + (pair[1] - pair[0]) * step / 4.0;
        for step in 0..4 {
            let step = f64::from(step);
            if theta == 0.0 && rate.abs() < 1e-6 {
                rate = 0.0;
                if ground(step).abs() <= GRAVITY * alpha.tan() {
                    continue;
                }
            }
            let s = [theta, rate, -ground(step)]
                .into_iter()
                .find(|x| *x != 0.0)
                .map_or(1.0, f64::signum);
            let f = |theta: f64, t: f64| {
                -p2 * ((alpha * s - theta).sin()
                    + ground(step + t) / GRAVITY * (alpha * s - theta).cos())
            };
            let k1 = (rate, f(theta, 0.0));
            let k2 = (rate + h / 2.0 * k1.1, f(theta + h / 2.0 * k1.0, 0.5));
            let k3 = (rate + h / 2.0 * k2.1, f(theta + h / 2.0 * k2.0, 0.5));
            let k4 = (rate + h * k3.1, f(theta + h * k3.0, 1.0));
            theta += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
            rate += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
            if theta * s < 0.0 {
                (theta, rate) = (0.0, e * rate);
            }
            peak = peak.max(theta.abs() / alpha);
        }
        if theta.abs() > 1.5 {
            break;
        }
    }
    if theta.abs() > alpha { f64::INFINITY } else { peak }
}

#[test]
fn outcomes_are_a_mix_from_hardly_lifting_to_toppling() {
    for (name, body) in bodies() {
        let n = 150;
        let (p, alpha) = (body.p(), body.alpha());
        let solved = parallel::map_range(0..n, |index| {
            let record = record(42, index, p, alpha);
            let rocking = housner::history(&body, record.dt, &record.accel);
            (
                peak_rocking(&body, &record),
                matches!(rocking.outcome, housner::RockingOutcome::Overturned { .. }),
            )
        });
        let (peaks, overturned): (Vec<f64>, Vec<bool>) = solved.into_iter().unzip();
        // the two solvers differ where a body hangs in the balance
        let agree = peaks
            .iter()
            .zip(&overturned)
            .filter(|(peak, overturned)| peak.is_infinite() == **overturned)
            .count();
        assert!(agree * 100 >= n * 97, "{name}: {agree} of {n} alike");
        let share = |low: f64, high: f64, kind: &[usize]| {
            let of_kind: Vec<f64> =
                (0..n).filter(|i| kind.contains(&(i % 3))).map(|i| peaks[i]).collect();
            of_kind.iter().filter(|peak| (low..high).contains(peak)).count() as f64
                / of_kind.len() as f64
        };
        let all = [0, 1, 2];
        let toppled_of = |kind: &[usize]| 1.0 - share(0.0, f64::INFINITY, kind);
        let toppled = all.map(|kind| toppled_of(&[kind]));
        let classes =
            [(0.0, 0.1), (0.1, 0.4), (0.4, f64::MAX)].map(|(low, high)| share(low, high, &all));
        assert!((0.1..=0.25).contains(&toppled_of(&all)), "{name}");
        assert!(toppled.iter().all(|share| (0.01..0.4).contains(share)), "{name}: {toppled:?}");
        assert!(classes.iter().all(|share| *share > 0.1), "{name}: {classes:?}");
    }
}

#[test]
fn every_record_passes_the_checks_of_a_record_and_lifts_the_body() {
    for (name, body) in bodies() {
        let uplift = GRAVITY * body.alpha().tan();
        for record in suite(60, 3, body.p(), body.alpha()) {
            let (low, high) =
                if record.name.starts_with("noise") { (1.2, 6.0) } else { (1.1, 4.0) };
            let amplitude = record.pga() / uplift;
            assert!(
                (low * (1.0 - 1e-12)..=high).contains(&amplitude),
                "{name} {} {amplitude}",
                record.name
            );
            assert!(
                record.accel[0].abs() < 1e-6 * uplift && record.accel.last() == Some(&0.0),
                "{}",
                record.name
            );
            assert_eq!(
                Record::new(record.name.clone(), record.dt, record.accel.clone()),
                Ok(record)
            );
        }
    }
}

/// The trapezoidal velocity of a smooth pulse ends within O(dt^2) of zero; the bound is 1e-3 of the
/// peak velocity.
#[test]
fn the_ground_comes_to_rest() {
    for record in suite(300, 11, 1.5, 0.2) {
        let (mut velocity, mut peak) = (0.0_f64, 0.0_f64);
        for pair in record.accel.windows(2) {
            velocity += record.dt * (pair[0] + pair[1]) / 2.0;
            peak = peak.max(velocity.abs());
        }
        assert!(velocity.abs() < 1e-3 * peak, "{} {velocity} {peak}", record.name);
    }
}

#[test]
fn a_record_depends_on_seed_and_index_alone() {
    let forwards: Vec<Record> = suite(9, 5, 1.0, 0.2).collect();
    for index in (0..9).rev() {
        assert_eq!(record(5, index, 1.0, 0.2), forwards[index]);
        assert_ne!(record(6, index, 1.0, 0.2).accel, forwards[index].accel);
        assert_ne!(record(5, index + 6, 1.0, 0.2).accel, forwards[index].accel);
    }
    let names: Vec<&str> = forwards.iter().map(|record| record.name.as_str()).collect();
    assert_eq!(names[..4], ["ricker-0000", "mavroeidis-0001", "noise-0002", "ricker-0003"]);
}

/// Lengths times L, time times sqrt L: pulses keep their shape when 1/(200 p) keeps its digits.
#[test]
fn pulses_scale_with_the_structure() {
    let (small, large) = (record(5, 0, 5.0, 0.2), record(5, 0, 0.5, 0.2));
    assert_eq!((small.dt, large.dt), (0.001, 0.01));
    assert_eq!(small.len(), large.len());
    for (a, b) in small.accel.iter().zip(&large.accel) {
        assert!((a - b).abs() < 1e-12 * small.pga());
    }
}

#[test]
fn time_steps_are_round() {
    for (x, step) in [
        (0.02, 0.02),
        (0.0126, 0.01),
        (0.005, 0.005),
        (4.2e-4, 2e-4),
        (0.0099, 0.005),
        (1e-3, 1e-3),
    ] {
        assert_eq!(round_step(x), step);
    }
    for p in [f64::NAN, 0.0, 1e9, f64::INFINITY] {
        assert!(record(1, 0, p, 0.2).accel.iter().all(|a| a.is_finite()), "{p}");
    }
}

#[test]
fn earthquakes_have_the_amplitudes_and_lengths_of_real_ones_whatever_the_structure() {
    let all: Vec<Record> = (0..200).map(|index| earthquake(3, index, 1.7)).collect();
    for record in &all {
        assert!(
            (0.2 * (1.0 - 1e-12)..0.9).contains(&record.pga_g()),
            "{} {}",
            record.name,
            record.pga_g()
        );
        assert!([0.005, 0.01].contains(&record.dt) && record.source == Source::Earthquake);
        let silence =
            record.accel.iter().rev().take_while(|a| **a == 0.0).count() as f64 * record.dt;
        assert!((8.0 / 1.7..8.0 / 1.7 + 0.03).contains(&silence), "{silence}");
        assert!((20.0..60.1).contains(&(record.duration() - silence)), "{}", record.duration());
        assert_eq!(
            Record::new(record.name.clone(), record.dt, record.accel.clone()).as_ref(),
            Ok(record)
        );
    }
    let mean = all.iter().map(Record::pga_g).sum::<f64>() / 200.0;
    // four standard errors: 0.7/sqrt(12)/sqrt(200)
    assert!((mean - 0.55).abs() < 0.06, "{mean}");
    // another structure has the same motion, and another silence: at least 2 s, at most 60
    for (p, silence) in [(100.0, 2.0), (1e-3, 60.0), (f64::NAN, 60.0)] {
        let other = earthquake(3, 7, p);
        let motion = all[7].len() - (8.0 / 1.7 / all[7].dt).ceil() as usize;
        assert_eq!(other.accel[..motion], all[7].accel[..motion]);
        assert_eq!(other.len() - motion, (silence / other.dt).ceil() as usize);
    }
}

/// The zero crossings of a narrow band come at its frequency: those of Kanai-Tajimi noise lie about
/// omega_g/pi, 3 to 11 a second.
#[test]
fn earthquakes_have_real_frequencies_and_are_drawn_apart_from_the_other_suite() {
    for index in 0..20 {
        let record = earthquake(5, index, 1.0);
        let crossings =
            record.accel.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count() as f64;
        let rate = crossings / (record.duration() - 8.0);
        assert!((2.0..16.0).contains(&rate), "{rate}");
        assert_ne!(earthquake(6, index, 1.0).accel, record.accel);
    }
    assert_eq!(earthquake(5, 3, 1.0), earthquake(5, 3, 1.0));
    assert_ne!(Random::new(5, EARTHQUAKES | 2).normal(), Random::new(5, 2).normal());
}
