//! A system in the layout of the card's textures, and equation 4 in the order of the card's passes.
//!
//! With `A = diag(M)^-1 M` and `e = diag(M)^-1 E`, both computed in f64 and rounded once, row i of a step is computed
//! as follows:
//!
//! - pass 0 starts from `B_i + e_i`, each later pass from the result of the previous pass;
//! - each pass subtracts `A_ij B_j` for its block of texels, in order of j, and rounds product and difference;
//! - with four elements per texel, the four partial sums of a block start from 0; at its end they are added from the
//!   left, and their sum is added to the result of the previous pass.

use super::System;
use super::packing::{self, Packing};
use crate::card::Texels;
use crate::error::InputError;
use crate::linalg::Matrix;

/// A system in the layout of the card's textures.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub struct CardSystem {
    /// The layout of elements in texels.
    pub packing: Packing,
    /// Number of patches.
    pub size: usize,
    /// Texels per block.
    pub block: usize,
    /// Texture of A.
    pub matrix: Texels,
    /// Texture of e.
    pub emittance: Texels,
}

impl CardSystem {
    /// Lays out all three channels, one texel per element, in blocks of `block` texels, with sides of at most `limit`.
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
        let [width, rows] = packing.matrix_texels(size);
        let matrix = packing::filled("a matrix", [width, rows], limit, |_, _| [0.0; 4])?;
        let emittance = packing::filled("a vector", [width, 1], limit, |_, _| [0.0; 4])?;
        Ok(Self { packing, size, block: block.max(1), matrix, emittance })
    }
}

/// The right-hand sides divided by the diagonal: one texture of three channels, or one per channel.
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
