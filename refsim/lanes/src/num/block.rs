//! Blocks of numbers with a shared scale: the MX formats of OCP's Microscaling specification, version 1.0.
//!
//! A block is a scale ([`Format::E8M0`], a power of two) and elements of a short format; a number is the scale times an
//! element. [`BlockFormat::quantize`] and [`BlockFormat::dequantize`] convert to and from plain numbers.
//!
//! ```
//! use refsim_lanes::num::{Format, block::BlockFormat};
//!
//! let mx: BlockFormat = "mxfp4".parse()?;
//! let numbers = [1.0f32, -0.4, 96.0, 40.0].map(f32::to_bits);
//! let block = mx.quantize(&Format::FP32, &numbers);
//! // The largest element is 6 = 1.5 * 2^2 of 96 = 1.5 * 2^6: the scale is 2^4.
//! assert_eq!((block.scale, block.elements.as_slice()), (131, &[0, 8, 7, 4][..]));
//! let back = mx.dequantize(Format::FP32, block.scale, &block.elements);
//! let back: Vec<f32> = back.iter().map(|number| f32::from_bits(number.bits)).collect();
//! assert_eq!(back, [0.0, -0.0, 96.0, 32.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fmt;
use std::str::FromStr;

use super::convert::unpack_f64;
use super::env::Env;
use super::flags::{Flags, Outcome};
use super::format::Format;
use super::round::{infinite, round_quotient};
use super::rules::{Encoding, Overflow};
use super::unpack::{Unpacked, nan_bits, unpack};

/// Elements of a block in every format of the specification.
pub const BLOCK: usize = 32;

/// A block format, named after the format of its elements. Written `mxfp8-e4m3`, `mxfp8-e5m2`, `mxfp6-e2m3`,
/// `mxfp6-e3m2`, `mxfp4` or `mxint8`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlockFormat {
    name: &'static str,
    element: Format,
}

const fn element(exp_bits: u8, man_bits: u8, encoding: Encoding) -> Format {
    let Some(format) = Format::float(exp_bits, man_bits) else { panic!("a float") };
    format.with_encoding(encoding).with_overflow(Overflow::Saturate)
}

/// Error of parsing a block format's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("block format `{text}`: expected one of {expected}")]
#[diagnostic(code(num::block_format), help("the names are those of OCP's Microscaling specification, in lower case"))]
pub struct BlockFormatError {
    /// The text.
    pub text: String,
    /// The names that exist, separated by spaces.
    pub expected: String,
}

/// A block of numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The scale, a pattern of [`Format::E8M0`].
    pub scale: u32,
    /// The elements, patterns of [`BlockFormat::element`].
    pub elements: Vec<u32>,
    /// The exceptions of all elements.
    pub flags: Flags,
}

impl BlockFormat {
    /// Every block format.
    pub const ALL: [Self; 6] = [
        Self { name: "mxfp8-e4m3", element: element(4, 3, Encoding::Finite) },
        Self { name: "mxfp8-e5m2", element: element(5, 2, Encoding::Ieee) },
        Self { name: "mxfp6-e2m3", element: element(2, 3, Encoding::Finite) },
        Self { name: "mxfp6-e3m2", element: element(3, 2, Encoding::Finite) },
        Self { name: "mxfp4", element: element(2, 1, Encoding::Finite) },
        Self { name: "mxint8", element: INT8 },
    ];

    /// The name.
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// The format of the elements: saturating, to nearest even. The elements of `mxint8` are `s1.6`.
    pub const fn element(self) -> Format {
        self.element
    }

    /// Converts numbers of a format to one block ([`BLOCK`] numbers in the specification; any count works).
    ///
    /// Source: specification 6.3 (docs/numbers.md, "Blocks with a scale"). Numbers divided by the scale are rounded
    /// once, to nearest even. A block that contains infinity or NaN gets the scale NaN and elements of 0, and raises
    /// `INVALID`.
    pub fn quantize(self, from: &Format, numbers: &[u32]) -> Block {
        self.quantize_values(&numbers.iter().map(|&bits| unpack(from, bits)).collect::<Vec<_>>())
    }

    /// [`Self::quantize`] for doubles.
    pub fn quantize_doubles(self, numbers: &[f64]) -> Block {
        self.quantize_values(&numbers.iter().map(|&number| unpack_f64(number)).collect::<Vec<_>>())
    }

    fn quantize_values(self, values: &[Unpacked]) -> Block {
        let mut largest = None;
        for value in values {
            match *value {
                Unpacked::Finite { sig: 0, .. } => {}
                Unpacked::Finite { sig, exp, den, .. } => largest = largest.max(Some(log2_floor(sig, den) + exp)),
                Unpacked::Inf { .. } | Unpacked::Nan { .. } => {
                    let elements = vec![0; values.len()];
                    return Block { scale: nan_bits(&Format::E8M0), elements, flags: Flags::INVALID };
                }
            }
        }
        let (least, most) = Format::E8M0.exponents();
        let power = largest.map_or(least, |exponent| (exponent - self.largest_exponent()).clamp(least, most));
        let env = Env::from(self.element);
        let rounded = values.iter().map(|value| match *value {
            Unpacked::Finite { sign, sig, exp, den } => round_quotient(&env, sign, sig, exp - power, den.into()),
            Unpacked::Inf { .. } | Unpacked::Nan { .. } => Outcome::exact(0),
        });
        let mut flags = Flags::empty();
        let elements = rounded.map(|outcome| {
            flags |= outcome.flags;
            outcome.bits
        });
        let elements = elements.collect();
        Block { scale: (power - least).unsigned_abs(), elements, flags }
    }

    /// Converts a block to numbers of a format, each the scale times an element, rounded once. A NaN scale makes every
    /// number NaN (0, and `INVALID`, in formats without NaN).
    pub fn dequantize(self, to: impl Into<Env>, scale: u32, elements: &[u32]) -> Vec<Outcome> {
        let to = to.into();
        let none = if to.format.canonical_nan().is_none() { Flags::INVALID } else { Flags::empty() };
        let number = |&bits: &u32| match (unpack(&Format::E8M0, scale), unpack(&self.element, bits)) {
            (Unpacked::Finite { exp: power, .. }, Unpacked::Finite { sign, sig, exp, den }) => {
                round_quotient(&to, sign, sig, exp + power, den.into())
            }
            (Unpacked::Finite { .. }, Unpacked::Inf { sign }) => infinite(&to.format, sign),
            _ => Outcome::new(nan_bits(&to.format), none),
        };
        elements.iter().map(number).collect()
    }

    /// The exponent of the largest element: 8 for `mxfp8-e4m3`, 0 for `mxint8`.
    const fn largest_exponent(self) -> i32 {
        self.element.exponents().1
    }
}

/// Two's complement in units of `2^-6`.
const INT8: Format = match Format::fixed(1, 6) {
    Some(format) => format,
    None => panic!("a format"),
};

/// `floor(log2(sig / den))`; neither is 0.
fn log2_floor(sig: u64, den: u32) -> i32 {
    let den = u64::from(den);
    let guess = sig.ilog2().cast_signed() - den.ilog2().cast_signed();
    let below = if guess >= 0 {
        u128::from(sig) < u128::from(den) << guess
    } else {
        (u128::from(sig) << -guess) < u128::from(den)
    };
    guess - i32::from(below)
}

impl FromStr for BlockFormat {
    type Err = BlockFormatError;

    fn from_str(text: &str) -> Result<Self, BlockFormatError> {
        Self::ALL.into_iter().find(|format| format.name == text).ok_or_else(|| BlockFormatError {
            text: text.chars().take(40).collect(),
            expected: Self::ALL.map(Self::name).join(" "),
        })
    }
}

impl fmt::Display for BlockFormat {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(self.name)
    }
}
