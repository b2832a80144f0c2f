//! Statistics of samples.

/// The q-quantile of sorted numbers, linear between the two nearest ranks (Hyndman and Fan 1996,
/// definition 7); none if that is not finite.
pub fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let rank = q * sorted.len().checked_sub(1)? as f64;
    let (low, share) = (rank.floor() as usize, rank.fract());
    let x = sorted[low];
    let x = if share == 0.0 { x } else { x + share * (sorted[low + 1] - x) };
    x.is_finite().then_some(x)
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
