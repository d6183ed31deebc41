//! Operations on rows of 256 lanes.
//!
//! - `code`: operations; `slots`: storage of values; `ops`, `loops`, `masks`, `pack`: their execution; `guard`:
//!   recomputation of results that fast arithmetics get wrong.
//! - `cards`: loops of units of cards.
//! - `array`: one operation on arrays of any length.

mod array;
mod cards;
mod code;
mod guard;
mod loops;
mod masks;
mod ops;
mod pack;
mod slots;

pub use array::ArrayOperation;
pub use code::{LaneCode, LaneOp, OPERANDS, Slot};
pub use ops::run;
pub use slots::Slots;
