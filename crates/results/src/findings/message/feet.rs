//! The words of where feet end that landed elsewhere than they stood.

use super::s;
use crate::findings::Finding;
use files::message::quantity;

/// Where feet stand, beside their place and each other (m).
fn place(aside_m: Option<f64>, apart_m: Option<f64>) -> String {
    let aside = aside_m.map(|x| format!("{} beside their place", quantity(x.abs(), "m")));
    let apart = apart_m.map(|x| {
        let way = if x > 0.0 { "further apart" } else { "closer together" };
        format!("{} {way}", quantity(x.abs(), "m"))
    });
    aside.into_iter().chain(apart).collect::<Vec<_>>().join(" and ")
}

fn doubt(predictable: bool) -> &'static str {
    if predictable { "" } else { " (not predictable)" }
}

/// Where feet end, for the answer's sentence; none of other findings.
pub fn feet_end(finding: &Finding) -> Option<String> {
    let Finding::FeetMoved { aside_m, apart_m, rocks_on_from_s, predictable } = *finding else {
        return None;
    };
    let place = place(aside_m, apart_m).replace("beside their place", "aside");
    let does = if rocks_on_from_s.is_some() { "it rocks on, its feet" } else { "its feet end" };
    Some(format!("{does} {place}{}", doubt(predictable)))
}

impl Finding {
    /// Where feet end, as a warning.
    pub(super) fn feet(&self) -> Option<String> {
        let Self::FeetMoved { aside_m, apart_m, rocks_on_from_s, predictable } = *self else {
            return None;
        };
        let place = place(aside_m, apart_m);
        let first = if apart_m.is_some() { " than at first" } else { "" };
        let doubt = doubt(predictable);
        let bent = if apart_m.is_some() { ": friction keeps the structure bent" } else { "" };
        Some(match rocks_on_from_s {
            Some(time) => format!(
                "the structure still rocks at the end; at t = {}, when all feet last press, they \
                    stand {place}{first}{doubt}{bent}",
                s(time)
            ),
            None => format!("at the end the feet stand {place}{first}{doubt}{bent}"),
        })
    }
}
