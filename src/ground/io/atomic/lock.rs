//! The lock on a folder while files are put into it, and while what killed processes left is cleared away.
//!
//! It is an operating system's lock on the file `.crossbar_lock`, which ends with its process, however that ends; the
//! file goes when the lock is given back.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

const FILE_NAME: &str = ".crossbar_lock";
/// A set is put into its place in milliseconds; a process that was stopped holds its lock for as long as it likes.
const PATIENCE: Duration = Duration::from_secs(60);
const PAUSE: Duration = Duration::from_millis(2);

/// The staging folders of this process. Held while one is made, and while files are renamed out of one: whoever ends
/// the process waits for that.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The staging folders of this process, for as long as the guard lives.
pub(super) fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths is right after any panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// One process at a time has a folder's lock; within the process one at a time has any.
#[derive(Debug)]
pub(super) struct FolderLock {
    /// None where the system has no locks, or the folder belongs to somebody else: then nothing is cleared away.
    file: Option<(PathBuf, File)>,
    /// The staging folders of this process.
    pub(super) folders: MutexGuard<'static, Vec<PathBuf>>,
}

impl FolderLock {
    /// Waits for the lock of `folder`, which exists.
    ///
    /// # Errors
    /// [`io::ErrorKind::TimedOut`] if another process keeps it for a minute.
    pub(super) fn of(folder: &Path) -> io::Result<Self> {
        let path = folder.join(FILE_NAME);
        let start = Instant::now();
        loop {
            let folders = in_use();
            let Ok(file) = File::options().create(true).truncate(false).write(true).open(&path) else {
                return Ok(Self { file: None, folders });
            };
            match file.try_lock() {
                // Whoever had it before may have removed the file that was opened here.
                Ok(()) if is_at(&file, &path) => return Ok(Self { file: Some((path, file)), folders }),
                Ok(()) => {}
                Err(TryLockError::Error(_)) => {
                    let _ = fs::remove_file(&path);
                    return Ok(Self { file: None, folders });
                }
                Err(TryLockError::WouldBlock) if start.elapsed() > PATIENCE => {
                    let what =
                        format!("another process keeps the lock {} for a minute: is it stopped?", path.display());
                    return Err(io::Error::new(io::ErrorKind::TimedOut, what));
                }
                Err(TryLockError::WouldBlock) => {}
            }
            // Others of this process go on meanwhile, and a signal may end it.
            drop((folders, file));
            std::thread::sleep(PAUSE);
        }
    }

    /// Whether no other process puts files into the folder or makes a staging folder in it.
    pub(super) fn is_exclusive(&self) -> bool {
        self.file.is_some()
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if let Some((path, file)) = self.file.take() {
            // While it is locked, so that nobody's lock is removed.
            let _ = fs::remove_file(path);
            drop(file);
        }
    }
}

/// Whether the file is the one that the path names.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    file.metadata().map(identity).ok() == fs::metadata(path).map(identity).ok()
}

/// Elsewhere a name cannot be taken again while a removed file is open.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}
