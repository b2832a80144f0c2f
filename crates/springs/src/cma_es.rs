//! CMA-ES: a search by generations of points drawn about a mean, whose covariance learns from the
//! best of them (Hansen, The CMA Evolution Strategy: A Tutorial, arXiv 1604.00772v1, 2016, with
//! the constants of its table 1, positive weights alone).

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// A search on its way.
pub(super) struct CmaEs {
    mean: DVector<f64>,
    /// Step size.
    sigma: f64,
    covariance: DMatrix<f64>,
    /// Principal axes of the covariance, each as long as its standard deviation.
    axes: DMatrix<f64>,
    /// The inverse of the covariance's square root.
    whitening: DMatrix<f64>,
    sigma_path: DVector<f64>,
    covariance_path: DVector<f64>,
    generations: i32,
    numbers: Constants,
}

/// Of a number of dimensions and points in a generation.
struct Constants {
    weights: Vec<f64>,
    /// Effective number of the points that are kept.
    kept: f64,
    c_sigma: f64,
    damping: f64,
    c_path: f64,
    c_one: f64,
    c_kept: f64,
    /// Mean length of a vector of standard normal numbers.
    length: f64,
}

impl Constants {
    fn new(dimensions: usize, points: usize) -> Self {
        let n = dimensions as f64;
        let raw: Vec<f64> = (1..=points / 2)
            .map(|i| (0.5 * (points as f64 + 1.0)).ln() - (i as f64).ln())
            .collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|w| w / sum).collect();
        let kept = 1.0 / weights.iter().map(|w| w * w).sum::<f64>();
        let c_sigma = (kept + 2.0) / (n + kept + 5.0);
        let c_one = 2.0 / ((n + 1.3).powi(2) + kept);
        let c_kept = 2.0 * (kept - 2.0 + 1.0 / kept) / ((n + 2.0).powi(2) + kept);
        Self {
            damping: 1.0 + 2.0 * (((kept - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + c_sigma,
            c_path: (4.0 + kept / n) / (n + 4.0 + 2.0 * kept / n),
            c_kept: c_kept.min(1.0 - c_one),
            length: n.sqrt() * (1.0 - 0.25 / n + 1.0 / (21.0 * n * n)),
            weights,
            kept,
            c_sigma,
            c_one,
        }
    }
}

/// Standard normal numbers (Box and Muller).
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (radius, turn): (f64, f64) = (1.0 - random.random::<f64>(), random.random());
    (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * turn).cos()
}

impl CmaEs {
    /// From a point, with a step size, generations of so many points.
    pub(super) fn new(begin: &[f64], sigma: f64, points: usize) -> Self {
        let n = begin.len();
        Self {
            mean: DVector::from_column_slice(begin),
            sigma,
            covariance: DMatrix::identity(n, n),
            axes: DMatrix::identity(n, n),
            whitening: DMatrix::identity(n, n),
            sigma_path: DVector::zeros(n),
            covariance_path: DVector::zeros(n),
            generations: 0,
            numbers: Constants::new(n, points),
        }
    }

    /// The next point of a generation.
    pub(super) fn draw(&self, random: &mut ChaCha8Rng) -> DVector<f64> {
        let z = DVector::from_fn(self.mean.len(), |_, _| normal(random));
        &self.mean + self.sigma * &self.axes * z
    }

    /// Learn from a generation, the best first.
    pub(super) fn learn(&mut self, ordered: &[DVector<f64>]) {
        let of = &self.numbers;
        let best: Vec<(f64, DVector<f64>)> = of
            .weights
            .iter()
            .zip(ordered)
            .map(|(&w, point)| (w, (point - &self.mean) / self.sigma))
            .collect();
        let step = best
            .iter()
            .fold(DVector::zeros(self.mean.len()), |sum: DVector<f64>, (w, y)| sum + *w * y);
        self.mean += self.sigma * &step;
        self.generations += 1;

        let gain = (of.c_sigma * (2.0 - of.c_sigma) * of.kept).sqrt();
        self.sigma_path = (1.0 - of.c_sigma) * &self.sigma_path + gain * &self.whitening * &step;
        let length = self.sigma_path.norm();
        let settled = (1.0 - (1.0 - of.c_sigma).powi(2 * self.generations)).sqrt();
        let n = self.mean.len() as f64;
        // h_sigma of the tutorial: where the path of the step size is long, that of the covariance
        // waits
        let stalled = length / settled >= (1.4 + 2.0 / (n + 1.0)) * of.length;
        let gain = (of.c_path * (2.0 - of.c_path) * of.kept).sqrt();
        self.covariance_path *= 1.0 - of.c_path;
        if !stalled {
            self.covariance_path += gain * &step;
        }
        let lost = if stalled { of.c_one * of.c_path * (2.0 - of.c_path) } else { 0.0 };
        self.covariance *= 1.0 + lost - of.c_one - of.c_kept;
        self.covariance += of.c_one * &self.covariance_path * self.covariance_path.transpose();
        for (w, y) in &best {
            self.covariance += of.c_kept * *w * y * y.transpose();
        }
        self.sigma *= (of.c_sigma / of.damping * (length / of.length - 1.0)).exp();
        self.take_axes();
    }

    /// Largest standard deviation of a coordinate.
    pub(super) fn width(&self) -> f64 {
        self.sigma * self.covariance.diagonal().max().sqrt()
    }

    fn take_axes(&mut self) {
        let SymmetricEigen { eigenvectors, eigenvalues } =
            SymmetricEigen::new(self.covariance.clone());
        let deviations = eigenvalues.map(|value| value.max(f64::MIN_POSITIVE).sqrt());
        let scaled = |by: &DVector<f64>| &eigenvectors * DMatrix::from_diagonal(by);
        self.axes = scaled(&deviations);
        self.whitening = scaled(&deviations.map(f64::recip)) * eigenvectors.transpose();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    /// For 8 dimensions and 14 points. Weights, the first three numbers and the last are those of
    /// the Python package cma 4.5.0 (`CMAEvolutionStrategy`, `popsize` 14, `CMA_active` false). It
    /// has other formulas for the rest, which are the tutorial's worked by hand.
    #[test]
    fn constants_are_those_of_the_tutorial() {
        let of = Constants::new(8, 14);
        let weights = [0.361148112, 0.236909479, 0.164234538, 0.112670847, 0.072674941];
        assert_eq!(of.weights.len(), 7);
        assert!(of.weights.iter().zip(weights).all(|(own, theirs)| (own - theirs).abs() < 1e-9));
        for (own, theirs) in [
            (of.kept, 4.287135066),
            (of.c_path, 0.346998693),
            (of.c_one, 0.022031980),
            (of.c_sigma, 6.287135066 / 17.287135066),
            (of.damping, 1.363688665),
            (of.c_kept, 0.048335609),
            (of.length, 2.742143262),
        ] {
            assert!((own - theirs).abs() < 2e-9, "{own} {theirs}");
        }
    }

    /// A narrow valley (Rosenbrock) in four dimensions ends at 1, 1, 1, 1.
    #[test]
    fn it_follows_a_narrow_valley() {
        let cost = |x: &DVector<f64>| -> f64 {
            x.as_slice()
                .windows(2)
                .map(|x| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2))
                .sum()
        };
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut walk = CmaEs::new(&[0.0; 4], 0.5, 12);
        for _ in 0..600 {
            let mut points: Vec<DVector<f64>> = (0..12).map(|_| walk.draw(&mut random)).collect();
            points.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
            walk.learn(&points);
        }
        assert!(walk.mean.iter().all(|x| (x - 1.0).abs() < 1e-6), "{}", walk.mean);
        assert!(walk.width() < 1e-6);
    }
}
