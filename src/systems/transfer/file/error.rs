//! Errors of reading files of transfer.

use std::path::PathBuf;

use thiserror::Error;

use super::{MeshDigest, PrtKind};
use crate::io::{NpzError, ReadError};

/// Errors of reading files of transfer.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PrtFileError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// It is no archive of arrays, or of arrays that make no transfer.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Arrays(#[from] NpzError),
    /// It belongs to another system.
    #[error("{}: expected a file of {expected}, found one of {found}", path.display())]
    #[diagnostic(code(crossbar::prt::kind), help("`crossbar {}` takes it", found.command()))]
    OtherKind { path: PathBuf, expected: PrtKind, found: PrtKind },
    /// It belongs to another mesh.
    #[error("{}: expected transfer of a mesh with {expected}, found that of {}", path.display(),
        found.map_or_else(|| "no mesh".to_owned(), |found| found.to_string()))]
    #[diagnostic(
        code(crossbar::prt::mesh),
        help("name the model that it was made from, or make it anew with `precompute`")
    )]
    OtherMesh { path: PathBuf, expected: MeshDigest, found: Option<MeshDigest> },
}
