//! Picture files: PNG, Radiance HDR and OpenEXR.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::read_limited;
use crate::picture::{Picture, PictureError};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// Why a file is no picture.
#[derive(Debug, Error, miette::Diagnostic)]
pub enum PictureFileError {
    /// The file cannot be opened or read.
    #[error("cannot read the picture {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is longer than [`MAX_BYTES`].
    #[error("{}: expected a picture of at most {MAX_BYTES} bytes, found more", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
    },
    /// The bytes are no picture.
    #[error("{}: {reason}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: PictureError,
    },
}

/// Reads a picture; its first bytes say in which format, whatever the file's name.
///
/// # Errors
/// [`PictureFileError`], with the path.
pub fn load_picture(path: &Path) -> Result<Picture, PictureFileError> {
    let bytes = read_limited(path, MAX_BYTES)
        .map_err(|source| PictureFileError::Read { path: path.into(), source })?
        .ok_or_else(|| PictureFileError::TooLong { path: path.into() })?;
    Picture::decode(&bytes).map_err(|reason| PictureFileError::Decode { path: path.into(), reason })
}
