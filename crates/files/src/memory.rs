//! Files given as bytes, for where there is no file system: a page in a browser. They go before
//! files of the same path.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Arc, PoisonError, RwLock},
};

static GIVEN: RwLock<BTreeMap<PathBuf, Arc<[u8]>>> = RwLock::new(BTreeMap::new());

/// Give a file: what reads this path from now on reads these bytes.
pub fn give(path: &Path, bytes: &[u8]) {
    GIVEN.write().unwrap_or_else(PoisonError::into_inner).insert(path.into(), bytes.into());
}

/// Forget a file that was given.
pub fn forget(path: &Path) {
    GIVEN.write().unwrap_or_else(PoisonError::into_inner).remove(path);
}

/// The bytes of a file that was given.
pub(crate) fn given(path: &Path) -> Option<Arc<[u8]>> {
    GIVEN.read().unwrap_or_else(PoisonError::into_inner).get(path).cloned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input;

    #[test]
    fn a_file_that_was_given_is_read_until_it_is_forgotten() {
        let path = Path::new("nowhere/given.txt");
        assert!(input::bytes(path, 9).is_err());
        give(path, b"abc");
        assert_eq!(input::bytes(path, 9).unwrap(), Some(b"abc".to_vec()));
        assert_eq!(input::bytes(path, 2).unwrap(), None);
        forget(path);
        assert!(input::bytes(path, 9).is_err());
    }
}
