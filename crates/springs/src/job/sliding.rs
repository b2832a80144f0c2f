//! Springs of feet that slide: how stiff they may be.

use std::f64::consts::TAU;

use rocking::scalar::GRAVITY;
use strong_motion::Record;

/// Part of the friction that rounding of a foot's place may take: with three times as much a step
/// takes ten times as long, with ten times as much it never ends.
const ROUNDING: f64 = 1e-5;
/// A slip that springs allow for, however little a record asks of it (m).
const LEAST: f64 = 1e-3;
/// Parts of a sample's interval that a slip is followed in.
const PARTS: usize = 16;

/// Omega_n of horizontal springs under feet that slide on this record, at most (Hz). Stiffer ones
/// lose the digits of their force in the place that a foot has slid to, and steps never end.
///
/// ```text
///   k1 2^-52 s <= 1e-5 mu m g,   k1 = m Omega_n^2,   s: slip
/// ```
pub(super) fn cap(record: &Record, friction: f64) -> f64 {
    let slip = slip(record, friction).max(LEAST);
    (ROUNDING * friction * GRAVITY / (f64::EPSILON * slip)).sqrt() / TAU
}

/// Largest slip of a block on a plane (m), of which a body that slides has about as much.
///
/// ```text
///   r'' = -ug'' - mu (g + vg'') sgn(r')
/// ```
///
/// Newmark, Géotechnique 15 (1965).
fn slip(record: &Record, friction: f64) -> f64 {
    let (up, part) = (record.up(), 1.0 / PARTS as f64);
    let h = record.dt * part;
    let between = |values: &[f64], i: usize, at: f64| match values.get(i..i + 2) {
        Some(&[a, b]) => a + at * (b - a),
        _ => 0.0,
    };
    let (mut slip, mut rate, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..record.len().saturating_sub(1) {
        for k in 0..PARTS {
            let at = (k as f64 + 0.5) * part;
            let push = -between(&record.accel, i, at);
            let limit = (friction * (GRAVITY + between(up, i, at))).max(0.0);
            if rate == 0.0 && push.abs() <= limit {
                continue;
            }
            let way = if rate == 0.0 { push.signum() } else { rate.signum() };
            let next = rate + h * (push - way * limit);
            let next = if next * way < 0.0 { 0.0 } else { next };
            slip += 0.5 * h * (rate + next);
            rate = next;
            largest = largest.max(slip.abs());
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A push A for a time T, then rest: the block gains (A - mu g) T against the ground, and loses
    /// it at mu g.
    #[test]
    fn a_push_moves_the_block_as_the_closed_form_says() {
        let (mu, push, dt) = (0.2, 4.0, 0.01);
        let accel = (0..400).map(|i| if i <= 100 { push } else { 0.0 }).collect();
        let record = Record::new("push", dt, accel).unwrap();
        // the push falls to zero within a sample's interval, half of which counts
        let (net, time) = (push - mu * GRAVITY, 1.0 + 0.5 * dt);
        let due = 0.5 * net * time * time * (1.0 + net / (mu * GRAVITY));
        assert!((slip(&record, mu) / due - 1.0).abs() < 0.01, "{}, {due}", slip(&record, mu));
        // a push that friction holds does not move it
        assert_eq!(slip(&record, 0.5), 0.0);
    }

    /// The rounding of the place, times the spring, is a hundred-thousandth of the friction.
    #[test]
    fn the_cap_leaves_the_digits_of_the_force() {
        let (mu, mass) = (0.3, 900.0);
        let record = Record::el_centro();
        let k1 = mass * (TAU * cap(&record, mu)).powi(2);
        let slid = slip(&record, mu).max(LEAST);
        assert!((k1 * f64::EPSILON * slid / (1e-5 * mu * mass * GRAVITY) - 1.0).abs() < 1e-12);
    }
}
