//! Matrices of all vertices, multiplied by the light anew in each frame.

use rayon::prelude::*;

use crate::error::{InputError, ensure};
use crate::sphere::{HarmonicLight, order_with};
use crate::transfer::Signal;

/// Vertices that are computed together.
const LANES: usize = 8;

/// A matrix per vertex, the same for all color channels, in f32.
///
/// Each number of the result is the sum over columns from the first to the last, one product at a time: its bits depend
/// neither on threads nor on the vector instructions of the processor.
#[derive(Clone, Debug, PartialEq)]
pub struct UncompressedTransfer {
    vertices: usize,
    rows: usize,
    columns: usize,
    /// Per [`LANES`] vertices, row and column: an element of each vertex's matrix. The last are filled with zeros.
    elements: Vec<[f32; LANES]>,
}

/// Coefficients of each vertex, such as exit radiance in an exit basis, of red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct ExitCoefficients {
    rows: usize,
    values: Vec<[f32; 3]>,
}

impl UncompressedTransfer {
    /// The matrices of a signal, one point per vertex, row by row.
    ///
    /// # Errors
    /// [`InputError`] if the numbers per point make no matrix with this many rows.
    pub fn new(signal: &Signal, rows: usize) -> Result<Self, InputError> {
        let found = signal.dimension();
        let columns = found.checked_div(rows).unwrap_or(0);
        ensure!(
            rows * columns == found && order_with(columns).is_some(),
            "expected {rows} rows of 1, 4, 9, ... or 100 numbers per point, found {found} numbers per point"
        );
        let vertices = signal.points();
        let mut elements = vec![[0.0; LANES]; vertices.div_ceil(LANES) * found];
        elements.par_chunks_exact_mut(found).enumerate().for_each(|(block, elements)| {
            for lane in 0..LANES.min(vertices - block * LANES) {
                let matrix = signal.point(block * LANES + lane);
                elements.iter_mut().zip(matrix).for_each(|(lanes, &element)| lanes[lane] = element);
            }
        });
        Ok(Self { vertices, rows, columns, elements })
    }

    /// M_p l of every vertex, for three channels.
    ///
    /// # Errors
    /// [`InputError`] for light of another order than the matrices.
    pub fn times(&self, light: &HarmonicLight) -> Result<ExitCoefficients, InputError> {
        let [red, green, blue] = light.channels();
        let (expected, found) = (self.columns, red.len());
        ensure!(expected == found, "expected light of {expected} functions, one per column of a matrix, found {found}");
        let light: Vec<[f32; 3]> = (0..found).map(|i| [red[i], green[i], blue[i]].map(|l| l as f32)).collect();
        let mut values = vec![[0.0; 3]; self.vertices * self.rows];
        let blocks = self.elements.par_chunks_exact(self.rows * self.columns);
        values.par_chunks_mut(LANES * self.rows).zip(blocks).for_each(|(values, block)| {
            for (row, elements) in block.chunks_exact(self.columns).enumerate() {
                let sums = products(elements, &light);
                for (lane, values) in values.chunks_exact_mut(self.rows).enumerate() {
                    values[row] = sums.map(|sum| sum[lane]);
                }
            }
        });
        Ok(ExitCoefficients { rows: self.rows, values })
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices
    }

    /// Rows of each matrix.
    pub fn row_count(&self) -> usize {
        self.rows
    }
}

/// A row of each lane's matrix times the three channels of the light.
fn products(elements: &[[f32; LANES]], light: &[[f32; 3]]) -> [[f32; LANES]; 3] {
    let mut sums = [[0.0; LANES]; 3];
    for (lanes, light) in elements.iter().zip(light) {
        for (sums, light) in sums.iter_mut().zip(light) {
            for (sum, element) in sums.iter_mut().zip(lanes) {
                *sum += element * light;
            }
        }
    }
    sums
}

impl ExitCoefficients {
    /// The coefficients of a vertex: one color per row.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn of(&self, vertex: usize) -> &[[f32; 3]] {
        &self.values[vertex * self.rows..(vertex + 1) * self.rows]
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.values.len() / self.rows
    }

    /// Coefficients of each vertex.
    pub fn row_count(&self) -> usize {
        self.rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::synthetic::torus_signal;

    /// Whatever the number of vertices and threads, the bits of a plain loop.
    #[test]
    fn products_have_the_bits_of_a_plain_loop() {
        let light = HarmonicLight::red_and_blue(3);
        for (points, rows) in [(1, 1), (8, 4), (21, 5)] {
            let signal = torus_signal(points, rows * 9, 3);
            let transfer = UncompressedTransfer::new(&signal, rows).expect("matrices");
            let plain = |point: usize, row: usize, channel: usize| {
                let row = &signal.point(point)[row * 9..(row + 1) * 9];
                row.iter().zip(&light.channels()[channel]).fold(0.0_f32, |sum, (m, l)| sum + m * *l as f32)
            };
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                let found = pool.install(|| transfer.times(&light)).expect("light of order 3");
                for (point, row) in (0..points).flat_map(|point| (0..rows).map(move |row| (point, row))) {
                    let expected = [0, 1, 2].map(|channel| plain(point, row, channel));
                    assert_eq!(found.of(point)[row].map(f32::to_bits), expected.map(f32::to_bits));
                }
            }
        }
    }

    #[test]
    fn what_is_no_matrix_is_refused() {
        let signal = torus_signal(3, 18, 0);
        assert_eq!(
            UncompressedTransfer::new(&signal, 0).unwrap_err().to_string(),
            "expected 0 rows of 1, 4, 9, ... or 100 numbers per point, found 18 numbers per point"
        );
        assert_eq!(
            UncompressedTransfer::new(&signal, 3).unwrap_err().to_string(),
            "expected 3 rows of 1, 4, 9, ... or 100 numbers per point, found 18 numbers per point"
        );
        let transfer = UncompressedTransfer::new(&signal, 2).expect("2 x 9");
        let message = transfer.times(&HarmonicLight::red_and_blue(4)).expect_err("another order").to_string();
        assert_eq!(message, "expected light of 9 functions, one per column of a matrix, found 16");
    }
}
