//! The arithmetic of number formats on single lanes, and the vector instructions that it is compiled for.
//!
//! - `row`: rows of lanes; `lane`: the interface of an arithmetic; `layout`: fields of floats; `integer`, `fixed`,
//!   `normalized`, `ieee`, `float`: in host integers and host floats; `round`: to formats that are narrower than the
//!   host's; `toward`: in roundings that the host does not have; `odd`, `power`: exact results rounded to odd into
//!   doubles.
//! - `unit`: units of cards, on words.
//! - `any`: the arithmetic for a format; `reading`: slots as numbers of the host.
//! - `matrix`: products of matrices in the units of [`crate::num::matrix`].
//! - `simd`: vector instructions; `evaluate`: one operation on many operands, for tests.

mod any;
mod evaluate;
mod fixed;
mod float;
mod ieee;
mod integer;
mod lane;
mod layout;
mod matrix;
mod normalized;
mod odd;
mod power;
mod reading;
mod round;
mod row;
mod simd;
mod toward;
mod unit;

pub use any::AnyLane;
pub(crate) use any::{Arithmetic, narrow, with_any_lane};
pub use evaluate::{convert, evaluate, exact_dot};
pub(crate) use lane::{Lane, RegisterNumber, apply, is_finite};
pub use matrix::{MatrixColumns, MatrixRows};
pub(crate) use odd::add_odd;
pub use odd::div_odd_long;
pub use reading::Reading;
pub use row::{LANES, LaneRow, TRUE};
pub use simd::SimdLevel;
pub(crate) use unit::{CardLane, CardUnit, Met, drops_small_halves, without_small};
