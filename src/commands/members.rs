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
    /// What match and forces are of, where it has members.
    #[serde(skip_serializing_if = "Option::is_none")]
    forces_are_of: Option<&'static str>,
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
        let forces_are_of = with.as_ref().map(|_| "the body without its members");
        Self {
            matched,
            forces_are_of,
            forces: all,
            forces_between_landings: between,
            with_members: with,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::spring::{Design, Springs};
    use parameters::answers::compare_models;
    use rocking::{
        members::{Damper, Members},
        structure::Structure,
    };
    use strong_motion::Record;

    #[test]
    fn forces_stand_by_their_names_with_their_times() {
        let mut demands = Demands::default();
        demands.peaks[0] = TimedPeak { value: -2.5, time: 0.013 };
        assert_eq!(forces(&demands.peaks)["base_shear_n"]["value"], -2.5);
        assert_eq!(forces(&demands.peaks)["base_shear_n"]["time_s"], 0.013);
    }

    /// What stands at the top is of the bare body: said where there is another.
    #[test]
    fn forces_of_a_body_with_members_say_that_those_at_the_top_are_not_its() {
        let body = Structure::a_frame(9.0, 2.1, 120e3).unwrap().body::<f64>();
        let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(120e3);
        let record = Record::new("rest", 0.01, vec![0.0; 10]).unwrap();
        let of = |members: &Members| {
            let both = compare_models(&body, body.restitution(), &springs, members, &record);
            let report = MembersReport::new(&both.matched, &both.demands, both.with.as_ref());
            serde_json::to_value(report).unwrap()
        };
        assert!(of(&Members::default()).get("forces_are_of").is_none());
        let damper = Some(Damper { c: 1e5 });
        let with = of(&Members { damper, ..Members::default() });
        assert_eq!(with["forces_are_of"], "the body without its members");
        assert!(with["with_members"]["forces"]["damper_left_n"].is_object());
    }
}
