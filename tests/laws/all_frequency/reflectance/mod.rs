//! Factors of reflectance: what singular values promise, measured files, tables.

mod factors;
mod tables;
