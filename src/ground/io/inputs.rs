//! The files that this process has opened to read.
//!
//! All reading of `io` begins in one function, which notes the path here. So a part of a divided run knows every file
//! that its result depends on, including files that no option names: materials of a model, textures, factors.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

static OPENED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Notes a file that was opened.
pub(super) fn note(path: &Path) {
    let mut opened = OPENED.lock().unwrap_or_else(PoisonError::into_inner);
    if !opened.contains(path) {
        opened.insert(path.to_owned());
    }
}

/// The paths of all files that this process has opened to read so far, as they were opened, sorted, without repetition.
pub fn files_read() -> Vec<PathBuf> {
    OPENED.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
}
