//! Values of options: what the parsers of the program and of the studies' own options share.

pub mod number;
pub mod one_of;
mod size;

pub use size::{BadSize, Size};
