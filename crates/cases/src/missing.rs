//! What a case file lacks, all of it at once, each section with its keys.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::{CaseError, structure::StructureSection};
use rocking::members::{Damper, Friction, Tendon};

/// Keys of `[record]` that tell of its file.
const OF_FILE: [&str; 6] = ["dt_s", "units", "component", "column", "baseline", "vertical"];

/// Refuse a text that can be read and yet lacks something.
pub(super) fn none(path: &str, text: &str) -> Result<(), CaseError> {
    let file = text.parse::<Table>().unwrap_or_default();
    match sections(&file) {
        Some((sections, shape)) => Err(CaseError::Missing { path: path.into(), sections, shape }),
        None => Ok(()),
    }
}

/// The key in serde's "missing field `x`".
pub(super) fn is_field(message: &str) -> Option<&str> {
    message.strip_prefix("missing field `")?.split('`').next()
}

/// Whether no kind of structure is given.
pub(super) fn no_kind(file: &Table) -> bool {
    file.get("structure")
        .and_then(Value::as_table)
        .is_some_and(|structure| !structure.contains_key("kind"))
}

/// "[structure] lacks width_m, mass_kg; [record] lacks file", and the shape that `tune init` is to
/// be asked for; nothing if nothing is missing.
pub(super) fn sections(file: &Table) -> Option<(String, &'static str)> {
    let section = |name: &str| file.get(name).and_then(Value::as_table);
    let empty = Table::new();
    let structure = section("structure").unwrap_or(&empty);
    let (keys, shape) = of_structure(structure);
    let mut all = vec![("structure", keys)];
    all.extend(section("damper").map(|damper| ("damper", lacks::<Damper>(damper))));
    all.extend(section("tendon").map(|tendon| ("tendon", lacks::<Tendon>(tendon))));
    all.extend(section("friction").map(|friction| ("friction", lacks::<Friction>(friction))));
    if let Some(record) = section("record").filter(|record| !record.contains_key("file")) {
        let told: Vec<&str> = OF_FILE.into_iter().filter(|key| record.contains_key(*key)).collect();
        let key = format!("file, for {}", told.join(", "));
        all.extend((!told.is_empty()).then(|| ("record", vec![key])));
    }
    let all = all.iter().filter(|(_, keys)| !keys.is_empty());
    let all: Vec<String> =
        all.map(|(name, keys)| format!("[{name}] lacks {}", keys.join(", "))).collect();
    (!all.is_empty()).then(|| (all.join("; "), shape))
}

/// What `[structure]` lacks, and the shape that it is.
fn of_structure(structure: &Table) -> (Vec<String>, &'static str) {
    let mut keys = Vec::new();
    if !structure.contains_key("kind") {
        keys.push("kind (aframe, block, pier or frame)".to_owned());
        if structure.is_empty() {
            keys.push("its sizes and its mass".to_owned());
        }
        return (keys, "");
    }
    let kind = structure.get("kind").and_then(Value::as_str).unwrap_or_default().to_owned();
    let (found, shape) = match kind.as_str() {
        "block" => (lacks::<StructureSection>(structure), " block"),
        _ if super::elastic::is_elastic(structure) => elastic(structure, &kind),
        _ => (lacks::<StructureSection>(structure), ""),
    };
    let whole = |key: String| {
        if (key.as_str(), shape) == ("height_m", " block") { TOTAL.to_owned() } else { key }
    };
    (found.into_iter().map(whole).collect(), shape)
}

/// Of a block, the first of them is what is measured.
const TOTAL: &str = "total_height_m (or height_m, of the centre of mass)";

fn elastic(structure: &Table, kind: &str) -> (Vec<String>, &'static str) {
    let mut keys = lacks::<frames::structure::ElasticStructure>(structure);
    let bends = ["frequency_hz", "ei_nm2"].iter().any(|key| structure.contains_key(*key));
    if kind == "pier" && !bends {
        keys.push("frequency_hz (or ei_nm2)".to_owned());
    }
    let shape = match kind {
        "pier" => " pier",
        "frame" => " frame",
        _ => " elastic-aframe",
    };
    (keys, shape)
}

/// Keys without which a section cannot be read: serde names one, which is then put there, until it
/// names none.
fn lacks<T: DeserializeOwned>(section: &Table) -> Vec<String> {
    let mut section = section.clone();
    let mut keys = Vec::new();
    while let Err(error) = Value::Table(section.clone()).try_into::<T>() {
        match is_field(error.message()) {
            Some(key) if !section.contains_key(key) => {
                keys.push(key.to_owned());
                section.insert(key.to_owned(), Value::Float(1.0));
            }
            _ => break,
        }
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str) -> String {
        sections(&text.parse().unwrap()).map_or_else(String::new, |(sections, _)| sections)
    }

    #[test]
    fn all_sections_are_told_at_once() {
        assert_eq!(
            said(
                "[structure]\nkind = 'aframe'\nheight_m = 1\n[damper]\n[tendon]\npretension_n = 1\n\
                    [record]\ndt_s = 0.01\n"
            ),
            "[structure] lacks width_m, mass_kg; [damper] lacks c_ns_per_m; [tendon] lacks \
                stiffness_n_per_m; [record] lacks file, for dt_s"
        );
        assert_eq!(
            said(""),
            "[structure] lacks kind (aframe, block, pier or frame), its sizes and its mass"
        );
        assert_eq!(
            said(
                "[structure]\nkind = 'block'\ntotal_height_ft = 6\nwidth_in = 24\nweight_lb = 900\n"
            ),
            ""
        );
    }

    /// What each kind cannot be without, as docs/elastic.md has it.
    #[test]
    fn each_kind_has_its_own_keys() {
        for (kind, keys) in [
            (
                "kind = 'block'\n",
                "total_height_m (or height_m, of the centre of mass), width_m, mass_kg",
            ),
            (
                "kind = 'pier'\n",
                "height_m, width_m, mass_kg, footing_mass_kg, footing_height_m, damping_ratio, \
                    frequency_hz (or ei_nm2)",
            ),
            (
                "kind = 'aframe'\nea_n = 1\n",
                "height_m, width_m, mass_kg, ei_nm2, foot_mass_kg, damping_ratio",
            ),
            (
                "kind = 'frame'\n",
                "height_m, span_m, footing_width_m, footing_height_m, footing_mass_kg, \
                    beam_mass_kg, column_ea_n, column_ei_nm2, beam_ea_n, beam_ei_nm2, \
                    damping_ratio",
            ),
        ] {
            assert_eq!(said(&format!("[structure]\n{kind}")), format!("[structure] lacks {keys}"));
        }
    }
}
