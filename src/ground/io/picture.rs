//! Picture files: PNG, Radiance HDR and OpenEXR.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::error::{ReadError, read};
use crate::picture::{Picture, PictureError, PictureSize};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// Errors of reading a picture.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PictureFileError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// The bytes cannot be decoded.
    #[error("{}: {reason}", path.display())]
    Decode { path: PathBuf, reason: PictureError },
}

/// A picture file of which the header is known, and no pixel is decoded yet.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    bytes: Vec<u8>,
    size: PictureSize,
}

impl PictureFile {
    /// Reads a file; its first bytes say in which format, whatever its name.
    ///
    /// # Errors
    /// [`PictureFileError`], with the path, for what [`PictureSize::of`] refuses too.
    pub fn open(path: &Path) -> Result<Self, PictureFileError> {
        let bytes = read(path, "picture", MAX_BYTES)?;
        match PictureSize::of(&bytes) {
            Ok(size) => Ok(Self { path: path.into(), bytes, size }),
            Err(reason) => Err(PictureFileError::Decode { path: path.into(), reason }),
        }
    }

    /// The size that the header states.
    pub const fn size(&self) -> PictureSize {
        self.size
    }

    /// The picture.
    ///
    /// # Errors
    /// [`PictureFileError::Decode`].
    pub fn decode(&self) -> Result<Picture, PictureFileError> {
        Picture::decode(&self.bytes).map_err(|reason| PictureFileError::Decode { path: self.path.clone(), reason })
    }
}

/// Reads a picture; its first bytes say in which format, whatever the file's name.
///
/// # Errors
/// [`PictureFileError`], with the path.
pub fn load_picture(path: &Path) -> Result<Picture, PictureFileError> {
    PictureFile::open(path)?.decode()
}
