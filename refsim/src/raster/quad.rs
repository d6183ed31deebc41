//! A full-screen quad that generates one fragment per texel.

use super::Vertex;

/// Creates a quad that covers the whole target, to be drawn as [`QuadList`](super::Primitive::QuadList) with Direct3D's
/// clip space and OpenGL's pixel centres. `coordinates` maps the position of a corner to its texture coordinate sets;
/// (0, 0) is the outer corner of the first texel, (1, 1) the outer corner of the last texel.
///
/// ```
/// use refsim::raster::full_screen_quad;
///
/// let quad = full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]);
/// assert_eq!(quad[2].texcoords[0].map(f32::from_bits), [1.0, 1.0, 0.0, 1.0]);
/// assert_eq!(quad[2].position.map(f32::from_bits), [1.0, -1.0, 0.0, 1.0]);
/// ```
pub fn full_screen_quad<const SETS: usize>(coordinates: impl Fn(f32, f32) -> [[f32; 4]; SETS]) -> [Vertex; 4] {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]: [f32; 2]| {
        let position = [2.0 * u - 1.0, 1.0 - 2.0 * v, 0.0, 1.0];
        let mut vertex = Vertex { position: position.map(f32::to_bits), ..Vertex::default() };
        for (slot, set) in vertex.texcoords.iter_mut().zip(coordinates(u, v)) {
            *slot = set.map(f32::to_bits);
        }
        vertex
    })
}
