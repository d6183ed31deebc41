//! Factors of reflectance: error bounds by singular values, measured files, tables.

mod factors;
mod tables;
