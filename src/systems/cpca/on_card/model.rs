//! The cost of a frame (sections 4.1, 6 and 6.2): the columns of the paper's Table 1 that follow from the first four
//! columns.

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

const CHANNELS: usize = 3;

impl TransferSize {
    /// Number of values after compression (section 4.1), for one matrix per vertex and clusters of full rank: m_p n' +
    /// m_c (n' + 1) N_r N_i.
    pub fn stored_numbers(&self) -> usize {
        self.vertices * self.vectors + self.representatives() * self.rows * self.columns
    }

    /// Number of means and vectors of all clusters: m_c (n' + 1), if no cluster has a lower rank.
    pub fn representatives(&self) -> usize {
        self.clusters * (self.vectors + 1)
    }

    /// Constant registers per cluster in the programs, in which each vector occupies whole registers.
    pub fn registers_per_cluster(&self) -> usize {
        self.registers(0).needed(self.vectors)
    }

    /// Number of clusters whose constants fit together into `registers`.
    pub fn clusters_per_batch(&self, registers: usize) -> usize {
        registers / self.registers_per_cluster()
    }

    /// Passes over each chunk: one per channel for glossy transfer.
    pub fn passes(&self) -> usize {
        if self.rows == 1 { 1 } else { CHANNELS }
    }

    /// Number of constant registers uploaded for a frame with this many means and vectors.
    pub fn uploaded_registers(&self, representatives: usize) -> usize {
        self.passes() * representatives * self.registers(0).per_vector
    }

    /// Multiplications and additions of the host for the products of this many matrices with a light of three channels:
    /// m_c (n' + 1) matrices with compression, m_p without.
    pub fn multiply_adds(&self, matrices: usize) -> usize {
        CHANNELS * matrices * self.rows * self.columns
    }

    fn registers(&self, limit: usize) -> ConstantRegisters {
        if self.rows == 1 { ConstantRegisters::diffuse(limit) } else { ConstantRegisters::glossy(limit, self.rows) }
    }
}
