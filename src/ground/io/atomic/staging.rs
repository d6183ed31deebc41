//! The folder `.crossbar-XXXXXX` in which files are written before they appear. A process that is killed leaves it.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempDir;

/// The staging folders of this process. The lock is held while a folder is created and while files are renamed out of
/// it, so that a signal ends the process only before or after.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths stays valid after a panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the staging folders of this process for good: nothing can be staged or renamed afterwards. For a process
/// that is about to end because of a signal. Returns true if there was one, so that files are lost.
pub fn abandon() -> bool {
    let folders = in_use();
    let some = !folders.is_empty();
    for folder in folders.iter() {
        // A thread may still be writing into it.
        for _ in 0..100 {
            if fs::remove_dir_all(folder).is_ok() || !folder.exists() {
                break;
            }
        }
    }
    std::mem::forget(folders);
    some
}

/// A staging folder, removed when dropped.
#[derive(Debug)]
pub(super) struct Staging(TempDir);

impl Staging {
    /// A staging folder within `base`, which exists.
    pub(super) fn within(base: &Path) -> io::Result<Self> {
        let mut folders = in_use();
        let folder = tempfile::Builder::new().prefix(".crossbar-").tempdir_in(base)?;
        folders.push(folder.path().to_path_buf());
        Ok(Self(folder))
    }

    /// The folder in which files are written, with the paths that they will have below the base.
    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Renames a folder that is written, named as below the base, to its place there, where nothing is yet.
    pub(super) fn rename_folder(&self, name: &Path, place: &Path) -> io::Result<()> {
        let _quiet = in_use();
        fs::rename(self.path().join(name), place)
    }

    /// Renames files, which lie below `rest`, to their places in `folder`, while no other process does so there.
    /// Returns the place that could not be written, if any.
    pub(super) fn rename_files(
        &self,
        rest: &Path,
        folder: &Path,
        names: &[PathBuf],
    ) -> Result<(), (PathBuf, io::Error)> {
        // Ends with the process. Where folders cannot be locked, nothing keeps two processes apart.
        let lock = File::open(folder).ok().filter(|folder| folder.lock().is_ok());
        let _quiet = in_use();
        for name in names {
            let place = folder.join(name);
            fs::rename(self.path().join(rest).join(name), &place).map_err(|error| (place, error))?;
        }
        drop(lock);
        Ok(())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        in_use().retain(|folder| folder != self.path());
    }
}
