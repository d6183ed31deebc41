//! Dense numerics in f64. Every sum has a fixed shape: the same bits on any processor and any number of threads.
//!
//! - [`dot`]: the inner product, eight partial sums side by side;
//! - [`Matrix`]: a square matrix by rows, and its product with a vector;
//! - [`Lu`]: the direct solver, Gaussian elimination with partial pivoting.
//!
//! Own code, and small on purpose: a library's product chooses its kernels by the processor (docs/architecture.md).

mod dot;
mod lu;
mod matrix;

pub use dot::dot;
pub use lu::{Lu, Singular};
pub use matrix::{MOST_ROWS, Matrix, MatrixError};
