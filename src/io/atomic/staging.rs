//! The folder in which files are written before they appear.
//!
//! `.crossbar-XXXXXX/new` holds them while they are written, `.crossbar-XXXXXX/whole` once all are there and only
//! renames are left, and the removal of the files in the list `.crossbar-XXXXXX/stale`. A process that is killed leaves
//! the folder; the next one that writes to the same place clears it away, or finishes its renames and removals. A lock
//! on `.crossbar-XXXXXX/lock`, which ends with its process, tells a folder that was left from one that is in use.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempDir;

use super::manifest::Manifest;

const PREFIX: &str = ".crossbar-";
const LOCK: &str = "lock";
const NEW: &str = "new";
const WHOLE: &str = "whole";
const STALE: &str = "stale";

/// The staging folders of this process. Held while one is made, and while files are renamed out of one: whoever ends
/// the process waits for that.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths is right after any panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the staging folders of this process for good: nothing can be staged or renamed afterwards. For a process
/// that is about to end because a signal says so. Returns whether there was one, so that files are lost.
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
pub(super) struct Staging {
    /// Held as long as this lives; closed before the folder goes, as some systems want it.
    _lock: File,
    folder: TempDir,
}

impl Staging {
    /// A staging folder within `base`, which exists; those that killed processes left there are dealt with first.
    pub(super) fn within(base: &Path) -> io::Result<Self> {
        sweep(base);
        let mut folders = in_use();
        let folder = tempfile::Builder::new().prefix(PREFIX).tempdir_in(base)?;
        // Under its name only when locked, so that nobody takes the folder for one that was left.
        let early = folder.path().join("lock-early");
        let lock = File::create(&early)?;
        // Where there are no locks nothing is ever cleared away, which is safe.
        if lock.try_lock().is_ok() {
            fs::rename(&early, folder.path().join(LOCK))?;
        }
        fs::create_dir(folder.path().join(NEW))?;
        folders.push(folder.path().to_path_buf());
        Ok(Self { folder, _lock: lock })
    }

    /// Where files are written, by the paths that they are to have below the base.
    pub(super) fn new_files(&self) -> PathBuf {
        self.folder.path().join(NEW)
    }

    /// Renames a folder that is written, named as below the base, to its place there, where nothing is yet.
    pub(super) fn rename_folder(&self, name: &Path, place: &Path) -> io::Result<()> {
        let _quiet = in_use();
        fs::rename(self.new_files().join(name), place)
    }

    /// Renames files, named as below `base`, to their places there, at most `most` of them; then removes those of
    /// `stale`. Whoever comes after a process that was killed on the way does the rest. Returns the place that could
    /// not be taken, if one could not.
    pub(super) fn rename_files(
        &self,
        base: &Path,
        names: &[PathBuf],
        stale: &Manifest,
        most: usize,
    ) -> Result<(), (PathBuf, io::Error)> {
        let _quiet = in_use();
        let list = self.folder.path().join(STALE);
        fs::write(&list, stale.to_string()).map_err(|error| (base.to_path_buf(), error))?;
        let whole = self.folder.path().join(WHOLE);
        fs::rename(self.new_files(), &whole).map_err(|error| (base.to_path_buf(), error))?;
        for name in names.iter().take(most) {
            let place = base.join(name);
            fs::rename(whole.join(name), &place).map_err(|error| (place, error))?;
        }
        if most > names.len() {
            stale.remove_files(base);
        }
        Ok(())
    }

    /// Leaves the folder as a killed process would.
    #[cfg(test)]
    pub(super) fn leave(mut self) {
        self.folder.disable_cleanup(true);
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        in_use().retain(|folder| folder != self.folder.path());
    }
}

/// Deals with the staging folders that killed processes left in `base`. What cannot be dealt with stays.
fn sweep(base: &Path) {
    for entry in fs::read_dir(base).into_iter().flatten().flatten() {
        if !entry.file_name().to_string_lossy().starts_with(PREFIX) {
            continue;
        }
        let folder = entry.path();
        let Ok(lock) = File::options().read(true).write(true).open(folder.join(LOCK)) else { continue };
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => continue,
        }
        let _quiet = in_use();
        let whole = folder.join(WHOLE);
        let decided = whole.exists();
        if finish(&whole, base).is_ok() {
            if decided {
                Manifest::read(&folder.join(STALE)).remove_files(base);
            }
            drop(lock);
            let _ = fs::remove_dir_all(&folder);
        }
    }
}

/// Renames all files below `from` to the same places below `to`; fine if there is no `from`.
fn finish(from: &Path, to: &Path) -> io::Result<()> {
    let entries = match fs::read_dir(from) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let entry = entry?;
        let place = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            fs::create_dir_all(&place)?;
            finish(&entry.path(), &place)?;
        } else {
            fs::rename(entry.path(), place)?;
        }
    }
    Ok(())
}
