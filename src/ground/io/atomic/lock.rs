//! The lock on a folder while files are moved into it, and while remains of killed processes are removed.
//!
//! It is an operating system's lock on the file `.crossbar_lock`, which ends with its process, however that ends; the
//! file is removed when the lock is released.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

const FILE_NAME: &str = ".crossbar_lock";
/// Moving a set of files takes milliseconds, but a suspended process holds its lock indefinitely.
const PATIENCE: Duration = Duration::from_secs(60);
const PAUSE: Duration = Duration::from_millis(2);

/// The staging folders of this process. Locked while one is created, and while files are renamed out of one: the end of
/// the process by a signal waits for that.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The staging folders of this process, locked while the guard lives.
pub(super) fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths stays valid after a panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The lock of a folder: one process at a time holds it, and within a process one thread at a time holds any.
#[derive(Debug)]
pub(super) struct FolderLock {
    /// `None` where the system has no locks, or the folder belongs to another user: then no remains are removed.
    file: Option<(PathBuf, File)>,
    /// The staging folders of this process.
    pub(super) folders: MutexGuard<'static, Vec<PathBuf>>,
}

impl FolderLock {
    /// Waits for the lock of `folder`, which must exist.
    ///
    /// # Errors
    /// [`io::ErrorKind::TimedOut`] if another process holds it for a minute.
    pub(super) fn of(folder: &Path) -> io::Result<Self> {
        let path = folder.join(FILE_NAME);
        let start = Instant::now();
        loop {
            let folders = in_use();
            let Ok(file) = File::options().create(true).truncate(false).write(true).open(&path) else {
                return Ok(Self { file: None, folders });
            };
            match file.try_lock() {
                // The previous holder may have removed the file that was opened here.
                Ok(()) if is_at(&file, &path) => return Ok(Self { file: Some((path, file)), folders }),
                Ok(()) => {}
                // Locks are not supported here.
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
            // Released while waiting, so that other threads proceed and a signal can end the process.
            drop((folders, file));
            std::thread::sleep(PAUSE);
        }
    }

    /// True if no other process can move files into the folder or create a staging folder in it.
    pub(super) fn is_exclusive(&self) -> bool {
        self.file.is_some()
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if let Some((path, file)) = self.file.take() {
            // Removed while it is locked, so that no lock of another process is removed.
            let _ = fs::remove_file(path);
            drop(file);
        }
    }
}

/// True if the path still names this file.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    file.metadata().map(identity).ok() == fs::metadata(path).map(identity).ok()
}

/// On other systems a name cannot be reused while a removed file is open.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}
