//! Each row of a matrix as a few Haar wavelet coefficients (section VI-B, Figure 6; \[NRH03\]'s non-linear
//! approximation).

use rayon::prelude::*;

use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::baselines::stored::columns_error;
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::error::{InputError, ensure};
use crate::transfer::grid::{LIGHT_SIDE, LIGHT_TEXELS};
use crate::transfer::haar::Haar;

/// Number of coefficients of a face.
pub(super) const FACE: usize = LIGHT_SIDE * LIGHT_SIDE;
/// The largest value of a signed byte.
const BYTE: f64 = 127.0;

/// The criterion by which a row's coefficients are chosen; on ties, the lowest coefficient number is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum CoefficientPriority {
    /// Magnitude times the number of texels under the basis function, as in the paper.
    #[default]
    Area,
    /// Magnitude: the least squared error of the row itself.
    Magnitude,
}

/// Storage of a coefficient's value; the coefficient's number takes two more bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum CoefficientStorage {
    /// A byte, in steps of 1/127 of the largest coefficient of all rows.
    ///
    /// Three bytes per coefficient agree with the paper's 37.1 MB.
    #[default]
    Byte,
    /// Four bytes, an f32.
    Single,
}

/// Options of the approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HaarRowOptions {
    /// Largest number of coefficients per row; 12 in the paper.
    pub keep: usize,
    /// The criterion by which coefficients are chosen.
    pub priority: CoefficientPriority,
    /// The storage of coefficient values.
    pub storage: CoefficientStorage,
}

impl Default for HaarRowOptions {
    fn default() -> Self {
        Self { keep: 12, priority: CoefficientPriority::default(), storage: CoefficientStorage::default() }
    }
}

impl HaarRowOptions {
    /// These options with the largest number of coefficients per row that fits into `bytes`, at least one.
    #[must_use]
    pub fn within(self, bytes: u64, rows: usize) -> Self {
        let each = self.storage.bytes() as u64 * rows.max(1) as u64;
        Self { keep: ((bytes / each) as usize).clamp(1, LIGHT_TEXELS), ..self }
    }
}

impl CoefficientStorage {
    /// Bytes of a coefficient with its number.
    fn bytes(self) -> usize {
        match self {
            Self::Byte => 3,
            Self::Single => 6,
        }
    }
}

/// Rows as their most important coefficients in Haar wavelets over the six faces of 32 x 32 texels.
#[derive(Clone, Debug, PartialEq)]
pub struct HaarRows {
    options: HaarRowOptions,
    begins: Vec<usize>,
    /// Coefficient numbers: 1024 x face + index in the face's pyramid.
    coefficients: Vec<u16>,
    /// Values, rounded as in storage.
    values: Vec<f32>,
}

impl HaarRows {
    /// Selects the most important coefficients of each row of a matrix.
    pub fn new(matrix: &SparseMatrix, options: HaarRowOptions) -> Result<Self, InputError> {
        if matrix.columns() != LIGHT_TEXELS {
            return Err(columns_error(matrix.columns()));
        }
        ensure!(
            (1..=LIGHT_TEXELS).contains(&options.keep),
            "expected 1 to {LIGHT_TEXELS} coefficients per row, found {}",
            options.keep
        );
        let weights = weights(options.priority);
        let scratch = || (Haar::new(LIGHT_SIDE), vec![0.0; FACE]);
        let of_rows: Vec<Vec<(u16, f64)>> = (0..matrix.rows())
            .into_par_iter()
            .map_init(scratch, |(haar, square), row| {
                let mut all = coefficients(matrix, row, haar, square);
                keep_largest(&mut all, options.keep, &weights);
                all
            })
            .collect();
        let largest = of_rows.iter().flatten().fold(0.0_f64, |largest, (_, value)| largest.max(value.abs()));
        let step = largest / BYTE;
        let stored = |value: f64| match options.storage {
            CoefficientStorage::Byte if step > 0.0 => ((value / step).round() * step) as f32,
            CoefficientStorage::Byte | CoefficientStorage::Single => value as f32,
        };
        let mut rows = Self { options, begins: vec![0], coefficients: Vec::new(), values: Vec::new() };
        for of_row in of_rows {
            rows.coefficients.extend(of_row.iter().map(|(at, _)| *at));
            rows.values.extend(of_row.iter().map(|(_, value)| stored(*value)));
            rows.begins.push(rows.coefficients.len());
        }
        Ok(rows)
    }

    /// Number of stored coefficients; rows with few non-zero coefficients store fewer than requested.
    pub fn stored(&self) -> usize {
        self.coefficients.len()
    }

    /// A row's coefficients by increasing number, with their values. Panics if there is no such row.
    pub fn row(&self, row: usize) -> impl ExactSizeIterator<Item = (usize, f64)> {
        let of = self.begins[row]..self.begins[row + 1];
        let values = self.values[of.clone()].iter().map(|&value| f64::from(value));
        self.coefficients[of].iter().map(|&at| usize::from(at)).zip(values)
    }
}

impl StoredTransfer for HaarRows {
    fn sizes(&self) -> Vec<StoredSize> {
        let each = self.options.storage.bytes();
        let rows = self.begins.len() - 1;
        let filled = match self.options.storage {
            CoefficientStorage::Byte => "3 bytes per coefficient, as many in each row",
            CoefficientStorage::Single => "6 bytes per coefficient, as many in each row",
        };
        let whole = StoredSize { layout: filled, bytes: (each * self.options.keep * rows) as u64 };
        let bytes = (each * self.stored() + 4 * self.begins.len()) as u64;
        vec![whole, StoredSize { layout: "only nonzeros, 4 bytes per row", bytes }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        let light = transformed(light);
        let row = |row| self.row(row).fold(0.0, |sum, (at, value)| sum + value * light[at]);
        (0..self.begins.len() - 1).map(row).collect()
    }
}

/// Coefficients of a vector over all light texels, face by face.
pub(super) fn transformed(vector: &[f64]) -> Vec<f64> {
    assert_eq!(vector.len(), LIGHT_TEXELS, "a number per light texel");
    let (mut haar, mut all) = (Haar::new(LIGHT_SIDE), vector.to_vec());
    all.chunks_exact_mut(FACE).for_each(|face| haar.forward(face));
    all
}

/// Weight of each coefficient's magnitude, for one face.
fn weights(priority: CoefficientPriority) -> Vec<f64> {
    let haar = Haar::new(LIGHT_SIDE);
    let weight = |at: usize| match priority {
        CoefficientPriority::Area => haar.support(at).side.pow(2) as f64,
        CoefficientPriority::Magnitude => 1.0,
    };
    (0..FACE).map(weight).collect()
}

/// All non-zero coefficients of a row, by increasing number; only faces with an entry are transformed.
fn coefficients(matrix: &SparseMatrix, row: usize, haar: &mut Haar, square: &mut [f64]) -> Vec<(u16, f64)> {
    let face = |entry: &MatrixEntry| entry.index as usize / FACE;
    let mut all = Vec::new();
    for of_face in matrix.row(row).chunk_by(|a, b| face(a) == face(b)) {
        square.fill(0.0);
        let first = face(&of_face[0]) * FACE;
        of_face.iter().for_each(|entry| square[entry.index as usize - first] = matrix.value(entry.value));
        haar.forward(square);
        let nonzero = (first..).zip(&*square).filter(|(_, value)| **value != 0.0);
        all.extend(nonzero.map(|(at, &value)| (at as u16, value)));
    }
    all
}

/// Keeps the coefficients of largest weighted magnitude, by increasing number.
fn keep_largest(all: &mut Vec<(u16, f64)>, keep: usize, weights: &[f64]) {
    if all.len() > keep {
        let priority = |&(at, value): &(u16, f64)| weights[usize::from(at) % FACE] * value.abs();
        all.select_nth_unstable_by(keep - 1, |a, b| priority(b).total_cmp(&priority(a)).then(a.0.cmp(&b.0)));
        all.truncate(keep);
    }
    all.sort_unstable_by_key(|&(at, _)| at);
}
