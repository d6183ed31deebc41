//! Triangles with sorted corners.

/// Triangle whose corners are sorted by coordinates, so that a common edge has the same direction in both of its
/// triangles, even if they do not share vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SortedTriangle {
    /// Corners p0, p1, p2, ascending in x, then y, then z.
    pub(super) corners: [[f32; 3]; 3],
    /// 1, or -1 if sorting exchanged two corners: the sign of the permutation.
    pub(super) turn: f64,
}

impl SortedTriangle {
    pub(super) fn new(mut corners: [[f32; 3]; 3]) -> Self {
        let mut turn = 1.0;
        for [first, second] in [[0, 1], [1, 2], [0, 1]] {
            // Corners are finite, so they always compare; equal corners are not exchanged.
            if corners[first] > corners[second] {
                corners.swap(first, second);
                turn = -turn;
            }
        }
        Self { corners, turn }
    }

    /// Edges p0 p1, p0 p2, p1 p2, each from its smaller to its larger corner.
    pub(super) fn edges(&self) -> [[[f32; 3]; 2]; 3] {
        let [p0, p1, p2] = self.corners;
        [[p0, p1], [p0, p2], [p1, p2]]
    }
}
