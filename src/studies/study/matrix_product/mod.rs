//! Study of a matrix product in matrix units: errors by unit and promotion, and the block where a sum first differs.

mod blame;
mod multiply;
mod operands;
mod product;
mod report;

use super::{ProgressFn, Study, StudyError};
use crate::report::Findings;

pub use multiply::MatrixOperands;
pub use operands::MatrixInput;
pub use product::MatrixProduct;

impl Study for MatrixProduct {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let outcome = self.compute(progress)?;
        report::findings(self, outcome)
    }
}
