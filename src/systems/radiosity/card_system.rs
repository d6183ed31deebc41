//! Equation 4 in f32, in the order of a card's passes: the reference bits of the fragment programs.
//!
//! With `A = diag(M)^-1 M` and `e = diag(M)^-1 E`, both computed in f64 and rounded once, row i of a step is computed
//! as follows:
//!
//! - pass 0 starts from `B_i + e_i`, each later pass from the result of the previous pass;
//! - each pass subtracts `A_ij B_j` for its block of texels, in order of j, and rounds product and difference;
//! - with four elements per texel, the four partial sums of a block start from 0; at its end they are added from the
//!   left, and their sum is added to the result of the previous pass.

use rayon::prelude::*;

use super::System;
use super::packing::{self, Packing};
use crate::card::Texels;
use crate::error::InputError;
use crate::linalg::Matrix;

/// Minimum number of rows of a parallel task.
const ROWS: usize = 16;

/// A system in the layout of the card's textures.
#[derive(Clone, Debug, PartialEq)]
pub struct CardSystem {
    packing: Packing,
    /// Number of patches.
    size: usize,
    /// Texels per block.
    block: usize,
    matrix: Texels,
    emittance: Texels,
}

impl CardSystem {
    /// Lays out all three channels of a system, one texel per element, in blocks of `block` texels per pass (at least
    /// 1). Textures have at most `limit` texels per side.
    pub fn rgb(system: &System, block: usize, limit: usize) -> Result<Self, InputError> {
        let size = system.factors().len();
        let mut right: Vec<[f64; 3]> = system.emittance().to_vec();
        let matrices = [0, 1, 2].map(|c| {
            let (matrix, diagonal) = divided(system.matrix(c));
            right.iter_mut().zip(diagonal).for_each(|(e, d)| e[c] /= d);
            matrix
        });
        let matrix = packing::rgb_matrix([&matrices[0], &matrices[1], &matrices[2]], limit)?;
        let emittance = packing::rgb_vector(&right, limit)?;
        Ok(Self { packing: Packing::Rgb, size, block: block.max(1), matrix, emittance })
    }

    /// Lays out one channel, given as matrix and right-hand side, four elements per texel.
    pub fn luminance(matrix: Matrix, right: &[f64], block: usize, limit: usize) -> Result<Self, InputError> {
        let size = matrix.row_count();
        let (matrix, diagonal) = divided(matrix);
        let right: Vec<f64> = right.iter().zip(diagonal).map(|(e, d)| e / d).collect();
        let matrix = packing::luminance_matrix(&matrix, limit)?;
        let emittance = packing::luminance_vector(&right, limit)?;
        Ok(Self { packing: Packing::Luminance, size, block: block.max(1), matrix, emittance })
    }

    /// Creates a system of zeros, for measuring time, which does not depend on values.
    pub fn zeros(packing: Packing, size: usize, block: usize, limit: usize) -> Result<Self, InputError> {
        let [width, rows] = match packing {
            Packing::Rgb => [size; 2],
            Packing::Luminance => [size.div_ceil(4), 4 * size.div_ceil(4)],
        };
        let matrix = packing::filled("a matrix", [width, rows], limit, |_, _| [0.0; 4])?;
        let emittance = packing::filled("a vector", [width, 1], limit, |_, _| [0.0; 4])?;
        Ok(Self { packing, size, block: block.max(1), matrix, emittance })
    }

    /// The layout of elements in texels.
    pub fn packing(&self) -> Packing {
        self.packing
    }

    /// Number of patches.
    pub fn len(&self) -> usize {
        self.size
    }

    /// Returns `true` if there are no patches.
    pub fn is_empty(&self) -> bool {
        self.size == 0
    }

    /// Texels per block.
    pub fn block(&self) -> usize {
        self.block
    }

    /// Texture of A.
    pub fn matrix(&self) -> &Texels {
        &self.matrix
    }

    /// Texture of e.
    pub fn emittance(&self) -> &Texels {
        &self.emittance
    }

    /// Passes per iteration: the matrix's width divided by the block's.
    pub fn passes(&self) -> usize {
        self.matrix.width.div_ceil(self.block)
    }

    /// Returns a texture of zeros, the initial state of an iteration.
    pub fn zero(&self) -> Texels {
        Texels::vector(vec![[0.0; 4]; self.emittance.width])
    }

    /// Computes one pass. `radiosity` is the result of the previous iteration, `partial` the result of the previous
    /// pass; pass 0 does not read `partial`. Panics if a texture is too small, or there is no such pass.
    pub fn pass(&self, radiosity: &Texels, partial: &Texels, pass: usize) -> Texels {
        let from = pass * self.block;
        let to = (from + self.block).min(self.matrix.width);
        let row = |i: usize| {
            let (matrix, b) = (&self.matrix.row(i)[from..to], &radiosity.texels[from..to]);
            let begin = |pick: &dyn Fn(&Texels) -> [f32; 4]| {
                let (b, e) = (pick(radiosity), pick(&self.emittance));
                if pass > 0 { pick(partial) } else { [0, 1, 2, 3].map(|c| b[c] + e[c]) }
            };
            match self.packing {
                Packing::Rgb => rgb_row(begin(&|texels| texels.texels[i]), matrix, b),
                Packing::Luminance => {
                    [luminance_row(begin(&|texels| [texels.texels[i / 4][i % 4]; 4])[0], matrix, b); 4]
                }
            }
        };
        let values: Vec<[f32; 4]> = (0..self.matrix.height).into_par_iter().with_min_len(ROWS).map(row).collect();
        Texels::vector(match self.packing {
            Packing::Rgb => values,
            Packing::Luminance => {
                values.chunks_exact(4).map(|four| [four[0][0], four[1][0], four[2][0], four[3][0]]).collect()
            }
        })
    }

    /// Computes one iteration: all passes.
    pub fn step(&self, radiosity: &Texels) -> Texels {
        (0..self.passes()).fold(self.zero(), |partial, pass| self.pass(radiosity, &partial, pass))
    }
}

/// `MAD acc, -m, b, acc` per texel.
fn rgb_row(mut acc: [f32; 4], matrix: &[[f32; 4]], b: &[[f32; 4]]) -> [f32; 4] {
    for (m, b) in matrix.iter().zip(b) {
        let product = [m[0] * b[0], m[1] * b[1], m[2] * b[2], m[3] * b[3]];
        acc = [acc[0] - product[0], acc[1] - product[1], acc[2] - product[2], acc[3] - product[3]];
    }
    acc
}

/// Accumulates four elements of the row at a time, then adds the four sums from the left (`DP4` with ones) to `begin`.
fn luminance_row(begin: f32, matrix: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    let [x, y, z, w] = rgb_row([0.0; 4], matrix, b);
    begin + (((x + y) + z) + w)
}

/// The right-hand sides divided by the diagonal of the system's matrix: one texture of three channels, or one per
/// channel.
pub fn emittances(system: &System, packing: Packing, limit: usize) -> Result<Vec<Texels>, InputError> {
    let factors = system.factors().matrix();
    let divided = |(i, e): (usize, &[f64; 3])| {
        let rho = system.reflectance()[i];
        [0, 1, 2].map(|c| e[c] / (1.0 - rho[c] * factors.row(i)[i]))
    };
    let right: Vec<[f64; 3]> = system.emittance().iter().enumerate().map(divided).collect();
    match packing {
        Packing::Rgb => packing::rgb_vector(&right, limit).map(|one| vec![one]),
        Packing::Luminance => {
            let channel = |c: usize| packing::luminance_vector(&right.iter().map(|e| e[c]).collect::<Vec<_>>(), limit);
            (0..3).map(channel).collect()
        }
    }
}

/// A matrix with each row divided by its diagonal element, and the diagonal.
fn divided(mut matrix: Matrix) -> (Matrix, Vec<f64>) {
    let diagonal = matrix.diagonal();
    for (i, &d) in diagonal.iter().enumerate() {
        matrix.row_mut(i).iter_mut().for_each(|value| *value /= d);
    }
    (matrix, diagonal)
}
