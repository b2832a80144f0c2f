//! Random cases: structures, springs and records over more than any user has.

use dynamics::spring::{Design, Springs};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rocking::structure::{Kind, Structure};

pub struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// Evenly in the logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub fn one_in(&mut self, n: u32) -> bool {
        self.0.random_range(0..n) == 0
    }

    /// R from 0.1 to 200 m, alpha 0.02 to 0.6, 1 kg to 1e7 kg; a third are solid blocks, the others
    /// have an I_cg from nothing to m R^2.
    pub fn structure(&mut self) -> Structure {
        loop {
            let (radius, alpha) = (self.log(0.1, 200.0), self.between(0.02, 0.6));
            let mass_kg = self.log(1.0, 1e7);
            let (kind, share) = match self.0.random_range(0..6) {
                0 | 1 => (Kind::Block, 1.0 / 3.0),
                2 => (Kind::AFrame, 0.0),
                _ => (Kind::AFrame, self.log(1e-5, 1.0)),
            };
            let structure = Structure {
                kind,
                height_m: radius * alpha.cos(),
                width_m: 2.0 * radius * alpha.sin(),
                mass_kg,
                rotational_inertia_kgm2: share * mass_kg * radius * radius,
            };
            if let Ok(structure) = structure.checked() {
                return structure;
            }
        }
    }

    /// 1 to 2000 Hz, mu 1e-3 to 100, K 1e-3 to 100, xi 0 to 100; one in eight has the same chain
    /// both ways.
    pub fn springs(&mut self) -> Springs<Design<f64>> {
        let vertical = self.design();
        let horizontal = if self.one_in(8) { vertical } else { self.design() };
        Springs { vertical, horizontal }
    }

    fn design(&mut self) -> Design<f64> {
        let (mu, k) = (self.log(1e-3, 100.0), self.log(1e-3, 100.0));
        let xi = if self.one_in(6) { 0.0 } else { self.log(1e-3, 100.0) };
        Design { mu, f: (k / mu).sqrt(), xi, omega_n_hz: self.log(1.0, 2000.0) }
    }

    /// dt (s) and at most 2000 samples (m/s2): dt 1e-4 to 0.05 s, peak 1e-6 g to 10 g.
    pub fn record(&mut self) -> (f64, Vec<f64>) {
        let dt = self.log(1e-4, 0.05);
        let seconds = self.log(0.1, 20.0);
        let n = ((seconds / dt) as usize).clamp(1, 2000);
        let peak = 9.81 * self.log(1e-6, 10.0) * if self.one_in(2) { 1.0 } else { -1.0 };
        // in parts of the record
        let (centre, width) = (self.between(0.0, 1.0), self.log(0.01, 1.0));
        let kind = self.0.random_range(0..9);
        let at = |i: usize, draw: &mut Self| {
            let x = (i as f64 / n as f64 - centre) / width;
            let after = f64::from(u8::from(x >= 0.0));
            match kind {
                0 => (1.0 - x * x).max(0.0),
                // Ricker's wavelet
                1 => (1.0 - 2.0 * x * x) * (-x * x).exp(),
                2 => draw.between(-1.0, 1.0),
                // one sample
                3 => f64::from(u8::from(i == n / 2)),
                // a step that stays
                4 => after,
                // strong from the first sample on, then nothing
                5 => 1.0 - after,
                // a square wave
                6 => (2.0 * std::f64::consts::PI * x).sin().signum(),
                // a sine that quickens
                7 => (20.0 * x * x).sin(),
                _ => 0.0,
            }
        };
        let accel = (0..n).map(|i| peak * at(i, self)).collect();
        (dt, accel)
    }
}
