//! Where results go: looked at before the work, so that no work is lost and nothing is half written.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    time::SystemTime,
};

use super::{CommandError, write_file};
use crate::record::fnv1a;

/// Whether a folder for results can be made or written into.
pub(super) fn check_folder(path: &Path) -> Result<(), CommandError> {
    let name = || path.display().to_string();
    let there = path.ancestors().find(|p| p.as_os_str().is_empty() || p.symlink_metadata().is_ok());
    let there = there.filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !there.is_dir() {
        return Err(CommandError::NotAFolder { path: there.display().to_string() });
    }
    probe(there).map_err(|source| CommandError::Write { path: name(), source })
}

/// Whether a file for results can be written.
pub(super) fn check_file(path: &Path) -> Result<(), CommandError> {
    let name = || path.display().to_string();
    if path.is_dir() || path.file_name().is_none() {
        return Err(CommandError::NotAFile { path: name() });
    }
    // results are renamed into place: that would take the place of /dev/full itself
    if path.metadata().is_ok_and(|there| !there.is_file()) {
        return Err(CommandError::NotRegular { path: name() });
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(CommandError::NoFolder { path: name(), folder: folder.display().to_string() });
    }
    probe(folder).map_err(|source| CommandError::Write { path: name(), source })
}

/// A file without a name, gone at once.
fn probe(folder: &Path) -> std::io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
}

/// A path for a single file: in a folder that is there, or is written as one (`results/`), under the command's own name.
pub(super) fn file_in(path: &Path, name: &str) -> Result<PathBuf, CommandError> {
    let folder = path.is_dir() || path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
    if !folder {
        check_file(path)?;
        return Ok(path.to_path_buf());
    }
    // without its last separator: a file of that name would pass for nothing
    let path: PathBuf = path.components().collect();
    check_folder(&path)?;
    let path = path.join(name);
    if path.parent().is_some_and(Path::is_dir) {
        check_file(&path)?;
    }
    Ok(path)
}

/// Which files of a folder each command wrote last, and their fingerprints.
type WrittenFiles = BTreeMap<String, BTreeMap<String, String>>;

/// Where that is remembered, in the folder.
const WRITTEN: &str = ".tune-files.json";

/// A folder while a command writes its results into it. What the command wrote there the last time and does not write again
/// is removed at the end, unless it was changed since: then it is the user's.
pub(super) struct Folder<'a> {
    path: &'a Path,
    command: &'static str,
    /// All that the command can write.
    files: &'a [&'static str],
    /// By the clock of the files.
    began: SystemTime,
}

impl<'a> Folder<'a> {
    /// Make a folder and begin to write.
    pub fn begin(path: &'a Path, command: &'static str, files: &'a [&'static str]) -> Result<Self, CommandError> {
        check_folder(path)?;
        let wrap = |source| CommandError::Write { path: path.display().to_string(), source };
        std::fs::create_dir_all(path).map_err(wrap)?;
        let now = || tempfile::NamedTempFile::new_in(path)?.as_file().metadata()?.modified();
        let before = now().map_err(wrap)?;
        let mut began = before;
        // that clock ticks every few milliseconds: what is there already must be older
        while began == before {
            std::thread::sleep(std::time::Duration::from_millis(1));
            began = now().map_err(wrap)?;
        }
        Ok(Self { path, command, files, began })
    }

    /// All is written.
    pub fn finish(self) -> Result<(), CommandError> {
        let list = self.path.join(WRITTEN);
        let mut all: WrittenFiles =
            std::fs::read(&list).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
        let before = all.remove(self.command).unwrap_or_default();
        let (mut now, mut stale) = (BTreeMap::new(), Vec::new());
        for &name in self.files {
            let path = self.path.join(name);
            let Some(fingerprint) = fingerprint(&path) else { continue };
            let modified = path.metadata().and_then(|there| there.modified());
            if modified.is_ok_and(|time| time >= self.began) {
                now.insert(name.to_string(), fingerprint);
            } else if before.get(name) == Some(&fingerprint) {
                stale.push(path);
            }
        }
        for path in stale {
            std::fs::remove_file(&path)
                .map_err(|source| CommandError::Write { path: path.display().to_string(), source })?;
            // a folder of its own that is empty now; else nothing happens
            path.parent().filter(|folder| *folder != self.path).map(std::fs::remove_dir);
        }
        all.insert(self.command.to_string(), now);
        let mut text = serde_json::to_string_pretty(&all).map_err(|e| CommandError::Result(e.to_string()))?;
        text.push('\n');
        write_file(&list, text.as_bytes())
    }
}

/// FNV-1a of a file; `None` if it is none.
fn fingerprint(path: &Path) -> Option<String> {
    let bytes = path.metadata().is_ok_and(|there| there.is_file()).then(|| std::fs::read(path).ok())??;
    Some(format!("{:016x}", fnv1a(bytes.into_iter())))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILES: &[&str] = &["a.csv", "b.csv", "decks/c.py"];

    fn written(folder: &Path, names: &[&str]) {
        let results = Folder::begin(folder, "run", FILES).unwrap();
        for name in names {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, name).unwrap();
        }
        results.finish().unwrap();
    }

    fn left(folder: &Path) -> Vec<&'static str> {
        FILES.iter().copied().filter(|name| folder.join(name).exists()).collect()
    }

    #[test]
    fn what_is_not_written_again_goes_and_its_empty_folder_with_it() {
        let dir = tempfile::tempdir().unwrap();
        written(dir.path(), FILES);
        assert_eq!(left(dir.path()), FILES);
        written(dir.path(), &["a.csv"]);
        assert_eq!(left(dir.path()), ["a.csv"]);
        assert!(!dir.path().join("decks").exists());
    }

    #[test]
    fn what_the_user_made_or_changed_stays() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("a.csv"), "the user's").unwrap();
        written(dir.path(), &["b.csv", "decks/c.py"]);
        std::fs::write(dir.path().join("decks/notes.txt"), "the user's").unwrap();
        std::fs::write(dir.path().join("b.csv"), "changed").unwrap();
        written(dir.path(), &[]);
        assert_eq!(left(dir.path()), ["a.csv", "b.csv"]);
        assert!(dir.path().join("decks/notes.txt").exists());
    }

    #[test]
    fn a_list_that_was_tampered_with_names_no_file_of_others() {
        let dir = tempfile::tempdir().unwrap();
        let own = dir.path().join("own.txt");
        std::fs::write(&own, "x").unwrap();
        let list = format!("{{\"run\": {{\"own.txt\": \"{}\"}}}}", fingerprint(&own).unwrap());
        std::fs::write(dir.path().join(WRITTEN), list).unwrap();
        written(dir.path(), &["a.csv"]);
        assert!(own.exists());
    }
}
