//! Study of a matrix product in matrix units: errors by unit and promotion, and the block where a sum first differs.

mod blame;
mod multiply;
mod operands;
mod product;
mod report;

pub use multiply::MatrixOperands;
pub use operands::MatrixInput;
pub use product::MatrixProduct;
