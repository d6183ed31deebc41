//! Vertices of a face, for drawing it into the atlas and for drawing it on the surface with texels from the atlas.
//!
//! Along the sides of the rectangle from a to b and from a to c, the point with the weights (1 - p - q, p, q) lies at
//! min(p + q, 2 p) and min(p + q, 2 q), the smaller of two affine maps, in both halves.

use glam::DVec3;

/// Vertex of a drawn triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnVertex<P> {
    /// Position on the surface, in the mesh's units.
    pub position: DVec3,
    /// Normal: of length 1 at corners of the face, or zero where none is known. At the middle of an edge it is the mean
    /// of the ends' normals, so that interpolation over the triangle equals interpolation over the face.
    pub normal: DVec3,
    /// Place in the atlas, in texels: a corner of the face's rectangle, or two pairs of coordinates.
    pub at: P,
}

/// Face as two triangles or as one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnFace {
    /// The corners a, b, m and a, m, c, where m is the middle of the edge from b to c. Drawn at their places, they cover
    /// the center of each texel of the face exactly once. On the surface they have the face's orientation; in the atlas
    /// the orientation differs from face to face.
    pub triangles: [[DrawnVertex<[u32; 2]>; 3]; 2],
    /// The corners in the order of the face, to be drawn at their positions: m would be a T-junction, which causes
    /// cracks. The componentwise minimum of the two interpolated pairs is the place in the atlas.
    pub whole: [DrawnVertex<[[u32; 2]; 2]>; 3],
    /// Texel coordinates to clamp reads to, `[x, y, x, y]`, as in [`super::FacePlace::bounds`].
    pub bounds: [f64; 4],
}
