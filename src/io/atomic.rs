//! Files that appear whole or not at all: written beside their place, then renamed into it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

use tempfile::TempDir;
use thiserror::Error;

/// Why a file was not written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The folder cannot be made, or nothing can be written in it.
    #[error("cannot write into the folder {}; choose another folder, or make it writable", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file cannot be written.
    #[error("cannot write {}", path.display())]
    File {
        /// The file, at its final place.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The name is not a plain path below the folder.
    #[error("expected the name of a file below the output folder, found {}", name.display())]
    Name {
        /// The name.
        name: PathBuf,
    },
}

/// Writes one file through `fill`; its folder must exist. On any error, whatever stood at `path` before still stands.
///
/// A link is followed, and stays. What is there but is no file, such as `/dev/stdout`, a pipe or a terminal, is written to and
/// never replaced; it too gets everything or, when `fill` fails, nothing.
///
/// # Errors
/// [`WriteError`].
pub fn write_file(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    match fs::metadata(path) {
        Ok(place) if place.is_dir() => {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(WriteError::File { path: path.into(), source });
        }
        Ok(place) if !place.is_file() => return fill_device(path, fill),
        Ok(_) => {}
        // Nothing is there yet, or a link to nothing, which becomes a file.
        Err(_) => return write_beside(path, path, fill),
    }
    let file = fs::canonicalize(path).map_err(|source| WriteError::File { path: path.into(), source })?;
    write_beside(&file, path, fill)
}

/// Hands over to a device or pipe at once what `fill` wrote.
fn fill_device(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let write = || {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        File::options().append(true).open(path)?.write_all(&bytes)
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

/// Writes beside `file`, and renames; errors name `path`.
fn write_beside(
    file: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let Some(name) = file.file_name() else {
        return Err(WriteError::Name { name: path.into() });
    };
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let staging = stage_in(folder)?;
    let staged = staging.path().join(name);
    fill_file(&staged, path, fill)?;
    rename(&staged, file)
}

/// A folder for what will be renamed, on the same file system because it lies within the target's folder. It goes away when dropped.
fn stage_in(folder: &Path) -> Result<TempDir, WriteError> {
    let made = tempfile::Builder::new().prefix(".crossbar-").tempdir_in(folder);
    made.map_err(|source| WriteError::Folder { path: folder.into(), source })
}

/// Writes the file at `staged`; errors name `path`.
fn fill_file(
    staged: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let write = || {
        let mut out = BufWriter::new(File::create(staged)?);
        fill(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

fn rename(staged: &Path, path: &Path) -> Result<(), WriteError> {
    fs::rename(staged, path).map_err(|source| WriteError::File { path: path.into(), source })
}

/// Several files that appear together: [`FileSet::commit`] renames them into their folder once all are written. Dropped
/// without it, it leaves nothing behind, not even folders that it made.
#[derive(Debug)]
pub struct FileSet {
    folder: PathBuf,
    /// Folders that did not exist before, outermost first.
    made: Vec<PathBuf>,
    /// `None` once committed.
    staging: Option<TempDir>,
    names: Vec<PathBuf>,
}

impl FileSet {
    /// A set for `folder`, which is made if it is missing. Made before long work, it finds out early that nothing can be
    /// written there.
    ///
    /// # Errors
    /// [`WriteError::Folder`].
    pub fn new(folder: &Path) -> Result<Self, WriteError> {
        let mut made = missing_folders(folder);
        made.reverse();
        let mut set = Self { folder: folder.into(), made, staging: None, names: Vec::new() };
        fs::create_dir_all(folder).map_err(|source| WriteError::Folder { path: folder.into(), source })?;
        set.staging = Some(stage_in(folder)?);
        Ok(set)
    }

    /// Where the file `name` (relative, without `..`) is to be written now, for writers that want a path.
    ///
    /// # Errors
    /// [`WriteError::Name`] for a name that leaves the folder, [`WriteError::File`] when its subfolder cannot be made.
    pub fn stage(&mut self, name: &Path) -> Result<PathBuf, WriteError> {
        let plain = name.components().all(|part| matches!(part, Component::Normal(_)));
        let (true, Some(staging), Some(_)) = (plain, &self.staging, name.file_name()) else {
            return Err(WriteError::Name { name: name.into() });
        };
        let staged = staging.path().join(name);
        if let Some(parent) = staged.parent() {
            let path = || self.folder.join(name);
            fs::create_dir_all(parent).map_err(|source| WriteError::File { path: path(), source })?;
        }
        if !self.names.iter().any(|known| known == name) {
            self.names.push(name.into());
        }
        Ok(staged)
    }

    /// Writes the file `name` through `fill`.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn write(
        &mut self,
        name: &Path,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let staged = self.stage(name)?;
        fill_file(&staged, &self.folder.join(name), fill)
    }

    /// Puts all files in their places and returns these, in the order of staging. What can fail (a file that was
    /// staged but not written, a place taken by a folder, a subfolder that cannot be made) is looked at before the first rename.
    ///
    /// # Errors
    /// [`WriteError`]; unless a rename itself fails, nothing has then appeared.
    pub fn commit(mut self) -> Result<Vec<PathBuf>, WriteError> {
        let Some(staging) = self.staging.take() else { return Ok(Vec::new()) };
        let places: Vec<(PathBuf, PathBuf)> =
            self.names.iter().map(|name| (staging.path().join(name), self.folder.join(name))).collect();
        for (staged, place) in &places {
            let fail = |source| WriteError::File { path: place.clone(), source };
            fs::metadata(staged).map_err(fail)?;
            if place.is_dir() {
                return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
            }
        }
        for folder in places.iter().filter_map(|(_, place)| place.parent()) {
            let missing = missing_folders(folder);
            self.made.extend(missing.into_iter().rev());
            fs::create_dir_all(folder).map_err(|source| WriteError::Folder { path: folder.into(), source })?;
        }
        for (staged, place) in &places {
            rename(staged, place)?;
        }
        self.made.clear();
        Ok(places.into_iter().map(|(_, place)| place).collect())
    }
}

impl Drop for FileSet {
    fn drop(&mut self) {
        // The staging folder lies within those that were made.
        self.staging = None;
        for folder in self.made.iter().rev() {
            // It fails, as it should, where something else has come in meanwhile.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// The folders that must be made for `folder` to exist, innermost first.
fn missing_folders(folder: &Path) -> Vec<PathBuf> {
    let missing = folder.ancestors().take_while(|path| *path != Path::new("") && !path.exists());
    missing.map(Path::to_path_buf).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.txt");
        write_file(&path, |out| out.write_all(b"old")).expect("written");
        let failed = write_file(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(failed.unwrap_err().to_string(), format!("cannot write {}", path.display()));
        assert_eq!(fs::read(&path).expect("read"), b"old");
        assert_eq!(listing(folder.path()), ["a.txt"]);
        write_file(&path, |out| out.write_all(b"new")).expect("written");
        assert_eq!(fs::read(&path).expect("read"), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_device_a_device() {
        use std::os::unix::fs::{FileTypeExt as _, symlink};
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, b"old").expect("written");
        symlink(&file, &link).expect("linked");
        write_file(&link, |out| out.write_all(b"new")).expect("written");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink(), "the link still stands");
        assert_eq!(fs::read(&file).expect("read"), b"new");
        assert_eq!(listing(folder.path()), ["file", "link"]);

        // A link of our own, so that a failure here does no harm to the machine.
        let null = folder.path().join("null");
        symlink("/dev/null", &null).expect("linked");
        write_file(&null, |out| out.write_all(b"gone")).expect("written");
        assert!(fs::metadata(&null).expect("there").file_type().is_char_device(), "the device still stands");
        let full = folder.path().join("full");
        symlink("/dev/full", &full).expect("linked");
        if full.exists() {
            assert!(matches!(write_file(&full, |out| out.write_all(b"x")), Err(WriteError::File { .. })), "no room");
        }
        assert!(matches!(write_file(folder.path(), |_| Ok(())), Err(WriteError::File { .. })), "a folder");
    }

    #[test]
    fn a_set_appears_whole_or_not_at_all() {
        let root = tempfile::tempdir().expect("a folder");
        let folder = root.path().join("deep/out");
        let mut set = FileSet::new(&folder).expect("a set");
        set.write(Path::new("a.txt"), |out| out.write_all(b"a")).expect("written");
        drop(set);
        assert!(listing(root.path()).is_empty(), "dropped, it leaves nothing");

        let mut set = FileSet::new(&folder).expect("a set");
        set.write(Path::new("a.txt"), |out| out.write_all(b"a")).expect("written");
        set.write(Path::new("sub/b.txt"), |out| out.write_all(b"b")).expect("written");
        assert!(!folder.join("a.txt").exists());
        assert_eq!(set.commit().expect("places"), [folder.join("a.txt"), folder.join("sub/b.txt")]);
        assert_eq!(
            (listing(&folder), listing(&folder.join("sub"))),
            (vec!["a.txt".into(), "sub".into()], vec!["b.txt".into()])
        );
    }

    #[test]
    fn a_place_taken_by_a_folder_stops_the_whole_set() {
        let root = tempfile::tempdir().expect("a folder");
        fs::create_dir(root.path().join("b")).expect("made");
        let mut set = FileSet::new(root.path()).expect("a set");
        set.write(Path::new("a"), |out| out.write_all(b"a")).expect("written");
        set.write(Path::new("b"), |out| out.write_all(b"b")).expect("written");
        assert!(matches!(set.commit(), Err(WriteError::File { .. })));
        assert_eq!(listing(root.path()), ["b"]);
    }

    #[test]
    fn names_stay_below_the_folder() {
        let root = tempfile::tempdir().expect("a folder");
        let mut set = FileSet::new(root.path()).expect("a set");
        for name in ["../x", "/x", ""] {
            assert!(matches!(set.stage(Path::new(name)), Err(WriteError::Name { .. })), "{name}");
        }
        let file = root.path().join("file");
        fs::write(&file, b"").expect("written");
        assert!(matches!(FileSet::new(&file), Err(WriteError::Folder { .. })));
        assert!(matches!(write_file(&file.join("x"), |_| Ok(())), Err(WriteError::Folder { .. })));
    }
}
