//! Identification of the mesh that a file belongs to.

use std::fmt;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::{InputError, input_error};
use crate::transfer::{LocalFrame, Tangents, Vertices};

/// Counts and checksums of the vertices at which transfer is computed. Meshes with different positions, normals,
/// tangents or triangles, or a different order, have different digests except with probability 2^-32.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshDigest {
    /// The source of the tangents.
    pub tangents: Tangents,
    /// Number of vertices.
    pub vertices: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// CRC-32 of all positions as little-endian f32, then all normals, then all tangents, as little-endian f64.
    pub vertex_crc: u32,
    /// CRC-32 of the triangles' corners as little-endian u32.
    pub triangle_crc: u32,
}

impl MeshDigest {
    /// The digest of a mesh's vertices.
    pub fn new(vertices: &Vertices) -> Self {
        let (mut vertex, mut triangle) = (crc32fast::Hasher::new(), crc32fast::Hasher::new());
        vertices.positions().as_flattened().iter().for_each(|value| vertex.update(&value.to_le_bytes()));
        for axis in [LocalFrame::normal, LocalFrame::tangent] {
            let values = vertices.frames().iter().flat_map(|frame| axis(frame).to_array());
            values.for_each(|value| vertex.update(&value.to_le_bytes()));
        }
        vertices.triangles().as_flattened().iter().for_each(|corner| triangle.update(&corner.to_le_bytes()));
        Self {
            tangents: vertices.tangents(),
            vertices: vertices.len() as u32,
            triangles: vertices.triangles().len() as u32,
            vertex_crc: vertex.finalize(),
            triangle_crc: triangle.finalize(),
        }
    }
}

impl fmt::Display for MeshDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tangents, vertices, triangles, vertex_crc, triangle_crc } = self;
        write!(f, "{vertices} vertices ({vertex_crc:08x}) and {triangles} triangles ({triangle_crc:08x}), ")?;
        match tangents {
            Tangents::Any => f.write_str("any tangents"),
            Tangents::Texture => f.write_str("tangents from texture coordinates"),
            Tangents::Along(_) => write!(f, "tangents along {tangents}"),
        }
    }
}

/// Checks that a file's mesh `found` is `expected`, with the same tangents; the message names `path`.
pub fn require_mesh(path: &Path, expected: &MeshDigest, found: Option<MeshDigest>) -> Result<(), InputError> {
    if found.as_ref() == Some(expected) {
        return Ok(());
    }
    Err(input_error!("crossbar::prt::mesh" =>
        "expected transfer of a mesh with {expected}, found that of {}",
        found.map_or_else(|| "no mesh".to_owned(), |found| found.to_string());
        help "give the model from which it was computed, or compute it again with `precompute`")
    .at(path))
}
