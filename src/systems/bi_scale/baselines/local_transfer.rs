//! A transfer matrix together with its vertices' frames, which baselines need to rotate harmonics or visibility.

use crate::bi_scale::baselines::stored::columns_error;
use crate::bi_scale::directions::{LocalDirections, hemisphere};
use crate::bi_scale::matrix::SparseMatrix;
use crate::error::{InputError, ensure};
use crate::sphere::{function_count, harmonics};
use crate::transfer::LocalFrame;
use crate::transfer::grid::LIGHT_TEXELS;

/// Number of cells along an edge of one local direction's part of the square, for integrals over its part of the
/// hemisphere.
const CELLS: usize = 16;

/// A transfer matrix, the frames of its vertices, and its local directions.
#[derive(Clone, Copy, Debug)]
pub struct LocalTransfer<'a> {
    matrix: &'a SparseMatrix,
    frames: &'a [LocalFrame],
    directions: &'a LocalDirections,
}

impl<'a> LocalTransfer<'a> {
    /// Creates local transfer. Row M p + j of the matrix belongs to local direction j in frame p.
    pub fn new(
        matrix: &'a SparseMatrix,
        frames: &'a [LocalFrame],
        directions: &'a LocalDirections,
    ) -> Result<Self, InputError> {
        if matrix.columns() != LIGHT_TEXELS {
            return Err(columns_error(matrix.columns()));
        }
        let expected = frames.len() * directions.directions().len();
        ensure!(
            matrix.rows() == expected,
            "expected {expected} rows, one per vertex and local direction, found {}: name the model of the file",
            matrix.rows()
        );
        Ok(Self { matrix, frames, directions })
    }

    /// The local directions.
    pub fn directions(&self) -> &'a LocalDirections {
        self.directions
    }

    /// The frames, one per vertex.
    pub fn frames(&self) -> &'a [LocalFrame] {
        self.frames
    }

    /// Local directions M.
    pub(super) fn local(&self) -> usize {
        self.directions.directions().len()
    }

    /// The visible fraction of each light texel at a vertex. A column has at most one entry per vertex.
    pub(super) fn visibility(&self, vertex: usize) -> Vec<f64> {
        let mut shares = vec![0.0; LIGHT_TEXELS];
        for row in vertex * self.local()..(vertex + 1) * self.local() {
            for entry in self.matrix.row(row) {
                shares[entry.index as usize] = self.matrix.value(entry.value);
            }
        }
        shares
    }
}

/// For each local direction, the integrals of the harmonics of an order over the part of the hemisphere nearest to it,
/// in steradians: sums over 16 x 16 points of equal solid angle per direction. For order 1 and times the square root of
/// 4 pi, they are solid angles, which sum to 2 pi. Panics if the order is not 1 to [`crate::sphere::MAX_ORDER`].
pub fn cell_integrals(directions: &LocalDirections, order: usize) -> Vec<Vec<f64>> {
    let count = function_count(order);
    let side = directions.side() * CELLS;
    let solid_angle = std::f64::consts::TAU / (side * side) as f64;
    let mut integrals = vec![vec![0.0; count]; directions.directions().len()];
    let mut y = vec![0.0; count];
    for cell in 0..side * side {
        let at = [cell % side, cell / side].map(|at| (2 * at + 1) as f64 / side as f64 - 1.0);
        let direction = hemisphere(at);
        harmonics(order, direction, &mut y);
        let nearest = directions.nearest(direction);
        integrals[nearest].iter_mut().zip(&y).for_each(|(sum, y)| *sum += solid_angle * y);
    }
    integrals
}
