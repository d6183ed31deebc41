//! Operations on rows of 256 lanes.
//!
//! - `code`: operations; `slots`: storage of values; `ops`, `loops`, `masks`, `pack`: their execution; `guard`:
//!   recomputation of results that fast arithmetics get wrong.
//! - `sums`: sums computed by one adder, with the same code for every format.
//! - `cards`: loops of units of cards; `apart`: code that does not depend on the format.
//! - `array`: one operation on arrays of any length.

mod apart;
mod array;
mod cards;
mod code;
mod guard;
mod loops;
mod masks;
mod ops;
mod pack;
mod slots;
mod sums;

pub use array::ArrayOperation;
pub use code::{LaneCode, LaneOp, OPERANDS, Slot};
pub use ops::run;
pub use slots::Slots;
pub use sums::{RowSum, add_rows};
