//! A folder of results that is of one run.
//!
//! A command writes its files into a folder of its own within that of the results, and exchanges
//! them for those of the last run when all are whole. A run that fails or is killed before has
//! changed nothing. While files are exchanged, `UNFINISHED-run.txt` stands in the folder, and stays
//! there if the command is killed: then files of two runs may be mixed, and [`of_one_run`] refuses
//! them. `.tune-files.json` holds the checksum of each file and the identity of the run. No clock
//! decides.

use std::{
    collections::BTreeMap,
    fmt::Debug,
    fs::{self, File},
    io,
    path::{Path, PathBuf},
};

use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use crate::{FolderError, place::check_folder};
use files::{
    input,
    whole_file::{self, UNFINISHED},
};
use strong_motion::fnv1a;

/// A run by what decides its results: FNV-1a of the program's version and of all that is given, in
/// the words of `Debug`.
pub fn identity(given: &[&dyn Debug]) -> String {
    let given: String = given.iter().map(|value| format!(" {value:?}")).collect();
    format!("{:016x}", fnv1a(format!("{}{given}", env!("CARGO_PKG_VERSION")).bytes()))
}

/// What a command wrote into a folder the last time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct WrittenFiles {
    identity: String,
    /// FNV-1a of each.
    files: BTreeMap<String, String>,
}

/// As it stands in the folder; an earlier version had the files alone.
#[derive(Deserialize)]
#[serde(untagged)]
enum FiledList {
    Now(WrittenFiles),
    Earlier(BTreeMap<String, String>),
}

/// Where that is remembered, in the folder.
const WRITTEN: &str = ".tune-files.json";
/// Lock of a command's own folder: its owner is alive while it holds it.
const LOCK: &str = ".lock";
/// How often a command makes a folder of its own that another took for one without an owner.
const TRIES: usize = 10;

fn mark(command: &str) -> String {
    format!("UNFINISHED-{command}.txt")
}

fn written(folder: &Path) -> BTreeMap<String, WrittenFiles> {
    let text = input::text(&folder.join(WRITTEN)).unwrap_or_default();
    let filed: BTreeMap<String, FiledList> = serde_json::from_str(&text).unwrap_or_default();
    let known = |filed| match filed {
        FiledList::Now(written) => written,
        FiledList::Earlier(files) => WrittenFiles { files, ..WrittenFiles::default() },
    };
    filed.into_iter().map(|(command, filed)| (command, known(filed))).collect()
}

/// A folder while a command writes its results. What the command wrote there the last time and does
/// not write again is removed at the end, unless it was changed since: then it is the user's.
pub struct Folder<'a> {
    path: &'a Path,
    command: &'static str,
    /// All that the command can write.
    files: &'a [&'static str],
    identity: String,
    /// Where it writes them, and the lock in there.
    own: TempDir,
    _lock: File,
}

impl<'a> Folder<'a> {
    /// Make a folder and begin to write into [`Folder::path`].
    pub fn begin(
        path: &'a Path,
        command: &'static str,
        files: &'a [&'static str],
        identity: String,
    ) -> Result<Self, FolderError> {
        check_folder(path)?;
        let begin = || {
            fs::create_dir_all(path)?;
            tidy(path);
            (1..TRIES).find_map(|_| own(path).ok()).map_or_else(|| own(path), Ok)
        };
        let (own, lock) = begin().map_err(|source| cannot(path, source))?;
        Ok(Self { path, command, files, identity, own, _lock: lock })
    }

    /// Where the command writes its files: they come into their place by [`Folder::finish`].
    pub fn path(&self) -> &Path {
        self.own.path()
    }

    /// All is written: put the files into their place.
    pub fn finish(self) -> Result<(), FolderError> {
        // another may finish at the same moment; file systems without locks are rare
        let lock = File::open(self.path);
        let _ = lock.as_ref().map(File::lock);
        let mut all = written(self.path);
        let before = all.remove(self.command).unwrap_or_default().files;
        let there =
            |folder: &Path, name: &'static str| Some((name, fingerprint(&folder.join(name))?));
        let now: BTreeMap<_, _> =
            self.files.iter().filter_map(|name| there(self.own.path(), name)).collect();
        let stale = self.files.iter().filter(|name| !now.contains_key(*name));
        let stale: Vec<_> = stale
            .filter_map(|name| there(self.path, name))
            .filter(|(name, print)| before.get(*name) == Some(print))
            .map(|(name, _)| name)
            .collect();
        let files = now.iter().map(|(name, print)| (name.to_string(), print.clone())).collect();
        all.insert(self.command.into(), WrittenFiles { identity: self.identity.clone(), files });
        let mut list = serde_json::to_string_pretty(&all)?;
        list.push('\n');

        let mark = self.path.join(mark(self.command));
        let text = format!(
            "tune {} was stopped while it put its files into this folder: some are of another run. \
             Run it again.\n",
            self.command
        );
        let save = |path: &Path, text: &str| {
            whole_file::write(path, text.as_bytes()).map_err(|e| cannot(path, e))
        };
        save(&mark, &text)?;
        save(&self.path.join(WRITTEN), &list)?;
        for name in now.keys() {
            self.exchange(name).map_err(|source| cannot(&self.path.join(name), source))?;
        }
        for name in stale {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(|source| cannot(&path, source))?;
            // a folder of its own that is empty now; else nothing happens
            path.parent().filter(|folder| *folder != self.path).map(fs::remove_dir);
        }
        fs::remove_file(&mark).map_err(|source| cannot(&mark, source))
    }

    fn exchange(&self, name: &str) -> io::Result<()> {
        let to = self.path.join(name);
        fs::create_dir_all(whole_file::folder(&to))?;
        fs::rename(self.own.path().join(name), to)
    }
}

/// A folder of a command's own, locked.
fn own(path: &Path) -> io::Result<(TempDir, File)> {
    let own = tempfile::Builder::new().prefix(UNFINISHED).tempdir_in(path)?;
    let lock = File::create(own.path().join(LOCK))?;
    let _ = lock.lock();
    // another may have taken it for one without an owner, before the lock
    own.path().join(LOCK).metadata()?;
    Ok((own, lock))
}

/// Remove what commands that were killed left behind.
fn tidy(path: &Path) {
    whole_file::tidy(path);
    let Ok(entries) = fs::read_dir(path) else { return };
    for entry in entries.flatten() {
        let own = entry.file_name().to_string_lossy().starts_with(UNFINISHED);
        if own && entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            // made here if its owner was killed before: then the lock is free
            let lock = File::options().create(true).append(true).open(entry.path().join(LOCK));
            if lock.is_ok_and(|lock| lock.try_lock().is_ok()) {
                let _ = fs::remove_dir_all(entry.path());
            }
        }
    }
}

/// Whether the file is of the run whose other files stand beside it; a file on its own belongs to
/// nothing and is taken as it is.
///
/// # Errors
/// Files of two runs are mixed there.
pub fn of_one_run(file: &Path) -> Result<(), FolderError> {
    const COMMAND: &str = "run";
    let folder = whole_file::folder(file);
    let (name, folder_name) = (file.display().to_string(), folder.display().to_string());
    if folder.join(mark(COMMAND)).exists() {
        return Err(FolderError::Mixed { folder: folder_name, command: COMMAND });
    }
    let Some(own) = file.file_name().and_then(|name| name.to_str()) else { return Ok(()) };
    let Some(run) = written(folder).remove(COMMAND) else { return Ok(()) };
    let as_written =
        |name: &str, print: &String| fingerprint(&folder.join(name)).as_ref() == Some(print);
    match run.files.get(own) {
        Some(print) if !as_written(own, print) => {
            let others =
                || run.files.iter().any(|(name, print)| name != own && as_written(name, print));
            if others() {
                Err(FolderError::OfAnotherRun { path: name, folder: folder_name })
            } else {
                Ok(())
            }
        }
        _ => Ok(()),
    }
}

fn cannot(path: &Path, source: io::Error) -> FolderError {
    FolderError::Write { path: path.display().to_string(), source }
}

/// FNV-1a of a file; `None` if it is none.
fn fingerprint(path: &PathBuf) -> Option<String> {
    let bytes =
        path.metadata().is_ok_and(|there| there.is_file()).then(|| fs::read(path).ok())??;
    Some(format!("{:016x}", fnv1a(bytes.into_iter())))
}

#[cfg(test)]
mod tests;
