use super::*;
use crate::scalar::GRAVITY;
use strong_motion::largest_magnitude;

/// El Centro, and what a floor of 3 Hz and 3 % damping makes of it: narrow, longer than the ground.
fn given() -> [Record; 2] {
    let ground = Record::el_centro();
    let (omega, zeta, dt) = (TAU * 3.0, 0.03, ground.dt);
    // central differences; 3 Hz at 100 steps a second
    let (mut before, mut now) = (0.0_f64, 0.0_f64);
    let floor = ground.accel.iter().map(|a| {
        let (k, c) = (omega * omega, 2.0 * zeta * omega);
        let next = ((2.0 / (dt * dt) - k) * now - (1.0 / (dt * dt) - c / (2.0 * dt)) * before - a)
            / (1.0 / (dt * dt) + c / (2.0 * dt));
        let rate = (next - before) / (2.0 * dt);
        let absolute = -c * rate - k * now;
        (before, now) = (now, next);
        absolute
    });
    let floor = Record::new("floor", dt, floor.collect()).unwrap();
    [ground, floor]
}

/// Every motion within 30 % of the given spectrum at every period of the band and 10 % in the root
/// mean square. Their mean at no period below 90 % of it, as EN 1998-1, 3.2.3.1.2 (4) c asks of
/// artificial accelerograms, and at most 15 % above: random phases fill narrow valleys of a
/// spectrum.
#[test]
fn spectra_are_those_of_the_given_motion() {
    for record in given() {
        let target = MotionTarget::new(&record).unwrap();
        let (from, to) = target.periods();
        let longest = record.duration() / 15.0;
        assert!((from - 0.04).abs() < 1e-12 && (to - longest).abs() < 1e-12, "{from} {to}");
        let periods: Vec<f64> =
            (0..=100).map(|i| from * (to / from).powf(f64::from(i) / 100.0)).collect();
        let spectrum = ResponseSpectrum::new(periods.clone(), record.dt);
        let wanted = spectrum.of(&record.accel);
        let (seeds, n) = ([1, 2, 77], 6);
        let mut ratios = vec![0.0; periods.len()];
        let (mut worst, mut worst_rms) = (0.0_f64, 0.0_f64);
        for seed in seeds {
            for index in 0..n {
                let motion = target.motion(seed, index, 2.0);
                let there = spectrum.of(&motion.accel[..record.len()]);
                let ln: Vec<f64> = there
                    .iter()
                    .zip(&wanted)
                    .map(|(there, wanted)| (there / wanted).ln())
                    .collect();
                let most = largest_magnitude(&ln);
                let rms = (ln.iter().map(|ln| ln * ln).sum::<f64>() / ln.len() as f64).sqrt();
                (worst, worst_rms) = (worst.max(most), worst_rms.max(rms));
                for (sum, ln) in ratios.iter_mut().zip(&ln) {
                    *sum += ln.exp() / (seeds.len() * n) as f64;
                }
            }
        }
        let (least, most) =
            ratios.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
        println!(
            "{}: {from:.2} to {to:.2} s, worst {worst:.3}, rms {worst_rms:.3}, means {least:.3} to \
             {most:.3}",
            record.name
        );
        assert!(worst < 1.3_f64.ln() && worst_rms < 0.10, "{worst} {worst_rms}");
        assert!((0.90..1.15).contains(&least) && (0.90..1.15).contains(&most), "{least} {most}");
    }
}

/// El Centro's 40 s between two minutes of noise of 0.2 % of its peak each.
fn between_quiet() -> Record {
    let ground = Record::el_centro();
    let mut random = Random::new(1, 0);
    let samples = (120.0 / ground.dt) as usize;
    let weak = 0.002 * ground.pga();
    let mut quiet = || (0..samples).map(|_| random.between(-weak, weak)).collect::<Vec<f64>>();
    let accel = [quiet(), ground.accel.clone(), quiet()].concat();
    Record::new("between-quiet", ground.dt, accel).unwrap()
}

/// Quiet before and after the strong part makes motions no longer, and not much more intense.
#[test]
fn quiet_parts_do_not_stretch_the_strong_one() {
    let record = between_quiet();
    let target = MotionTarget::new(&record).unwrap();
    let given = record.measures();
    for index in 0..4 {
        let motion = target.motion(5, index, 2.0);
        let like = likeness(&target, &motion);
        let arias = motion.measures().arias_m_per_s / given.arias_m_per_s;
        println!("{index}: {like:?} Arias x {arias:.3}");
        assert!((0.9..1.1).contains(&like.duration) && like.fits(), "{index}: {like:?}");
        assert!((0.8..1.6).contains(&arias), "{index}: {arias}");
    }
}

/// One that is longer, or whose ground goes farther, does not fit.
#[test]
fn what_is_not_like_the_given_motion_is_told() {
    let [ground, floor] = given();
    let target = MotionTarget::new(&ground).unwrap();
    let same = likeness(&target, &ground);
    assert_eq!(same.duration, 1.0);
    let longer = Likeness { duration: 1.3, displacement: 1.0 };
    let farther = Likeness { duration: 1.0, displacement: 2.6 };
    assert!(!longer.fits() && !farther.fits());
    assert!(likeness(&target, &floor).duration != 1.0);
}

/// The time between 5 and 95 % of the Arias intensity within a fifth. The intensity itself is not
/// promised: motions of one spectrum differ in it.
#[test]
fn envelopes_are_those_of_the_given_motion() {
    for record in given() {
        let target = MotionTarget::new(&record).unwrap();
        let given = record.measures();
        for index in 0..12 {
            let made = target.motion(5, index, 2.0).measures();
            let duration = made.duration_5_95_s / given.duration_5_95_s;
            println!("{} {index}: duration x {duration:.3}", record.name);
            assert!((0.8..1.25).contains(&duration), "{} {index}: {duration}", record.name);
        }
    }
}

/// The ground comes to rest where it began, and goes no farther on the way than a few times the
/// given ground, its own drift taken off alike.
#[test]
fn the_ground_does_not_drift() {
    for record in given() {
        let target = MotionTarget::new(&record).unwrap();
        let path = |accel: &[f64]| {
            let (mut v, mut d, mut most) = (0.0, 0.0, 0.0_f64);
            for pair in accel.windows(2) {
                d += record.dt * v + record.dt * record.dt * (2.0 * pair[0] + pair[1]) / 6.0;
                v += record.dt * (pair[0] + pair[1]) / 2.0;
                most = most.max(f64::abs(d));
            }
            (v, d, most)
        };
        let mut rested = record.accel.clone();
        target.rest(&mut rested);
        let (_, _, given) = path(&rested);
        for index in 0..8 {
            let motion = target.motion(9, index, 2.0);
            let (v, d, most) = path(&motion.accel);
            println!(
                "{} {index}: {:.0} mm, the given {:.0} mm",
                record.name,
                1e3 * most,
                1e3 * given
            );
            assert!(v.abs() < 1e-9 && d.abs() < 1e-8, "{v} {d}");
            assert!(most < 2.5 * given, "{most} {given}");
        }
    }
}

#[test]
fn a_motion_depends_on_the_given_one_the_seed_and_the_index_alone() {
    let [ground, floor] = given();
    let target = MotionTarget::new(&ground).unwrap();
    let first = target.motion(3, 7, 2.0);
    assert_eq!(MotionTarget::new(&ground).unwrap().motion(3, 7, 2.0), first);
    for (seed, index) in [(3, 8), (4, 7)] {
        assert_ne!(target.motion(seed, index, 2.0).accel, first.accel);
    }
    // unrelated, not shifted or mirrored
    let other = target.motion(3, 8, 2.0);
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let together = product(&first.accel, &other.accel)
        / (product(&first.accel, &first.accel) * product(&other.accel, &other.accel)).sqrt();
    assert!(together.abs() < 0.3, "{together}");
    // another structure has the same motion and another silence
    let longer = target.motion(3, 7, 0.5);
    assert_eq!(longer.accel[..ground.len()], first.accel[..ground.len()]);
    assert_eq!((first.len(), longer.len()), (ground.len() + 400, ground.len() + 1600));
    assert_ne!(MotionTarget::new(&floor).unwrap().fingerprint(), target.fingerprint());
    assert_eq!((first.name.as_str(), target.name()), ("like-IELC180-00007", "IELC180"));
    assert_eq!(Record::new(first.name.clone(), first.dt, first.accel.clone()), Ok(first));
}

/// Twice the motion, twice the motions.
#[test]
fn motions_scale_with_the_given_one() {
    let [ground, _] = given();
    let twice = MotionTarget::new(&ground.scaled(2.0).unwrap()).unwrap().motion(1, 0, 2.0);
    let once = MotionTarget::new(&ground).unwrap().motion(1, 0, 2.0);
    let worst = once
        .accel
        .iter()
        .zip(&twice.accel)
        .fold(0.0_f64, |most, (a, b)| most.max((2.0 * a - b).abs()));
    assert!(worst < 1e-9 * GRAVITY, "{worst}");
}

#[test]
fn what_no_motion_can_be_like_is_refused() {
    let still = Record::new("still", 0.01, vec![0.0; 500]).unwrap();
    assert_eq!(MotionTarget::new(&still).unwrap_err(), LikeError::Still { record: "still".into() });
    let short = Record::new("short", 0.01, vec![1.0; 199]).unwrap();
    let said = MotionTarget::new(&short).unwrap_err().to_string();
    assert_eq!(
        said,
        "short: 199 samples; motions like it need 200 to 400000: give a longer record, or \
         duration_s"
    );
    // steps as coarse as they come, a single sample that moves: no panic, no NaN
    for (dt, at) in [(1.0, 100), (1e-6, 0), (0.01, 199)] {
        let mut accel = vec![0.0; 200];
        accel[at] = 1.0;
        let target = MotionTarget::new(&Record::new("odd", dt, accel).unwrap()).unwrap();
        assert!(target.motion(1, 0, 2.0).accel.iter().all(|a| a.is_finite()), "{dt} {at}");
    }
}
