//! The operations: functions from a format and bit patterns to an [`Outcome`](super::Outcome).
//!
//! Each accepts `impl Into<Env>`: a [`Format`](super::Format), a `&Format` or an [`Env`](super::Env). Operands are
//! bit patterns in the low bits; bits above the width are ignored. Every result is the exact real result rounded
//! once, unless the operation's documentation lists its steps. No operation panics.

mod add;
mod aligned;
mod compare;
mod div;
mod dot;
mod fused;
mod integral;
mod mul;
mod scale;
mod select;
mod sqrt;

pub use super::convert::convert;
pub use super::transcendental::{cos, exp2, log2, pow, sin};
pub use add::{add, sub};
pub use aligned::{MAX_ALIGNED_BITS, product_cut_mad, sum_aligned};
pub use compare::{eq, le, le_quiet, lt, lt_quiet};
pub use div::{div, rcp};
pub use dot::{DotOrder, aligned_bits, dot, dot_accumulated, dot_of_products};
pub use fused::{fused_mad, mad};
pub use integral::{floor, frc, round_to_int, round_to_int_exact, round_to_int_with};
pub use mul::mul;
pub use scale::{abs, neg, saturate01, scale};
pub use select::{cmp, cnd, max, min};
pub use sqrt::{rsq, sqrt};
