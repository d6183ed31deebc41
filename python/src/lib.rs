//! The compiled part of the Python package `crossbar_gi`: loops over arrays, and the library's studies as JSON
//! documents.
//!
//! Users see the Python modules in `crossbar_gi/`, which handle shapes, broadcasting and names. Functions here take
//! C-order arrays of one type, and return arrays, or JSON documents.
//!
//! - `operand`: operands in the shape of a result; `signals`: work without the interpreter's lock, which Ctrl-C
//!   interrupts; `error`: errors of the library as Python errors. `numbers`: number formats; `matrix`: matrix units;
//!   `oracle`: exact hits; `cases`: cases on cards; `studies`: studies and pictures.

mod cases;
mod error;
mod matrix;
mod numbers;
mod operand;
mod oracle;
mod signals;
mod studies;

use pyo3::prelude::*;

/// The compiled part of `crossbar_gi`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::cases::{Case, compare};
    #[pymodule_export]
    use crate::matrix::{matmul, unit_dot, units};
    #[pymodule_export]
    use crate::numbers::{compute, compute_patterns, dot, format_facts, from_patterns, to_patterns};
    #[pymodule_export]
    use crate::oracle::{Oracle, aims, hard_rays, kinds};
    #[pymodule_export]
    use crate::studies::{diff, entries, precision, reproduce};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
