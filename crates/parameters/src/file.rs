//! What files of a rigid body and of an elastic structure have in common: their text and their
//! schema.

use std::path::Path;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use super::{ParametersError, SCHEMA};
use files::message::one_line;

/// The one key that is read of a newer file.
#[derive(Deserialize)]
struct Version {
    #[serde(default = "first")]
    schema: u32,
}

/// The schema of files that do not say.
pub(crate) fn first() -> u32 {
    1
}

/// A file's name for messages and its text.
///
/// # Errors
/// It cannot be read.
pub(crate) fn read(path: &Path) -> Result<(String, String), ParametersError> {
    let name = path.display().to_string();
    match files::input::text(path) {
        Ok(text) => Ok((name, text)),
        Err(source) => Err(ParametersError::Read { path: name, source }),
    }
}

/// That a file is not of a newer program, before its keys are read: it may have some that this
/// program does not know.
///
/// # Errors
/// It is of a newer program.
pub(crate) fn known(path: &str, text: &str) -> Result<(), ParametersError> {
    match serde_json::from_str(text) {
        Ok(Version { schema }) if schema > SCHEMA => {
            Err(ParametersError::Schema { path: path.to_string(), schema })
        }
        _ => Ok(()),
    }
}

/// A file's text as what it is of; `path` names it in messages.
///
/// # Errors
/// No JSON, a key missing or not known.
pub(crate) fn parse<T: DeserializeOwned>(path: &str, text: &str) -> Result<T, ParametersError> {
    serde_json::from_str(text).map_err(|e| ParametersError::Parse {
        path: path.to_string(),
        line: e.line(),
        message: one_line(e.to_string().split(" at line").next().unwrap_or_default()),
    })
}

/// The text of a file.
pub(crate) fn to_json(parameters: &impl Serialize) -> String {
    // plain numbers and strings always serialise
    serde_json::to_string_pretty(parameters).unwrap_or_default() + "\n"
}
