//! Atomic writes: a file is written beside its place, then renamed into it. A killed process leaves at most
//! `.crossbar-XXXXXX` behind.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use tempfile::TempDir;
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
    /// The file was read by this process, and its inputs are protected ([`protect_inputs`]).
    #[error("cannot write {}: the command reads this file; choose another place", path.display())]
    Input { path: PathBuf },
    /// The name is not a plain path below the folder.
    #[error("expected the name of a file below the output folder, found {}", name.display())]
    Name { name: PathBuf },
}

/// Canonical paths of the files that were read since [`protect_inputs`].
static INPUTS: OnceLock<Mutex<BTreeSet<PathBuf>>> = OnceLock::new();

/// From now on, this process does not overwrite files that it has read through [`super::read_limited`]. For a program
/// of one command, which checks before its work the files that its arguments name.
pub fn protect_inputs() {
    INPUTS.get_or_init(Mutex::default);
}

/// Notes that a file was read, if inputs are protected.
pub(super) fn note_input(path: &Path) {
    if let Some((inputs, path)) = INPUTS.get().zip(fs::canonicalize(path).ok()) {
        inputs.lock().unwrap_or_else(PoisonError::into_inner).insert(path);
    }
}

fn is_input(place: &Path) -> bool {
    INPUTS.get().is_some_and(|inputs| inputs.lock().unwrap_or_else(PoisonError::into_inner).contains(place))
}

/// Writes one file through `fill`, and creates missing folders of its path. On any error the file at `path` is
/// unchanged.
///
/// A link is followed and kept. An existing path that is not a regular file, such as `/dev/stdout`, a pipe or a
/// terminal, is written to and never replaced; if `fill` fails, nothing is written to it.
pub fn write_file(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    Written::new(path, fill)?.put(path)
}

/// Output before it is in its place.
enum Written {
    /// A file of the same name in a folder beside the place.
    File(TempDir, PathBuf),
    /// The bytes for a device or pipe, which are written at once.
    Device(Vec<u8>),
}

impl Written {
    fn new(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Self, WriteError> {
        let fail = |source| WriteError::File { path: path.into(), source };
        let place = match fs::metadata(path) {
            Ok(place) if place.is_dir() => return Err(fail(io::ErrorKind::IsADirectory.into())),
            Ok(place) if !place.is_file() => {
                let mut bytes = Vec::new();
                fill(&mut bytes).map_err(fail)?;
                return Ok(Self::Device(bytes));
            }
            Ok(_) => match fs::canonicalize(path).map_err(fail)? {
                place if is_input(&place) => return Err(WriteError::Input { path: path.into() }),
                place => place,
            },
            // There is no file yet, or a dangling link, which a file replaces.
            Err(_) => path.into(),
        };
        let (Some(folder), Some(name)) = (place.parent(), place.file_name()) else {
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
            let mut out = BufWriter::new(File::create(beside.path().join(name))?);
            fill(&mut out)?;
            out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
        };
        write().map_err(fail)?;
        Ok(Self::File(beside, place))
    }

    fn put(self, path: &Path) -> Result<(), WriteError> {
        let put = match &self {
            Self::File(beside, place) => fs::rename(beside.path().join(place.file_name().unwrap_or_default()), place),
            Self::Device(bytes) => File::options().append(true).open(path).and_then(|mut to| to.write_all(bytes)),
        };
        put.map_err(|source| WriteError::File { path: path.into(), source })
    }
}

/// Checks before long work that files can be written into a folder, or into the folder in which it is to be created.
/// Nothing is created.
pub fn require_writable(folder: &Path) -> Result<(), WriteError> {
    let there = folder.ancestors().find(|path| path.exists()).unwrap_or(Path::new("."));
    tempfile::tempfile_in(there).map(drop).map_err(|source| WriteError::Folder { path: folder.into(), source })
}

/// Writes files into a folder, and returns their places. All are written beside their places before the first is put
/// there, so that a failed write leaves the folder as it was. A name that leaves the folder is refused before anything
/// is written.
pub fn write_files(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<Vec<PathBuf>, WriteError> {
    let is_plain =
        |name: &Path| name.file_name().is_some() && name.components().all(|part| matches!(part, Component::Normal(_)));
    if let Some((name, _)) = files.iter().find(|(name, _)| !is_plain(Path::new(name))) {
        return Err(WriteError::Name { name: name.into() });
    }
    let places: Vec<PathBuf> = files.iter().map(|(name, _)| folder.join(name)).collect();
    let write = |(place, (_, bytes)): (&PathBuf, &(String, Vec<u8>))| Written::new(place, |out| out.write_all(bytes));
    let written: Vec<Written> = places.iter().zip(files).map(write).collect::<Result<_, _>>()?;
    written.into_iter().zip(&places).try_for_each(|(written, place)| written.put(place))?;
    Ok(places)
}
