//! Tables of a rigid body's run as CSV.

use std::fmt::Write;

use dynamics::fem::{Demands, QUANTITIES};
use springs::answers::ModelComparison;

/// `history.csv`: the motions at the record's samples, 12 significant digits; with members three
/// columns more.
pub fn history_csv(dt: f64, both: &ModelComparison) -> String {
    let mut motions = vec![("housner", &both.housner), ("fem", &both.fem.motion)];
    motions.extend(both.with.as_ref().map(|with| ("members", &with.history.motion)));
    let mut out = String::from("t");
    for (name, _) in &motions {
        // writing to a String cannot fail
        let _ = write!(out, ",u_{name},v_{name},th_{name}");
    }
    out.push('\n');
    // the finite elements go on where Housner's solution ends because the pivot lets go: his
    // columns are then empty
    let left = both.rocking.left_ground().is_some();
    let compared =
        motions.iter().skip(usize::from(left)).map(|(_, motion)| motion.len()).min().unwrap_or(0);
    for i in 0..compared {
        out.push_str(&digits_12(i as f64 * dt));
        for (_, motion) in &motions {
            let row = (i < motion.len())
                .then(|| [motion.u[i], motion.v[i], motion.theta[i]].map(digits_12));
            let _ = write!(out, ",{}", row.map_or(",,".into(), |row| row.join(",")));
        }
        out.push('\n');
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

/// `members.csv`: forces at the record's samples, each the largest since the sample before.
pub fn members_csv(dt: f64, demands: &Demands) -> String {
    let mut out = format!("t,{}\n", QUANTITIES.join(","));
    for (i, row) in demands.rows.iter().enumerate() {
        let mut all = [0.0; QUANTITIES.len() + 1];
        all[0] = i as f64 * dt;
        all[1..].copy_from_slice(row);
        csv_row(&mut out, &all);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_twelve_significant_digits() {
        assert_eq!(digits_12(0.401181622959), "0.401181622959");
        assert_eq!(digits_12(-12.5), "-12.5000000000");
        assert_eq!(digits_12(1.0 / 3.0e6), "3.33333333333e-7");
        assert_eq!(digits_12(0.0), "0");
    }
}
