//! The record files of a folder.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use super::{Record, RecordError, RecordFormat};

/// Endings of the files that are taken for records, in any case.
fn endings() -> BTreeSet<&'static str> {
    RecordFormat::ALL.into_iter().flat_map(RecordFormat::endings).copied().collect()
}

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
        let (endings, mut files) = (endings(), Vec::new());
        for entry in std::fs::read_dir(folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let ending = path
                .extension()
                .and_then(|ending| ending.to_str())
                .unwrap_or("")
                .to_ascii_lowercase();
            if endings.contains(ending.as_str()) && !path.is_dir() {
                files.push(path);
            }
        }
        if files.is_empty() {
            return Err(RecordError::NoRecords {
                folder: super::label(folder),
                extensions: endings.into_iter().collect::<Vec<_>>().join(", "),
            });
        }
        files.sort();
        Ok(files)
    }
}
