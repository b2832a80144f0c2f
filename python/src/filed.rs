//! A history as it is pickled and compared: all the numbers that it is made of.

use std::sync::Arc;

use pyo3::prelude::*;
use rocking::{
    housner::{Impact, Rocking, RockingOutcome, Uplift},
    structure::Body,
};

use crate::{
    numbers,
    rocking::{Histories, History, Solved, ended},
    said::value_error,
};

/// Body and dt; theta and rate; times and rates of impacts, times and sides of uplifts; outcome and
/// its time.
type Numbers<'a> = ([f64; 5], [&'a [f64]; 2], [Vec<f64>; 5], &'static str, Option<f64>);

impl Solved {
    /// All that it is made of.
    pub fn numbers(&self) -> Numbers<'_> {
        let (b, r) = (&self.body, &self.rocking);
        let impacts = |pick: fn(&Impact<f64>) -> f64| r.impacts.iter().map(pick).collect();
        let uplifts = |pick: fn(&Uplift<f64>) -> f64| r.uplifts.iter().map(pick).collect();
        let events = [
            impacts(|i| i.time),
            impacts(|i| i.rate_before),
            impacts(|i| i.rate_after),
            uplifts(|u| u.time),
            uplifts(|u| u.side),
        ];
        let body = [b.mass, b.half_width, b.height, b.inertia, self.dt];
        (body, [&r.theta, &r.rate], events, ended(&r.outcome), when(&r.outcome))
    }
}

/// When it came to that (s).
fn when(outcome: &RockingOutcome) -> Option<f64> {
    match *outcome {
        RockingOutcome::Rocked | RockingOutcome::NeverMoved => None,
        RockingOutcome::Overturned { time }
        | RockingOutcome::LeavesGround { time }
        | RockingOutcome::WorkBound { time }
        | RockingOutcome::NotFinite { time } => Some(time),
    }
}

/// The outcome of a name.
fn outcome(name: &str, time: Option<f64>) -> Option<RockingOutcome> {
    Some(match (name, time) {
        ("rocked", None) => RockingOutcome::Rocked,
        ("never_lifted", None) => RockingOutcome::NeverMoved,
        ("overturned", Some(time)) => RockingOutcome::Overturned { time },
        ("leaves_ground", Some(time)) => RockingOutcome::LeavesGround { time },
        ("work_bound", Some(time)) => RockingOutcome::WorkBound { time },
        ("not_finite", Some(time)) => RockingOutcome::NotFinite { time },
        _ => return None,
    })
}

/// A history as it is pickled: body and dt; theta and rate; times and rates of impacts, times and
/// sides of uplifts; outcome and its time.
pub type Filed<'py> =
    ([f64; 5], Bound<'py, PyAny>, Bound<'py, PyAny>, [Vec<f64>; 5], String, Option<f64>);

/// A history that was pickled.
#[pyfunction]
pub fn _history(filed: Filed<'_>) -> PyResult<History> {
    let ([mass, half_width, height, inertia, dt], theta, rate, events, name, time) = filed;
    let [at, before, after, lifted, side] = events;
    let impacts = at.iter().zip(&before).zip(&after);
    let impacts = impacts.map(|((&time, &rate_before), &rate_after)| Impact {
        time,
        rate_before,
        rate_after,
    });
    let uplifts = lifted.iter().zip(&side).map(|(&time, &side)| Uplift { time, side });
    let rocking = Rocking {
        theta: numbers::row(&theta, "theta", "rad")?,
        rate: numbers::row(&rate, "rate", "rad/s")?,
        impacts: impacts.collect(),
        uplifts: uplifts.collect(),
        outcome: outcome(&name, time)
            .ok_or_else(|| value_error(format!("_history: outcome is {name:?}")))?,
    };
    Ok(History::new(Body { mass, half_width, height, inertia }, dt, rocking))
}

/// Histories that were pickled.
#[pyfunction]
pub fn _histories(all: Vec<PyRef<'_, History>>) -> Histories {
    let again = |one: &PyRef<'_, History>| {
        let Solved { body, dt, rocking, .. } = one.one();
        Solved::new(*body, *dt, rocking.clone())
    };
    Histories(Arc::new(all.iter().map(again).collect()))
}
