//! A face as a card draws it into the atlas, and from it.
//!
//! Along the sides of the rectangle from a to b and from a to c, the point with the weights (1 - p - q, p, q) lies at
//! min(p + q, 2 p) and min(p + q, 2 q): the smaller of two affine maps in both halves.

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
/// positions, they read the atlas at the interpolated coordinates, clamped to the bounds; [`WholeFace`] does that
/// without a vertex in the middle of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnFace {
    /// The corners a, b, m and a, m, c, where m is the middle of the edge from b to c. On the surface they run as those
    /// of the face do; in the atlas the way round depends on the face.
    pub triangles: [[DrawnVertex; 3]; 2],
    /// The least and the largest texel coordinates of reads, `[x, y, x, y]`: half a texel within the rectangle, where a
    /// bilinear read does not leave the face.
    pub bounds: [f64; 4],
}

/// A vertex of a face that is drawn whole, from the atlas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeVertex {
    /// Where it is on the surface, in the mesh's units.
    pub position: DVec3,
    /// The normal there, of length 1, or zero where none is known.
    pub normal: DVec3,
    /// Two pairs of texel coordinates, to be interpolated. Their minimum, component by component, is the place in the
    /// atlas, in both halves of the face: a program needs one more instruction.
    pub at: [[u32; 2]; 2],
}

/// A face as one triangle, to be drawn at its positions. Halves would have a vertex in the middle of an edge where the
/// neighbor has none, and the surface cracks there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeFace {
    /// The corners, as those of the face run.
    pub vertices: [WholeVertex; 3],
    /// As those of [`DrawnFace`].
    pub bounds: [f64; 4],
}
