//! `[[structure]]` of a sweep: as in a case file, and a name, a tendon, dampers.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, IntoDeserializer, MapAccess, Visitor, value::MapAccessDeserializer},
};
use toml::Spanned;

use cases::StructureSection;
use rocking::members::{Damper, Members, Tendon};

/// A structure, what the user calls it, and what it has besides.
#[derive(Clone, Debug)]
pub(crate) struct NamedStructure {
    pub name: Option<Spanned<String>>,
    pub members: Members,
    pub section: StructureSection,
}

/// What a section has that a case file's has not.
#[derive(Default)]
struct OwnKeys {
    name: Option<Spanned<String>>,
    tendon: Option<Tendon>,
    damper: Option<Damper>,
}

impl OwnKeys {
    const ALL: [&str; 3] = ["name", "tendon", "damper"];

    /// Put the value of one of these keys aside.
    fn take<'de, A: MapAccess<'de>>(&mut self, key: &str, map: &mut A) -> Result<(), A::Error> {
        match key {
            "tendon" => self.tendon = Some(map.next_value()?),
            "damper" => self.damper = Some(map.next_value()?),
            _ => self.name = Some(map.next_value()?),
        }
        Ok(())
    }
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
        let mut own = OwnKeys::default();
        let rest = OtherKeys { map, own: &mut own };
        let section = StructureSection::deserialize(MapAccessDeserializer::new(rest))?;
        let OwnKeys { name, tendon, damper } = own;
        let members = Members { tendon, damper, friction: None };
        Ok(NamedStructure { name, members, section })
    }
}

/// A map without those, which are put aside.
struct OtherKeys<'a, A> {
    map: A,
    own: &'a mut OwnKeys,
}

/// What becomes of a key: it is read, or it is one of those and comes back with the seed.
struct KeySeed<K>(K);

impl<'de, K: DeserializeSeed<'de>> DeserializeSeed<'de> for KeySeed<K> {
    type Value = Result<K::Value, (K, String)>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        let key = String::deserialize(deserializer)?;
        if OwnKeys::ALL.contains(&key.as_str()) {
            Ok(Err((self.0, key)))
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
                Some(Err((back, key))) => {
                    self.own.take(&key, &mut self.map)?;
                    seed = back;
                }
            }
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}
