//! A program's formats bound to lane arithmetic.

use refsim_lanes::{AnyLane, SimdLevel};

use crate::exec::lower::{Arith, Formats};
use crate::num::Format;

/// The formats of a program, the arithmetic of each, and the vector instructions that it uses.
#[derive(Clone, Debug)]
pub(crate) struct LaneFormats {
    table: Formats,
    lanes: Vec<AnyLane>,
    simd: SimdLevel,
}

impl LaneFormats {
    /// Selects the arithmetic of each format.
    pub(crate) fn new(table: Formats, simd: SimdLevel) -> Self {
        let lanes = table.all().iter().copied().map(AnyLane::new).collect();
        Self { table, lanes, simd }
    }

    pub(crate) fn format(&self, arith: Arith) -> Format {
        self.table.format(arith)
    }

    pub(crate) fn lane(&self, arith: Arith) -> &AnyLane {
        &self.lanes[arith.index()]
    }

    /// The vector instructions to use.
    pub(crate) fn simd(&self) -> SimdLevel {
        self.simd
    }
}
