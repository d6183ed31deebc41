//! Picture files: PNG, Radiance HDR and OpenEXR.

use std::path::{Path, PathBuf};

use super::error::read_file;
use crate::error::InputError;
use crate::picture::{Picture, PictureSize};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

fn decode_error(path: &Path, reason: InputError) -> InputError {
    reason.coded("").at(path)
}

/// A picture file with a parsed header and undecoded pixels.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    bytes: Vec<u8>,
    size: PictureSize,
}

impl PictureFile {
    /// Reads a file; its first bytes, not its name, determine the format.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let bytes = read_file(path, "picture", MAX_BYTES)?;
        match PictureSize::of(&bytes) {
            Ok(size) => Ok(Self { path: path.into(), bytes, size }),
            Err(reason) => Err(decode_error(path, reason)),
        }
    }

    /// The size that the header states.
    pub const fn size(&self) -> PictureSize {
        self.size
    }

    /// The picture.
    pub fn decode(&self) -> Result<Picture, InputError> {
        Picture::decode(&self.bytes).map_err(|reason| decode_error(&self.path, reason))
    }
}
