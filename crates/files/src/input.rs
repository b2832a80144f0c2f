//! Files that users name, read whole: regular files of a bounded size. A pipe or a device may never
//! end.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

use crate::memory;

/// Largest text that people write: cases, sweeps, parameters.
const MOST_TEXT: u64 = 16 << 20;

/// The bytes of a regular file, or `None` if it has more than `most`.
///
/// # Errors
/// It is none, or cannot be read.
pub fn bytes(path: &Path, most: u64) -> io::Result<Option<Vec<u8>>> {
    if let Some(given) = memory::given(path) {
        return Ok((given.len() as u64 <= most).then(|| given.to_vec()));
    }
    // to open a pipe waits for its writer
    let there = path.metadata()?;
    if there.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder; name a file"));
    }
    if !there.is_file() {
        return Err(io::Error::other("a pipe, a socket or a device; copy it to a file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

/// The bytes of a regular file of at most 16 MB.
///
/// # Errors
/// It is none, is larger, or cannot be read.
pub fn bounded(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = bytes(path, MOST_TEXT)?;
    bytes.ok_or_else(|| io::Error::other(format!("it has more than {} MB", MOST_TEXT >> 20)))
}

/// The text of a regular file of at most 16 MB.
///
/// # Errors
/// It is none, is larger, is no UTF-8, or cannot be read.
pub fn text(path: &Path) -> io::Result<String> {
    String::from_utf8(bounded(path)?)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_bound() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, "abc").unwrap();
        assert_eq!(bytes(&path, 3).unwrap(), Some(b"abc".to_vec()));
        assert_eq!(bytes(&path, 2).unwrap(), None);
        assert_eq!(text(&path).unwrap(), "abc");
        std::fs::write(&path, [0xff, 0xfe]).unwrap();
        assert!(text(&path).unwrap_err().to_string().contains("UTF-8"));
        File::create(&path).unwrap().set_len(MOST_TEXT + 1).unwrap();
        assert!(text(&path).unwrap_err().to_string().contains("16 MB"));
    }

    #[cfg(unix)]
    #[test]
    fn what_may_never_end_is_not_opened() {
        let dir = tempfile::tempdir().unwrap();
        let pipe = dir.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        for path in [pipe.as_path(), Path::new("/dev/zero")] {
            assert!(text(path).unwrap_err().to_string().contains("a pipe, a socket or a device"));
        }
        assert_eq!(text(dir.path()).unwrap_err().kind(), io::ErrorKind::IsADirectory);
    }
}
