//! The paper by plain loops in f64: Algorithm 1 on a dense matrix, Algorithm 2, and equation 3.

use super::bicluster::{Bicluster, Biclustering, start};
use super::matrix::{MatrixEntry, SparseMatrix};
use super::shade::ShadedPixel;
use super::texture::{BidirectionalTexture, GridSamples};

/// A submatrix T_b: its rows, and its columns with the values t of the bicluster.
#[derive(Clone, Debug)]
struct Submatrix {
    rows: Vec<usize>,
    columns: Vec<(usize, f64)>,
}

impl Submatrix {
    /// Equation 9: 2 nnz(M) - (r + 2l - 1) - 2 nnz(M_R), where M_R is M minus the bicluster.
    fn reduction(&self, matrix: &[Vec<f64>]) -> i64 {
        let mut nonzeros = 0;
        let mut residual_nonzeros = 0;
        for &row in &self.rows {
            for (column, t) in &self.columns {
                let value = matrix[row][*column];
                nonzeros += i64::from(value != 0.0);
                residual_nonzeros += i64::from(value != *t);
            }
        }
        let cost = (self.rows.len() + 2 * self.columns.len()).cast_signed() as i64 - 1;
        2 * nonzeros - cost - 2 * residual_nonzeros
    }

    /// The submatrix after an insertion or a deletion of a row; `None` if no row would be left.
    fn with_row_changed(&self, row: usize) -> Option<Self> {
        let mut changed = self.clone();
        match changed.rows.iter().position(|&inside| inside == row) {
            None => changed.rows.push(row),
            Some(_) if changed.rows.len() == 1 => return None,
            Some(at) => _ = changed.rows.remove(at),
        }
        Some(changed)
    }

    /// Like [`Self::with_row_changed`], for a column. Also `None` if a column is 0 in all rows, because it then has no
    /// value.
    fn with_column_changed(&self, column: usize, matrix: &[Vec<f64>]) -> Option<Self> {
        let mut changed = self.clone();
        match changed.columns.iter().position(|(inside, _)| *inside == column) {
            None => changed.columns.push((column, self.most_frequent(column, matrix)?)),
            Some(_) if changed.columns.len() == 1 => return None,
            Some(at) => _ = changed.columns.remove(at),
        }
        Some(changed)
    }

    /// The most frequent non-zero value of a column in the rows; on ties, the lowest value.
    fn most_frequent(&self, column: usize, matrix: &[Vec<f64>]) -> Option<f64> {
        let values = || self.rows.iter().map(|&row| matrix[row][column]).filter(|&value| value != 0.0);
        let count = |value: f64| values().filter(|&other| other == value).count();
        values().max_by(|&a, &b| count(a).cmp(&count(b)).then(b.total_cmp(&a)))
    }

    /// Converts to a bicluster, with values in units of 2^-`fraction_bits`.
    fn bicluster(mut self, fraction_bits: u32) -> Bicluster {
        self.rows.sort_unstable();
        self.columns.sort_unstable_by_key(|&(column, _)| column);
        let units = |t: f64| (t * f64::from(1_u32 << fraction_bits)) as i32;
        let entry = |(column, t): (usize, f64)| MatrixEntry { index: column as u32, value: units(t) };
        Bicluster {
            rows: self.rows.iter().map(|&row| row as u32).collect(),
            columns: self.columns.into_iter().map(entry).collect(),
        }
    }
}

/// Algorithm 1, in which every possible operation is tried and evaluated with equation 9. Each operation scans the
/// whole matrix, so the function is for small matrices.
pub fn biclusters(matrix: &SparseMatrix, seed: u64) -> Biclustering {
    let mut left = dense(matrix);
    let mut found = Biclustering::empty(matrix.rows(), matrix.columns(), matrix.fraction_bits());
    // Line 2: until no element is left.
    while let Some((row, column)) = choose(&left, seed, found.len()) {
        // Lines 5 and 6.
        let mut submatrix = Submatrix { rows: vec![row], columns: vec![(column, left[row][column])] };
        // Lines 7 to 20.
        while let Some(better) = best_operation(&submatrix, &left) {
            submatrix = better;
        }
        // Lines 15 and 16: the bicluster is subtracted, which leaves the residual.
        for &row in &submatrix.rows {
            for (column, t) in &submatrix.columns {
                left[row][*column] -= t;
            }
        }
        found.push(&submatrix.bicluster(matrix.fraction_bits()));
    }
    found
}

fn dense(matrix: &SparseMatrix) -> Vec<Vec<f64>> {
    let row = |row| {
        let mut values = vec![0.0; matrix.columns()];
        for entry in matrix.row(row) {
            values[entry.index as usize] = matrix.value(entry.value);
        }
        values
    };
    (0..matrix.rows()).map(row).collect()
}

/// Row and column of the element at which the next bicluster starts.
fn choose(left: &[Vec<f64>], seed: u64, number: usize) -> Option<(usize, usize)> {
    let places = left.iter().enumerate().flat_map(|(row, values)| {
        values.iter().enumerate().filter(|(_, value)| **value != 0.0).map(move |(column, _)| (row, column))
    });
    let places: Vec<(usize, usize)> = places.collect();
    (!places.is_empty()).then(|| places[start(seed, number as u64, places.len() as u64) as usize])
}

/// The submatrix after the operation that reduces the cost most; `None` if no operation reduces it.
fn best_operation(submatrix: &Submatrix, left: &[Vec<f64>]) -> Option<Submatrix> {
    let after_rows = (0..left.len()).filter_map(|row| submatrix.with_row_changed(row));
    let after_columns = (0..left[0].len()).filter_map(|column| submatrix.with_column_changed(column, left));
    let mut best = None;
    let mut most = submatrix.reduction(left);
    for after in after_rows.chain(after_columns) {
        let reduction = after.reduction(left);
        if reduction > most {
            (best, most) = (Some(after), reduction);
        }
    }
    best
}

/// Algorithm 2 in f64, step by step. Panics if the light does not have one number per column.
pub fn multiply(biclusters: &Biclustering, light: &[f64]) -> Vec<f64> {
    let [rows, columns] = biclusters.matrix_size();
    assert_eq!(light.len(), columns, "as many numbers as columns");
    // Lines 1 to 3: the bicluster buffer P.
    let mut buffer = vec![0.0; biclusters.len()];
    for (bicluster, sum) in buffer.iter_mut().enumerate() {
        for entry in biclusters.columns_of(bicluster) {
            *sum += biclusters.value(entry.value) * light[entry.index as usize];
        }
    }
    // Lines 4 to 11 with exchanged loops: each row adds its biclusters in the same order.
    let mut local = vec![0.0; rows];
    for (bicluster, sum) in buffer.iter().enumerate() {
        for &row in biclusters.rows_of(bicluster) {
            local[row as usize] += sum;
        }
    }
    local
}

/// Equation 3: B(x, e) = sum over d of b(u, e, d) L~(x, d). `local` is L~ of all vertices, with local direction j of
/// vertex p in row M p + j.
///
/// Sums begin with 0. The sum over directions of light contains, per direction, sums over four views with four texels
/// each, and over the triangle's three corners.
pub fn radiance(texture: &BidirectionalTexture, local: &[[f64; 3]], pixel: &ShadedPixel) -> [f64; 3] {
    let lights = texture.light().directions().len();
    let views = GridSamples::of_view(texture.view(), pixel.view);
    let texels = GridSamples::of_texels(texture.size(), pixel.place);
    let mut radiance = [0.0; 3];
    for light in 0..lights {
        for (channel, radiance) in radiance.iter_mut().enumerate() {
            let mut b = 0.0;
            for (view, of_view) in views.numbers.into_iter().zip(views.weights) {
                let patch = texture.patch(view, light);
                for (texel, of_texel) in texels.numbers.into_iter().zip(texels.weights) {
                    b += of_view * of_texel * f64::from(patch[texel][channel]);
                }
            }
            let mut arriving = 0.0;
            for (corner, weight) in pixel.corners.into_iter().zip(pixel.weights) {
                arriving += weight * local[corner as usize * lights + light][channel];
            }
            *radiance += b * arriving;
        }
    }
    radiance
}
