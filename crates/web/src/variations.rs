//! The case's body at other sizes, slendernesses and scales of its record, by Housner's equation;
//! and between one that stands and one that falls, the first that falls.

use serde::Deserialize;

use crate::{WebError, any_case::AnyCase};
use rocking::{
    housner::{RockingOptions, RockingOutcome, solve_lanes},
    motion::largest_magnitude,
    structure::Body,
};

/// A body and a scale; the case's own where left out.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Variation {
    /// (rad)
    alpha: Option<f64>,
    /// R (m).
    radius_m: Option<f64>,
    /// Factor on the record of the case, its own scale not counted.
    scale: Option<f64>,
}

/// Peak |theta|/alpha of each; none where it overturns, or Housner's equation ends.
pub(crate) fn answer(case: &AnyCase, asked: &str) -> Result<Vec<Option<f32>>, WebError> {
    peaks(case, &serde_json::from_str::<Vec<_>>(asked)?)
}

/// How many variations are tried side by side between two.
const BETWEEN: u32 = 15;
/// How often: the share is found to 1/16^3.
const ROUNDS: usize = 3;

/// On the way from a variation that stands (0) to one that falls (1), the share where the first
/// falls of those tried; every one tried before it stands.
pub(crate) fn first_fall(case: &AnyCase, ends: &str) -> Result<f64, WebError> {
    let [stands, falls]: [Variation; 2] = serde_json::from_str(ends)?;
    let mix = |a: Option<f64>, b: Option<f64>, t: f64| Some(a? + t * (b? - a?));
    let at = |t: f64| Variation {
        alpha: mix(stands.alpha, falls.alpha, t),
        radius_m: mix(stands.radius_m, falls.radius_m, t),
        scale: mix(stands.scale, falls.scale, t),
    };
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..ROUNDS {
        let part = (to - from) / f64::from(BETWEEN + 1);
        let tried: Vec<f64> = (1..=BETWEEN).map(|i| from + f64::from(i) * part).collect();
        let peaks = peaks(case, &tried.iter().map(|t| at(*t)).collect::<Vec<_>>())?;
        let first = tried.iter().zip(&peaks).find(|(_, peak)| peak.is_none());
        to = first.map_or(to, |(t, _)| *t);
        from = to - part;
    }
    Ok(to)
}

fn peaks(case: &AnyCase, asked: &[Variation]) -> Result<Vec<Option<f32>>, WebError> {
    let (own, excitation) = (case.body(), case.excitation());
    let record = excitation.used()?;
    let vertical = record.vertical_accel();
    // the record is scaled already
    let scale = |asked: f64| if excitation.scale == 0.0 { 0.0 } else { asked / excitation.scale };
    let body = |v: &Variation| {
        of(&own, v.alpha.unwrap_or(own.alpha()), v.radius_m.unwrap_or(own.radius()))
    };
    let bodies: Vec<Body<f64>> = asked.iter().map(body).collect();
    let options = |v: &Variation| RockingOptions {
        scale: v.scale.map_or(1.0, scale),
        vertical: vertical.clone(),
        ..RockingOptions::default()
    };
    let options: Vec<_> = asked.iter().map(options).collect();
    let all = solve_lanes(&bodies, record.dt, &record.accel, &options);
    let peak = |(body, rocking): (&Body<f64>, &rocking::housner::Rocking<f64>)| match rocking
        .outcome
    {
        RockingOutcome::NeverMoved => Some(0.0),
        RockingOutcome::Rocked => Some((largest_magnitude(&rocking.theta) / body.alpha()) as f32),
        _ => None,
    };
    Ok(bodies.iter().zip(&all).map(peak).collect())
}

/// A body like another, of this slenderness (rad) and this R (m).
fn of(like: &Body<f64>, alpha: f64, radius: f64) -> Body<f64> {
    let (share, mass) = (like.mass_share(), like.mass);
    Body {
        mass,
        half_width: radius * alpha.sin(),
        height: radius * alpha.cos(),
        inertia: mass * radius * radius * (1.0 / share - 1.0),
    }
}
