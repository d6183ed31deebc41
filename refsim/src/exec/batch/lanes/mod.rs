//! The arithmetic of number formats on single lanes, and the vector instructions that it is compiled for.
//!
//! - `lane`: what an arithmetic has to offer; `fixed`, `normalized`, `ieee`, `float`: in host integers
//!   and host floats; `round`: to formats that are narrower than the host's; `toward`: in roundings that the host does
//!   not have; `odd`, `power`: exact results rounded to odd into doubles; `any`: which format gets which; `formats`:
//!   those of a program.
//! - `simd`: vector instructions; `evaluate`: one operation on many operands, for the proof.

mod any;
mod evaluate;
mod fixed;
mod float;
mod formats;
mod ieee;
mod lane;
mod normalized;
pub(crate) mod odd;
mod power;
mod round;
mod simd;
mod toward;

pub(crate) use any::{AnyLane, with_any_lane};
pub(crate) use evaluate::{apply, is_finite};
pub use evaluate::{convert, evaluate, exact_dot};
pub(crate) use formats::LaneFormats;
pub(crate) use lane::{LANES, Lane, LaneRow};
pub use simd::SimdLevel;
