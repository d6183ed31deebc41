//! A program's formats bound to lane arithmetic.

use super::lanes::AnyLane;
use super::simd::SimdLevel;
use crate::exec::lower::{Arith, Formats};
use crate::num::Format;

/// The formats of a program, the arithmetic of each, and the vector instructions that it uses.
#[derive(Clone, Debug)]
pub(crate) struct LaneFormats {
    table: Formats,
    lanes: [AnyLane; 6],
    simd: SimdLevel,
}

impl LaneFormats {
    /// Those of a program with these formats, in the widest vector instructions.
    pub(crate) fn new(table: Formats) -> Self {
        Self { table, lanes: table.all().map(AnyLane::new), simd: SimdLevel::widest() }
    }

    /// The formats without arithmetic.
    pub(crate) fn table(&self) -> Formats {
        self.table
    }

    pub(crate) fn format(&self, arith: Arith) -> Format {
        self.table.format(arith)
    }

    pub(crate) fn lane(&self, arith: Arith) -> &AnyLane {
        &self.lanes[arith as usize]
    }

    /// The vector instructions to use.
    pub(crate) fn simd(&self) -> SimdLevel {
        self.simd
    }

    /// Chooses vector instructions; `None` for the widest there are.
    pub(crate) fn set_simd(&mut self, level: Option<SimdLevel>) {
        self.simd = level.unwrap_or(SimdLevel::widest());
    }
}
