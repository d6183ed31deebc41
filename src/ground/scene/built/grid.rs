//! Meshes from grids of vertices.

use crate::geom::Mesh;

/// Triangles of a grid of `columns` x `rows` quads whose vertices are numbered row by row from `first`; each quad is
/// split along the diagonal from its first corner.
pub(super) fn grid_triangles(first: u32, [columns, rows]: [u32; 2]) -> impl Iterator<Item = [u32; 3]> {
    let quads = (0..rows).flat_map(move |row| (0..columns).map(move |column| first + row * (columns + 1) + column));
    quads.flat_map(move |a| {
        let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
        [[a, b, c], [a, c, d]]
    })
}

/// Creates a mesh with one normal and texture coordinate per vertex; all must be finite.
pub(super) fn with_attributes(
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[f32; 3]>,
    texture: Vec<[f32; 2]>,
) -> Mesh {
    let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_attributes(Some(normals), Some(texture)));
    mesh.expect("finite numbers, as many as vertices")
}
