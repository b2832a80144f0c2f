//! The ground motion as SAP2000 and ETABS take it: a function of pairs of time and value.
//!
//! A load case that continues from another takes its function relative to the first value
//! (<https://wiki.csiamerica.com/display/kb/Time+function>): one that begins at -0.06 m/s2 would be
//! shifted by 0.06 m/s2 for good. Such a function begins at 0 and is where the record begins a
//! thousandth of a sample later.

/// How late the record's first value comes, over its time step.
const RISE: f64 = 1e-3;

/// Times (s) and accelerations (m/s2) of a ground motion with this time step (s).
pub(super) fn pairs(dt: f64, accel: &[f64]) -> Vec<[f64; 2]> {
    let first = accel.first().copied().filter(|&first| first != 0.0);
    let rise = first.map(|first| [[0.0, 0.0], [RISE * dt, first]]);
    let rest = accel.iter().enumerate().skip(usize::from(first.is_some()));
    rise.into_iter().flatten().chain(rest.map(|(i, &a)| [i as f64 * dt, a])).collect()
}

/// The same as a file that SAP2000 and ETABS read: a pair a line.
pub fn sap_function(dt: f64, accel: &[f64]) -> String {
    pairs(dt, accel).iter().map(|[t, a]| format!("{t:.9e} {a:.9e}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_begins_at_zero_and_follows_the_record() {
        assert_eq!(pairs(0.5, &[0.0, 1.0, -2.0]), [[0.0, 0.0], [0.5, 1.0], [1.0, -2.0]]);
        let [zero, first, second] = pairs(0.5, &[3.0, 1.0])[..] else { panic!("three pairs") };
        assert_eq!([zero, first, second], [[0.0, 0.0], [5e-4, 3.0], [0.5, 1.0]]);
        assert_eq!(
            sap_function(0.5, &[0.0, 1.0]),
            "0.000000000e0 0.000000000e0\n5.000000000e-1 1.000000000e0\n"
        );
    }
}
