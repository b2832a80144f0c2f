//! Random structures and ground motions from a seed.

use frames::{Mechanics, Pier};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Numbers from a seed.
pub struct Random(ChaCha8Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    pub fn happens(&mut self, share: f64) -> bool {
        self.0.random_bool(share)
    }

    /// A pier of 3 to 30 m, 0.7 to 12 Hz, with a light or heavy footing and any column.
    pub fn pier(&mut self) -> Pier {
        let h = self.within(3.0, 30.0);
        let (b, m) = (h * self.within(0.08, 0.5), self.within(5e4, 1e6));
        let dynamics = [self.within(0.7, 12.0), self.within(0.0, 0.08)];
        let pier = Pier::new(
            [m, h, b],
            dynamics,
            [m * self.within(0.02, 3.0), b * self.within(0.05, 1.0)],
        );
        if self.happens(0.4) {
            return pier;
        }
        let pier = pier
            .with_axial(pier.stiffness * 10_f64.powf(self.within(1.0, 3.0)), self.within(0.0, 0.1));
        if self.happens(0.5) { pier.with_chord(h * self.within(0.6, 1.0)) } else { pier }
    }

    /// n samples at 0.01 s of six sines that swell for a second, at most of a given size (m/s2).
    pub fn motion(&mut self, n: usize, size: f64) -> Vec<f64> {
        let sines: Vec<_> =
            (0..6).map(|_| (self.within(1.0, 30.0), self.within(0.0, 6.3))).collect();
        let at = |t: f64| {
            sines.iter().map(|(w, phase)| (w * t + phase).sin()).sum::<f64>() / 6.0 * t.min(1.0)
        };
        (0..n).map(|i| size * at(0.01 * i as f64)).collect()
    }

    /// Horizontal and vertical motions that make a structure rock: up to eight times what lifts it,
    /// some with up to 0.6 g vertically.
    pub fn shake(&mut self, slenderness: f64, n: usize) -> [Vec<f64>; 2] {
        let size = 9.81 * slenderness * self.within(1.0, 8.0);
        let vertical = if self.happens(0.5) { 9.81 * self.within(0.0, 1.2) } else { 0.0 };
        [self.motion(n, size), self.motion(n, vertical)]
    }
}

/// b/h of a pier.
pub fn slenderness(pier: &Pier) -> f64 {
    debug_assert!(pier.size() >= 4);
    pier.half_width / pier.height
}
