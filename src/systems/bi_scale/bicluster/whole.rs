//! Biclusters, and their sum: exactly the matrix.

use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix, number};
use crate::error::{InputError, input_error};

/// A constant-column bicluster: within each of its columns, all of its rows have the same value (equation 4).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bicluster {
    /// Rows j_1 ... j_r, increasing.
    pub rows: Vec<u32>,
    /// Columns k_1 ... k_l, increasing, each with its non-zero value t, in units of the matrix.
    pub columns: Vec<MatrixEntry>,
}

impl Bicluster {
    /// Cost W = r + 2l - 1: multiplications and additions of the bicluster's product (equation 7).
    pub fn cost(&self) -> u64 {
        self.rows.len() as u64 + 2 * self.columns.len() as u64 - 1
    }

    /// True if the bicluster fits a matrix of this size: rows and columns are in range and increasing, and values are
    /// non-zero.
    pub(crate) fn fits(&self, [matrix_rows, matrix_columns]: [usize; 2]) -> bool {
        let increase = self.rows.is_sorted_by(|a, b| a < b) && self.columns.is_sorted_by(|a, b| a.index < b.index);
        let row_fits = self.rows.last().is_some_and(|&row| (row as usize) < matrix_rows);
        let column_fits = self.columns.last().is_some_and(|last| (last.index as usize) < matrix_columns);
        increase && row_fits && column_fits && self.columns.iter().all(|entry| entry.value != 0)
    }
}

/// A matrix as a sum of biclusters (equation 8), in the order in which they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Biclustering {
    matrix_rows: usize,
    matrix_columns: usize,
    fraction_bits: u32,
    row_begins: Vec<usize>,
    rows: Vec<u32>,
    column_begins: Vec<usize>,
    columns: Vec<MatrixEntry>,
}

impl Biclustering {
    /// The biclustering of a zero matrix of this size.
    pub(crate) fn empty(matrix_rows: usize, matrix_columns: usize, fraction_bits: u32) -> Self {
        let (row_begins, column_begins) = (vec![0], vec![0]);
        let (rows, columns) = (Vec::new(), Vec::new());
        Self { matrix_rows, matrix_columns, fraction_bits, row_begins, rows, column_begins, columns }
    }

    pub(crate) fn push(&mut self, bicluster: &Bicluster) {
        self.rows.extend_from_slice(&bicluster.rows);
        self.row_begins.push(self.rows.len());
        self.columns.extend_from_slice(&bicluster.columns);
        self.column_begins.push(self.columns.len());
    }

    /// The number of biclusters.
    pub fn len(&self) -> usize {
        self.row_begins.len() - 1
    }

    /// True if there are no biclusters, so that the matrix is 0.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows and columns of the matrix.
    pub fn matrix_size(&self) -> [usize; 2] {
        [self.matrix_rows, self.matrix_columns]
    }

    /// Number f of fraction bits: values are multiples of 2^-f.
    pub fn fraction_bits(&self) -> u32 {
        self.fraction_bits
    }

    /// The number that the value of a column represents.
    #[inline]
    pub fn value(&self, value: i32) -> f64 {
        number(value, self.fraction_bits)
    }

    /// The rows of a bicluster, increasing. Panics if there is no such bicluster.
    pub fn rows_of(&self, bicluster: usize) -> &[u32] {
        &self.rows[self.row_begins[bicluster]..self.row_begins[bicluster + 1]]
    }

    /// The columns of a bicluster with their values, increasing. Panics if there is no such bicluster.
    pub fn columns_of(&self, bicluster: usize) -> &[MatrixEntry] {
        &self.columns[self.column_begins[bicluster]..self.column_begins[bicluster + 1]]
    }

    /// One bicluster, copied. Panics if there is no such bicluster.
    pub fn get(&self, bicluster: usize) -> Bicluster {
        Bicluster { rows: self.rows_of(bicluster).to_vec(), columns: self.columns_of(bicluster).to_vec() }
    }

    /// The sum of r over all biclusters.
    pub fn row_entries(&self) -> usize {
        self.rows.len()
    }

    /// The sum of l over all biclusters.
    pub fn column_entries(&self) -> usize {
        self.columns.len()
    }

    /// The cost of the product of light and all biclusters, in floating-point operations: the sum of r + 2l - 1.
    pub fn cost(&self) -> u64 {
        (self.rows.len() + 2 * self.columns.len() - self.len()) as u64
    }

    /// The biclusters I_j of each row j, increasing within a row, row by row; the first vector has the start of each
    /// row, then the end of the last.
    pub fn by_row(&self) -> (Vec<usize>, Vec<u32>) {
        let mut begins = vec![0; self.matrix_rows + 1];
        self.rows.iter().for_each(|&row| begins[row as usize + 1] += 1);
        (0..self.matrix_rows).for_each(|row| begins[row + 1] += begins[row]);
        let mut ends = begins.clone();
        let mut of_row = vec![0; self.rows.len()];
        for bicluster in 0..self.len() {
            for &row in self.rows_of(bicluster) {
                of_row[ends[row as usize]] = bicluster as u32;
                ends[row as usize] += 1;
            }
        }
        (begins, of_row)
    }

    /// The sum of the biclusters: the original matrix. Fails with [`InputError`] if a sum does not fit into 32 bits, as
    /// may happen for biclusters from other programs.
    pub fn sum(&self) -> Result<SparseMatrix, InputError> {
        let (begins, of_row) = self.by_row();
        let columns = self.matrix_size()[1];
        let mut matrix = SparseMatrix::new(columns, self.fraction_bits())?;
        let (mut sums, mut touched) = (vec![0_i64; columns], Vec::new());
        for (row, ends) in begins.windows(2).enumerate() {
            for entry in of_row[ends[0]..ends[1]].iter().flat_map(|&number| self.columns_of(number as usize)) {
                sums[entry.index as usize] += i64::from(entry.value);
                touched.push(entry.index);
            }
            touched.sort_unstable();
            touched.dedup();
            let mut entries = Vec::new();
            for index in touched.drain(..) {
                match i32::try_from(std::mem::take(&mut sums[index as usize])) {
                    Ok(0) => {}
                    Ok(value) => entries.push(MatrixEntry { index, value }),
                    Err(_) => {
                        return Err(input_error!(
                            "expected a sum that fits into 32 bits in row {row}, column {index} (counted from 0), \
                             found another: the biclusters belong to no matrix"
                        ));
                    }
                }
            }
            matrix.push_row(&entries)?;
        }
        Ok(matrix)
    }
}
