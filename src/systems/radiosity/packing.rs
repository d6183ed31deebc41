//! Matrices and vectors as textures of four f32 per texel (section 3): layouts.
//!
//! | layout | texel (x, y) of a matrix | texel x of a vector |
//! |---|---|---|
//! | RGB | elements (y, x) of the red, green and blue matrix, 0 | elements x of the three vectors, 0 |
//! | luminance | elements (y, 4x) to (y, 4x + 3) of one matrix | elements 4x to 4x + 3 |
//!
//! Each value is rounded once, from f64. Elements beyond the matrix are 0; a luminance matrix has rows up to a
//! multiple of four.

use crate::card::Texels;
use crate::error::{InputError, input_error};
use crate::linalg::Matrix;

/// The layout of elements in texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum Packing {
    /// One element per texel, red, green and blue at once: three systems.
    Rgb,
    /// Four elements per texel, all of one channel; each channel is a separate system.
    Luminance,
}

impl Packing {
    /// Number of elements of a matrix's row in a texel.
    pub const fn elements(self) -> u32 {
        match self {
            Self::Rgb => 1,
            Self::Luminance => 4,
        }
    }

    /// Texels across and down of the matrix of a system of `patches` patches.
    pub const fn matrix_texels(self, patches: usize) -> [usize; 2] {
        match self {
            Self::Rgb => [patches; 2],
            Self::Luminance => [patches.div_ceil(4), 4 * patches.div_ceil(4)],
        }
    }
}

/// The error of a texture that is larger than the card allows; `what` is `a matrix` or `a vector`.
pub(super) fn too_large(what: &str, limit: usize, [width, height]: [usize; 2]) -> InputError {
    input_error!(
        "expected {what} that fits a texture of {limit} x {limit} texels, the card's largest, found {width} x {height}; \
         use fewer patches"
    )
}

pub(super) fn filled(
    what: &str,
    size: [usize; 2],
    limit: usize,
    texel: impl Fn(usize, usize) -> [f32; 4],
) -> Result<Texels, InputError> {
    if size[0].max(size[1]) > limit {
        return Err(too_large(what, limit, size));
    }
    Ok(Texels::from_fn(size, texel))
}

fn element(matrix: &Matrix, row: usize, column: usize) -> f32 {
    if row < matrix.row_count() && column < matrix.column_count() { matrix.row(row)[column] as f32 } else { 0.0 }
}

/// Three matrices of the same size, with one texel per element. `limit` is the card's largest texture side.
pub fn rgb_matrix(matrices: [&Matrix; 3], limit: usize) -> Result<Texels, InputError> {
    filled("a matrix", Packing::Rgb.matrix_texels(matrices[0].row_count()), limit, |x, y| {
        let [r, g, b] = matrices.map(|m| element(m, y, x));
        [r, g, b, 0.0]
    })
}

/// Three vectors, one texel per element.
pub fn rgb_vector(values: &[[f64; 3]], limit: usize) -> Result<Texels, InputError> {
    filled("a vector", [values.len(), 1], limit, |x, _| {
        let [r, g, b] = values[x].map(|value| value as f32);
        [r, g, b, 0.0]
    })
}

/// Four columns per texel. The number of rows is rounded up to a multiple of four, like the length of a vector.
pub fn luminance_matrix(matrix: &Matrix, limit: usize) -> Result<Texels, InputError> {
    filled("a matrix", Packing::Luminance.matrix_texels(matrix.row_count()), limit, |x, y| {
        [0, 1, 2, 3].map(|c| element(matrix, y, 4 * x + c))
    })
}

/// A vector, four elements per texel.
pub fn luminance_vector(values: &[f64], limit: usize) -> Result<Texels, InputError> {
    let value = |i: usize| values.get(i).map_or(0.0, |&value| value as f32);
    filled("a vector", [values.len().div_ceil(4), 1], limit, |x, _| [0, 1, 2, 3].map(|c| value(4 * x + c)))
}

/// The inverse of [`rgb_vector`].
pub fn from_rgb_vector(texels: &Texels) -> Vec<[f32; 3]> {
    texels.texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
}
