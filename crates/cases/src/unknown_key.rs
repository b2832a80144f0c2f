//! A key that is not known, and the known one that was meant.

/// The key of a mass.
const MASS: &str = "mass_kg";

/// The key of the kind.
const KIND: &str = "kind";
/// Keys of elastic structures, by their kind.
const OF_KINDS: [(&str, &[&str]); 3] = [
    (
        "pier",
        &[
            "height_m",
            "width_m",
            "mass_kg",
            "footing_mass_kg",
            "footing_height_m",
            "footing_inertia_kgm2",
            "ea_n",
            "ga_n",
            "ei_nm2",
            "frequency_hz",
            "damping_ratio",
            "axial_damping_ratio",
            "column_mass_kg",
            "elements",
        ],
    ),
    (
        "frame",
        &[
            "height_m",
            "span_m",
            "footing_width_m",
            "footing_height_m",
            "footing_mass_kg",
            "beam_mass_kg",
            "column_ea_n",
            "column_ei_nm2",
            "column_ga_n",
            "beam_ea_n",
            "beam_ei_nm2",
            "damping_ratio",
            "column_mass_kg",
            "elements",
        ],
    ),
    (
        "aframe",
        &[
            "height_m",
            "width_m",
            "mass_kg",
            "rotational_inertia_kgm2",
            "ea_n",
            "ei_nm2",
            "foot_mass_kg",
            "damping_ratio",
        ],
    ),
];
/// The section of keys that describe a structure, and a key that it has whatever the kind.
const SECTION: &str = "structure";
const HEIGHT: &str = "height_m";
/// Keys of the other sections that could stand in the wrong one.
const OF_SECTIONS: [(&str, &[&str]); 6] = [
    (
        "record",
        &[
            "file",
            "dt_s",
            "units",
            "component",
            "column",
            "baseline",
            "vertical",
            "scale",
            "duration_s",
        ],
    ),
    (
        "tuning",
        &[
            "objective",
            "accuracy",
            "peaks",
            "max_omega_hz",
            "max_settlement_m",
            "mass_ratios_vertical",
            "mass_ratios_horizontal",
            "candidates",
        ],
    ),
    ("friction", &["coefficient"]),
    ("damper", &["c_ns_per_m"]),
    ("tendon", &["stiffness_n_per_m", "pretension_n"]),
    ("program", &["for", "step_s", "integrator", "substeps"]),
];
/// A key of rigid bodies alone.
const RIGID: &str = "total_height_m";

/// What serde says of a key that is not known.
pub(super) struct UnknownKey {
    pub key: String,
    /// The known key that it is like.
    pub near: Option<String>,
    /// All known keys.
    known: Vec<String>,
}

impl UnknownKey {
    /// From "unknown field `x`, expected one of `a`, `b`".
    pub(super) fn of(message: &str) -> Option<Self> {
        let rest = message.strip_prefix("unknown field ")?;
        let mut quoted = rest.split('`').skip(1).step_by(2).map(str::to_string);
        let key = quoted.next()?;
        let known: Vec<String> = quoted.collect();
        // a mass by its weight, where only masses are taken
        let distance = |known: &&String| strsim::damerau_levenshtein(&key, known);
        let masses = known.iter().filter(|known| key.contains("weight") && known.ends_with(MASS));
        let mass = masses.min_by_key(distance);
        let like = known.iter().filter(|known| is_like(&key, known));
        let like = like
            .min_by_key(|known| (!same_words(&key, known), !is_end(&key, known), distance(known)));
        // weight_kN is weight_kn
        let same = known.iter().find(|known| known.eq_ignore_ascii_case(&key));
        let near = same.or(weight_of(&key, &known)).or(mass).or(like).cloned();
        Some(Self { key, near, known })
    }

    /// What to do, after the key.
    pub(super) fn advice(&self) -> String {
        let of_others = kinds_with(&self.key);
        let knows = |key: &str| self.known.iter().any(|known| known == key);
        let in_structure = knows(HEIGHT) || knows(RIGID);
        if in_structure && !of_others.is_empty() {
            let kinds: Vec<String> = of_others.iter().map(|kind| format!("\"{kind}\"")).collect();
            let meant = self.near.as_ref().filter(|_| !knows(RIGID));
            let meant = meant.map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
            return format!("it is a key of kind = {}{meant}", kinds.join(" or "));
        }
        // keys outside of their section
        if !of_others.is_empty() {
            return format!("put it under [{SECTION}]");
        }
        if let Some((section, _)) =
            OF_SECTIONS.iter().find(|(_, keys)| keys.contains(&self.key.as_str()))
        {
            return format!("put it under [{section}]");
        }
        if let Some((section, keys)) = OF_SECTIONS.iter().find(|(section, _)| *section == self.key)
        {
            return format!("it is a section: [{section}], with {}", keys.join(", "));
        }
        match &self.near {
            Some(near) if other_unit(&self.key, near) => {
                format!("give \"{near}\", in that unit")
            }
            Some(near) => format!("did you mean \"{near}\"?"),
            None if self.known.is_empty() => "remove it".into(),
            None => format!("known are {}", self.known.join(", ")),
        }
    }
}

/// The weight that is meant by a mass in newtons: weight_kn, of mass_kN.
fn weight_of<'a>(key: &str, known: &'a [String]) -> Option<&'a String> {
    let unit = key.to_lowercase().strip_prefix("mass_")?.to_owned();
    known.iter().find(|known| known.strip_prefix("weight_") == Some(&*unit))
}

/// Kinds of elastic structures that have a key.
fn kinds_with(key: &str) -> Vec<&'static str> {
    let has = |(_, keys): &&(&str, &[&str])| key == KIND || keys.contains(&key);
    OF_KINDS.iter().filter(has).map(|(kind, _)| *kind).collect()
}

/// Whether a key is a known one in another unit: mass_t where mass_kg is known.
fn other_unit(key: &str, known: &str) -> bool {
    let quantity = |key: &str| key.rsplit_once('_').map(|(quantity, _)| quantity.to_owned());
    let unit = |key: &str| key.rsplit_once('_').map(|(_, unit)| unit.to_owned());
    let units = ["t", "kn", "n", "lb", "kip", "mm", "cm", "ft", "in", "mn", "knm2", "mnm2", "g"];
    quantity(key) == quantity(known) && unit(key).is_some_and(|unit| units.contains(&&*unit))
}

/// Whether the words of one are those of the other, or begin as they do: foot_mass_kg,
/// footing_mass_kg.
fn same_words(key: &str, known: &str) -> bool {
    let words = |text: &str| text.split('_').map(str::to_owned).collect::<Vec<_>>();
    let (key, known) = (words(key), words(known));
    let same = |(a, b): (&String, &String)| a.starts_with(b.as_str()) || b.starts_with(a.as_str());
    key.len() == known.len() && key.iter().zip(&known).all(same)
}

/// Whether one is an end of the other.
fn is_end(key: &str, known: &str) -> bool {
    let end = |long: &str, short: &str| long.starts_with(short) || long.ends_with(short);
    end(known, key) || end(key, known)
}

/// Whether one could be meant by the other: an end of it, or at most half of its letters differ.
fn is_like(key: &str, known: &str) -> bool {
    is_end(key, known) || 2 * strsim::damerau_levenshtein(key, known) <= key.len().min(known.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advice(key: &str) -> String {
        let known = "expected one of `height_m`, `width_m`, `column_mass_kg`, `ei_nm2`, `material`";
        UnknownKey::of(&format!("unknown field `{key}`, {known}")).unwrap().advice()
    }

    #[test]
    fn the_key_that_is_like_it_is_named_and_else_all() {
        for (key, near) in [
            ("widht_m", "width_m"),
            ("height", "height_m"),
            ("weight_kn", "column_mass_kg"),
            ("ei", "ei_nm2"),
            ("column_weight_kn", "column_mass_kg"),
        ] {
            assert_eq!(advice(key), format!("did you mean \"{near}\"?"), "{key}");
        }
        for key in ["mass_kN", "weight_kN", "Weight_KN"] {
            let known = "expected one of `mass_kg`, `weight_kn`, `width_m`";
            let weight = UnknownKey::of(&format!("unknown field `{key}`, {known}"));
            assert_eq!(weight.unwrap().advice(), "did you mean \"weight_kn\"?", "{key}");
        }
        let mass = "it is a key of kind = \"pier\" or \"aframe\"; did you mean \"column_mass_kg\"?";
        assert_eq!(advice("mass_kg"), mass);
        let known = "known are height_m, width_m, column_mass_kg, ei_nm2, material";
        assert_eq!(advice("colour"), known);
        // an end before letters that differ
        let pier = "unknown field `footing_width_m`, expected one of `footing_height_m`, `width_m`";
        assert_eq!(UnknownKey::of(pier).unwrap().near.as_deref(), Some("width_m"));
    }

    #[test]
    fn keys_of_kinds_are_those_that_are_read() {
        for (kind, keys) in OF_KINDS {
            let asked = format!("kind = \"{kind}\"\n\"\" = 0");
            let error = toml::from_str::<frames::structure::ElasticStructure>(&asked).unwrap_err();
            let unknown = UnknownKey::of(error.message().lines().next().unwrap()).unwrap();
            assert_eq!(unknown.known, keys);
        }
    }

    #[test]
    fn keys_of_sections_are_those_that_are_read() {
        fn known<T: serde::de::DeserializeOwned>() -> Vec<String> {
            let error = toml::from_str::<T>("\"\" = 0").err().unwrap();
            UnknownKey::of(error.message().lines().next().unwrap()).unwrap().known
        }
        let of = |section: &str| OF_SECTIONS.iter().find(|(name, _)| *name == section).unwrap().1;
        assert_eq!(known::<super::super::record::RecordSection>(), of("record"));
        assert_eq!(known::<super::super::Tuning>(), of("tuning"));
        assert_eq!(known::<super::super::program::ProgramSection>(), of("program"));
        assert_eq!(known::<rocking::members::Friction>(), of("friction"));
        assert_eq!(known::<rocking::members::Damper>(), of("damper"));
        assert_eq!(known::<rocking::members::Tendon>(), of("tendon"));
    }

    #[test]
    fn a_key_of_another_kind_is_told_of() {
        let block = "unknown field `column_mass_kg`, expected one of `total_height_m`, `mass_kg`";
        let kinds = "it is a key of kind = \"pier\" or \"frame\"";
        assert_eq!(UnknownKey::of(block).unwrap().advice(), kinds);
        let pier = "unknown field `foot_mass_kg`, expected one of `height_m`, `mass_kg`, \
            `footing_mass_kg`, `column_mass_kg`";
        let advice = "it is a key of kind = \"aframe\"; did you mean \"footing_mass_kg\"?";
        assert_eq!(UnknownKey::of(pier).unwrap().advice(), advice);
    }

    #[test]
    fn a_key_in_another_unit_and_one_outside_its_section_are_told() {
        for (key, advice) in [
            ("column_mass_t", "give \"column_mass_kg\", in that unit"),
            ("height_mm", "give \"height_m\", in that unit"),
        ] {
            assert_eq!(self::advice(key), advice);
        }
        let outside = "unknown field `height_m`, expected one of `structure`, `record`";
        assert_eq!(UnknownKey::of(outside).unwrap().advice(), "put it under [structure]");
        let kind = "unknown field `kind`, expected one of `structure`, `record`";
        assert_eq!(UnknownKey::of(kind).unwrap().advice(), "put it under [structure]");
        for known in ["`structure`, `record`", "`height_m`, `width_m`", "`objective`, `accuracy`"] {
            let scale = format!("unknown field `scale`, expected one of {known}");
            assert_eq!(UnknownKey::of(&scale).unwrap().advice(), "put it under [record]");
        }
        let friction = "unknown field `friction`, expected one of `height_m`, `width_m`";
        let advice = "it is a section: [friction], with coefficient";
        assert_eq!(UnknownKey::of(friction).unwrap().advice(), advice);
        let mass = "unknown field `mass_kg`, expected one of `file`, `scale`";
        assert_eq!(UnknownKey::of(mass).unwrap().advice(), "put it under [structure]");
    }

    #[test]
    fn other_messages_are_of_no_key() {
        assert!(UnknownKey::of("invalid type: string").is_none());
    }
}
