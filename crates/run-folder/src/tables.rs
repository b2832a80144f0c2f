//! Tables of a rigid body's run as CSV.

use std::fmt::Write;

use dynamics::fem::{Demands, History, QUANTITIES, corner_forces};
use parameters::answers::ModelComparison;
use rocking::{
    motion::Motion,
    structure::{Body, Kind},
};

/// `history.csv`: the motions at the record's samples, 12 significant digits; with members three
/// columns more, and with a tendon or dampers three of Housner's equation with them.
pub fn history_csv(dt: f64, both: &ModelComparison) -> String {
    let mut motions = vec![("housner", &both.housner), ("fem", &both.fem.motion)];
    motions.extend(both.with.as_ref().map(|with| ("members", &with.history.motion)));
    let rigid = both.with.as_ref().and_then(|with| with.housner.as_ref());
    motions.extend(rigid.map(|motion| ("housner_members", motion)));
    let mut out = String::from("t");
    for (name, _) in &motions {
        // writing to a String cannot fail
        let _ = write!(out, ",u_{name},v_{name},th_{name}");
    }
    out.push('\n');
    // the finite elements go on where Housner's solution ends because the pivot lets go, and a body
    // with members where one without falls: the columns of what has ended are then empty
    let left = both.rocking.left_ground().is_some();
    let compared = || motions.iter().skip(usize::from(left)).map(|(_, motion)| motion.len()).min();
    let rows = both.with.as_ref().map(|with| with.history.motion.len()).or_else(compared);
    for i in 0..rows.unwrap_or(0) {
        let mut row = vec![i as f64 * dt];
        for (_, Motion { u, v, theta }) in &motions {
            row.extend([u, v, theta].map(|x| x.get(i).copied().unwrap_or(f64::NAN)));
        }
        csv_row(&mut out, &row);
    }
    out
}

/// One CSV row with 12 significant digits.
pub fn csv_row(out: &mut String, row: &[f64]) {
    for (i, x) in row.iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // where a history has ended there is no number
        let cell = if x.is_nan() { String::new() } else { digits_12(*x) };
        // writing to a String cannot fail
        let _ = write!(out, "{comma}{cell}");
    }
    out.push('\n');
}

/// 12 significant digits, plain where that is short.
fn digits_12(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if (-4..12).contains(&exponent) {
        format!("{x:.*}", (11 - exponent).max(0) as usize)
    } else {
        format!("{x:.11e}")
    }
}

/// What a file of forces holds of every instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instants {
    /// All of them at the same instants: the record's samples.
    Samples,
    /// Of each value, the largest magnitude since the sample before.
    Envelopes,
}

/// Forces of a block: about the middle of its base.
const OF_BLOCK: [&str; 6] = [
    "base_shear_n",
    "base_axial_n",
    "base_moment_nm",
    "tendon_n",
    "damper_left_n",
    "damper_right_n",
];

/// Where in a row of `QUANTITIES` those of members begin.
const MEMBERS: usize = 7;

/// `members.csv` or `members_envelopes.csv` of a rigid body: of an A-frame's legs, of a block's
/// section above its base, where dashpots hold its corners and a tendon from mass to ground passes
/// by; the base shear is all that the ground gives, the tendon's included. Axial forces are
/// positive in tension. Samples are `dt` (s) apart.
pub fn members_csv(
    (kind, body): (Kind, &Body<f64>),
    dt: f64,
    (history, demands): (&History, &Demands),
    instants: Instants,
) -> String {
    let at_samples = instants == Instants::Samples;
    let rows = if at_samples { &demands.at } else { &demands.rows };
    let names: &[&str] = if kind == Kind::Block { &OF_BLOCK } else { &QUANTITIES };
    let mut out = format!("t,{}\n", names.join(","));
    for (i, row) in rows.iter().enumerate() {
        let mut all = vec![i as f64 * dt, row[0]];
        if kind == Kind::Block {
            let [sum, difference] = match at_samples {
                true => {
                    let [[_, left], [_, right]] = corner_forces(demands, i);
                    [left + right, left - right]
                }
                false => [0, 1].map(|k| history.forces.both[k][i]),
            };
            all.extend([-sum, difference * body.half_width]);
            all.extend(&row[MEMBERS..]);
        } else {
            all.extend(&row[1..]);
        }
        csv_row(&mut out, &all);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::{Design, Springs};
    use parameters::answers::compare_models;
    use rocking::{members::Members, scalar::GRAVITY, structure::Structure};
    use strong_motion::Record;

    #[test]
    fn numbers_have_twelve_significant_digits() {
        assert_eq!(digits_12(0.401181622959), "0.401181622959");
        assert_eq!(digits_12(-12.5), "-12.5000000000");
        assert_eq!(digits_12(1.0 / 3.0e6), "3.33333333333e-7");
        assert_eq!(digits_12(0.0), "0");
    }

    /// A block on its left foot: shear, compression and the moment about the middle of its base at
    /// the sample; in the other file the largest since the sample before.
    #[test]
    fn a_block_has_forces_of_its_base_at_one_instant() {
        let mut demands = Demands::default();
        demands.at = vec![[3.0; QUANTITIES.len()]];
        demands.rows = vec![[-7.0; QUANTITIES.len()]];
        demands.feet = vec![[[3.0, 50.0], [0.0, 10.0]]];
        let record = Record::new("at rest", 0.01, vec![0.0; 2]).unwrap();
        let block = Structure::block(2.0, 0.5, 1e3).unwrap();
        let body = block.body::<f64>();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(1e3);
        let both =
            compare_models(&body, body.restitution(), &springs, &Members::default(), &record);
        let of = (Kind::Block, &body);
        let text = members_csv(of, 0.01, (&both.fem, &demands), Instants::Samples);
        let row = |text: &str| -> Vec<f64> {
            text.lines().nth(1).unwrap().split(',').map(|x| x.parse().unwrap()).collect()
        };
        assert!(text.starts_with("t,base_shear_n,base_axial_n,base_moment_nm,tendon_n"));
        // 50 N and 10 N of the ground, 3 N of each dashpot
        assert_eq!(row(&text), [0.0, 3.0, -66.0, 10.0, 3.0, 3.0, 3.0]);
        let worst = members_csv(of, 0.01, (&both.fem, &demands), Instants::Envelopes);
        let worst = row(&worst);
        assert_eq!((worst[1], worst[4]), (-7.0, -7.0));
        // at rest it weighs what it weighs
        assert!((worst[2] / (-1e3 * GRAVITY) - 1.0).abs() < 1e-9, "{worst:?}");
        let legs =
            members_csv((Kind::AFrame, &body), 0.01, (&both.fem, &demands), Instants::Samples);
        assert!(legs.starts_with("t,base_shear_n,axial_left_n,shear_left_n"));
        assert_eq!(row(&legs), [vec![0.0], vec![3.0; QUANTITIES.len()]].concat());
    }
}
