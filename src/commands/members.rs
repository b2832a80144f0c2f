//! Forces in a rigid body's legs, dampers and tendon: as CSV and as JSON.

use dynamics::compare::Match;
use serde::Serialize;
use serde_json::{Map, Value, json};

use dynamics::fem::{Demands, QUANTITIES};
use parameters::answers::MemberHistory;
use rocking::motion::TimedPeak;

/// Largest forces and their times, as JSON.
fn forces(peaks: &[TimedPeak; QUANTITIES.len()]) -> Value {
    let peak = |k: usize| json!({ "value": peaks[k].value, "time_s": peaks[k].time });
    Value::Object(
        QUANTITIES
            .iter()
            .enumerate()
            .map(|(k, name)| (name.to_string(), peak(k)))
            .collect::<Map<_, _>>(),
    )
}

/// The match and the largest forces of the rigid body, and of the one with members.
#[derive(Serialize)]
pub struct MembersReport<'a> {
    #[serde(flatten)]
    matched: &'a Match,
    /// Over all steps: in landings, forces of the springs.
    forces: Value,
    forces_between_landings: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    with_members: Option<With<'a>>,
}

#[derive(Serialize)]
struct With<'a> {
    #[serde(rename = "match")]
    matched: &'a Match,
    forces: Value,
    forces_between_landings: Value,
}

impl<'a> MembersReport<'a> {
    /// Of a rigid body's history, and of one with members if there is one.
    pub fn new(matched: &'a Match, demands: &Demands, with: Option<&'a MemberHistory>) -> Self {
        let with = with.map(|with| With {
            matched: &with.matched,
            forces: forces(&with.demands.peaks),
            forces_between_landings: forces(&with.demands.between),
        });
        let (all, between) = (forces(&demands.peaks), forces(&demands.between));
        Self { matched, forces: all, forces_between_landings: between, with_members: with }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_stand_by_their_names_with_their_times() {
        let mut demands = Demands::default();
        demands.peaks[0] = TimedPeak { value: -2.5, time: 0.013 };
        assert_eq!(forces(&demands.peaks)["base_shear_n"]["value"], -2.5);
        assert_eq!(forces(&demands.peaks)["base_shear_n"]["time_s"], 0.013);
    }
}
