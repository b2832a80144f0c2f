//! One step of the Runge-Kutta method of order 8 by Dormand and Prince (Hairer, Norsett & Wanner,
//! Solving Ordinary Differential Equations I, section II.5 and the code DOP853), for q'' = a(q, q',
//! t) and the work of forces along the way.

use super::state::{Rates, ReferenceState, ReferenceStep, StepTolerance};
use super::stiffness::LastStage;

/// Stages of a step.
const STAGES: usize = 12;

/// Nodes c_i.
const C: [f64; STAGES] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
];

/// Coefficients a_ij of stages 2 to 12, each as (j, a_ij); at last the weights b_j.
const A: [&[(usize, f64)]; STAGES] = [
    &[(0, 0.05260015195876773)],
    &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
    &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
    &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
    &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
    &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
    &[
        (0, 0.03709200011850479),
        (3, 0.17038392571223998),
        (4, 0.10726203044637328),
        (5, -0.015319437748624402),
        (6, 0.008273789163814023),
    ],
    &[
        (0, 0.6241109587160757),
        (3, -3.3608926294469414),
        (4, -0.868219346841726),
        (5, 27.59209969944671),
        (6, 20.154067550477894),
        (7, -43.48988418106996),
    ],
    &[
        (0, 0.47766253643826434),
        (3, -2.4881146199716677),
        (4, -0.590290826836843),
        (5, 21.230051448181193),
        (6, 15.279233632882423),
        (7, -33.28821096898486),
        (8, -0.020331201708508627),
    ],
    &[
        (0, -0.9371424300859873),
        (3, 5.186372428844064),
        (4, 1.0914373489967295),
        (5, -8.149787010746927),
        (6, -18.52006565999696),
        (7, 22.739487099350505),
        (8, 2.4936055526796523),
        (9, -3.0467644718982196),
    ],
    &[
        (0, 2.273310147516538),
        (3, -10.53449546673725),
        (4, -2.0008720582248625),
        (5, -17.9589318631188),
        (6, 27.94888452941996),
        (7, -2.8589982771350235),
        (8, -8.87285693353063),
        (9, 12.360567175794303),
        (10, 0.6433927460157636),
    ],
    &[
        (0, 0.054293734116568765),
        (5, 4.450312892752409),
        (6, 1.8915178993145003),
        (7, -5.801203960010585),
        (8, 0.3111643669578199),
        (9, -0.1521609496625161),
        (10, 0.20136540080403034),
        (11, 0.04471061572777259),
    ],
];

/// Error estimates of order 5 and 3.
const ERROR: [&[(usize, f64)]; 2] = [
    &[
        (0, 0.01312004499419488),
        (5, -1.2251564463762044),
        (6, -0.4957589496572502),
        (7, 1.6643771824549864),
        (8, -0.35032884874997366),
        (9, 0.3341791187130175),
        (10, 0.08192320648511571),
        (11, -0.022355307863886294),
    ],
    &[
        (0, -0.18980075407240762),
        (5, 4.450312892752409),
        (6, 1.8915178993145003),
        (7, -5.801203960010585),
        (8, -0.4226823213237919),
        (9, -0.1521609496625161),
        (10, 0.20136540080403034),
        (11, 0.02265179219836082),
    ],
];

/// The order of the error estimate in h.
const ORDER: f64 = 8.0;

/// A step of length h from a state and its rates. These are functions of the time since the step's
/// start. None where they are not defined.
pub(crate) fn step(
    mut rates: impl FnMut(f64, &ReferenceState) -> Option<Rates>,
    start: &ReferenceState,
    first: &Rates,
    h: f64,
    rtol: f64,
) -> Option<ReferenceStep> {
    let mut velocities = vec![start.v.clone()];
    let mut slopes = vec![first.clone()];
    let mut stage = start.clone();
    let mut last_place = start.q.clone();
    for (i, row) in A.iter().enumerate() {
        stage.clone_from(start);
        for &(j, a) in *row {
            stage.q.axpy(h * a, &velocities[j], 1.0);
            stage.v.axpy(h * a, &slopes[j].a, 1.0);
            for k in 0..stage.work.len() {
                stage.work[k] += h * a * slopes[j].power[k];
            }
        }
        if i + 1 < STAGES {
            slopes.push(rates(h * C[i + 1], &stage)?);
            velocities.push(stage.v.clone());
        }
        if i + 2 == STAGES {
            last_place.clone_from(&stage.q);
        }
    }
    let tolerance = StepTolerance(rtol);
    let mut squares = [0.0; 2];
    for (square, row) in squares.iter_mut().zip(ERROR) {
        let estimate = |of: &dyn Fn(usize) -> f64| row.iter().map(|&(j, e)| e * of(j)).sum::<f64>();
        for (k, (a, b)) in start.q.iter().zip(stage.q.iter()).enumerate() {
            *square += (estimate(&|j| velocities[j][k]) / tolerance.place(*a, *b)).powi(2);
        }
        for (k, (a, b)) in start.v.iter().zip(stage.v.iter()).enumerate() {
            *square += (estimate(&|j| slopes[j].a[k]) / tolerance.velocity(*a, *b)).powi(2);
        }
    }
    let [fifth, third] = squares;
    let below = (fifth + 0.01 * third) * (2 * start.q.len()) as f64;
    let error = if fifth == 0.0 { 0.0 } else { h * fifth / below.sqrt() };
    let last = LastStage { q: last_place, v: velocities.pop()?, a: slopes.pop()?.a };
    error.is_finite().then_some(ReferenceStep {
        state: stage,
        error,
        order: ORDER,
        last: Some(last),
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::super::state::within;
    use super::*;

    /// q'' = -q - 0.1 q' + t: the error of one step falls like h^9, and the estimate is of its size
    /// or above.
    #[test]
    fn the_order_is_eight() {
        let rates = |t: f64, y: &ReferenceState| {
            let a = t - y.q[0] - 0.1 * y.v[0];
            Some(Rates {
                a: DVector::from_element(1, a),
                power: [0.1 * y.v[0] * y.v[0], 0.0, 0.0],
                forces: vec![],
            })
        };
        let start = ReferenceState {
            q: DVector::from_element(1, 1.0),
            v: DVector::zeros(1),
            work: [0.0; 3],
        };
        // q = t - 0.1 + exp(-t/20)(A cos + B sin)
        let exact = |t: f64| {
            let w = (1.0_f64 - 0.0025).sqrt();
            let (a, b) = (1.1, (0.05 * 1.1 - 1.0) / w);
            t - 0.1 + (-0.05 * t).exp() * (a * (w * t).cos() + b * (w * t).sin())
        };
        let error = |h: f64| {
            let first = rates(0.0, &start).unwrap();
            let end = step(rates, &start, &first, h, 1e-9).unwrap().state;
            (end.q[0] - exact(h)).abs()
        };
        let order = (error(1.6) / error(0.8)).log2();
        assert!((8.5..10.5).contains(&order), "{order} {} {}", error(1.6), error(0.8));
        let first = rates(0.0, &start).unwrap();
        let ReferenceStep { state: end, error: estimate, .. } =
            step(rates, &start, &first, 0.4, 1e-9).unwrap();
        assert!(estimate < 1.0 && (end.q[0] - exact(0.4)).abs() < 1e-9, "{estimate}");
        let last = rates(0.4, &end).unwrap();
        let middle = within([(&start, &first), (&end, &last)], 0.4, 0.3);
        assert!((middle.q[0] - exact(0.12)).abs() < 1e-7, "{} {}", middle.q[0], exact(0.12));
    }
}
