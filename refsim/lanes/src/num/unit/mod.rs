//! Arithmetic units of cards, bit for bit as measured.
//!
//! The rules and the tables restate the integer models of envytools (MIT, M. Koscielnicka; `hwtest` and `nvhw` at
//! commit f102b823), whose tests compare every bit with real chips: the vertex units of NV20, NV25 and an NV34 (a
//! sibling of NV30 and NV35), and the unit of GT200.
//!
//! | file | contents |
//! |---|---|
//! | `word.rs` | single floats as words; truncation to 24 bits |
//! | `dispatch.rs` | maps each [`super::NumberOperation`] to a function |
//! | `tables.rs` | the tables of the chips, `tables/*.csv` |
//! | [`nv`] | vertex units: product, aligned sum, comparisons, floor |
//! | [`nv_functions`] | vertex units: RCP RCC RSQ EXP LOG LIT, and LG2 EX2 SIN COS of NV3x |
//! | [`gt200`] | GT200: sums, products, MAD with its truncated product, comparisons, floor |
//! | [`gt200_functions`] | GT200: RCP RSQRT LG2, PRESIN SIN COS, PREEX2 EX2 |
//!
//! Operands and results are 32-bit words. A NaN result is [`NAN`]; an instruction that copies an operand keeps its
//! word, including NaN and subnormals. [`super::ops`] dispatches to the units by [`super::Format::unit`]. Operations of
//! a unit raise only `INVALID`, if the result is NaN and no operand is; comparisons raise it as in IEEE 754.

mod dispatch;
pub mod gt200;
pub mod gt200_functions;
pub mod nv;
pub mod nv_functions;
mod operation;
pub mod tables;
mod word;

pub use word::NAN;

pub(super) use dispatch::{dot, evaluate, order};
pub(super) use operation::UnitOperation;
