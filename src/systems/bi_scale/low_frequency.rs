//! Low-frequency bi-scale transfer, with which Figures 1 and 5 compare biclusters: a matrix per vertex from harmonics
//! of the distant light to harmonics of the light around the vertex, both of the same order (the paper's reference 3).

use rayon::prelude::*;

use crate::bi_scale::directions::{LocalDirections, hemisphere};
use crate::bi_scale::matrix::SparseMatrix;
use crate::error::{InputError, ensure};
use crate::sphere::{MAX_ORDER, function_count, harmonics};
use crate::transfer::LocalFrame;
use crate::transfer::grid::{LIGHT_TEXELS, texel_center, texel_solid_angle};

/// Number of cells along an edge of one local direction's part of the square, for integrals over its part of the
/// hemisphere.
const CELLS: usize = 16;

/// A matrix of n^2 x n^2 numbers per vertex, in f32. Light from a local direction: the integral of the local-harmonics
/// expansion over the part of the hemisphere that is nearest to that direction.
#[derive(Clone, Debug)]
pub struct LowFrequencyTransfer {
    functions: TexelHarmonics,
    /// Vertex by vertex, row by row, n^2 numbers per row.
    values: Vec<f32>,
    /// Weight of each local harmonic per local direction.
    cells: Vec<Vec<f64>>,
}

impl LowFrequencyTransfer {
    /// Integrates, over light texels, visibility times both harmonics at the texel's center. Row M p + j of the matrix
    /// belongs to local direction j in frame p. Fails with [`InputError`] for a matrix of another size, or an order
    /// that is not 1 to [`MAX_ORDER`].
    pub fn new(
        matrix: &SparseMatrix,
        frames: &[LocalFrame],
        directions: &LocalDirections,
        order: usize,
    ) -> Result<Self, InputError> {
        ensure!(
            matrix.columns() == LIGHT_TEXELS,
            "expected a matrix of {LIGHT_TEXELS} columns, a light texel each, found {}",
            matrix.columns()
        );
        let local_count = directions.directions().len();
        let expected = frames.len() * local_count;
        ensure!(
            matrix.rows() == expected,
            "expected {expected} rows, one per vertex and local direction, found {}: give the model of the file",
            matrix.rows()
        );
        let functions = TexelHarmonics::new(order)?;
        let count = functions.count;
        let mut values = vec![0.0; frames.len() * count * count];
        values.par_chunks_exact_mut(count * count).enumerate().for_each(|(vertex, into)| {
            let frame = &frames[vertex];
            let (mut sums, mut local) = (vec![0.0; count * count], vec![0.0; count]);
            let seen = visibility(matrix, vertex * local_count..(vertex + 1) * local_count);
            for (texel, share) in seen.into_iter().enumerate().filter(|(_, share)| *share > 0.0) {
                harmonics(order, frame.to_local(texel_center(texel)), &mut local);
                let scale = share * functions.solid_angles[texel];
                for (sums, local) in sums.chunks_exact_mut(count).zip(&local) {
                    let scale = scale * local;
                    sums.iter_mut().zip(functions.of(texel)).for_each(|(sum, y)| *sum += scale * y);
                }
            }
            into.iter_mut().zip(sums).for_each(|(into, sum)| *into = sum as f32);
        });
        Ok(Self { functions, values, cells: cell_integrals(directions, order) })
    }

    /// Local light L~ in f64: one number per row of T, from `light` with one number per column. Panics if the light
    /// does not have one number per column of T.
    pub fn multiply(&self, light: &[f64]) -> Vec<f64> {
        let (light, count) = (self.functions.project(light), self.functions.count);
        let products: Vec<f64> = self
            .values
            .par_chunks_exact(count)
            .map(|row| row.iter().zip(&light).fold(0.0, |sum, (&value, light)| sum + f64::from(value) * light))
            .collect();
        let integral = |cell: &Vec<f64>, local: &[f64]| cell.iter().zip(local).fold(0.0, |sum, (y, c)| sum + y * c);
        let of_vertex = |local| self.cells.iter().map(move |cell| integral(cell, local));
        products.chunks_exact(count).flat_map(of_vertex).collect()
    }
}

/// The visible fraction of each light texel at the vertex of these rows. A column has at most one entry per vertex.
fn visibility(matrix: &SparseMatrix, rows: std::ops::Range<usize>) -> Vec<f64> {
    let mut shares = vec![0.0; LIGHT_TEXELS];
    for entry in rows.flat_map(|row| matrix.row(row)) {
        shares[entry.index as usize] = matrix.value(entry.value);
    }
    shares
}

/// For each local direction, the integrals of the harmonics of an order over the part of the hemisphere nearest to it,
/// in steradians: sums over 16 x 16 points of equal solid angle per direction. For order 1 and times the square root of
/// 4 pi, they are solid angles, which sum to 2 pi. Panics if the order is not 1 to [`MAX_ORDER`].
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

/// Harmonics at the centers of light texels, and their solid angles.
#[derive(Clone, Debug)]
struct TexelHarmonics {
    count: usize,
    functions: Vec<f64>,
    solid_angles: Vec<f64>,
}

impl TexelHarmonics {
    fn new(order: usize) -> Result<Self, InputError> {
        let fits = (1..=MAX_ORDER).contains(&order);
        ensure!(fits, "expected an order of harmonics of 1 to {MAX_ORDER}, found {order}");
        let count = function_count(order);
        let mut functions = vec![0.0; LIGHT_TEXELS * count];
        for (texel, y) in functions.chunks_exact_mut(count).enumerate() {
            harmonics(order, texel_center(texel), y);
        }
        Ok(Self { count, functions, solid_angles: (0..LIGHT_TEXELS).map(texel_solid_angle).collect() })
    }

    fn of(&self, texel: usize) -> &[f64] {
        &self.functions[texel * self.count..][..self.count]
    }

    /// Coefficients of a light, given by its texels' radiances times their solid angles.
    fn project(&self, light: &[f64]) -> Vec<f64> {
        assert_eq!(light.len(), LIGHT_TEXELS, "a number per light texel");
        let mut coefficients = vec![0.0; self.count];
        for (texel, light) in light.iter().enumerate() {
            coefficients.iter_mut().zip(self.of(texel)).for_each(|(sum, y)| *sum += light * y);
        }
        coefficients
    }
}
