//! A face as a card draws it into the atlas, and from it.

use glam::DVec3;

/// A vertex of a drawn triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnVertex {
    /// Where it is on the surface, in the mesh's units.
    pub position: DVec3,
    /// The normal there: of length 1 at corners of the face; at the middle of an edge the mean of its ends, so that
    /// interpolation over the triangle is that over the face.
    pub normal: DVec3,
    /// Where it is in the atlas, in texels: a corner of the face's rectangle.
    pub at: [u32; 2],
}

/// A face as two triangles.
///
/// Drawn at [`DrawnVertex::at`], they cover the center of each texel of the face exactly once. Drawn at their
/// positions, they read the atlas at the interpolated coordinates, clamped to the bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnFace {
    /// The corners a, b, m and a, m, c, where m is the middle of the edge from b to c. On the surface they run as those
    /// of the face do; in the atlas the way round depends on the face.
    pub triangles: [[DrawnVertex; 3]; 2],
    /// The least and the largest texel coordinates of reads, `[x, y, x, y]`: half a texel within the rectangle, where a
    /// bilinear read does not leave the face.
    pub bounds: [f64; 4],
}
