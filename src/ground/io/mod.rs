//! Input and output of files: models, scenes, pictures, rays and hits; writing is atomic, so that no partial file is
//! left. [`scenes`] are the scenes of this project.

mod atomic;
pub mod cube_map;
pub mod error;
mod faces;
pub mod gltf;
mod headed_table;
pub mod light_sources;
mod lines;
pub mod matrix_market;
pub mod model;
pub mod model_note;
pub mod npy;
pub mod npz;
mod number;
pub mod number_table;
pub mod obj;
pub mod picture;
pub mod ply;
pub mod rays;
pub mod scene_file;
pub mod scene_obj;
pub mod scenes;
pub mod stl;

pub use crate::error::FilePlace;
pub use atomic::{WriteError, protect_inputs, require_writable, write_file, write_files};
pub use cube_map::{load_cube_table, parse_cube_table, write_cube_table};
pub use error::read_file;
pub use gltf::parse_gltf;
pub use light_sources::{LightSourceRow, load_light_sources, parse_light_sources};
pub use matrix_market::{CoordinateMatrix, load_matrix_market, parse_matrix_market, write_matrix_market};
pub use model::{ModelOptions, UpAxis, load_mesh, load_mesh_with, load_scene, load_scene_with};
pub use model_note::ModelNote;
pub use npy::{
    NumberArray, NumbersOrCodes, load_npy_array, load_numbers, load_numbers_or_codes, parse_npy_array, parse_numbers,
    write_npy_array, write_npy_doubles,
};
pub use npz::{NpzReader, NpzWriter};
pub use number::{NumberError, parse_f32, parse_f64, to_f32};
pub use number_table::{NumberTable, TableNumber, parse_number_table};
pub use obj::{parse_obj, write_obj};
pub use picture::load_picture;
pub use ply::parse_ply;
pub use rays::{load_rays, parse_rays, write_hits};
pub use scene_file::{scene_files, write_scene_file};
pub use scene_obj::{parse_mtl, parse_scene, write_mtl, write_scene};
pub use stl::parse_stl;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest number of bytes read from a device (1 MiB), which may be endless. Files and pipes have limits by file
/// format.
const MAX_DEVICE_BYTES: u64 = 1 << 20;

#[cfg(unix)]
fn is_device(kind: &std::fs::FileType) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    kind.is_char_device() || kind.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: &std::fs::FileType) -> bool {
    false
}

/// The contents of a file of at most `limit` bytes, or `None` if it is longer. A device with more bytes is an error.
pub fn read_limited(path: &Path, limit: u64) -> io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    atomic::note_input(path);
    let is_device = file.metadata().is_ok_and(|found| is_device(&found.file_type()));
    let most = if is_device { limit.min(MAX_DEVICE_BYTES) } else { limit };
    let mut bytes = Vec::new();
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    let length = bytes.len() as u64;
    if is_device && length > MAX_DEVICE_BYTES {
        let what =
            format!("expected a file, or at most {MAX_DEVICE_BYTES} bytes of a device, found more: is it endless?");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, what));
    }
    Ok((length <= limit).then_some(bytes))
}

/// Invalid input as quoted in messages: [`visible`], cut to 40 characters.
fn quoted(text: &[u8]) -> String {
    format!("`{}`", visible(&String::from_utf8_lossy(text), 40))
}

/// The first `most` characters of a text, with hidden characters escaped; quotation marks stay.
fn visible(text: &str, most: usize) -> String {
    let more = if text.chars().nth(most).is_some() { "..." } else { "" };
    let cut: String = text.chars().take(most).collect();
    // A quotation mark follows its own backslash only.
    cut.escape_debug().to_string().replace("\\\"", "\"").replace("\\'", "'") + more
}
