//! One uplift: the ground swings from one side to beyond the uplift limit of the other.
//!
//! ```text
//!  a_g/(g tan alpha)  =  0 .. -0.8  in 0.1 s,   -0.8 .. 1.7  in t_r, as a half cosine,   1.7 for a moment more
//! ```
//!
//! A stance that deflects by x = a_g/w^2 (w: its sway frequency) has the velocity a_g'/w^2 at
//! uplift; undamped sway changes it to between zero and twice that, depending on w t_r. So there
//! are many t_r: those of earthquakes and, as what is wanted does not depend on the size of a
//! structure alone, some in units of 1/p.

use std::{f64::consts::PI, ops::ControlFlow};

use dynamics::{
    effort::Effort,
    fem::{Analysis, Control, HistoryOutcome, View},
    spring::{Chain, Springs},
};
use rocking::{housner, scalar::GRAVITY, structure::Body};

/// Durations t_r (s).
const RAMPS_S: [f64; 5] = [0.045, 0.065, 0.095, 0.14, 0.2];
/// Durations t_r, in 1/p.
const RAMPS_P: [f64; 3] = [0.06, 0.12, 0.24];
/// Ground acceleration before and after, in g tan alpha.
const SWING: (f64, f64) = (-0.8, 1.7);

/// Ground acceleration from rest through an uplift, and Housner's displacement at its end.
#[derive(Clone, Debug)]
pub(super) struct UpliftRamp {
    dt: f64,
    accel: Vec<f64>,
    /// Samples over which the velocity is taken.
    last: usize,
    /// Housner's u at both ends of these (m).
    housner: (f64, f64),
}

/// The uplifts of a structure.
pub(super) fn all(body: &Body<f64>) -> Vec<UpliftRamp> {
    let p = body.p();
    RAMPS_S
        .iter()
        .copied()
        .chain(RAMPS_P.iter().map(|t| t / p))
        .map(|tr| UpliftRamp::new(body, tr))
        .collect()
}

impl UpliftRamp {
    fn new(body: &Body<f64>, tr: f64) -> Self {
        let lift = GRAVITY * body.half_width / body.height;
        let steps = 6;
        let dt = tr / steps as f64;
        let before = (0.1 / dt).ceil() as usize;
        let after = ((0.08 / dt).ceil() as usize).max(4);
        let mut accel: Vec<f64> =
            (0..=before).map(|i| SWING.0 * lift * i as f64 / before as f64).collect();
        accel.extend((1..=steps).map(|i| {
            let share = 0.5 * (1.0 - (PI * i as f64 / steps as f64).cos());
            lift * (SWING.0 + (SWING.1 - SWING.0) * share)
        }));
        accel.extend(std::iter::repeat_n(lift * SWING.1, after));
        let rocking = housner::history(body, dt, &accel);
        let last = ((0.04 / dt).ceil() as usize).clamp(2, after);
        let end = accel.len() - 1;
        let u = |i: usize| rocking.theta.get(i).map_or(f64::NAN, |&theta| body.u(theta));
        Self { dt, last, housner: (u(end - last), u(end)), accel }
    }

    /// The uplift error, in units of p R alpha / 4; infinite if the run did not finish.
    pub(crate) fn uplift_error(
        &self,
        body: &Body<f64>,
        chains: &Springs<Chain>,
        (control, effort): (Control, &Effort),
    ) -> f64 {
        let end = self.accel.len() - 1;
        let (mut from, mut to) = (0.0, 0.0);
        let mut observer = |i: usize, view: &View| {
            if i == end - self.last {
                from = view.x();
            } else if i == end {
                to = view.x();
            }
            ControlFlow::Continue(())
        };
        let case = Analysis { control, ..Analysis::new(*body, *chains, self.dt, &self.accel) };
        let finish = case.observe(&mut observer);
        finish.spend(effort);
        if finish.outcome != HistoryOutcome::Completed {
            return f64::INFINITY;
        }
        let p = body.p();
        let (from, to) = (from - self.housner.0, to - self.housner.1);
        let ahead = (to - from) / (self.last as f64 * self.dt) + p * to;
        ahead / (p * body.radius() * body.alpha() * 0.25)
    }
}
