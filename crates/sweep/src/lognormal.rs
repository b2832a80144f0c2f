//! Lognormal fragility by maximum likelihood.
//!
//! ```text
//! P(exceeds | x) = Phi( ln(x/theta) / beta ) = Phi(a + b ln x),     b = 1/beta,  theta = exp(-a/b)
//! ln L = sum k ln P + (n - k) ln(1 - P)
//! ```
//!
//! J. W. Baker (2015), "Efficient analytical fragility function fitting using dynamic structural
//! analysis", Earthquake Spectra 31(1). ln L is concave in (a, b), so Newton's method (Fisher
//! scoring) finds its only maximum.
//!
//! **Bounds.** The histories of one record at many scales are not independent, and bounds that take
//! them to be are far too narrow. With the scores u_j of record j summed over its histories and the
//! information I, the covariance of (a, b) is
//!
//! ```text
//! V = I^-1 ( J/(J - 1) sum_j u_j u_j^T ) I^-1
//! ```
//!
//! for J >= 2 records: K.-Y. Liang and S. L. Zeger (1986), "Longitudinal data analysis using
//! generalized linear models", Biometrika 73(1).

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Outcomes at one intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Group {
    /// ln of the intensity.
    pub ln_x: f64,
    pub n: u64,
    /// How many of them exceed.
    pub k: u64,
}

/// A deviation of the median's logarithm that is rounding.
const EXACT: f64 = 1e-9;

/// A symmetric 2 x 2 matrix: aa, ab, bb.
pub(crate) type SymmetricMatrix = [f64; 3];

/// Phi(a + b ln x).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probit {
    /// a.
    pub a: f64,
    /// b.
    pub b: f64,
    /// Expected information.
    pub information: SymmetricMatrix,
    /// Logarithm of the likelihood.
    pub log_likelihood: f64,
}

/// What can be said of some outcomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LognormalFit {
    /// A curve.
    Fitted(Probit),
    /// No history exceeds.
    NoneExceeded,
    /// Every history exceeds.
    AllExceeded,
    /// All that exceed lie above all that do not: the median is between the two, no width can be
    /// told.
    Separated {
        /// Largest intensity that does not exceed.
        below: f64,
        /// Least intensity that exceeds.
        above: f64,
    },
    /// Outcomes are mixed at one intensity alone: no width can be told.
    Undetermined,
    /// Higher intensities exceed less often.
    Falling,
}

/// Cumulative standard normal distribution.
pub fn phi(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Its density.
pub(crate) fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// Its inverse, for 0 < share < 1.
pub(crate) fn quantile(share: f64) -> f64 {
    let (mut low, mut high) = (-40.0, 40.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if phi(middle) < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Phi(z) and 1 - Phi(z), and d ln P/dz of an outcome: of one that exceeds phi/Phi, of one that
/// does not -phi/(1 - Phi).
pub(crate) struct Outcomes {
    pub over: f64,
    pub under: f64,
    pub score_over: f64,
    pub score_under: f64,
}

impl Outcomes {
    pub(crate) fn at(z: f64) -> Self {
        let (over, under, density) = (phi(z), phi(-z), density(z));
        // far in the tail phi/Phi tends to -z
        let score = |side: f64, tail: f64| if tail > 1e-300 { side * density / tail } else { -z };
        Self { over, under, score_over: score(1.0, over), score_under: score(-1.0, under) }
    }
}

impl LognormalFit {
    /// The fit to groups, in any order.
    pub(crate) fn new(groups: &[Group]) -> Self {
        let (n, k): (u64, u64) =
            groups.iter().fold((0, 0), |(n, k), group| (n + group.n, k + group.k));
        if k == 0 {
            return Self::NoneExceeded;
        }
        if k == n {
            return Self::AllExceeded;
        }
        let over = groups
            .iter()
            .filter(|group| group.k > 0)
            .map(|group| group.ln_x)
            .fold(f64::INFINITY, f64::min);
        let under = groups
            .iter()
            .filter(|group| group.k < group.n)
            .map(|group| group.ln_x)
            .fold(f64::NEG_INFINITY, f64::max);
        // one intensity, to rounding: the likelihood rises for ever with the slope
        if (under - over).abs() < 1e-9 {
            return Self::Undetermined;
        }
        if under < over {
            return Self::Separated { below: under.exp(), above: over.exp() };
        }
        match Probit::new(groups) {
            Some(probit) if probit.b > 0.0 => Self::Fitted(probit),
            _ => Self::Falling,
        }
    }
}

impl Probit {
    /// Newton's method from a flat line; the intensities are centred, so that a and b hardly depend
    /// on each other on the way.
    fn new(groups: &[Group]) -> Option<Self> {
        let all: f64 = groups.iter().map(|group| group.n as f64).sum();
        let centre = groups.iter().map(|group| group.ln_x * group.n as f64).sum::<f64>() / all;
        let share = groups.iter().map(|group| group.k as f64).sum::<f64>() / all;
        let (mut a, mut b) = (quantile(share), 0.0);
        let mut state = sums(groups, centre, a, b);
        for _ in 0..100 {
            let ([ua, ub], information, _) = state;
            let [[iaa, iab], [_, ibb]] = inverse(information)?;
            let (da, db) = (iaa * ua + iab * ub, iab * ua + ibb * ub);
            if da.abs() + db.abs() < 1e-10 * (1.0 + a.abs() + b.abs()) {
                break;
            }
            // concave: half a step at a time goes uphill at last
            let mut factor = 1.0;
            let mut next = sums(groups, centre, a + da, b + db);
            // to rounding: at the top it may not rise any more
            while next.2 < state.2 - 1e-12 * state.2.abs() && factor > 1e-6 {
                factor *= 0.5;
                next = sums(groups, centre, a + factor * da, b + factor * db);
            }
            (a, b) = (a + factor * da, b + factor * db);
            state = next;
        }
        let (_, _, log_likelihood) = state;
        let a = a - b * centre;
        let (_, information, _) = sums(groups, 0.0, a, b);
        (a.is_finite() && b.is_finite()).then_some(Self { a, b, information, log_likelihood })
    }

    /// The median theta.
    pub fn median(&self) -> f64 {
        (-self.a / self.b).exp()
    }

    /// The logarithmic standard deviation beta.
    pub fn beta(&self) -> f64 {
        1.0 / self.b
    }

    /// Covariance of (a, b) from the scores of records, summed as u u^T, of so many records. None
    /// of one record, which says nothing of others, and of records that do not differ in what they
    /// say of the median.
    pub(crate) fn covariance(
        &self,
        scores: SymmetricMatrix,
        records: usize,
    ) -> Option<SymmetricMatrix> {
        if records < 2 {
            return None;
        }
        let [[aa, ab], [_, bb]] = inverse(self.information)?;
        let factor = records as f64 / (records - 1) as f64;
        let [saa, sab, sbb] = scores.map(|s| factor * s);
        let (xaa, xab) = (aa * saa + ab * sab, aa * sab + ab * sbb);
        let (xba, xbb) = (ab * saa + bb * sab, ab * sab + bb * sbb);
        let covariance = [xaa * aa + xab * ab, xaa * ab + xab * bb, xba * ab + xbb * bb];
        (self.deviations(covariance).0 > EXACT).then_some(covariance)
    }

    /// Standard deviations of ln(theta) and of beta, to first order.
    pub(crate) fn deviations(&self, covariance: SymmetricMatrix) -> (f64, f64) {
        let [aa, ab, bb] = covariance;
        let m = -self.a / self.b;
        let ln_median = ((aa + 2.0 * m * ab + m * m * bb).max(0.0)).sqrt() / self.b;
        (ln_median, bb.max(0.0).sqrt() / (self.b * self.b))
    }

    /// Standard deviation of a + b ln x.
    pub fn deviation_at(&self, covariance: SymmetricMatrix, x: f64) -> f64 {
        let ([aa, ab, bb], ln_x) = (covariance, x.ln());
        (aa + 2.0 * ln_x * ab + ln_x * ln_x * bb).max(0.0).sqrt()
    }
}

/// Score, expected information and ln L.
fn sums(groups: &[Group], centre: f64, a: f64, b: f64) -> ([f64; 2], SymmetricMatrix, f64) {
    let (mut score_sum, mut information, mut likelihood) = ([0.0; 2], [0.0; 3], 0.0);
    for group in groups {
        let x = group.ln_x - centre;
        let z = a + b * x;
        let (n, k) = (group.n as f64, group.k as f64);
        let at = Outcomes::at(z);
        let u = k * at.score_over + (n - k) * at.score_under;
        // phi^2/(P (1 - P))
        let weight = -n * at.score_over * at.score_under;
        score_sum[0] += u;
        score_sum[1] += u * x;
        information[0] += weight;
        information[1] += weight * x;
        information[2] += weight * x * x;
        let ln = |p: f64| p.max(f64::MIN_POSITIVE).ln();
        likelihood += k * ln(at.over) + (n - k) * ln(at.under);
    }
    (score_sum, information, likelihood)
}

fn inverse([aa, ab, bb]: SymmetricMatrix) -> Option<[[f64; 2]; 2]> {
    let determinant = aa * bb - ab * ab;
    (determinant > 1e-14 * aa * bb)
        .then(|| [[bb / determinant, -ab / determinant], [-ab / determinant, aa / determinant]])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz & Stegun, tables 26.1 and 26.5.
    #[test]
    fn the_normal_distribution_has_its_printed_values() {
        for (z, printed) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_543),
            (2.0, 0.977_249_868_051_821),
            (-3.0, 0.001_349_898_031_630),
        ] {
            assert!((phi(z) - printed).abs() < 2e-15, "{z}: {}", phi(z));
        }
        assert!((phi(-6.0) / 9.865_876_450_377e-10 - 1.0).abs() < 1e-12);
        assert!((quantile(0.95) - 1.644_853_626_951_473).abs() < 1e-13);
    }

    /// Covariance of (a, b) if all outcomes are independent.
    fn independent(fit: &Probit) -> SymmetricMatrix {
        let [[aa, ab], [_, bb]] = inverse(fit.information).unwrap();
        [aa, ab, bb]
    }

    /// Two intensities and two parameters: the fit goes through both shares, and its covariance is
    /// that of two independent binomial shares, var(z) = P (1 - P)/(n phi(z)^2).
    #[test]
    fn two_intensities_are_fitted_exactly() {
        let groups = [Group { ln_x: 0.3, n: 200, k: 30 }, Group { ln_x: 1.1, n: 100, k: 80 }];
        let LognormalFit::Fitted(fit) = LognormalFit::new(&groups) else { panic!() };
        let z = [quantile(0.15), quantile(0.8)];
        let b = (z[1] - z[0]) / 0.8;
        assert!((fit.b - b).abs() < 1e-10 && (fit.a - (z[0] - 0.3 * b)).abs() < 1e-10, "{fit:?}");
        assert!((phi(fit.a + 1.1 * fit.b) - 0.8).abs() < 1e-10);
        let variance = |z: f64, n: f64| phi(z) * phi(-z) / (n * density(z).powi(2));
        let [v0, v1] = [variance(z[0], 200.0), variance(z[1], 100.0)];
        let covariance = independent(&fit);
        assert!((covariance[2] / ((v0 + v1) / 0.64) - 1.0).abs() < 1e-8, "{covariance:?}");
        assert!((fit.deviation_at(covariance, 0.3_f64.exp()).powi(2) / v0 - 1.0).abs() < 1e-8);
    }

    /// A thousand records, each overturned from a capacity of its own, ln of it normal about ln 2
    /// with 0.4 and stretched evenly over its quantiles: median 2 and beta 0.4 come back, and the
    /// bounds of the median are those of a mean of a thousand, 0.4/sqrt(1000), whatever the number
    /// of scales.
    #[test]
    fn capacities_of_records_give_the_deviation_of_their_mean() {
        let levels: Vec<f64> = (0..200).map(|i| -1.0 + 0.02 * f64::from(i)).collect();
        let capacities: Vec<f64> =
            (0..1000).map(|j| 2_f64.ln() + 0.4 * quantile((f64::from(j) + 0.5) / 1000.0)).collect();
        let below = |ln_x: f64| capacities.iter().filter(|c| **c < ln_x).count() as u64;
        let groups: Vec<Group> =
            levels.iter().map(|&ln_x| Group { ln_x, n: 1000, k: below(ln_x) }).collect();
        let LognormalFit::Fitted(fit) = LognormalFit::new(&groups) else { panic!() };
        assert!((fit.median() - 2.0).abs() < 0.01 && (fit.beta() - 0.4).abs() < 0.005, "{fit:?}");
        let mut scores = [0.0; 3];
        for capacity in &capacities {
            let u = levels.iter().fold([0.0; 2], |[a, b], ln_x| {
                let at = Outcomes::at(fit.a + fit.b * ln_x);
                let u = if capacity < ln_x { at.score_over } else { at.score_under };
                [a + u, b + u * ln_x]
            });
            scores = [scores[0] + u[0] * u[0], scores[1] + u[0] * u[1], scores[2] + u[1] * u[1]];
        }
        let robust = fit.deviations(fit.covariance(scores, 1000).unwrap()).0;
        let naive = fit.deviations(independent(&fit)).0;
        println!("median {} beta {} deviations {robust} {naive}", fit.median(), fit.beta());
        assert!((robust / (0.4 / 1000_f64.sqrt()) - 1.0).abs() < 0.1, "{robust}");
        assert!(naive < 0.4 * robust, "{naive}");
        // one record has no bounds, nor have records that do not differ: their scores are zero
        assert_eq!(fit.covariance(scores, 1), None);
        assert_eq!(fit.covariance([0.0; 3], 2), None);
    }

    #[test]
    fn what_cannot_be_fitted_is_said() {
        let group = |ln_x: f64, k: u64| Group { ln_x, n: 10, k };
        assert_eq!(LognormalFit::new(&[group(0.0, 0), group(1.0, 0)]), LognormalFit::NoneExceeded);
        assert_eq!(LognormalFit::new(&[group(0.0, 10)]), LognormalFit::AllExceeded);
        assert!(matches!(
            LognormalFit::new(&[group(0.0, 0), group(1.0, 10)]),
            LognormalFit::Separated { .. }
        ));
        assert_eq!(
            LognormalFit::new(&[group(0.0, 0), group(1.0, 5), group(2.0, 10)]),
            LognormalFit::Undetermined
        );
        assert_eq!(LognormalFit::new(&[group(1.0, 3)]), LognormalFit::Undetermined);
        assert_eq!(LognormalFit::new(&[group(0.0, 8), group(1.0, 2)]), LognormalFit::Falling);
    }
}
