//! Statistics of samples.

/// The q-quantile of sorted numbers, linear between the two nearest ranks (Hyndman and Fan 1996,
/// definition 7); infinite where it lies at or next to an infinite number, none of no numbers.
pub fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    quantile_of_ranks(sorted.len() as u64, q, |rank| sorted[rank as usize])
}

/// The same of so many numbers, of which `ranked` gives that of a rank from zero, in ascending
/// order.
pub fn quantile_of_ranks(count: u64, q: f64, ranked: impl Fn(u64) -> f64) -> Option<f64> {
    let rank = q * count.checked_sub(1)? as f64;
    let (low, share) = (rank.floor() as u64, rank.fract());
    let x = ranked(low);
    let above = if share == 0.0 { x } else { ranked(low + 1) };
    // between two infinite ones nothing is computed
    Some(if x == above { x } else { x + share * (above - x) })
}

/// The largest of magnitudes; zero of none, infinite where one is not a number.
pub fn largest(magnitudes: impl IntoIterator<Item = f64>) -> f64 {
    let sure = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    magnitudes.into_iter().map(sure).fold(0.0, f64::max)
}

/// Two-sample Kolmogorov-Smirnov distance: the largest difference of the two empirical
/// distributions; ties are one step.
pub fn ks_distance(a: &[f64], b: &[f64]) -> f64 {
    if a.is_empty() || b.is_empty() {
        return 0.0;
    }
    let sorted = |x: &[f64]| {
        let mut x = x.to_vec();
        x.sort_by(f64::total_cmp);
        x
    };
    let (a, b) = (sorted(a), sorted(b));
    let (mut i, mut j, mut widest) = (0, 0, 0.0_f64);
    while i < a.len() && j < b.len() {
        let x = a[i].min(b[j]);
        i += a[i..].iter().take_while(|y| **y <= x).count();
        j += b[j..].iter().take_while(|y| **y <= x).count();
        widest = widest.max((i as f64 / a.len() as f64 - j as f64 / b.len() as f64).abs());
    }
    widest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_lies_between_ranks_and_is_infinite_next_to_an_infinite_number() {
        let over = f64::INFINITY;
        assert_eq!(quantile(&[1.0, 2.0, 3.0, 5.0], 0.5), Some(2.5));
        assert_eq!(quantile(&[1.0, 2.0, 4.0], 0.75), Some(3.0));
        assert_eq!(quantile(&[1.0, 2.0, over], 0.5), Some(2.0));
        assert_eq!(quantile(&[1.0, over], 0.5), Some(over));
        assert_eq!(quantile(&[over, over], 0.5), Some(over));
        assert_eq!((quantile(&[7.0], 0.9), quantile(&[], 0.5)), (Some(7.0), None));
    }
}
