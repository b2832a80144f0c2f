//! Infinity in JSON, which has none: it is written as null.

use serde::{Deserialize, Deserializer};

/// A number; null is infinite.
///
/// # Errors
/// It is neither.
pub fn null_as_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// The same of a number that may be absent, with `default`.
///
/// # Errors
/// As there.
pub fn null_as_lost<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    null_as_infinite(from).map(Some)
}

/// The same of two.
///
/// # Errors
/// As there.
pub fn nulls_as_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    let given: [Option<f64>; 2] = Deserialize::deserialize(from)?;
    Ok(given.map(|value| value.unwrap_or(f64::INFINITY)))
}
