//! Files that are there whole or not at all: written under a temporary name in the same folder,
//! then renamed.
//!
//! A process holds a lock on the temporary file while it writes. The lock of a process that was
//! killed is gone, and so whoever writes into the folder next knows that the file has no owner, and
//! removes it. No clock decides.

use std::{
    fs::{self, File},
    io::{self, ErrorKind, Write},
    path::Path,
};

/// Prefix of names that files have until they are whole.
pub const UNFINISHED: &str = ".unfinished-";

/// How often a file is written again that another process took for one without an owner, in the
/// moment between its making and its lock.
const TRIES: usize = 10;

/// Put bytes under a name at once.
///
/// # Errors
/// It cannot be written; nothing new has the name then.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace(path, bytes, |_| Ok(()))
}

/// The same, so that a name that is there has all its bytes even after a crash of the machine.
///
/// # Errors
/// As [`write()`].
pub fn write_durably(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace(path, bytes, File::sync_all)?;
    #[cfg(unix)]
    File::open(folder(path)).and_then(|folder| folder.sync_all())?;
    Ok(())
}

/// The folder of a file.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// What is written gets its name after `ready`.
fn replace(path: &Path, bytes: &[u8], ready: fn(&File) -> io::Result<()>) -> io::Result<()> {
    let folder = folder(path);
    for _ in 1..TRIES {
        match once(path, folder, bytes, ready) {
            Err(e) if e.kind() == ErrorKind::NotFound && folder.is_dir() => {}
            written => return written,
        }
    }
    once(path, folder, bytes, ready)
}

fn once(
    path: &Path,
    folder: &Path,
    bytes: &[u8],
    ready: fn(&File) -> io::Result<()>,
) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED);
    // a temporary file is private by default; a result is for everyone whom the user's mask admits
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    // a file system without locks loses nothing: what is removed too early is written again
    let _ = file.as_file().lock();
    file.write_all(bytes)?;
    ready(file.as_file())?;
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// Remove what processes that were killed left behind in a folder.
pub fn tidy(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let own = entry.file_name().to_string_lossy().starts_with(UNFINISHED);
        if own && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            remove_if_orphan(&entry.path());
        }
    }
}

fn remove_if_orphan(path: &Path) {
    let Ok(file) = File::options().read(true).write(true).open(path) else { return };
    if file.try_lock().is_ok() {
        // another may have removed it
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_owner_goes_and_what_is_being_written_stays() {
        let dir = tempfile::tempdir().unwrap();
        let [orphan, owned] =
            ["orphan", "owned"].map(|name| dir.path().join(format!("{UNFINISHED}{name}")));
        fs::write(&orphan, "half").unwrap();
        let writing = File::create(&owned).unwrap();
        writing.lock().unwrap();
        fs::write(dir.path().join("results.csv"), "whole").unwrap();
        tidy(dir.path());
        assert!(!orphan.exists() && owned.exists() && dir.path().join("results.csv").exists());
        drop(writing);
        tidy(dir.path());
        assert!(!owned.exists());
    }

    #[test]
    fn writers_lose_nothing_to_another_that_tidies() {
        let dir = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            let writers: Vec<_> = (0..4)
                .map(|i| {
                    let folder = dir.path();
                    scope.spawn(move || {
                        (0..100)
                            .for_each(|k| write(&folder.join(format!("{i}-{k}")), b"x").unwrap())
                    })
                })
                .collect();
            while writers.iter().any(|writer| !writer.is_finished()) {
                tidy(dir.path());
            }
        });
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 400);
    }
}
