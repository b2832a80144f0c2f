//! The files of a run as texts, before anything is written.

use std::path::Path;

use crate::{FolderError, place::write_file};

/// Text files of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunTexts {
    /// Name in the folder, with `/`, and what the file holds.
    pub files: Vec<(String, String)>,
    /// Decks that are left out, with the reason.
    pub left_out: Vec<String>,
}

impl RunTexts {
    /// Of tables by name.
    pub(crate) fn of(tables: impl IntoIterator<Item = (&'static str, String)>) -> Self {
        let files = tables.into_iter().map(|(name, text)| (name.into(), text)).collect();
        Self { files, left_out: Vec::new() }
    }

    /// Both.
    pub(crate) fn and(mut self, other: Self) -> Self {
        self.files.extend(other.files);
        self.left_out.extend(other.left_out);
        self
    }

    /// Write them into a folder, which is made.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), FolderError> {
        self.files
            .iter()
            .try_for_each(|(name, text)| write_file(&folder.join(name), text.as_bytes()))
    }
}
