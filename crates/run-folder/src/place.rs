//! Where results go: looked at before the work, so that no work is lost and nothing is half
//! written.

use std::path::{Path, PathBuf};

use files::whole_file;

use crate::FolderError;

/// Whether a folder for results can be made or written into.
pub fn check_folder(path: &Path) -> Result<(), FolderError> {
    let name = || path.display().to_string();
    let there = path.ancestors().find(|p| p.as_os_str().is_empty() || p.symlink_metadata().is_ok());
    let there = there.filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !there.is_dir() {
        return Err(FolderError::NotAFolder { path: there.display().to_string() });
    }
    probe(there).map_err(|source| FolderError::Write { path: name(), source })
}

/// Whether a file for results can be written.
pub(crate) fn check_file(path: &Path) -> Result<(), FolderError> {
    let name = || path.display().to_string();
    if path.is_dir() || path.file_name().is_none() {
        return Err(FolderError::NotAFile { path: name() });
    }
    // results are renamed into place: that would take the place of /dev/full itself
    if path.metadata().is_ok_and(|there| !there.is_file()) {
        return Err(FolderError::NotRegular { path: name() });
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(FolderError::NoFolder { path: name(), folder: folder.display().to_string() });
    }
    probe(folder).map_err(|source| FolderError::Write { path: name(), source })
}

/// A file without a name, gone at once.
fn probe(folder: &Path) -> std::io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
}

/// A path for a single file: in a folder that is there, or is written as one (`results/`), under
/// the command's own name.
pub fn file_in(path: &Path, name: &str) -> Result<PathBuf, FolderError> {
    let folder =
        path.is_dir() || path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
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

/// Whether a file to write is none of those that a command reads, and no case file, which
/// [`write_file`] would replace.
///
/// # Errors
/// It is one.
pub fn not_an_input<'a>(
    path: &Path,
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), FolderError> {
    let Ok(there) = path.canonicalize() else { return Ok(()) };
    let same = |input: &Path| input.canonicalize().is_ok_and(|input| input == there);
    let what = match inputs.into_iter().any(same) {
        true => "a file that this command reads",
        false if there.extension().is_some_and(|extension| extension == "toml") => "a case file",
        false => return Ok(()),
    };
    Err(FolderError::Input { path: path.display().to_string(), what })
}

/// Write a whole file or nothing. Its folder is made, and rid of what killed runs left in it.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), FolderError> {
    let folder = whole_file::folder(path);
    let write = || {
        std::fs::create_dir_all(folder)?;
        whole_file::tidy(folder);
        whole_file::write(path, bytes)
    };
    write().map_err(|source| FolderError::Write { path: path.display().to_string(), source })
}
