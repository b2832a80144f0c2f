//! Integrators on oscillators whose answer is known.

use dynamics::spring::Chain;
use fixed_steps::{
    ConvergenceTest, FixedStepAnalysis, FixedStepModel, FixedStepOutcome, Integrator, Iteration,
    StepSettings,
    contact::FixedFoot,
    kinematics::{Kinematics, TangentWeights, Trial},
};
use frames::frame::EquilibriumError;
use nalgebra::{Matrix2, Matrix3, Matrix4, Vector3, Vector4};
use rocking::motion::largest_magnitude;

/// A mass of one on a spring, without contact; its record is a force.
struct Oscillator {
    omega: f64,
}

impl FixedStepModel for Oscillator {
    type Vector = [f64; 1];
    type Feet = [FixedFoot; 0];
    type Places = ();
    type Factor = f64;

    fn standing(&self) -> Result<([f64; 1], [FixedFoot; 0]), EquilibriumError> {
        Ok(([0.0], []))
    }

    fn places(&self, _: &[f64; 1]) {}

    fn meet(&self, (): &(), _: &[f64; 1], _: &mut [FixedFoot; 0]) {}

    fn unbalance(
        &self,
        (trial, ()): (&Trial<[f64; 1]>, &()),
        _: &[FixedFoot; 0],
        [ground, _]: [f64; 2],
        out: &mut [f64; 1],
    ) {
        out[0] = -ground - self.omega * self.omega * trial.q[0] - trial.a[0];
    }

    fn factor(
        &self,
        _: (&Trial<[f64; 1]>, &()),
        _: &[FixedFoot; 0],
        weights: &TangentWeights,
    ) -> Option<f64> {
        Some(weights.mass + weights.stiffness * self.omega * self.omega)
    }

    fn solve(&self, factor: &f64, right: &mut [f64; 1]) {
        right[0] /= factor;
    }
}

const ALL: [Integrator; 8] = [
    Integrator::AVERAGE_ACCELERATION,
    Integrator::Newmark { gamma: 0.6, beta: 0.3025 },
    Integrator::Hht { alpha: -0.1 },
    Integrator::HHT_MOST,
    Integrator::GENERALIZED_ALPHA_0,
    Integrator::GeneralizedAlpha { rho_inf: 0.6 },
    Integrator::Trbdf2,
    Integrator::BackwardEuler,
];

/// Free vibration of omega = 1 from (q, v) = (1, 0), consistent acceleration: the place after every
/// step.
fn free(integrator: Integrator, omega: f64, step: f64, steps: usize) -> Vec<f64> {
    let accel = vec![0.0; steps + 1];
    let iteration = Iteration { constant: 0, newton: 5, test: ConvergenceTest::Increment(1e-13) };
    let settings = StepSettings { iteration, ..StepSettings::new(integrator, step) };
    let model = Oscillator { omega };
    let start = Kinematics::moving([1.0], [0.0], [-omega * omega]);
    let mut shown = Vec::new();
    let (outcome, _) = FixedStepAnalysis::new(&model, settings, step, &accel).follow_from(
        start,
        [],
        &mut |_, q| {
            shown.push(q[0]);
            std::ops::ControlFlow::Continue(())
        },
    );
    assert_eq!(outcome, FixedStepOutcome::Finished);
    shown
}

/// The trapezoidal rule keeps the amplitude and turns by 2 atan(omega dt/2) a step: Bathe, Finite
/// Element Procedures (1996), section 9.4.
#[test]
fn the_trapezoidal_rule_lengthens_the_period_by_what_theory_says() {
    for step in [0.01_f64, 0.3, 2.0] {
        let turn = 2.0 * (0.5 * step).atan();
        for (n, q) in free(Integrator::AVERAGE_ACCELERATION, 1.0, step, 200).into_iter().enumerate()
        {
            assert!((q - (n as f64 * turn).cos()).abs() < 1e-11, "{step}, {n}: {q}");
        }
    }
}

/// Hughes, The Finite Element Method (1987), section 9.3, and Chung and Hulbert: the three-variable
/// recurrence of (q, v dt, a dt^2) in terms of the acceleration at the end, which is not how it is
/// stepped here.
#[test]
fn hht_and_generalized_alpha_follow_their_amplification_matrices() {
    let square = 0.7_f64 * 0.7;
    let cases = [
        (Integrator::Hht { alpha: -0.2 }, [0.8, 1.0], [0.7, 0.36]),
        (
            Integrator::GeneralizedAlpha { rho_inf: 0.5 },
            [1.0 / 1.5, 1.0],
            [0.5 + 1.0 - 1.0 / 1.5, 0.25 * (4.0_f64 / 3.0).powi(2)],
        ),
        (Integrator::Newmark { gamma: 0.6, beta: 0.3025 }, [1.0, 1.0], [0.6, 0.3025]),
    ];
    for (integrator, [w, m], [gamma, beta]) in cases {
        // m A + (1 - m) a + Omega^2 (w (q + v + (1/2 - beta) a + beta A) + (1 - w) q) = 0
        let below = m + square * w * beta;
        let row =
            [-square / below, -square * w / below, -(1.0 - m + square * w * (0.5 - beta)) / below];
        let a = Matrix3::new(
            1.0 + beta * row[0],
            1.0 + beta * row[1],
            0.5 - beta + beta * row[2],
            gamma * row[0],
            1.0 + gamma * row[1],
            1.0 - gamma + gamma * row[2],
            row[0],
            row[1],
            row[2],
        );
        let mut state = Vector3::new(1.0, 0.0, -square);
        for (n, q) in free(integrator, 0.7, 1.0, 60).into_iter().enumerate() {
            assert!((q - state[0]).abs() < 1e-12, "{integrator}, {n}: {q}, {}", state[0]);
            state = a * state;
        }
    }
}

/// Halving the step divides the error by four, for every one of them: also OpenSees' BackwardEuler,
/// which is the three-point formula.
#[test]
fn all_are_of_second_order() {
    for integrator in
        ALL.into_iter().filter(|i| !matches!(i, Integrator::Newmark { gamma: 0.6, .. }))
    {
        let error = |step: f64| {
            (free(integrator, 1.0, step, (6.0 / step).round() as usize).last().unwrap()
                - 6f64.cos())
            .abs()
        };
        let ratio = error(0.01) / error(0.005);
        assert!((3.5..4.5).contains(&ratio), "{integrator}: {ratio}");
    }
    // gamma above one half costs an order
    let error = |step: f64| {
        (free(ALL[1], 1.0, step, (6.0 / step).round() as usize).last().unwrap() - 6f64.cos()).abs()
    };
    let ratio = error(0.01) / error(0.005);
    assert!((1.8..2.2).contains(&ratio), "{ratio}");
}

/// What is left of a mode of 1e7 rad a step is `stiff_radius` a step, on the long run.
#[test]
fn stiff_modes_end_as_the_spectral_radius_says() {
    for integrator in [ALL[0], ALL[2], ALL[3], ALL[5], Integrator::Hht { alpha: -0.414 }] {
        let q = free(integrator, 1e7, 1.0, 320);
        let found =
            (largest_magnitude(&q[300..320]) / largest_magnitude(&q[150..170])).powf(1.0 / 150.0);
        let expected = integrator.stiff_radius();
        // a double or triple root adds n or n^2: 4^(1/150)
        assert!((found / expected - 1.0).abs() < 0.012, "{integrator}: {found}, {expected}");
    }
    for integrator in
        [Integrator::Trbdf2, Integrator::BackwardEuler, Integrator::GENERALIZED_ALPHA_0]
    {
        let q = free(integrator, 1e7, 1.0, 8);
        assert!(q[5..].iter().all(|q| q.abs() < 1e-9), "{integrator}: {q:?}");
        assert!(integrator.ends_stiff_modes());
    }
}

/// A mass on a spring-absorber unit under a force that grows evenly: two coordinates, against the
/// exact solution exp(A t). The unit stands upside down: gravity has no part.
#[test]
fn a_linear_chain_under_a_ramp() {
    let chain = Chain { k1: 4000.0, k2: 900.0, m2: 3.0, c: 60.0 };
    let mass = 10.0;
    let model = LinearChain { mass, chain };
    let (step, steps) = (1e-3, 400);
    let accel: Vec<f64> = (0..=steps).map(|i| i as f64 * step).collect();
    let exact = exact_chain(mass, &chain, step * steps as f64);
    for integrator in
        ALL.into_iter().filter(|i| !matches!(i, Integrator::Newmark { gamma: 0.6, .. }))
    {
        let iteration =
            Iteration { constant: 0, newton: 5, test: ConvergenceTest::Increment(1e-14) };
        let settings = StepSettings { iteration, ..StepSettings::new(integrator, step) };
        let mut last = [0.0; 2];
        let analysis = FixedStepAnalysis::new(&model, settings, step, &accel);
        let (outcome, _) = analysis
            .follow(|_, q| {
                last = *q;
                std::ops::ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!(outcome, FixedStepOutcome::Finished);
        for (found, expected) in last.iter().zip(exact) {
            assert!((found / expected - 1.0).abs() < 1e-3, "{integrator}: {last:?}, {exact:?}");
        }
    }
}

/// Mass u, absorber a: m u'' = -m t - k1 (u - a), m2 a'' = k1 (u - a) - k2 a - c a'.
struct LinearChain {
    mass: f64,
    chain: Chain,
}

impl FixedStepModel for LinearChain {
    type Vector = [f64; 2];
    type Feet = [FixedFoot; 0];
    type Places = ();
    type Factor = Matrix2<f64>;

    fn standing(&self) -> Result<([f64; 2], [FixedFoot; 0]), EquilibriumError> {
        Ok(([0.0; 2], []))
    }

    fn places(&self, _: &[f64; 2]) {}

    fn meet(&self, (): &(), _: &[f64; 2], _: &mut [FixedFoot; 0]) {}

    fn unbalance(
        &self,
        (trial, ()): (&Trial<[f64; 2]>, &()),
        _: &[FixedFoot; 0],
        [ground, _]: [f64; 2],
        out: &mut [f64; 2],
    ) {
        let Chain { k1, k2, m2, c } = self.chain;
        let Trial { q: [u, a], v, a: accel, .. } = trial;
        out[0] = -self.mass * (ground + accel[0]) - k1 * (u - a);
        out[1] = k1 * (u - a) - k2 * a - c * v[1] - m2 * accel[1];
    }

    fn factor(
        &self,
        _: (&Trial<[f64; 2]>, &()),
        _: &[FixedFoot; 0],
        w: &TangentWeights,
    ) -> Option<Matrix2<f64>> {
        let Chain { k1, k2, m2, c } = self.chain;
        let k = w.stiffness * k1;
        let own = w.mass * m2 + w.damping * c + w.stiffness * k2;
        Matrix2::new(w.mass * self.mass + k, -k, -k, own + k).try_inverse()
    }

    fn solve(&self, factor: &Matrix2<f64>, right: &mut [f64; 2]) {
        *right = (factor * nalgebra::Vector2::from(*right)).into();
    }
}

/// x = (u, a, u', a'): the ramp is a polynomial, so x = x_p(t) + exp(A t)(x(0) - x_p(0)).
fn exact_chain(mass: f64, chain: &Chain, t: f64) -> [f64; 2] {
    let Chain { k1, k2, m2, c } = *chain;
    let a = Matrix4::new(
        0.0,
        0.0,
        1.0,
        0.0,
        0.0,
        0.0,
        0.0,
        1.0,
        -k1 / mass,
        k1 / mass,
        0.0,
        0.0,
        k1 / m2,
        -(k1 + k2) / m2,
        0.0,
        -c / m2,
    );
    // x' = A x - e t:  x_p = A^-1 e t + A^-2 e
    let inverse = a.try_inverse().unwrap();
    let e = Vector4::new(0.0, 0.0, 1.0, 0.0);
    let particular = |t: f64| inverse * e * t + inverse * inverse * e;
    let x = particular(t) - (a * t).exp() * particular(0.0);
    [x[0], x[1]]
}

/// The force of a record lies on straight lines between samples, whatever the step.
#[test]
fn records_are_interpolated() {
    let model = Oscillator { omega: 1e-6 };
    // v' = -a_g: the trapezoidal rule integrates straight lines exactly at their ends
    let accel = [0.0, 2.0, -1.0, 0.0];
    let settings = StepSettings::new(Integrator::AVERAGE_ACCELERATION, 0.05);
    let mut shown = Vec::new();
    let analysis =
        FixedStepAnalysis { scale: 2.0, ..FixedStepAnalysis::new(&model, settings, 0.1, &accel) };
    analysis
        .follow(|i, q| {
            shown.push((i, q[0]));
            std::ops::ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(shown.len(), 4);
    // velocities at the samples: -0.2, -0.3, -0.2 of scale 2; at half of the first interval -0.05
    let step = |v0: f64, v1: f64| 0.05 * 0.5 * (v0 + v1);
    let expected = step(0.0, -0.05) + step(-0.05, -0.2);
    assert!((shown[1].1 - expected).abs() < 1e-12, "{shown:?}, {expected}");
    assert!(shown[3].1 < shown[2].1);
}
