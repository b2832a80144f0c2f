//! Random cases of every kind: no panic, no NaN, no hang, the energy account within its bound.
//!
//! `STRESS=100000 cargo test --release --test fem stress` runs more of them.

use groundspring::{
    fem::{Case, Control, Outcome, Start},
    spring::{Design, Springs},
    structure::{Kind, Structure},
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

struct Draw(ChaCha8Rng);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// Evenly in the logarithm.
    fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn one_in(&mut self, n: u32) -> bool {
        self.0.random_range(0..n) == 0
    }

    fn structure(&mut self) -> Structure {
        loop {
            let (radius, alpha) = (self.log(0.1, 200.0), self.between(0.02, 0.6));
            let mass_kg = self.log(1.0, 1e7);
            let share = if self.one_in(4) { 0.0 } else { self.log(1e-5, 1.0) };
            let structure = Structure {
                kind: Kind::AFrame,
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

    fn design(&mut self) -> Design<f64> {
        let (mu, k) = (self.log(1e-3, 100.0), self.log(1e-3, 100.0));
        let xi = if self.one_in(6) { 0.0 } else { self.log(1e-3, 100.0) };
        Design { mu, f: (k / mu).sqrt(), xi, omega_n_hz: self.log(1.0, 2000.0) }
    }

    /// About a second of ground motion, m/s2.
    fn record(&mut self) -> (f64, Vec<f64>) {
        let dt = self.log(1e-4, 0.05);
        let n = ((1.0 / dt) as usize).clamp(2, 2000);
        let peak = 9.81 * self.log(1e-6, 10.0);
        let (centre, width) = (self.between(0.0, 1.0), self.log(0.01, 1.0));
        let kind = self.0.random_range(0..5);
        let at = |i: usize, draw: &mut Self| match kind {
            0 => peak * (1.0 - ((i as f64 / n as f64 - centre) / width).powi(2)).max(0.0),
            1 => draw.between(-peak, peak),
            2 => f64::from(u8::from(i == n / 2)) * peak,
            3 => f64::from(u8::from(i >= n / 3)) * peak,
            _ => 0.0,
        };
        let accel = (0..n).map(|i| at(i, self)).collect();
        (dt, accel)
    }
}

/// Steps allowed to one case; springs of 2 kHz without damping may want more.
const MOST_STEPS: usize = 20_000;

#[test]
fn random_cases_end_in_a_history_or_a_said_outcome() {
    let count: u64 = std::env::var("STRESS").ok().and_then(|n| n.parse().ok()).unwrap_or(1000);
    let (mut bound, mut faults) = (0, Vec::new());
    for seed in 0..count {
        let mut draw = Draw(ChaCha8Rng::seed_from_u64(seed));
        let structure = draw.structure();
        let springs = Springs { vertical: draw.design(), horizontal: draw.design() }.chains(structure.mass_kg);
        let (dt, accel) = draw.record();
        let body = structure.body::<f64>();
        let start =
            if draw.one_in(3) { Start::Leaning(body.alpha() * draw.between(-1.2, 1.2)) } else { Start::Settled };
        let control = Control { most_steps: MOST_STEPS, ..Control::default() };
        let history = Case { body, springs, start, dt, accel: &accel, scale: 1.0, control }.simulate();

        let motion = &history.motion;
        let finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
        let mut fault = |what: &str| faults.push(format!("seed {seed}: {what}"));
        if !(finite(&motion.u) && finite(&motion.v) && finite(&motion.theta)) {
            fault("not finite");
        }
        if history.energy_residual.is_nan() || history.energy_residual >= 1e-6 {
            fault(&format!("residual {:e}, {:?}", history.energy_residual, history.outcome));
        }
        let account = &history.account;
        let largest = account.stored.iter().chain(&account.input).fold(0.0_f64, |m, e| m.max(e.abs()));
        if account.dissipated.windows(2).any(|w| w[1] < w[0] - 1e-6 * largest) {
            fault(&format!("energy created, {:?}", history.outcome));
        }
        match history.outcome {
            Outcome::Completed if motion.len() != accel.len() => fault("samples missing"),
            Outcome::WorkBound { .. } => bound += 1,
            _ => {}
        }
        if history.work.steps + history.work.rejected > MOST_STEPS {
            fault("more steps than allowed");
        }
    }
    eprintln!("{bound} of {count} cases reached the bound on steps");
    assert!(faults.is_empty(), "{} of {count}: {}", faults.len(), faults[..faults.len().min(40)].join("\n"));
    assert!(bound * 20 < count, "{bound} of {count} reached the bound on steps");
}
