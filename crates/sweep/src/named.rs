//! `[[structure]]` of a sweep: as in a case file, and a name.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, IntoDeserializer, MapAccess, Visitor, value::MapAccessDeserializer},
};
use toml::Spanned;

use cases::StructureSection;

/// The key that a case file's section does not have.
const NAME: &str = "name";

/// A structure, and what the user calls it.
#[derive(Clone, Debug)]
pub(crate) struct NamedStructure {
    pub name: Option<Spanned<String>>,
    pub section: StructureSection,
}

impl<'de> Deserialize<'de> for NamedStructure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(NamedVisitor)
    }
}

struct NamedVisitor;

impl<'de> Visitor<'de> for NamedVisitor {
    type Value = NamedStructure;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a section [[structure]] with kind, height_m, width_m and mass_kg")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<NamedStructure, A::Error> {
        let mut name = None;
        let rest = OtherKeys { map, name: &mut name };
        let section = StructureSection::deserialize(MapAccessDeserializer::new(rest))?;
        Ok(NamedStructure { name, section })
    }
}

/// A map without its name, which is put aside.
struct OtherKeys<'a, A> {
    map: A,
    name: &'a mut Option<Spanned<String>>,
}

/// What becomes of a key: it is read, or it is the name and the seed is given back.
struct KeySeed<K>(K);

impl<'de, K: DeserializeSeed<'de>> DeserializeSeed<'de> for KeySeed<K> {
    type Value = Result<K::Value, K>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        let key = String::deserialize(deserializer)?;
        if key == NAME {
            Ok(Err(self.0))
        } else {
            self.0.deserialize(key.into_deserializer()).map(Ok)
        }
    }
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for OtherKeys<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        mut seed: K,
    ) -> Result<Option<K::Value>, A::Error> {
        loop {
            match self.map.next_key_seed(KeySeed(seed))? {
                None => return Ok(None),
                Some(Ok(key)) => return Ok(Some(key)),
                Some(Err(back)) => {
                    *self.name = Some(self.map.next_value()?);
                    seed = back;
                }
            }
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}
