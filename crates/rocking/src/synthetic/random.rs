//! Random numbers that are the same everywhere: ChaCha8, one stream a record, turned into numbers
//! here and not by a library whose algorithms may change.

use std::f64::consts::TAU;

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

pub(super) struct Random(ChaCha8Rng);

impl Random {
    pub(super) fn new(seed: u64, stream: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        Self(generator)
    }

    /// Evenly in [0, 1).
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (f64::EPSILON / 2.0)
    }

    /// Evenly in [low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// In [low, high), evenly in the logarithm.
    pub(super) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    /// From `low` to so many octaves above it, evenly in the logarithm. `log_between` is not for
    /// these: compilers turn a power of 2 or 4 into `exp2` in some builds and not in others, and
    /// the last digit differs.
    pub(super) fn octaves_above(&mut self, low: f64, octaves: f64) -> f64 {
        low * (octaves * self.unit()).exp2()
    }

    /// +1 or -1.
    pub(super) fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { 1.0 } else { -1.0 }
    }

    /// Standard normal, by Box and Muller (1958).
    pub(super) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (TAU * self.unit()).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_the_moments_of_the_normal_distribution() {
        let mut random = Random::new(1, 0);
        let n = 200_000_i32;
        let mut moments = [0.0; 4];
        for _ in 0..n {
            let x = random.normal();
            for (power, moment) in (1..).zip(&mut moments) {
                *moment += x.powi(power) / f64::from(n);
            }
        }
        // four standard errors of each mean: sqrt(1/n), sqrt(2/n), sqrt(15/n), sqrt(96/n)
        for ((moment, exact), variance) in
            moments.into_iter().zip([0.0, 1.0, 0.0, 3.0]).zip([1.0, 2.0, 15.0, 96.0])
        {
            assert!(
                (moment - exact).abs() < 4.0 * (variance / f64::from(n)).sqrt(),
                "{moment} {exact}"
            );
        }
    }

    #[test]
    fn octaves_are_even_in_the_logarithm() {
        let (mut octaves, mut unit) = (Random::new(3, 1), Random::new(3, 1));
        for _ in 0..1000 {
            let (x, share) = (octaves.octaves_above(9.0, 2.0), unit.unit());
            assert!((9.0..36.0).contains(&x));
            assert!(((x / 9.0).log2() - 2.0 * share).abs() < 1e-14, "{x} {share}");
        }
    }

    #[test]
    fn streams_differ_and_repeat() {
        let first = |seed, stream| Random::new(seed, stream).unit();
        assert_eq!(first(1, 2), first(1, 2));
        assert_ne!(first(1, 2), first(1, 3));
        assert_ne!(first(1, 2), first(2, 2));
    }
}
