//! Number formats, and arithmetic in them by integer operations alone.
//!
//! A [`Format`] is a record: a layout ([`FormatKind`], [`Encoding`]) and four rules ([`Rounding`], [`Overflow`],
//! [`Denormals`], [`Specials`]). It is written as a string, the same everywhere in Crossbar:
//!
//! | string | meaning |
//! |---|---|
//! | `s3.12` | fixed point: sign, 3 integer and 12 fraction bits, two's complement |
//! | `n3.8` | normalized integers: sign, 3 integer and 8 fraction bits, two's complement, in units of 1/255 |
//! | `e5m10` | float: sign, 5 exponent and 10 mantissa bits, as IEEE 754 lays them out |
//! | `e4m3fn` `e4m3fnuz` | floats without infinity: one NaN of either sign, or one NaN and one zero ([`Encoding`]) |
//! | `e8m0` | powers of two, without sign or zero: scales of blocks ([`block`]) |
//! | `ps14` `fx12` `fp16` `fp24` `fp32` `bf16` | `s3.12` `s1.10` `e5m10` `e7m16` `e8m23` `e8m7` |
//! | `:rne` `:rna` `:rtz` | rounding: nearest even (default), nearest away, toward zero |
//! | `:rdn` `:rup` `:rod` | rounding: down, up, to odd |
//! | `:rst` | stochastic rounding, by the word of an operation ([`Rounding::Stochastic`]) |
//! | `:sat` `:wrap` | overflow in fixed point and normalized integers: saturate (default), wrap |
//! | `:inf` `:sat` `:nvovf` | overflow in floats: IEEE (default), saturate, `NV_fragment_program` |
//! | `:keep` `:ftz` | floats: subnormals kept (default), flushed to zero |
//! | `:ieee` `:nv` | floats: special values as in Direct3D 9 (default) or `NV_fragment_program` |
//!
//! Values are bit patterns in the low bits of a `u32`. An operation of [`ops`] takes a format and patterns and returns
//! an [`Outcome`]: a pattern, and the exceptions as [`Flags`]. Its result is **the exact real result, rounded once**:
//! an operation computes the exact magnitude (or enough leading bits and a sticky bit), and one function rounds and
//! encodes it ([`from_parts`] is its public form). Numbers of a normalized format are integers over
//! [`Format::denominator`]: operations and rounding count in units of the format, and only `round_quotient` divides.
//! Operations with intermediate roundings have separate names: [`ops::mad`] has two roundings, [`ops::fused_mad`] has
//! one, and [`ops::dot`] has the order of summation as a parameter.
//!
//! [`NumberOperation`] enumerates the operations.
//!
//! Conventions that hold for all operations:
//! - Host floats are never used, not even for `fp32`.
//! - A NaN result is the canonical one: positive, quiet, the rest of its payload zero. A signalling NaN operand
//!   raises `INVALID`, a quiet one doesn't (except in the signalling comparisons).
//! - Where there is no real result, floats give NaN and formats without NaN give zero, with `INVALID`.
//! - An exactly infinite result is infinity with `DIVIDE_BY_ZERO`, or NaN in formats without infinity; fixed point,
//!   floats with neither, and `:sat` floats give the end of the range.
//! - Under `:ftz` subnormal operands and results become zeros of their sign, in every operation, including moves.
//! - `UNDERFLOW` is raised for results that are tiny and inexact; [`Tininess`] chooses what tiny means. In fixed
//!   point it is never raised.
//!
//! ```
//! use refsim_lanes::num::{Flags, Format, decimal, ops};
//!
//! let ps14: Format = "s3.12:rtz".parse()?;
//! let third = ops::div(&ps14, ps14.one(), decimal::from_decimal(&ps14, "3")?.bits);
//! assert_eq!((third.bits, third.flags), (0x0555, Flags::INEXACT));
//! assert_eq!(decimal::to_decimal_exact(&ps14, third.bits), "0.333251953125");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod aligned;
pub mod block;
mod convert;
pub mod decimal;
mod env;
mod flags;
mod format;
pub mod matrix;
mod operation;
pub mod ops;
mod parse;
mod random;
mod round;
mod rules;
pub mod series;
mod sum;
mod transcendental;
pub mod unit;
mod unpack;

pub use convert::{from_f64, power_of_two, to_f64};
pub use env::{Env, Tininess};
pub use flags::{Flags, Outcome};
pub use format::{Format, FormatKind};
pub use operation::NumberOperation;
pub use ops::DotOrder;
pub use parse::FormatError;
pub use random::random_word;
pub use round::{from_parts, from_ratio};
pub use rules::{Denormals, Encoding, Overflow, Rounding, Specials, Unit};
pub use unpack::{Unpacked, unpack};
