//! Picture files: PNG, Radiance HDR and OpenEXR.

use std::path::Path;

use super::error::read_file;
use crate::error::InputError;
use crate::picture::Picture;

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 256 << 20;

/// Reads a picture; the file's first bytes, not its name, determine the format.
pub fn load_picture(path: &Path) -> Result<Picture, InputError> {
    Picture::decode(&read_file(path, "picture", MAX_BYTES)?).map_err(|reason| reason.coded("").at(path))
}
