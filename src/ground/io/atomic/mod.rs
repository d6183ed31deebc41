//! Atomic writes: a file is written to a staging folder next to its destination, then renamed.

mod staging;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use self::staging::Staging;
pub use self::staging::abandon;

/// Errors of writing files.
#[non_exhaustive]
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum WriteError {
    /// The folder cannot be made, or nothing can be written in it.
    #[error("cannot write into the folder {}; choose another folder, or make it writable", path.display())]
    Folder { path: PathBuf, source: io::Error },
    /// The file cannot be written.
    #[error("cannot write {}", path.display())]
    File { path: PathBuf, source: io::Error },
    /// The name is not a plain path below the folder.
    #[error("expected the name of a file below the output folder, found {}", name.display())]
    Name { name: PathBuf },
}

/// Writes one file through `fill`, and creates missing folders of its path. On any error the file at `path` is
/// unchanged, and no folder was created.
///
/// A link is followed and kept. An existing path that is not a regular file, such as `/dev/stdout`, a pipe or a
/// terminal, is written to and never replaced; if `fill` fails, nothing is written to it.
pub fn write_file(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    match fs::metadata(path) {
        Ok(place) if place.is_dir() => {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(WriteError::File { path: path.into(), source });
        }
        Ok(place) if !place.is_file() => return fill_device(path, fill),
        Ok(_) => {}
        // There is no file yet, or a dangling link, which a file replaces.
        Err(_) => return write_beside(path, path, fill),
    }
    let file = fs::canonicalize(path).map_err(|source| WriteError::File { path: path.into(), source })?;
    write_beside(&file, path, fill)
}

/// Writes the output of `fill` to a device or pipe at once.
fn fill_device(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let write = || {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        File::options().append(true).open(path)?.write_all(&bytes)
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

/// Writes to a staging folder next to `file`, then renames; errors name `path`. Missing folders are created.
fn write_beside(
    file: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else {
        return Err(WriteError::Name { name: path.into() });
    };
    let mut set = FileSet::new(folder)?;
    let staged = set.stage(name.as_ref())?;
    fill_file(&staged, path, fill)?;
    set.commit()?;
    Ok(())
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

/// Several files that appear together in one folder, when [`FileSet::commit`] is called. If the set is dropped without
/// a commit, no files remain.
///
/// A folder that was missing appears by one rename, with all its files. In an existing folder the files are renamed one
/// after another, because programs may use the folder, and it may hold other files. A lock on the folder serialises the
/// renames of two processes. A process that is killed between renames leaves old files beside new ones, and the
/// remaining files in `.crossbar-XXXXXX`.
#[derive(Debug)]
pub struct FileSet {
    /// The folder as given.
    folder: PathBuf,
    /// The innermost existing folder on the path.
    base: PathBuf,
    /// The path from `base` to the folder: empty if the folder exists.
    rest: PathBuf,
    staging: Staging,
    names: Vec<PathBuf>,
}

impl FileSet {
    /// A set for `folder`. Created before long work, it detects early that the folder is not writable. Fails with
    /// [`WriteError::Folder`].
    pub fn new(folder: &Path) -> Result<Self, WriteError> {
        let fail = |source| WriteError::Folder { path: folder.into(), source };
        let (base, rest) = split(folder);
        if let Some(first) = rest.iter().next()
            && base.join(first).is_symlink()
        {
            return Err(fail(io::Error::new(io::ErrorKind::NotFound, "a link leads nowhere")));
        }
        let staging = Staging::within(&base).map_err(fail)?;
        let set = Self { folder: folder.into(), base, rest, staging, names: Vec::new() };
        fs::create_dir_all(set.staged(Path::new(""))).map_err(fail)?;
        Ok(set)
    }

    fn staged(&self, name: &Path) -> PathBuf {
        self.staging.path().join(&self.rest).join(name)
    }

    /// The staging path of the file `name`, which is relative and has no `..`.
    fn stage(&mut self, name: &Path) -> Result<PathBuf, WriteError> {
        let plain = name.components().all(|part| matches!(part, Component::Normal(_)));
        if !plain || name.file_name().is_none() {
            return Err(WriteError::Name { name: name.into() });
        }
        let staged = self.staged(name);
        if let Some(parent) = staged.parent() {
            let path = || self.folder.join(name);
            fs::create_dir_all(parent).map_err(|source| WriteError::File { path: path(), source })?;
        }
        if !self.names.iter().any(|known| known == name) {
            self.names.push(name.into());
        }
        Ok(staged)
    }

    /// Writes the file `name` through `fill`. Fails with [`WriteError::Name`] for a name that leaves the folder,
    /// [`WriteError::File`] when it cannot be written.
    pub fn write(
        &mut self,
        name: &Path,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let staged = self.stage(name)?;
        fill_file(&staged, &self.folder.join(name), fill)
    }

    /// Moves all files to their final paths and returns these paths in the order of staging. Likely failures (a file
    /// that was staged but not written, a path that is a folder, a subfolder that cannot be created) are checked before
    /// the first rename. Fails with [`WriteError`]; after an error, no file has been moved unless a rename itself
    /// failed.
    pub fn commit(self) -> Result<Vec<PathBuf>, WriteError> {
        let places: Vec<PathBuf> = self.names.iter().map(|name| self.folder.join(name)).collect();
        for (name, place) in self.names.iter().zip(&places) {
            let fail = |source| WriteError::File { path: place.clone(), source };
            fs::metadata(self.staged(name)).map_err(fail)?;
            if place.is_dir() {
                return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
            }
        }
        if let Some(first) = self.rest.iter().next() {
            let place = self.base.join(first);
            match self.staging.rename_folder(first.as_ref(), &place) {
                Ok(()) => return Ok(places),
                // Another process has created the folder meanwhile: move file by file.
                Err(_) if place.is_dir() => {}
                Err(source) => return Err(WriteError::Folder { path: self.folder.clone(), source }),
            }
        }
        let mut made = Vec::new();
        let moved = self.move_into_existing(&mut made);
        if moved.is_err() {
            // Removal fails, as it should, if another process has put a file in the folder.
            made.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
        }
        moved.map(|()| places)
    }

    /// Moves the files into the folder one by one; adds the folders that it creates to `made`.
    fn move_into_existing(&self, made: &mut Vec<PathBuf>) -> Result<(), WriteError> {
        // Paths begin at the base, because the folder's path as given may pass through missing folders.
        let folder = self.base.join(&self.rest);
        let parents = self.names.iter().filter_map(|name| Some(folder.join(name).parent()?.to_path_buf()));
        for parent in std::iter::once(folder.clone()).chain(parents) {
            made.extend(missing_folders(&parent).into_iter().rev());
            fs::create_dir_all(&parent).map_err(|source| WriteError::Folder { path: parent, source })?;
        }
        let renamed = self.staging.rename_files(&self.rest, &folder, &self.names);
        renamed.map_err(|(path, source)| WriteError::File { path, source })
    }
}

/// The innermost existing folder of the path `folder`, and the rest of the path as plain names. Missing parts cannot be
/// links, so that `..` after them has its literal meaning.
fn split(folder: &Path) -> (PathBuf, PathBuf) {
    let mut base = PathBuf::new();
    let mut rest = PathBuf::new();
    for part in folder.components() {
        match part {
            Component::Normal(name) if rest == Path::new("") && base.join(name).exists() => base.push(name),
            Component::Normal(name) => rest.push(name),
            Component::ParentDir if rest != Path::new("") => drop(rest.pop()),
            Component::CurDir => {}
            other => base.push(other),
        }
    }
    (if base == Path::new("") { ".".into() } else { base }, rest)
}

/// The missing folders of the path `folder`, innermost first.
fn missing_folders(folder: &Path) -> Vec<PathBuf> {
    let missing = folder.ancestors().take_while(|path| *path != Path::new("") && !path.exists());
    missing.map(Path::to_path_buf).collect()
}
