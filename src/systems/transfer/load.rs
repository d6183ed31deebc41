//! Signals from files.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::file::{self, MeshDigest, PrtFile, PrtFileError, PrtMeaning, parse_prt};
use super::{Signal, SignalError};
use crate::io::{NumbersError, ReadError, npz, number_table, parse_single_numbers, read_limited};

/// Errors of reading a signal.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SignalFileError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// It is a `.npz` file that cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Prt(#[from] PrtFileError),
    /// It is a `.npz` file of clusters alone.
    #[error("{}: expected transfer, found clusters alone", path.display())]
    #[diagnostic(code(crossbar::signal::compressed), help("name the file that it was compressed from"))]
    NoTransfer { path: PathBuf },
    /// It is an array of NumPy's or a table that cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Numbers(#[from] NumbersError),
    /// The numbers make no signal.
    #[error("{}: {reason}", path.display())]
    #[diagnostic(code(crossbar::signal::numbers))]
    Signal { path: PathBuf, reason: SignalError },
}

/// Reads a signal from a file: the transfer of a `.npz` file, a NumPy array, or comma-separated values, recognised by
/// the first bytes. Its numbers are f32, as transfer is stored.
///
/// # Errors
/// [`SignalFileError`].
pub fn load_signal(path: &Path) -> Result<Signal, SignalFileError> {
    load_signal_and_meaning(path).map(|(_, _, signal)| signal)
}

/// As [`load_signal`], with the meaning of the numbers, and the mesh whose vertices are the points.
///
/// # Errors
/// [`SignalFileError`].
pub fn load_signal_and_meaning(path: &Path) -> Result<(PrtMeaning, Option<MeshDigest>, Signal), SignalFileError> {
    let limit = file::MAX_BYTES.max(number_table::MAX_BYTES);
    let unreadable = |source| ReadError::Unreadable { what: "signal", path: path.into(), source };
    let bytes = read_limited(path, limit).map_err(unreadable)?;
    let bytes = bytes.ok_or_else(|| ReadError::TooLong { what: "signal", path: path.into(), limit })?;
    if bytes.starts_with(npz::MAGIC) {
        let PrtFile { meaning, mesh, transfer, .. } = parse_prt(&bytes, path)?;
        let signal = transfer.ok_or_else(|| SignalFileError::NoTransfer { path: path.into() })?;
        return Ok((meaning, mesh, signal));
    }
    let table = parse_single_numbers(&bytes, path)?;
    let meaning = PrtMeaning::Numbers { dimension: u32::try_from(table.columns).unwrap_or(u32::MAX) };
    let signal = Signal::new(table.columns, table.values);
    let signal = signal.map_err(|reason| SignalFileError::Signal { path: path.into(), reason })?;
    Ok((meaning, None, signal))
}
