//! Picture files: PNG, Radiance HDR and OpenEXR.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::error::{ReadError, read};
use crate::picture::{Picture, PictureError};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// Why a file is no picture.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PictureFileError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// The bytes are no picture.
    #[error("{}: {reason}", path.display())]
    Decode { path: PathBuf, reason: PictureError },
}

/// Reads a picture; its first bytes say in which format, whatever the file's name.
///
/// # Errors
/// [`PictureFileError`], with the path.
pub fn load_picture(path: &Path) -> Result<Picture, PictureFileError> {
    let bytes = read(path, "picture", MAX_BYTES)?;
    Picture::decode(&bytes).map_err(|reason| PictureFileError::Decode { path: path.into(), reason })
}
