//! Which mesh a file belongs to.

use std::fmt;

use crate::geom::Mesh;

/// A mesh's counts and checksums. Meshes of other positions, normals, texture coordinates or triangles, or of the same
/// in another order, have other digests, but for one in 2^32.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshDigest {
    /// Number of vertices.
    pub vertices: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// CRC-32 of positions, normals and texture coordinates as little-endian f32, all of one after all of another.
    pub vertex_crc: u32,
    /// CRC-32 of the triangles' corners as little-endian u32.
    pub triangle_crc: u32,
}

impl MeshDigest {
    /// Of a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let (mut vertex, mut triangle) = (crc32fast::Hasher::new(), crc32fast::Hasher::new());
        let mut add = |values: &[f32]| values.iter().for_each(|value| vertex.update(&value.to_le_bytes()));
        add(mesh.positions().as_flattened());
        add(mesh.normals().unwrap_or_default().as_flattened());
        add(mesh.texcoords().unwrap_or_default().as_flattened());
        mesh.triangles().as_flattened().iter().for_each(|corner| triangle.update(&corner.to_le_bytes()));
        Self {
            vertices: mesh.positions().len() as u32,
            triangles: mesh.len() as u32,
            vertex_crc: vertex.finalize(),
            triangle_crc: triangle.finalize(),
        }
    }
}

impl fmt::Display for MeshDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { vertices, triangles, vertex_crc, triangle_crc } = self;
        write!(f, "{vertices} vertices ({vertex_crc:08x}) and {triangles} triangles ({triangle_crc:08x})")
    }
}
