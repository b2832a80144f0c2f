//! The section `[structure]` of a case file: kind, lengths, mass, in SI or with the unit of the
//! drawing in the key's name.
//!
//! | quantity | keys | in SI |
//! |---|---|---|
//! | height of the centre of mass | `height_m`, `_ft`, `_in` | m |
//! | a block's whole height, twice that | `total_height_m`, `_ft`, `_in` | m |
//! | distance between the feet | `width_m`, `_ft`, `_in` | m |
//! | mass, or the weight m g | `mass_kg`, `_t`, `_lb`; `weight_n`, `_kn`, `_lb`, `_kip` | kg |

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, Error, MapAccess, Visitor},
};

use super::CaseError;
use rocking::{
    scalar::GRAVITY,
    structure::{Kind, LEAST_INERTIA, Structure},
};

/// The international foot and inch (m), the avoirdupois pound (kg): exact by definition (1959).
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;

/// What a key gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KeyQuantity {
    Height,
    TotalHeight,
    Width,
    Mass,
}

impl KeyQuantity {
    /// What may not be given beside it.
    fn same(self) -> &'static [Self] {
        match self {
            Self::Height | Self::TotalHeight => &[Self::Height, Self::TotalHeight],
            Self::Width => &[Self::Width],
            Self::Mass => &[Self::Mass],
        }
    }
}

/// Keys with a number of a unit: what it gives, in how many SI units one of it is.
const QUANTITIES: [(&str, KeyQuantity, f64); 16] = [
    ("height_m", KeyQuantity::Height, 1.0),
    ("height_ft", KeyQuantity::Height, FOOT),
    ("height_in", KeyQuantity::Height, INCH),
    ("total_height_m", KeyQuantity::TotalHeight, 1.0),
    ("total_height_ft", KeyQuantity::TotalHeight, FOOT),
    ("total_height_in", KeyQuantity::TotalHeight, INCH),
    ("width_m", KeyQuantity::Width, 1.0),
    ("width_ft", KeyQuantity::Width, FOOT),
    ("width_in", KeyQuantity::Width, INCH),
    ("mass_kg", KeyQuantity::Mass, 1.0),
    ("mass_t", KeyQuantity::Mass, 1e3),
    ("mass_lb", KeyQuantity::Mass, POUND),
    ("weight_n", KeyQuantity::Mass, 1.0 / GRAVITY),
    ("weight_kn", KeyQuantity::Mass, 1e3 / GRAVITY),
    // the weight of a pound of mass is a pound of force
    ("weight_lb", KeyQuantity::Mass, POUND),
    ("weight_kip", KeyQuantity::Mass, 1e3 * POUND),
];

/// All keys, for the message about one that is none of them.
const KEYS: [&str; 4 + QUANTITIES.len()] = {
    let mut keys = [""; 4 + QUANTITIES.len()];
    [keys[0], keys[1], keys[2], keys[3]] =
        ["kind", "rotational_inertia_kgm2", "restitution", "restitution_ratio"];
    let mut i = 0;
    while i < QUANTITIES.len() {
        keys[4 + i] = QUANTITIES[i].0;
        i += 1;
    }
    keys
};

/// A structure as a user describes it, in SI, unchecked.
#[derive(Clone, Debug)]
pub struct StructureSection {
    pub kind: Kind,
    /// Height of the centre of mass (m).
    pub height_m: f64,
    /// Distance between the feet (m).
    pub width_m: f64,
    pub mass_kg: f64,
    /// About the centre of mass; by `kind` unless given.
    pub rotational_inertia_kgm2: Option<f64>,
    /// Velocity restitution e; by equation 2 unless given.
    pub restitution: Option<f64>,
    /// Factor on equation 2's e.
    pub restitution_ratio: Option<f64>,
    /// The key that gave the height.
    pub height_key: Option<&'static str>,
}

/// What a case file gave, where the program would take something by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GivenKeys {
    /// The key that gave the height, with its unit; none if no case file did.
    pub height: Option<&'static str>,
    /// The restitution, or a factor on equation 2's.
    pub restitution: bool,
    /// The rotational inertia.
    pub inertia: bool,
}

/// How many metres one unit of a key of lengths is; 1 for a key without a unit.
pub(super) fn unit_of(key: &str) -> f64 {
    QUANTITIES.iter().find(|(known, ..)| *known == key).map_or(1.0, |(.., unit)| *unit)
}

impl<'de> Deserialize<'de> for StructureSection {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

/// What the key of a whole height begins with.
const TOTAL: &str = "total_height";

/// That a key of a whole height is not an A-frame's.
fn for_a_block(key: &str) -> String {
    format!(
        "{key} is for a block, whose centre of mass is half way up; give the height of the \
            A-frame's centre of mass, height_m"
    )
}

struct Keys;

/// One of [`KEYS`]; refused as it is read, so that the message tells its line.
struct StructureKey(&'static str);

impl<'de> Deserialize<'de> for StructureKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let key = String::deserialize(deserializer)?;
        let known = KEYS.iter().find(|known| **known == key);
        known.map(|known| Self(known)).ok_or_else(|| D::Error::unknown_field(&key, &KEYS))
    }
}

/// A number, unless its key says again what another has said.
struct Number {
    key: &'static str,
    clash: Option<String>,
}

/// Keys whose numbers are checked as they are, by [`Structure::checked`], which knows no other.
const CHECKED_LATER: [&str; 3] = ["height_m", "width_m", "mass_kg"];

impl<'de> DeserializeSeed<'de> for Number {
    type Value = f64;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        match self.clash {
            Some(clash) => Err(D::Error::custom(clash)),
            None => {
                let value = f64::deserialize(deserializer)?;
                let key = self.key;
                if CHECKED_LATER.contains(&key) || value.is_finite() && value > 0.0 {
                    return Ok(value);
                }
                Err(D::Error::custom(format!(
                    "{key} is {value:?}; give a finite number greater than zero"
                )))
            }
        }
    }
}

impl<'de> Visitor<'de> for Keys {
    type Value = StructureSection;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a section [structure] with kind, height_m, width_m and mass_kg")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<StructureSection, A::Error> {
        let mut kind = None;
        let (mut inertia, mut restitution, mut ratio) = (None, None, None);
        // each with the key that gave it
        let mut given: [Option<(&'static str, f64)>; 4] = [None; 4];
        while let Some(StructureKey(key)) = map.next_key()? {
            match key {
                "kind" => kind = Some(map.next_value()?),
                "rotational_inertia_kgm2" => inertia = Some(map.next_value()?),
                "restitution" => restitution = Some(map.next_value()?),
                "restitution_ratio" => ratio = Some(map.next_value()?),
                _ => {
                    let Some(&(key, quantity, unit)) =
                        QUANTITIES.iter().find(|(known, ..)| *known == key)
                    else {
                        continue;
                    };
                    let same = quantity.same().iter().find_map(|other| given[*other as usize]);
                    let clash = same.map(|(first, _)| {
                        let total = [first, key].into_iter().find(|key| key.starts_with(TOTAL));
                        match total.filter(|_| kind == Some(Kind::AFrame)) {
                            Some(total) => for_a_block(total),
                            None => {
                                format!("{first} and {key} give the same quantity; leave one out")
                            }
                        }
                    });
                    given[quantity as usize] =
                        Some((key, unit * map.next_value_seed(Number { key, clash })?));
                }
            }
        }
        let kind = kind.ok_or_else(|| A::Error::missing_field("kind"))?;
        let [height, total, width, mass] = given;
        let height_m = match (height, total) {
            (_, Some((key, _))) if kind == Kind::AFrame => {
                return Err(A::Error::custom(for_a_block(key)));
            }
            (Some((_, height)), _) => height,
            (None, Some((_, total))) => 0.5 * total,
            (None, None) => return Err(A::Error::missing_field("height_m")),
        };
        let need = |given: Option<(&str, f64)>, name| {
            given.map(|(_, x)| x).ok_or_else(|| A::Error::missing_field(name))
        };
        Ok(StructureSection {
            kind,
            height_m,
            width_m: need(width, "width_m")?,
            mass_kg: need(mass, "mass_kg")?,
            rotational_inertia_kgm2: inertia,
            restitution,
            restitution_ratio: ratio,
            height_key: height.or(total).map(|(key, _)| key),
        })
    }
}

impl StructureSection {
    /// What was given, and what not.
    pub(super) fn given(&self) -> GivenKeys {
        GivenKeys {
            height: self.height_key,
            restitution: self.restitution.is_some() || self.restitution_ratio.is_some(),
            inertia: self.rotational_inertia_kgm2.is_some(),
        }
    }

    /// The structure and its velocity restitution; `path` names the file in messages.
    ///
    /// # Errors
    /// Numbers that cannot rock, or a restitution that is no velocity ratio.
    pub fn checked(&self, path: &str) -> Result<(Structure, f64), CaseError> {
        let wrap = |source| CaseError::Structure { path: path.into(), source };
        let mut structure = Structure {
            kind: self.kind,
            height_m: self.height_m,
            width_m: self.width_m,
            mass_kg: self.mass_kg,
            rotational_inertia_kgm2: 0.0,
        };
        let m_r2 = self.mass_kg * (self.height_m.powi(2) + self.width_m.powi(2) / 4.0);
        structure.rotational_inertia_kgm2 =
            self.rotational_inertia_kgm2.unwrap_or(match self.kind {
                Kind::AFrame => LEAST_INERTIA * m_r2,
                Kind::Block => m_r2 / 3.0,
            });
        let structure = structure.checked().map_err(wrap)?;
        let housner = structure.body::<f64>().restitution();
        let value = |key, value: f64, remedy| CaseError::Value {
            path: path.into(),
            key,
            value: format!("{value:?}"),
            remedy,
        };
        let restitution = match (self.restitution, self.restitution_ratio) {
            (None, None) => housner,
            (Some(e), None) => e,
            (None, Some(ratio)) => ratio * housner,
            (Some(e), Some(_)) => {
                return Err(value(
                    "structure.restitution",
                    e,
                    "give restitution or restitution_ratio, not both",
                ));
            }
        };
        if !(0.0..=1.0).contains(&restitution) {
            return Err(value(
                "structure.restitution",
                restitution,
                "a velocity ratio lies between 0 and 1",
            ));
        }
        Ok((structure, restitution))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Case;

    fn structure(section: &str) -> Result<rocking::structure::Structure, String> {
        let text = format!("[structure]\n{section}");
        Case::parse("case.toml", &text).map(|case| case.structure).map_err(|e| e.to_string())
    }

    /// The paper's frame as its drawing has it, 200 ft by 40 ft and 1500 kip; foot, inch and pound
    /// are exact, so is the comparison but for rounding.
    #[test]
    fn units_of_a_drawing_are_those_of_the_definitions() {
        let si = structure(
            "kind = \"aframe\"\nheight_m = 60.96\nwidth_m = 12.192\nmass_kg = 680388.555\n",
        )
        .unwrap();
        for given in [
            "height_ft = 200.0\nwidth_in = 480\nweight_kip = 1500\n",
            "height_in = 2400\nwidth_ft = 40\nmass_lb = 1.5e6\n",
            "height_m = 60.96\nwidth_m = 12.192\nweight_kn = 6674.61172455\n",
            "height_m = 60.96\nwidth_m = 12.192\nmass_t = 680.388555\n",
        ] {
            let found = structure(&format!("kind = \"aframe\"\n{given}")).unwrap();
            let pairs = [
                (found.height_m, si.height_m),
                (found.width_m, si.width_m),
                (found.mass_kg, si.mass_kg),
            ];
            assert!(pairs.iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{given}: {found:?}");
        }
    }

    #[test]
    fn a_number_below_zero_is_refused_by_the_key_that_was_written() {
        let rest = "width_m = 0.5\nmass_kg = 300.0\n";
        for (line, said) in [
            ("total_height_m = -1.7", "total_height_m is -1.7"),
            ("total_height_in = 0.0", "total_height_in is 0.0"),
            ("height_ft = -3", "height_ft is -3.0"),
            ("height_in = nan", "height_in is NaN"),
        ] {
            let message = structure(&format!("kind = \"block\"\n{line}\n{rest}")).unwrap_err();
            let whole =
                format!("case.toml, line 3: {said}; give a finite number greater than zero");
            assert_eq!(message, whole);
        }
        let message = structure("kind = \"block\"\nheight_m = -1.7\nwidth_m = 1\nmass_t = 1\n");
        assert!(message.unwrap_err().contains("line 3: structure: height_m is -1.7; give a"));
    }

    #[test]
    fn a_cabinet_is_given_by_its_whole_height() {
        let whole =
            structure("kind = \"block\"\ntotal_height_in = 80\nwidth_in = 24\nweight_lb = 900\n")
                .unwrap();
        assert!(
            (whole.height_m - 1.016).abs() < 1e-12 && (whole.mass_kg - 408.233133).abs() < 1e-9,
            "{whole:?}"
        );
    }

    #[test]
    fn what_is_given_twice_or_not_at_all_is_named() {
        let said = |section: &str| structure(section).unwrap_err();
        let twice = said(
            "kind = \"block\"\nheight_m = 1.0\ntotal_height_m = 2.0\nwidth_m = 0.5\nmass_kg = \
                1.0\n",
        );
        assert_eq!(
            twice,
            "case.toml, line 4: height_m and total_height_m give the same quantity; leave one out"
        );
        let twice = said(
            "kind = \"block\"\nheight_m = 1.0\nheight_ft = 3.0\nwidth_m = 0.5\nmass_kg = 1.0\n",
        );
        assert_eq!(
            twice,
            "case.toml, line 3: height_ft and height_m give the same quantity; leave one out"
        );
        let frame = said("kind = \"aframe\"\ntotal_height_m = 2.0\nwidth_m = 0.5\nmass_kg = 1.0\n");
        assert!(frame.contains("total_height_m is for a block"), "{frame}");
        let both = said(
            "kind = \"aframe\"\nheight_m = 1.0\ntotal_height_m = 2.0\nwidth_m = 0.5\nmass_kg = \
                1.0\n",
        );
        assert!(both.contains("line 4: total_height_m is for a block"), "{both}");
        let near = said("kind = \"block\"\nheight_m = 1.0\nwidht_m = 0.5\nmass_kg = 1.0\n");
        assert_eq!(near, "case.toml, line 4: unknown key \"widht_m\"; did you mean \"width_m\"?");
        let none = said("kind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\n");
        assert!(none.contains("[structure] lacks mass_kg: add"), "{none}");
    }
}
