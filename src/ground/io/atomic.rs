//! Atomic writes: a file is written beside its place, then renamed into it. A killed process leaves `.crossbar-XXXXXX`
//! behind at most.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

/// Errors of writing files.
#[non_exhaustive]
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
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
/// unchanged.
///
/// A link is followed and kept. An existing path that is not a regular file, such as `/dev/stdout`, a pipe or a
/// terminal, is written to and never replaced; if `fill` fails, nothing is written to it.
pub fn write_file(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    let fail = |source| WriteError::File { path: path.into(), source };
    match fs::metadata(path) {
        Ok(place) if place.is_dir() => Err(fail(io::ErrorKind::IsADirectory.into())),
        Ok(place) if !place.is_file() => fill_device(path, fill).map_err(fail),
        Ok(_) => write_beside(&fs::canonicalize(path).map_err(fail)?, path, fill),
        // There is no file yet, or a dangling link, which a file replaces.
        Err(_) => write_beside(path, path, fill),
    }
}

/// Writes the output of `fill` to a device or pipe at once.
fn fill_device(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut bytes = Vec::new();
    fill(&mut bytes)?;
    File::options().append(true).open(path)?.write_all(&bytes)
}

/// Writes beside `file`, and renames; errors name `path`.
fn write_beside(
    file: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else {
        return Err(WriteError::Name { name: path.into() });
    };
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let beside = || {
        fs::create_dir_all(folder).map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => io::ErrorKind::NotADirectory.into(),
            _ => error,
        })?;
        tempfile::Builder::new().prefix(".crossbar-").tempdir_in(folder)
    };
    let beside = beside().map_err(|source| WriteError::Folder { path: folder.into(), source })?;
    let write = || {
        let staged = beside.path().join(name);
        let mut out = BufWriter::new(File::create(&staged)?);
        fill(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()?;
        fs::rename(staged, file)
    };
    write().map_err(|source| WriteError::File { path: path.into(), source })
}

/// Checks before long work that files can be written into a folder, or into the folder in which it is to be created.
/// Nothing is created.
pub fn require_writable(folder: &Path) -> Result<(), WriteError> {
    let there = folder.ancestors().find(|path| path.exists()).unwrap_or(Path::new("."));
    tempfile::tempfile_in(there).map(drop).map_err(|source| WriteError::Folder { path: folder.into(), source })
}

/// Writes files into a folder, one after the other, and returns their places. Fails before the first one for a name
/// that leaves the folder.
pub fn write_files(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Vec<PathBuf>, WriteError> {
    let is_plain =
        |name: &Path| name.file_name().is_some() && name.components().all(|part| matches!(part, Component::Normal(_)));
    if let Some((name, _)) = files.iter().find(|(name, _)| !is_plain(Path::new(name))) {
        return Err(WriteError::Name { name: name.into() });
    }
    let write = |(name, bytes): &(String, Vec<u8>)| {
        let place = folder.join(name);
        write_file(&place, |out| out.write_all(bytes)).map(|()| place)
    };
    files.iter().map(write).collect()
}
