//! Whole histories against housner_quad (float128): a Taylor program of degree 26 in __float128,
//! with sub-steps.
//!
//! Literals are rounded from its 25 digits. Where the body comes to rest between them, that program
//! was given a rule of its own: rest once the rate after an impact is below 1e-18 rad/s and |a_g| <
//! g tan(alpha).

#![allow(clippy::excessive_precision)] // the digits of the reference as it printed them

use rocking::housner::{Rocking, RockingOutcome, history};
use rocking::structure::Body;
use strong_motion::Record;

use super::{in_si, noise};

fn body(half_width: f64, height: f64, mass_share: f64) -> Body<f64> {
    let r2 = half_width * half_width + height * height;
    Body { mass: 1.0, half_width, height, inertia: r2 * (1.0 / mass_share - 1.0) }
}

fn agree(rocking: &Rocking<f64>, dt: f64, reference: &[(f64, f64)], tolerance: f64) {
    for &(t, theta) in reference {
        let ours = rocking.theta[(t / dt).round() as usize];
        assert!((ours - theta).abs() <= tolerance, "t = {t} s: {ours:e}, reference {theta:e}");
    }
}

#[test]
fn the_papers_frame_on_el_centro() {
    let rocking = history(&body(6.1, 61.0, 1.0), 0.01, &Record::el_centro().accel);
    let reference = [
        (5.0, 4.6911533147641060474975924e-3),
        (10.0, -5.1432040599407297874283211e-3),
        (15.0, 4.8238985406325855962540217e-3),
        (20.0, -1.6066849748720470138379756e-3),
    ];
    agree(&rocking, 0.01, &reference, 1e-15);
}

#[test]
fn the_papers_frame_on_noise_with_eighteen_impacts() {
    let rocking = history(&body(6.1, 61.0, 1.0), 0.01, &in_si(&noise(0.01, 10.0)));
    let reference = [
        (2.0, -4.3925914800682702603747970e-3),
        (4.0, 1.1516204545341678206408391e-5),
        (6.0, 7.3922952316511562048661963e-4),
        (8.0, -4.0672412687594324538750652e-4),
        (10.0, -1.6995027540740999579635767e-5),
    ];
    agree(&rocking, 0.01, &reference, 1e-15);
    let impacts = [
        (0.616747284615201205536, 3.5648499184821072914066296e-4),
        (2.52788071436221490407, 1.6165609513786762782752920e-2),
        (9.40534350190528307282, -1.0929525061337243390271251e-2),
    ];
    assert_eq!(rocking.impacts.len(), 18);
    for ((time, rate), k) in impacts.into_iter().zip([0, 6, 17]) {
        assert!((rocking.impacts[k].time - time).abs() < 1e-13);
        assert!((rocking.impacts[k].rate_after - rate).abs() < 1e-15);
    }
}

#[test]
fn a_solid_block_on_a_coarse_half_sine() {
    let pulse: Vec<f64> = (0..=80)
        .map(|i| {
            if i <= 10 {
                (0.45e6 * (std::f64::consts::PI * f64::from(i) / 10.0).sin()).round() / 1e6
            } else {
                0.0
            }
        })
        .collect();
    let rocking = history(&body(0.25, 1.0, 0.75), 0.05, &in_si(&pulse));
    let reference = [
        (0.5, -7.3659083286177456066113373e-2),
        (1.0, -7.5550545225275583744688881e-2),
        (2.0, -2.7990026858194695411938435e-2),
        (3.0, 3.5120556087916426176374821e-2),
        (4.0, 9.8268582596968669967603127e-3),
    ];
    agree(&rocking, 0.05, &reference, 2e-15);
    let impacts = [
        1.19329497545653445765,
        1.92774700688760565597,
        2.55904056500307393619,
        3.11070802620724495669,
    ];
    for (impact, time) in rocking.impacts.iter().zip(impacts) {
        assert!((impact.time - time).abs() < 1e-14);
    }
}

#[test]
fn a_block_that_rests_and_lifts_again() {
    let rocking = history(&body(0.25, 1.0, 0.75), 0.01, &in_si(&noise(0.01, 10.0)));
    assert!(rocking.uplifts.len() > 1);
    let reference = [
        (2.0, 1.4964729463827091964726032e-2),
        (4.0, 7.6941806817571351055523646e-2),
        (6.0, -7.5761253725399856020923387e-2),
        (8.0, -2.9540002353372852157917191e-3),
        (10.0, 5.0962585895080207377265902e-2),
    ];
    agree(&rocking, 0.01, &reference, 1e-14);
}

#[test]
fn a_small_block_on_el_centro() {
    let rocking = history(&body(0.125, 0.5, 0.75), 0.01, &Record::el_centro().accel);
    let reference = [
        (3.0, 1.7029312761129117021427735e-2),
        (5.0, 2.8184768047915924198898630e-2),
        (8.0, -2.6869600495475326417140486e-2),
        (12.0, -4.4577971970715490613155126e-3),
    ];
    agree(&rocking, 0.01, &reference, 1e-13);
}

/// 40 cm high, every fifth sample of the noise, p dt = 0.3: one step in twenty is not enough for an
/// interval.
#[test]
fn a_tiny_block_at_a_coarse_time_step_until_it_overturns() {
    let coarse: Vec<f64> = noise(0.01, 10.0).into_iter().step_by(5).collect();
    let rocking = history(&body(0.05, 0.2, 0.75), 0.05, &in_si(&coarse));
    let reference = [
        (1.0, 3.0950174906828177867369721e-4),
        (1.5, 0.0),
        (2.0, 6.6460442907077138502921257e-2),
        (2.25, 7.1659618804601975666240788e-1),
    ];
    agree(&rocking, 0.05, &reference, 1e-14);
    let RockingOutcome::Overturned { time } = rocking.outcome else {
        panic!("{:?}", rocking.outcome)
    };
    // between the samples of the reference where |theta| is below and above alpha = 0.245
    assert!((2.0..2.25).contains(&time));
    assert!(rocking.theta.len() < coarse.len());
    assert!(rocking.theta.iter().all(|theta| theta.abs() < std::f64::consts::FRAC_PI_2));
}
