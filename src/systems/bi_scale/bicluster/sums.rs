//! Sums of biclusters, and the residual of a matrix: exact if the matrix has a unit, else in f64.

use super::Biclustering;
use crate::bi_scale::matrix::{EntryValues, SparseMatrix};
use crate::error::{InputError, ensure};
use crate::io::CoordinateMatrix;

/// Difference between the sum of biclusters and a matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BiclusterResidual {
    /// Number of elements that differ.
    pub count: usize,
    /// The largest magnitude of a difference.
    pub largest: f64,
    /// The sum of squared differences.
    pub squares: f64,
}

impl BiclusterResidual {
    fn add(&mut self, difference: f64) {
        self.count += 1;
        self.largest = self.largest.max(difference.abs());
        self.squares += difference * difference;
    }
}

impl Biclustering {
    /// The sum of the biclusters: exactly the original matrix if that has a unit, else the original matrix up to
    /// rounding of residuals and of the sum. Fails with [`InputError`] if a sum is not a valid matrix value, which can
    /// happen for biclusters from other programs.
    pub fn sum(&self) -> Result<SparseMatrix, InputError> {
        let ([rows, columns], bits) = (self.matrix_size(), self.values().fraction_bits());
        let units = bits.map(EntryValues::units);
        let mut entries = Vec::new();
        self.sums(None, |row, column, sum| {
            let holds = if units.is_some() { "32 bits of units" } else { "double precision" };
            let is_value = units.as_ref().map_or(sum.is_finite(), |units| units.entry(sum).is_some());
            entries.push((row, column, sum));
            ensure!(
                is_value,
                "expected a sum that {holds} holds in row {row}, column {column} (counted from 0), found another: the \
                 biclusters are of no matrix"
            );
            Ok(())
        })?;
        let sum = CoordinateMatrix { rows, columns, entries };
        let sum = bits.map_or_else(|| SparseMatrix::from_coordinates(&sum), |bits| SparseMatrix::in_units(&sum, bits));
        Ok(sum.expect("finite numbers in a matrix of this size"))
    }

    /// Difference of the sum from a matrix of the same size; zero if the matrix has a unit. Panics if the sizes
    /// differ.
    pub fn residual(&self, matrix: &SparseMatrix) -> BiclusterResidual {
        assert_eq!(self.matrix_size(), [matrix.rows(), matrix.columns()], "the size of the matrix");
        let mut residual = BiclusterResidual::default();
        let done = self.sums(Some(matrix), |_, _, difference| {
            residual.add(difference);
            Ok(())
        });
        done.expect("nothing is refused");
        residual
    }

    /// Calls `take` with the row, column and value of each non-zero sum of biclusters minus the matrix `less`, row by
    /// row. Sums are in the order of biclusters; f64 represents sums of multiples of one unit exactly.
    fn sums(
        &self,
        less: Option<&SparseMatrix>,
        mut take: impl FnMut(u32, u32, f64) -> Result<(), InputError>,
    ) -> Result<(), InputError> {
        let (begins, of_row) = self.by_row();
        let mut sums = vec![0.0; self.matrix_size()[1]];
        let mut touched = Vec::new();
        for (row, ends) in begins.windows(2).enumerate() {
            let of_biclusters = of_row[ends[0]..ends[1]].iter().flat_map(|&number| self.columns_of(number as usize));
            let added = of_biclusters.map(|entry| (entry.index, self.value(entry.value)));
            let subtracted = less
                .into_iter()
                .flat_map(|matrix| matrix.row(row).iter().map(|entry| (entry.index, -matrix.value(entry.value))));
            for (column, value) in added.chain(subtracted) {
                sums[column as usize] += value;
                touched.push(column);
            }
            touched.sort_unstable();
            touched.dedup();
            for column in touched.drain(..) {
                let sum = std::mem::take(&mut sums[column as usize]);
                if sum != 0.0 {
                    take(row as u32, column, sum)?;
                }
            }
        }
        Ok(())
    }
}
