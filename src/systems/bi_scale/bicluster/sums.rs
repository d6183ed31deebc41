//! Sums of biclusters, and what they leave of a matrix, without rounding.

use num_bigint::BigInt;

use super::Biclustering;
use crate::bi_scale::exact::ExactNumber;
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::bi_scale::values::EntryValues;
use crate::error::{InputError, input_error};
use crate::io::CoordinateMatrix;

/// How the sum of biclusters differs from a matrix.
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

/// How entries with the values of biclusters, or of a matrix, change a sum.
type Change<'a, N> = &'a dyn Fn(&mut N, i32);

impl Biclustering {
    /// The sum of the biclusters, which is exactly the original matrix.
    ///
    /// # Errors
    /// [`InputError`] if a sum can be no value of a matrix, which happens for biclusters from elsewhere and
    /// where residuals were dropped.
    pub fn sum(&self) -> Result<SparseMatrix, InputError> {
        let ([rows, columns], bits) = (self.matrix_size(), self.values().fraction_bits());
        let error = |row: usize, column, holds| {
            input_error!(
                "expected a sum that {holds} holds in row {row}, column {column} (counted from 0), found \
                 another: the biclusters are of no matrix"
            )
        };
        let Some(bits) = bits else {
            let mut entries = Vec::new();
            self.exact_rows(None, |row, sums| {
                for (column, sum) in sums {
                    let value = sum.double().ok_or_else(|| error(row, column, "double precision"))?;
                    entries.push((row as u32, column, value));
                }
                Ok(())
            })?;
            let sum = SparseMatrix::from_coordinates(&CoordinateMatrix { rows, columns, entries });
            return Ok(sum.expect("finite numbers in a matrix of this size"));
        };
        let mut matrix = SparseMatrix::new(columns, bits).expect("the size of a matrix");
        let mut push = |row: usize, sums: Vec<(u32, Option<i32>)>| -> Result<(), InputError> {
            let entry = |(index, value): (u32, Option<i32>)| -> Result<MatrixEntry, InputError> {
                let value = value.ok_or_else(|| error(row, index, "32 bits of units"))?;
                Ok(MatrixEntry { index, value })
            };
            let entries: Vec<MatrixEntry> = sums.into_iter().map(entry).collect::<Result<_, _>>()?;
            matrix.push_row(&entries).expect("a row of a matrix");
            Ok(())
        };
        if self.values().table_len().is_none() {
            self.unit_rows(None, |row, sums| {
                push(row, sums.into_iter().map(|(column, sum)| (column, i32::try_from(sum).ok())).collect())
            })?;
        } else {
            let units = |sum: &ExactNumber| i32::try_from(sum.in_units(-bits.cast_signed())?).ok();
            self.exact_rows(None, |row, sums| {
                push(row, sums.into_iter().map(|(column, sum)| (column, units(&sum))).collect())
            })?;
        }
        Ok(matrix)
    }

    /// How the sum differs from a matrix of the same size; not at all if nothing was dropped. Differences are exact
    /// until they are rounded to f64.
    ///
    /// # Panics
    /// If the sizes differ.
    pub fn residual(&self, matrix: &SparseMatrix) -> BiclusterResidual {
        assert_eq!(self.matrix_size(), [matrix.rows(), matrix.columns()], "the size of the matrix");
        let mut residual = BiclusterResidual::default();
        let units = matrix.values().fraction_bits().filter(|_| matrix.values().table_len().is_none());
        let done = if self.values().table_len().is_none() && units == self.values().fraction_bits() {
            let unit = matrix.values().unit();
            self.unit_rows(Some(matrix), |_, sums| {
                sums.iter().for_each(|&(_, units)| residual.add(unit * units as f64));
                Ok(())
            })
        } else {
            self.exact_rows(Some(matrix), |_, sums| {
                sums.iter().for_each(|(_, difference)| residual.add(difference.nearest()));
                Ok(())
            })
        };
        done.expect("nothing is refused");
        residual
    }

    /// Sums other than 0 of each row in units, `less` a matrix in the same.
    fn unit_rows(
        &self,
        less: Option<&SparseMatrix>,
        take: impl FnMut(usize, Vec<(u32, i64)>) -> Result<(), InputError>,
    ) -> Result<(), InputError> {
        let add = |sum: &mut i64, entry: i32| *sum += i64::from(entry);
        let subtract = |sum: &mut i64, entry: i32| *sum -= i64::from(entry);
        self.rows_of_sums((&add, &subtract), less, |sum| Some(sum).filter(|sum| *sum != 0), take)
    }

    /// The same of any numbers.
    fn exact_rows(
        &self,
        less: Option<&SparseMatrix>,
        take: impl FnMut(usize, Vec<(u32, ExactNumber)>) -> Result<(), InputError>,
    ) -> Result<(), InputError> {
        let of_matrix = less.map_or(i32::MAX, |matrix| matrix.values().least_exponent());
        let exponent = of_matrix.min(self.values().least_exponent());
        let units = |values: &EntryValues, entry| -> BigInt {
            values.exact(entry).in_units(exponent).expect("a multiple of the finest number")
        };
        let add = |sum: &mut BigInt, entry: i32| *sum += units(self.values(), entry);
        let subtract = |sum: &mut BigInt, entry: i32| {
            if let Some(matrix) = less {
                *sum -= units(matrix.values(), entry);
            }
        };
        let number = |sum: BigInt| Some(ExactNumber::new(sum, exponent)).filter(|sum| *sum.whole() != BigInt::ZERO);
        self.rows_of_sums((&add, &subtract), less, number, take)
    }

    /// Calls `take` with each row, its columns and its sums, as far as `finish` of a sum is something.
    fn rows_of_sums<N: Default, S>(
        &self,
        (add, subtract): (Change<'_, N>, Change<'_, N>),
        less: Option<&SparseMatrix>,
        finish: impl Fn(N) -> Option<S>,
        mut take: impl FnMut(usize, Vec<(u32, S)>) -> Result<(), InputError>,
    ) -> Result<(), InputError> {
        let (begins, of_row) = self.by_row();
        let mut sums: Vec<N> = Vec::new();
        sums.resize_with(self.matrix_size()[1], N::default);
        let mut touched = Vec::new();
        for (row, ends) in begins.windows(2).enumerate() {
            let of_biclusters = of_row[ends[0]..ends[1]].iter().flat_map(|&number| self.columns_of(number as usize));
            let of_matrix = less.map_or(&[][..], |matrix| matrix.row(row));
            for (change, entry) in
                of_biclusters.map(|entry| (add, entry)).chain(of_matrix.iter().map(|entry| (subtract, entry)))
            {
                change(&mut sums[entry.index as usize], entry.value);
                touched.push(entry.index);
            }
            touched.sort_unstable();
            touched.dedup();
            let sum = |column: u32| Some((column, finish(std::mem::take(&mut sums[column as usize]))?));
            take(row, touched.drain(..).filter_map(sum).collect())?;
        }
        Ok(())
    }
}
