//! The arithmetic units of cards, on words. Shares only the tables with [`crate::num::unit`].
//!
//! - `word`: single floats as words.
//! - `nv`, `nv_functions`: the vertex unit of NV20 to NV35; `gt200`, `gt200_functions`: the unit of GT200.
//! - `tables`: tables as doubles.
//! - `card`: a unit as the arithmetic of a format.
//!
//! Slots hold the words themselves, so an instruction that copies an operand keeps all bits of a NaN or subnormal
//! number.

mod card;
mod gt200;
mod gt200_functions;
mod nv;
mod nv_functions;
mod tables;
mod word;

pub(crate) use card::{CardLane, CardUnit};
pub(crate) use gt200::{Gt200, drops_small_halves, without_small};
pub(crate) use nv::Nv;
pub(crate) use word::Met;
