//! Errors of reading `.prt` files.

use std::path::PathBuf;

use thiserror::Error;

use super::{MeshDigest, PrtKind};
use crate::io::ReadError;
use crate::transfer::SignalError;
use crate::transfer::clustering::ClusteringError;

/// Errors of reading `.prt` files. Offsets are in bytes from 0.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PrtFileError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// It does not begin as such a file.
    #[error("{}: expected a .prt file, found another beginning", path.display())]
    #[diagnostic(code(crossbar::prt::magic), help("is it a .prt file, and copied as one?"))]
    Magic { path: PathBuf },
    /// It belongs to another system.
    #[error("{}: expected a file of {expected}, found one of {found}", path.display())]
    #[diagnostic(code(crossbar::prt::kind), help("`crossbar {}` takes it", found.command()))]
    OtherKind { path: PathBuf, expected: PrtKind, found: PrtKind },
    /// It is of a version that is not known.
    #[error("{}: expected a .prt file of version 1 to {most}, found version {found}", path.display())]
    #[diagnostic(
        code(crossbar::prt::version),
        help("a newer crossbar has written it: use that one, or write it again")
    )]
    Version { path: PathBuf, most: u32, found: u32 },
    /// It ends too early.
    #[error("{}: expected {needed} bytes of {what} at {offset}, found {found}", path.display())]
    #[diagnostic(code(crossbar::prt::truncated), help("the file is cut; copy or write it again"))]
    Truncated { path: PathBuf, what: &'static str, offset: usize, needed: u64, found: usize },
    /// Bytes behind the last part.
    #[error("{}: expected the end of the file at {offset}, found {found} more bytes", path.display())]
    #[diagnostic(code(crossbar::prt::trailing), help("the file is damaged; copy or write it again"))]
    Trailing { path: PathBuf, offset: usize, found: usize },
    /// A part was changed after it was written.
    #[error("{}: {what} at {offset}: expected the checksum {expected:08x}, found {found:08x}", path.display())]
    #[diagnostic(code(crossbar::prt::checksum), help("the file is damaged; copy or write it again"))]
    Checksum { path: PathBuf, what: &'static str, offset: usize, expected: u32, found: u32 },
    /// A part with an invalid value.
    #[error("{}: {field}: expected {expected}, found {found}", path.display())]
    #[diagnostic(code(crossbar::prt::field), help("docs/prt-format.md says what belongs there"))]
    Field { path: PathBuf, field: &'static str, expected: String, found: String },
    /// The transfer makes no signal.
    #[error("{}: {reason}", path.display())]
    #[diagnostic(code(crossbar::prt::transfer))]
    Transfer { path: PathBuf, reason: SignalError },
    /// The clusters contradict each other.
    #[error("{}: {reason}", path.display())]
    #[diagnostic(code(crossbar::prt::clustering))]
    Clustering { path: PathBuf, reason: ClusteringError },
    /// It belongs to another mesh.
    #[error("{}: expected transfer of a mesh with {expected}, found that of {}", path.display(),
        found.map_or_else(|| "no mesh".to_owned(), |found| found.to_string()))]
    #[diagnostic(
        code(crossbar::prt::mesh),
        help("name the model that it was made from, or make it anew with `precompute`")
    )]
    OtherMesh { path: PathBuf, expected: MeshDigest, found: Option<MeshDigest> },
}
