//! Vertices of a face, for drawing it into the atlas and for drawing it on the surface with texels from the atlas.
//!
//! Along the sides of the rectangle from a to b and from a to c, the point with the weights (1 - p - q, p, q) lies at
//! min(p + q, 2 p) and min(p + q, 2 q), the smaller of two affine maps, in both halves.

use glam::DVec3;

/// Vertex of a drawn triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnVertex {
    /// Position on the surface, in the mesh's units.
    pub position: DVec3,
    /// Normal: of length 1 at corners of the face. At the middle of an edge it is the mean of the ends' normals, so
    /// that interpolation over the triangle equals interpolation over the face.
    pub normal: DVec3,
    /// Position in the atlas, in texels: a corner of the face's rectangle.
    pub at: [u32; 2],
}

/// Face as two triangles.
///
/// Drawn at [`DrawnVertex::at`], they cover the center of each texel of the face exactly once. Drawn at their
/// positions, they read the atlas at the interpolated coordinates, clamped to the bounds. [`WholeFace`] draws the
/// surface without a vertex in the middle of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnFace {
    /// The corners a, b, m and a, m, c, where m is the middle of the edge from b to c. On the surface they have the
    /// face's orientation; in the atlas the orientation differs from face to face.
    pub triangles: [[DrawnVertex; 3]; 2],
    /// Smallest and largest texel coordinates of reads, `[x, y, x, y]`: half a texel inside the rectangle's border, so
    /// that a bilinear read stays on the face.
    pub bounds: [f64; 4],
}

/// Vertex of a face that is drawn as one triangle with texels from the atlas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeVertex {
    /// Position on the surface, in the mesh's units.
    pub position: DVec3,
    /// Unit normal, or zero where none is known.
    pub normal: DVec3,
    /// Two pairs of texel coordinates, to be interpolated. Their componentwise minimum (one more instruction) is the
    /// position in the atlas in both halves of the face.
    pub at: [[u32; 2]; 2],
}

/// Face as one triangle, drawn at its surface positions. Two halves would have a vertex in the middle of an edge, a
/// T-junction that causes cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeFace {
    /// The corners, in the order of the face.
    pub vertices: [WholeVertex; 3],
    /// Bounds of reads, as in [`DrawnFace`].
    pub bounds: [f64; 4],
}
