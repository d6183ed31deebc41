//! Number formats and the arithmetic in them: exact by definition ([`num`]), and in vector code of the host.
//!
//! The lower part of the emulator `refsim`, which re-exports its public items as `refsim::num` and
//! `refsim::exec::batch`. It contains most of the emulator's machine code. As a separate package, it is not recompiled
//! when the assembler, the checker or the machine changes. Use `refsim` instead.
//!
//! - [`num`]: the definition, by integer operations alone.
//! - `lanes`: the same arithmetic on single lanes, written independently of `num`, with the fastest method for each
//!   format that gives the same bits.
//! - `rows`: operations on rows of 256 lanes, compiled for each level of vector instructions.

pub mod num;

mod lanes;
mod rows;

pub use lanes::{
    AnyLane, LANES, LaneRow, MatrixColumns, MatrixRows, Reading, SimdLevel, TRUE, convert, div_odd_long, evaluate,
    exact_dot,
};
pub use rows::{ArrayOperation, LaneCode, LaneOp, OPERANDS, RowSum, Slot, Slots, add_rows, run};
