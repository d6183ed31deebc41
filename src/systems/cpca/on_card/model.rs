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

    /// Constant registers per cluster in the programs, in which each vector occupies whole registers.
    pub fn registers_per_cluster(&self) -> usize {
        self.registers(0).needed(self.vectors)
    }

    /// Number of clusters whose constants fit together into `registers`.
    pub fn clusters_per_batch(&self, registers: usize) -> usize {
        registers / self.registers_per_cluster()
    }

    /// The least number of draws of chunks per channel with `registers`; `None` if no cluster fits.
    pub fn batches(&self, registers: usize) -> Option<usize> {
        Some(self.clusters.div_ceil(Some(self.clusters_per_batch(registers)).filter(|&fit| fit > 0)?))
    }

    /// Passes over each chunk: one per channel for glossy transfer.
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

    /// Multiplications and additions of the host for a frame without compression: 3 m_p N_r N_i.
    pub fn uncompressed_multiply_adds(&self) -> usize {
        CHANNELS * self.raw_numbers()
    }

    fn registers(&self, limit: usize) -> ConstantRegisters {
        if self.rows == 1 { ConstantRegisters::diffuse(limit) } else { ConstantRegisters::glossy(limit, self.rows) }
    }
}
