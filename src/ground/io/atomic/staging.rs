//! The folder in which files are written before they appear.
//!
//! `.crossbar-XXXXXX/new` holds them while they are written, `.crossbar-XXXXXX/whole` once all are there and only
//! renames are left, and the removal of the files in the list `.crossbar-XXXXXX/stale`. A process that is killed leaves
//! the folder; the next one that writes to the same place clears it away, or finishes its renames and removals. A lock
//! on `.crossbar-XXXXXX/lock`, which ends with its process, tells a folder that was left from one that is in use.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use super::lock::{FolderLock, in_use};
use super::manifest::Manifest;

const PREFIX: &str = ".crossbar-";
const LOCK: &str = "lock";
const NEW: &str = "new";
const WHOLE: &str = "whole";
const STALE: &str = "stale";

/// Removes the staging folders of this process for good: nothing can be staged or renamed afterwards. For a process
/// that is about to end because of a signal. Returns true if there was one, so that files are lost.
pub fn abandon() -> bool {
    let folders = in_use();
    let some = !folders.is_empty();
    for folder in folders.iter() {
        // A thread may still be writing into it.
        for _ in 0..100 {
            if remove_tree(folder).is_ok() || !folder.exists() {
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
    lock: Option<File>,
    folder: PathBuf,
}

impl Staging {
    /// A staging folder within `base`, which exists; those that killed processes left there are dealt with first.
    pub(super) fn within(base: &Path) -> io::Result<Self> {
        let mut held = FolderLock::of(base)?;
        sweep(base, &held);
        let folder = tempfile::Builder::new().prefix(PREFIX).tempdir_in(base)?.keep();
        let make = || {
            let lock = File::create(folder.join(LOCK))?;
            // Without locks nothing is ever removed, which is safe.
            let _ = lock.try_lock();
            fs::create_dir(folder.join(NEW))?;
            Ok(lock)
        };
        let made: io::Result<File> = make();
        match made {
            Ok(lock) => {
                held.folders.push(folder.clone());
                Ok(Self { lock: Some(lock), folder })
            }
            Err(error) => {
                // Without opening the folder, because the process may have no file descriptors left.
                let _ = fs::remove_file(folder.join(LOCK));
                let _ = fs::remove_dir(&folder);
                Err(error)
            }
        }
    }

    /// The same files in a staging folder within `base`; `rest` is their path below it.
    pub(super) fn moved(&self, rest: &Path, base: &Path) -> io::Result<Self> {
        let moved = Self::within(base)?;
        fs::remove_dir(moved.new_files())?;
        fs::rename(self.new_files().join(rest), moved.new_files())?;
        Ok(moved)
    }

    /// The folder in which files are written, with the paths that they will have below the base.
    pub(super) fn new_files(&self) -> PathBuf {
        self.folder.join(NEW)
    }

    /// Renames a folder that is written, named as below the base, to its place there, where nothing is yet.
    pub(super) fn rename_folder(&self, name: &Path, place: &Path) -> io::Result<()> {
        let _quiet = in_use();
        fs::rename(self.new_files().join(name), place)
    }

    /// Renames at most `most` files, named relative to `base`, to their places; then removes the `stale` ones. If the
    /// process is killed in between, a later process does the rest. Returns the place that could not be written, if
    /// any.
    pub(super) fn rename_files(
        &self,
        base: &Path,
        names: &[PathBuf],
        stale: &Manifest,
        most: usize,
        _held: &FolderLock,
    ) -> Result<(), (PathBuf, io::Error)> {
        let list = self.folder.join(STALE);
        fs::write(&list, stale.to_string()).map_err(|error| (base.to_path_buf(), error))?;
        let whole = self.folder.join(WHOLE);
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
        self.lock = None;
        in_use().retain(|folder| *folder != self.folder);
        self.folder = PathBuf::new();
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        self.lock = None;
        if self.folder != Path::new("") {
            let _ = remove_tree(&self.folder);
        }
        in_use().retain(|folder| *folder != self.folder);
    }
}

/// Finishes or removes the staging folders that killed processes left in `base`. Failures are ignored.
pub(super) fn sweep(base: &Path, held: &FolderLock) {
    if !held.is_exclusive() {
        return;
    }
    for entry in fs::read_dir(base).into_iter().flatten().flatten() {
        let folder = entry.path();
        let is_one = entry.file_name().to_string_lossy().starts_with(PREFIX);
        if !is_one || held.folders.contains(&folder) || !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            continue;
        }
        match File::options().read(true).write(true).open(folder.join(LOCK)) {
            Ok(lock) if lock.try_lock().is_ok() => {}
            // This process has the lock of `base`, so the process that created it was killed, or could not remove it.
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            _ => continue,
        }
        let whole = folder.join(WHOLE);
        let decided = whole.exists();
        if finish(&whole, base).is_ok() {
            if decided {
                Manifest::read(&folder.join(STALE)).remove_files(base);
            }
            let _ = remove_tree(&folder);
        }
    }
}

/// Removes a folder with all that is in it. One folder is open at a time, so that a process that has no more files to
/// open can still clean up; the lock goes last but for the folder.
fn remove_tree(folder: &Path) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(|entry| entry.file_name() == LOCK);
    for entry in entries {
        if entry.file_type()?.is_dir() { remove_tree(&entry.path())? } else { fs::remove_file(entry.path())? }
    }
    fs::remove_dir(folder)
}

/// Renames all files below `from` to the same places below `to`; no error if `from` does not exist.
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
