//! Heights of a small square patch that repeats in both directions.
//!
//! The unit of length is an edge of the patch. Texel (row, column) of n x n has its height at u = (column + 1/2) / n, v
//! = (row + 1/2) / n; the surface is bilinear between four texels. Internally, positions are in texels: x = n u - 1/2,
//! y = n v - 1/2, so that heights are at integers and cell (i, j) extends from (i, j) to (i + 1, j + 1).
//!
//! The highest height is 0: the patch lies below the mesh's surface, and light and view of a point of the mesh reach
//! the top of the patch. (The paper does not say where its patches lie.)

use glam::DVec3;

use crate::error::{InputError, ensure, input_error};

/// A repeating patch of heights.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    side: usize,
    heights: Vec<f64>,
    /// The largest height of each cell.
    tops: Vec<f64>,
    /// The minimum height, at most 0.
    bottom: f64,
}

/// The bilinear surface of a cell: corner + a along + b across + a b twist, a and b in [0, 1] from the first corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CellPatch {
    corner: f64,
    along: f64,
    across: f64,
    pub(super) twist: f64,
}

impl CellPatch {
    /// The height at a position in the cell.
    pub(super) fn height(&self, [a, b]: [f64; 2]) -> f64 {
        self.corner + a * self.along + b * self.across + a * b * self.twist
    }

    /// The derivatives of the height along x and y, per texel.
    pub(super) fn slope(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        [self.along + b * self.twist, self.across + a * self.twist]
    }
}

impl HeightField {
    /// Maximum number of texels along an edge.
    pub const MOST: usize = 1024;
    /// Maximum depth in edges of the patch.
    pub const DEEPEST: f64 = 16.0;

    /// Checks the number of texels along an edge. Fails with [`InputError`] if it is 0 or above [`Self::MOST`].
    pub fn check_side(side: usize) -> Result<(), InputError> {
        ensure!(
            (1..=Self::MOST).contains(&side),
            "expected 1 to {} texels along an edge of the heights, found {side}",
            Self::MOST
        );
        Ok(())
    }

    /// Creates a height field from heights row by row, in edges of the patch; they are shifted so that the highest is
    /// 0.
    pub fn new(side: usize, heights: &[f64]) -> Result<Self, InputError> {
        Self::check_side(side)?;
        ensure!(
            heights.len() == side * side,
            "expected {} heights, {side} x {side}, found {}",
            side * side,
            heights.len()
        );
        let top = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let is_good = |height: f64| height.is_finite() && top - height <= Self::DEEPEST;
        if let Some(at) = heights.iter().position(|&height| !is_good(height)) {
            return Err(input_error!(
                "expected finite heights, the lowest at most {} edges of the patch below the highest; found \
         {} in row {}, column {}",
                HeightField::DEEPEST,
                heights[at],
                at / side,
                at % side
            ));
        }
        let heights: Vec<f64> = heights.iter().map(|height| height - top).collect();
        let bottom = heights.iter().copied().fold(0.0, f64::min);
        let mut field = Self { side, heights, tops: Vec::new(), bottom };
        let top = |at: usize| {
            let [i, j] = [at % side, at / side].map(usize::cast_signed);
            let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
            corners.into_iter().fold(field.bottom, |most, [x, y]| most.max(field.texel(x, y)))
        };
        field.tops = (0..side * side).map(top).collect();
        Ok(field)
    }

    /// A patch without relief.
    pub fn flat() -> Self {
        Self { side: 1, heights: vec![0.0], tops: vec![0.0], bottom: 0.0 }
    }

    /// Texels along an edge.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Heights, row by row; all are at most 0.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The difference between the highest and the lowest height.
    pub fn depth(&self) -> f64 {
        // Not -0 for a flat patch.
        0.0 - self.bottom
    }

    /// The height of a texel of the repeated patch.
    fn texel(&self, column: isize, row: isize) -> f64 {
        self.heights[self.wrapped(column, row)]
    }

    /// The index of a texel, or of a cell, within the repeating patch.
    pub(super) fn wrapped(&self, column: isize, row: isize) -> usize {
        let side = self.side.cast_signed();
        (row.rem_euclid(side) * side + column.rem_euclid(side)).cast_unsigned()
    }

    /// The largest height of a cell.
    pub(super) fn top(&self, [i, j]: [isize; 2]) -> f64 {
        self.tops[self.wrapped(i, j)]
    }

    pub(super) fn cell(&self, [i, j]: [isize; 2]) -> CellPatch {
        let [h00, h10, h01, h11] =
            [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]].map(|[column, row]| self.texel(column, row));
        CellPatch { corner: h00, along: h10 - h00, across: h01 - h00, twist: (h11 - h01) - (h10 - h00) }
    }

    /// The height at texture coordinates.
    pub fn height(&self, place: [f64; 2]) -> f64 {
        self.height_at(self.texels(place))
    }

    /// The unit normal at texture coordinates.
    pub fn normal(&self, place: [f64; 2]) -> DVec3 {
        let at = self.texels(place);
        let cell = at.map(|at| at.floor() as isize);
        self.normal_in(cell, at)
    }

    /// Converts texture coordinates to a position in texels, wrapped into the patch.
    pub(super) fn texels(&self, place: [f64; 2]) -> [f64; 2] {
        let side = self.side as f64;
        place.map(|at| (at - at.floor()) * side - 0.5)
    }

    /// The height at a position in texels.
    pub(super) fn height_at(&self, at: [f64; 2]) -> f64 {
        let cell = at.map(|at| at.floor() as isize);
        self.cell(cell).height(within(cell, at))
    }

    /// The unit normal at a position in a cell.
    pub(super) fn normal_in(&self, cell: [isize; 2], at: [f64; 2]) -> DVec3 {
        let [along, across] = self.cell(cell).slope(within(cell, at));
        let side = self.side as f64;
        DVec3::new(-side * along, -side * across, 1.0).normalize()
    }
}

/// A position relative to a cell's first corner, clamped to the cell.
pub(super) fn within([i, j]: [isize; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    [(x - i as f64).clamp(0.0, 1.0), (y - j as f64).clamp(0.0, 1.0)]
}
