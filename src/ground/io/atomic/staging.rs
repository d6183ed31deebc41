//! The folder `.crossbar-XXXXXX` in which files are written before they appear. A killed process leaves the folder
//! behind.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempDir;

/// The staging folders of this process. The lock is held while a folder is created and while files are renamed out of
/// it, so that a signal ends the process only before or after these steps.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths stays valid after a panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the staging folders of this process, which is about to end because of a signal; no file can be staged or
/// renamed afterwards. Returns true if there was a folder, so that files are lost.
pub fn abandon() -> bool {
    let folders = in_use();
    let some = !folders.is_empty();
    for folder in folders.iter() {
        // A thread may still be writing into the folder.
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

    /// The folder in which files are written; their paths below it are their later paths below the base.
    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Renames a complete folder to `place`, where nothing exists yet; `name` is its path below the base.
    pub(super) fn rename_folder(&self, name: &Path, place: &Path) -> io::Result<()> {
        let _quiet = in_use();
        fs::rename(self.path().join(name), place)
    }

    /// Moves the files below `rest` into `folder` by renaming, under a lock against other processes. Returns the path
    /// that could not be written, if any.
    pub(super) fn rename_files(
        &self,
        rest: &Path,
        folder: &Path,
        names: &[PathBuf],
    ) -> Result<(), (PathBuf, io::Error)> {
        // The lock ends with the process. On systems that cannot lock folders, two processes are not kept apart.
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
