//! Number formats and the arithmetic in them: exact by definition ([`num`]), and in vector code of the host.
//!
//! The lower part of the emulator `refsim`, which re-exports its public items as `refsim::num` and
//! `refsim::exec::batch`. It is a separate package because it is most of the emulator's machine code: a change of the
//! assembler, the checker or the machine recompiles none of it. Use `refsim` instead.
//!
//! - [`num`]: the definition, by integer operations alone.
//! - `lanes`: the same arithmetic on single lanes, written apart from `num`, for each format the fastest way that gives
//!   the same bits.
//! - `rows`: operations on rows of 256 lanes, compiled for each level of vector instructions.

pub mod num;

mod lanes;
mod rows;

pub use lanes::{
    AnyLane, LANES, LaneRow, MatrixColumns, MatrixRows, Reading, SimdLevel, TRUE, convert, div_odd_long, evaluate,
    exact_dot,
};
pub use rows::{ArrayOperation, LaneCode, LaneOp, OPERANDS, RowSum, Slot, Slots, add_rows, run};
