//! Elastic structures in a sweep file: sweeps follow rigid bodies.

use serde::Deserialize;
use toml::{Spanned, Value};

use super::line_of;
use crate::SweepError;

/// What tells an elastic structure, whatever else is there.
#[derive(Deserialize)]
struct ElasticKeys {
    kind: Option<Spanned<Value>>,
    ea_n: Option<Spanned<Value>>,
    ei_nm2: Option<Spanned<Value>>,
}

#[derive(Deserialize)]
struct ElasticKeysFile {
    #[serde(default)]
    structure: Vec<ElasticKeys>,
}

/// Of a sweep file that cannot be read: what is wrong with its first elastic structure, if it has
/// one.
pub(super) fn refusal(path: &str, text: &str) -> Option<SweepError> {
    let file: ElasticKeysFile = toml::from_str(text).ok()?;
    let of_one = |told: &ElasticKeys| {
        let kind = told.kind.as_ref();
        let named = kind.and_then(|kind| kind.get_ref().as_str()).unwrap_or("");
        if let (Some(kind), "pier" | "frame") = (kind, named) {
            return Some((line_of(text, kind), format!("kind = {named:?} is elastic")));
        }
        let stiffness = told.ea_n.as_ref().or(told.ei_nm2.as_ref())?;
        Some((line_of(text, stiffness), "ea_n and ei_nm2 are of an elastic A-frame".to_owned()))
    };
    let (line, what) = file.structure.iter().find_map(of_one)?;
    let message = format!(
        "{what}; sweeps follow rigid bodies alone: give kind = \"block\" or \"aframe\" with its \
         height, width and mass"
    );
    Some(SweepError::Spec { path: path.into(), line, message })
}
