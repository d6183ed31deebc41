//! The sum of biclusters: exactly the matrix.

use super::Biclustering;
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::error::{InputError, input_error};

impl Biclustering {
    /// The sum of the biclusters: the original matrix. Fails with [`InputError`] if 32 bits do not hold a sum, which can
    /// happen for biclusters from other programs.
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
                            "expected a sum that 32 bits of units hold in row {row}, column {index} (counted from 0), \
                             found another: the biclusters are of no matrix"
                        ));
                    }
                }
            }
            matrix.push_row(&entries)?;
        }
        Ok(matrix)
    }
}
