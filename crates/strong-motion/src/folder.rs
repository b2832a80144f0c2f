//! The record files of a folder.

use std::path::{Path, PathBuf};

use super::{Record, RecordError};

/// Endings of the files that are taken for records, in any case; of K-NET's and
/// KiK-net's, which have one component each, the horizontal ones at the surface.
const EXTENSIONS: [&str; 16] = [
    "at2", "txt", "csv", "dat", "acc", "asc", "v1", "v2", "v1a", "v2a", "v1c", "v2c", "ns", "ew",
    "ns2", "ew2",
];

impl Record {
    /// The record files of a folder (by their endings, in any case; not of its subfolders), sorted
    /// by name.
    ///
    /// # Errors
    /// The folder cannot be listed, or holds no such file.
    pub fn list_dir(folder: &Path) -> Result<Vec<PathBuf>, RecordError> {
        let unreadable = |error: std::io::Error| RecordError::Unreadable {
            file: super::label(folder),
            reason: super::text::quote(&error.to_string()),
        };
        let mut files = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let ending = path
                .extension()
                .and_then(|ending| ending.to_str())
                .unwrap_or("")
                .to_ascii_lowercase();
            if EXTENSIONS.contains(&ending.as_str()) && !path.is_dir() {
                files.push(path);
            }
        }
        if files.is_empty() {
            return Err(RecordError::NoRecords {
                folder: super::label(folder),
                extensions: EXTENSIONS.join(", "),
            });
        }
        files.sort();
        Ok(files)
    }
}

/// The same, for the Python package.
pub fn list_dir(folder: &Path) -> Result<Vec<PathBuf>, RecordError> {
    Record::list_dir(folder)
}
