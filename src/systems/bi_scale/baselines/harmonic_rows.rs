//! Low-frequency bi-scale transfer: light in spherical harmonics of an order, instead of texels.

use rayon::prelude::*;

use super::local_transfer::{LocalTransfer, cell_integrals};
use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::baselines::stored::columns_error;
use crate::bi_scale::matrix::SparseMatrix;
use crate::error::{InputError, ensure};
use crate::sphere::{MAX_ORDER, function_count, harmonics};
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE, LIGHT_TEXELS, face_row_column, texel_center};

/// The sides of transfer that are represented in harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub enum HarmonicSides {
    /// Only the distant light: M x n^2 numbers per vertex for M local directions.
    Light,
    /// Both sides, as in the paper's reference 3: n^2 x n^2 numbers per vertex; the light of a local direction is the
    /// integral of the local harmonics over the direction's part of the hemisphere.
    Both,
}

/// Transfer of harmonics, a matrix of f32 per vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicRows {
    order: usize,
    sides: HarmonicSides,
    /// Rows of a vertex's matrix: M, or n^2.
    height: usize,
    /// Vertex by vertex, row by row, n^2 numbers per row.
    values: Vec<f32>,
    /// Weight of each local harmonic per local direction; empty unless both sides are in harmonics.
    cells: Vec<Vec<f64>>,
}

impl HarmonicRows {
    /// Projects each row from light texels to harmonics of an order; vertex data are not needed.
    pub fn of_light(matrix: &SparseMatrix, order: usize) -> Result<Self, InputError> {
        if matrix.columns() != LIGHT_TEXELS {
            return Err(columns_error(matrix.columns()));
        }
        let functions = TexelHarmonics::new(order)?;
        let count = function_count(order);
        let mut values = vec![0.0; matrix.rows() * count];
        values.par_chunks_exact_mut(count).enumerate().for_each(|(row, into)| {
            let mut sums = vec![0.0; count];
            for entry in matrix.row(row) {
                let (texel, share) = (entry.index as usize, matrix.value(entry.value));
                let scale = share * functions.solid_angles[texel];
                sums.iter_mut().zip(functions.of(texel)).for_each(|(sum, y)| *sum += scale * y);
            }
            into.iter_mut().zip(sums).for_each(|(into, sum)| *into = sum as f32);
        });
        Ok(Self { order, sides: HarmonicSides::Light, height: 1, values, cells: Vec::new() })
    }

    /// Matrices from harmonics of the distant light to harmonics of the light around a vertex, in the vertex's frame:
    /// integrals over light texels of visibility times both harmonics at the texel's center.
    pub fn of_both(transfer: &LocalTransfer<'_>, order: usize) -> Result<Self, InputError> {
        let functions = TexelHarmonics::new(order)?;
        let count = function_count(order);
        let mut values = vec![0.0; transfer.frames().len() * count * count];
        values.par_chunks_exact_mut(count * count).enumerate().for_each(|(vertex, into)| {
            let frame = &transfer.frames()[vertex];
            let (mut sums, mut local) = (vec![0.0; count * count], vec![0.0; count]);
            for (texel, share) in transfer.visibility(vertex).into_iter().enumerate().filter(|(_, share)| *share > 0.0)
            {
                harmonics(order, frame.to_local(texel_center(texel)), &mut local);
                let scale = share * functions.solid_angles[texel];
                for (sums, local) in sums.chunks_exact_mut(count).zip(&local) {
                    let scale = scale * local;
                    sums.iter_mut().zip(functions.of(texel)).for_each(|(sum, y)| *sum += scale * y);
                }
            }
            into.iter_mut().zip(sums).for_each(|(into, sum)| *into = sum as f32);
        });
        let cells = cell_integrals(transfer.directions(), order);
        Ok(Self { order, sides: HarmonicSides::Both, height: count, values, cells })
    }

    /// The sides that are in harmonics.
    pub fn sides(&self) -> HarmonicSides {
        self.sides
    }
}

impl StoredTransfer for HarmonicRows {
    fn sizes(&self) -> Vec<StoredSize> {
        let layout = match self.sides {
            HarmonicSides::Light => "4 bytes per number, n^2 per row",
            HarmonicSides::Both => "4 bytes per number, n^4 per vertex",
        };
        vec![StoredSize { layout, bytes: 4 * self.values.len() as u64 }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        let light = TexelHarmonics::new(self.order).map_or_else(|_| Vec::new(), |functions| functions.project(light));
        let count = function_count(self.order);
        let products: Vec<f64> = self
            .values
            .par_chunks_exact(count)
            .map(|row| row.iter().zip(&light).fold(0.0, |sum, (&value, light)| sum + f64::from(value) * light))
            .collect();
        if self.sides == HarmonicSides::Light {
            return products;
        }
        let integral = |cell: &Vec<f64>, local: &[f64]| cell.iter().zip(local).fold(0.0, |sum, (y, c)| sum + y * c);
        let of_vertex = |local| self.cells.iter().map(move |cell| integral(cell, local));
        products.chunks_exact(self.height).flat_map(of_vertex).collect()
    }
}

/// Harmonics at the centers of light texels, and their solid angles.
struct TexelHarmonics {
    count: usize,
    functions: Vec<f64>,
    solid_angles: Vec<f64>,
}

impl TexelHarmonics {
    fn new(order: usize) -> Result<Self, InputError> {
        ensure!(
            (1..=MAX_ORDER).contains(&order),
            "expected an order of harmonics of 1 to {}, found {order}",
            MAX_ORDER
        );
        let count = function_count(order);
        let mut functions = vec![0.0; LIGHT_TEXELS * count];
        for (texel, y) in functions.chunks_exact_mut(count).enumerate() {
            harmonics(order, texel_center(texel), y);
        }
        let solid_angle = |texel| {
            let [_, row, column] = face_row_column(texel, LIGHT_SIDE);
            LIGHT_MAP.solid_angle(column, row)
        };
        Ok(Self { count, functions, solid_angles: (0..LIGHT_TEXELS).map(solid_angle).collect() })
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
