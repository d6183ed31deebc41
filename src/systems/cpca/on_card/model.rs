//! The cost of a frame (sections 4.1, 6 and 6.2): the columns of the paper's Table 1 that follow from its first four.

use crate::cpca::coherence::ConstantRegisters;

/// The sizes of a compressed transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TransferSize {
    /// Number of vertices m_p.
    pub vertices: usize,
    /// Number of rows of a matrix (functions of exit radiance) N_r; 1 for diffuse transfer.
    pub rows: usize,
    /// Number of columns (functions of the light) N_i.
    pub columns: usize,
    /// Number of clusters m_c.
    pub clusters: usize,
    /// Number of vectors per cluster n', without its mean.
    pub vectors: usize,
}

/// Channels of light.
const CHANNELS: usize = 3;

impl TransferSize {
    /// Number of values before compression: m_p N_r N_i.
    pub fn raw_numbers(&self) -> usize {
        self.vertices * self.rows * self.columns
    }

    /// Number of values after compression (section 4.1): m_p n' + m_c (n' + 1) N_r N_i.
    pub fn stored_numbers(&self) -> usize {
        self.vertices * self.vectors + self.representatives() * self.rows * self.columns
    }

    /// Number of means and vectors of all clusters: m_c (n' + 1).
    pub fn representatives(&self) -> usize {
        self.clusters * (self.vectors + 1)
    }

    /// Constants per cluster as the programs use them, with whole registers per vector.
    pub fn registers_per_cluster(&self) -> usize {
        self.registers(0).needed(self.vectors)
    }

    /// Number of clusters whose constants fit `registers` together.
    pub fn clusters_per_batch(&self, registers: usize) -> usize {
        registers / self.registers_per_cluster()
    }

    /// The least number of draws of chunks per channel with `registers`; `None` if no cluster fits.
    pub fn batches(&self, registers: usize) -> Option<usize> {
        Some(self.clusters.div_ceil(Some(self.clusters_per_batch(registers)).filter(|&fit| fit > 0)?))
    }

    /// Passes over each chunk: for glossy transfer one per channel.
    pub fn passes(&self) -> usize {
        if self.rows == 1 { 1 } else { CHANNELS }
    }

    /// Number of constant registers uploaded for a frame.
    pub fn uploaded_registers(&self) -> usize {
        self.passes() * self.clusters * self.registers_per_cluster()
    }

    /// Multiplications and additions of the host for a frame: 3 m_c (n' + 1) N_r N_i.
    pub fn host_multiply_adds(&self) -> usize {
        CHANNELS * self.representatives() * self.rows * self.columns
    }

    /// The same without compression: 3 m_p N_r N_i.
    pub fn uncompressed_multiply_adds(&self) -> usize {
        CHANNELS * self.raw_numbers()
    }

    fn registers(&self, limit: usize) -> ConstantRegisters {
        if self.rows == 1 { ConstantRegisters::diffuse(limit) } else { ConstantRegisters::glossy(limit, self.rows) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn size(vertices: usize, [rows, columns]: [usize; 2], clusters: usize, vectors: usize) -> TransferSize {
        TransferSize { vertices, rows, columns, clusters, vectors }
    }

    /// The sizes of Table 1, with raw and stored numbers in millions, registers per cluster, and clusters per 256
    /// registers and per registers that remain beside transform, eye and constants.
    #[test]
    fn table_1_follows_from_its_sizes() {
        let rows = [
            (size(49_990, [16, 25], 256, 6), [20.0, 1.017], 28, [9, 8]),
            (size(49_990, [24, 25], 256, 8), [30.0, 1.782], 54, [4, 4]),
            (size(49_990, [25, 25], 256, 8), [31.2, 1.840], 63, [4, 3]),
            (size(48_688, [24, 25], 256, 8), [29.2, 1.772], 54, [4, 4]),
            (size(48_688, [1, 100], 256, 8), [4.87, 0.620], 9, [28, 27]),
            (size(50_060, [16, 25], 256, 6), [20.0, 1.017], 28, [9, 8]),
            (size(58_624, [1, 100], 32, 4), [5.86, 0.250], 5, [51, 50]),
        ];
        for (size, millions, registers, fitting) in rows {
            let found = [size.raw_numbers(), size.stored_numbers()].map(|numbers| numbers as f64 / 1e6);
            for ((found, printed), half_digit) in found.iter().zip(millions).zip([0.05, 0.0005]) {
                assert!((found - printed).abs() <= half_digit, "{size:?}: {found}, {printed}");
            }
            assert_eq!(size.registers_per_cluster(), registers, "{size:?}");
            assert_eq!([256, 250].map(|limit| size.clusters_per_batch(limit)), fitting, "{size:?}");
        }
    }

    /// Section 6.2 for the bird: 54 constants, 4 clusters per batch, 64 batches; and Figures 10 and 11.
    #[test]
    fn batches_and_host_work_of_the_bird() {
        let bird = |clusters, vectors| size(48_688, [24, 25], clusters, vectors);
        assert_eq!(bird(256, 8).batches(256), Some(64));
        for (vectors, registers, clusters, batches) in [(2, 18, 13, 20), (4, 30, 8, 32), (12, 78, 3, 86)] {
            let bird = bird(256, vectors);
            let found = (bird.registers_per_cluster(), bird.clusters_per_batch(250), bird.batches(250));
            assert_eq!(found, (registers, clusters, Some(batches)), "{vectors} vectors");
        }
        let quantised = bird(1792, 0);
        assert_eq!((quantised.registers_per_cluster(), quantised.batches(250)), (6, Some(44)));
        assert_eq!(bird(1, 20).registers_per_cluster(), 126);
        assert_eq!(bird(1, 20).batches(91), None, "vs_1_1 has 96 constants");
        assert_eq!(bird(256, 8).uploaded_registers(), 41_472);
        assert_eq!(bird(256, 8).host_multiply_adds(), 4_147_200);
        assert_eq!(bird(256, 8).uncompressed_multiply_adds(), 87_638_400);
    }

    /// "For N = 25 and n' = 5 we save more than a factor of 4" (section 6): per vertex, products with six vectors of 25
    /// numbers instead of a 25 x 25 matrix.
    #[test]
    fn the_factor_of_four() {
        let size = size(1, [25, 25], 1, 5);
        let per_vertex = (size.vectors + 1) * size.rows;
        let factor = (size.rows * size.columns) as f64 / per_vertex as f64;
        assert!((factor - 25.0 / 6.0).abs() < 1e-12);
    }
}
