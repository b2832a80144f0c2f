//! Housner's equation by diffsol's explicit Tsit45, stopped at every sample (the record's kinks)
//! and at every impact.
//!
//! An interval that ends with theta on the other side is taken back and repeated up to the impact,
//! whose time follows by Newton on the repeated step, so that the impact is as accurate as the step
//! itself.

use std::cell::Cell;

use comparison::rigid::RockingProblem;
use diffsol::{
    DiffsolError, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverStopReason,
};
use rocking::scalar::GRAVITY;

/// A body at rest that is lifted once and then rocks on, and its record.
#[derive(Clone, Copy, Debug)]
pub struct DiffsolHistory<'a> {
    /// p^2 (1/s2).
    pub p2: f64,
    /// alpha (rad).
    pub alpha: f64,
    /// Velocity restitution.
    pub e: f64,
    /// Gravity (m/s2).
    pub g: f64,
    /// Sampling interval (s).
    pub dt: f64,
    /// Ground acceleration (m/s2).
    pub accel: &'a [f64],
}

/// What the equation needs to know of the interval it is in.
#[derive(Clone, Copy, Default)]
struct Here {
    /// Start of the interval (s).
    t: f64,
    /// Ground acceleration there (g) and its slope (g/s).
    a: f64,
    slope: f64,
    /// sgn(theta).
    side: f64,
}

/// Where a step began: time, step size, theta and theta'.
#[derive(Clone, Copy)]
struct Mark {
    t: f64,
    theta: f64,
    rate: f64,
}

impl<'a> DiffsolHistory<'a> {
    /// A history of the comparison.
    pub fn of(problem: &'a RockingProblem) -> Self {
        Self {
            p2: problem.body.p_squared(),
            alpha: problem.body.alpha(),
            e: problem.body.restitution(),
            g: GRAVITY,
            dt: problem.record.dt,
            accel: &problem.record.accel,
        }
    }

    /// theta at every sample (rad) with relative tolerance `rtol`.
    ///
    /// # Errors
    /// diffsol gives up.
    pub fn theta(&self, rtol: f64) -> Result<Vec<f64>, DiffsolError> {
        let limit = self.g * self.alpha.tan();
        let n = self.accel.len();
        let mut theta = vec![0.0; n];
        let Some(lifted) = self.accel.iter().position(|a| a.abs() > limit) else {
            return Ok(theta);
        };
        let first = lifted.saturating_sub(1);
        let (a0, a1) = (self.accel[first], self.accel[lifted]);
        let side = -a1.signum();
        let share = if a0 == a1 { 0.0 } else { (-side * limit - a0) / (a1 - a0) };

        let here = Cell::new(Here { side, ..self.interval(first) });
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rhs(|y, _p, t, dy| {
                dy[0] = y[1];
                dy[1] = self.acceleration(&here.get(), t, y[0]);
            })
            .init(|_p, _t, y| y.fill(0.0), 2)
            .t0((first as f64 + share) * self.dt)
            .h0((1.0 - share) * self.dt)
            .rtol(rtol)
            .atol([rtol * self.alpha; 2])
            .build()?;
        let mut solver = problem.tsit45()?;
        for i in first..n - 1 {
            here.set(Here { side: here.get().side, ..self.interval(i) });
            self.cross(&mut solver, &here, (i + 1) as f64 * self.dt)?;
            theta[i + 1] = solver.state().y[0];
        }
        Ok(theta)
    }

    fn interval(&self, i: usize) -> Here {
        let (a, next) =
            (self.accel[i] / self.g, self.accel[(i + 1).min(self.accel.len() - 1)] / self.g);
        Here { t: i as f64 * self.dt, a, slope: (next - a) / self.dt, side: 0.0 }
    }

    /// Equation (3).
    fn acceleration(&self, here: &Here, t: f64, theta: f64) -> f64 {
        let (sin, cos) = (self.alpha * here.side - theta).sin_cos();
        -self.p2 * (sin + (here.a + here.slope * (t - here.t)) * cos)
    }

    /// To the interval's end, through its impacts.
    fn cross<'s, E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 's>(
        &self,
        solver: &mut impl OdeSolverMethod<'s, E>,
        here: &Cell<Here>,
        end: f64,
    ) -> Result<(), DiffsolError> {
        loop {
            let start = mark(solver);
            if end - start.t <= 1e-12 * self.dt {
                return Ok(());
            }
            advance(solver, end)?;
            let mut reached = mark(solver);
            if reached.theta * here.get().side >= 0.0 {
                return Ok(());
            }
            // Newton for the impact's time, from the linear estimate
            let mut t = start.t + (end - start.t) * start.theta / (start.theta - reached.theta);
            for _ in 0..5 {
                self.place(solver, here, start, t - start.t);
                advance(solver, t)?;
                reached = mark(solver);
                let correction = reached.theta / reached.rate;
                if correction.abs() <= 1e-16 * t {
                    break;
                }
                t -= correction;
            }
            here.set(Here { side: reached.rate.signum(), ..here.get() });
            self.place(
                solver,
                here,
                Mark { theta: 0.0, rate: self.e * reached.rate, ..reached },
                end - reached.t,
            );
        }
    }

    /// Put the solver somewhere, its next step h.
    fn place<'s, E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 's>(
        &self,
        solver: &mut impl OdeSolverMethod<'s, E>,
        here: &Cell<Here>,
        at: Mark,
        h: f64,
    ) {
        let state = solver.state_mut();
        *state.t = at.t;
        *state.h = h;
        state.y[0] = at.theta;
        state.y[1] = at.rate;
        state.dy[0] = at.rate;
        state.dy[1] = self.acceleration(&here.get(), at.t, at.theta);
    }
}

fn mark<'a, E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a>(
    solver: &impl OdeSolverMethod<'a, E>,
) -> Mark {
    let state = solver.state();
    Mark { t: state.t, theta: state.y[0], rate: state.y[1] }
}

fn advance<'a, E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a>(
    solver: &mut impl OdeSolverMethod<'a, E>,
    end: f64,
) -> Result<(), DiffsolError> {
    solver.set_stop_time(end)?;
    while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
    Ok(())
}
