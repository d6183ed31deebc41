//! STL, binary and ASCII, through stl_io.
//!
//! Triangles are in the order of the file; corners with the same position, bit for bit, become one vertex. The file's
//! normals, which are those of the triangles, are ignored, as are colors. Binary data are recognised by their length,
//! because some begin with the word `solid` of the ASCII format.

use std::io::Cursor;
use std::path::Path;

use super::error::{FilePlace, ModelError};
use super::obj::{load_model, within_limit};
use crate::geom::mesh::{Mesh, Welder};

/// Bytes before the triangles of binary data: a header, and their number.
const HEAD: usize = 84;
/// Bytes per triangle: twelve numbers, and an attribute.
const TRIANGLE: usize = 50;

/// Reads a mesh from a file.
///
/// # Errors
/// [`ModelError`], with the path.
pub fn load_stl(path: &Path) -> Result<Mesh, ModelError> {
    parse_stl(&load_model(path)?, path)
}

/// Reads a mesh from bytes; `name` is the file's name in messages. Never panics, and allocates memory in proportion to
/// the file's length only.
///
/// # Errors
/// [`ModelError`].
pub fn parse_stl(bytes: &[u8], name: &Path) -> Result<Mesh, ModelError> {
    within_limit(bytes, name)?;
    let syntax = |expected: &'static str, found: String| ModelError::Syntax {
        place: FilePlace::from(name),
        expected: expected.into(),
        found,
    };
    let mut bytes = bytes.to_vec();
    let claimed = claimed_length(&bytes);
    if claimed == Some(bytes.len() as u64) {
        // stl_io takes data that begin with `solid` for ASCII; the header has no meaning otherwise.
        bytes[..5].fill(0);
    } else if !bytes.trim_ascii_start().starts_with(b"solid") {
        let expected = "an STL file: `solid`, or binary data of the length that they claim";
        let found = match claimed {
            Some(claimed) => format!("{} bytes of {claimed}", bytes.len()),
            None => format!("{} bytes", bytes.len()),
        };
        return Err(syntax(expected, found));
    }
    let broken = |error: std::io::Error| syntax("an STL file", format!("one that stl_io refuses: {error}"));
    let mut file = Cursor::new(bytes);
    let (mut welder, mut triangles) = (Welder::default(), Vec::new());
    for triangle in stl_io::create_stl_reader(&mut file).map_err(broken)? {
        let corners = triangle.map_err(broken)?.vertices.map(|corner| corner.0);
        triangles.push(corners.map(|corner| welder.vertex(corner)));
    }
    if triangles.is_empty() {
        return Err(syntax("at least one triangle", "none".to_owned()));
    }
    Mesh::new(welder.into_positions(), triangles).map_err(|reason| ModelError::Mesh(name.into(), reason))
}

/// True for the contents of an STL file: binary data with the length that they state, or text that begins as ASCII STL.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    bytes.starts_with(b"solid ") || claimed_length(bytes) == Some(bytes.len() as u64)
}

/// The length of binary data as their head states it.
fn claimed_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEAD - 4..HEAD)?.try_into().ok()?;
    Some(HEAD as u64 + TRIANGLE as u64 * u64::from(u32::from_le_bytes(count)))
}
