//! Types of operands, addends and results, and the adders' view of a number.

use crate::num::aligned::Addend;
use crate::num::{
    Encoding, Flags, Format, FormatKind, Overflow, Rounding, Unpacked, from_f64, from_parts, to_f64, unpack,
};

/// A number type of operands, addends, scales or results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// Name in test vectors and on the command line.
    pub name: &'static str,
    /// Its format; types of up to 8 bits saturate. `None` for fp64.
    pub format: Option<Format>,
    /// Ignored bits below the format's bits: 13 in tf32 and xf32, whose numbers are words of single precision.
    pub ignored_bits: u32,
}

/// A number as an adder's input: nothing is normalized, and subnormal numbers and zeros have the least exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    Finite(Addend),
    Infinite { negative: bool },
    Nan,
}

const fn element(name: &'static str, exponent: u8, fraction: u8, encoding: Encoding) -> Element {
    let overflow = if exponent + fraction < 8 { Overflow::Saturate } else { Overflow::Infinity };
    let format = match Format::float(exponent, fraction) {
        Some(format) => Some(format.with_encoding(encoding).with_overflow(overflow)),
        None => None,
    };
    Element { name, format, ignored_bits: 0 }
}

impl Element {
    /// IEEE binary64.
    pub const FP64: Self = Self { name: "fp64", format: None, ignored_bits: 0 };
    /// IEEE binary32.
    pub const FP32: Self = element("fp32", 8, 23, Encoding::Ieee);
    /// NVIDIA's TF32: a word of single precision whose low 13 bits are ignored.
    pub const TF32: Self = Self { ignored_bits: 13, ..element("tf32", 8, 10, Encoding::Ieee) };
    /// AMD's XF32: the layout of [`Self::TF32`].
    pub const XF32: Self = Self { name: "xf32", ..Self::TF32 };
    /// IEEE binary16.
    pub const FP16: Self = element("fp16", 5, 10, Encoding::Ieee);
    /// The upper half of binary32.
    pub const BF16: Self = element("bf16", 8, 7, Encoding::Ieee);
    /// OCP E4M3: no infinity; the patterns 7f and ff are NaN.
    pub const E4M3: Self = element("e4m3", 4, 3, Encoding::Finite);
    /// OCP E5M2: IEEE.
    pub const E5M2: Self = element("e5m2", 5, 2, Encoding::Ieee);
    /// OCP E3M2: numbers only.
    pub const E3M2: Self = element("e3m2", 3, 2, Encoding::Finite);
    /// OCP E2M3: numbers only.
    pub const E2M3: Self = element("e2m3", 2, 3, Encoding::Finite);
    /// OCP E2M1: numbers only.
    pub const E2M1: Self = element("e2m1", 2, 1, Encoding::Finite);
    /// AMD's fp8: bias 8; the pattern 80 is the only NaN.
    pub const FP8: Self = element("fp8", 4, 3, Encoding::UnsignedZero);
    /// AMD's bf8: bias 16; the pattern 80 is the only NaN.
    pub const BF8: Self = element("bf8", 5, 2, Encoding::UnsignedZero);
    /// Scales that are powers of two.
    pub const UE8M0: Self = Self { name: "ue8m0", format: Some(Format::E8M0), ignored_bits: 0 };
    /// Scales of NVFP4: E4M3 with the sign ignored.
    pub const UE4M3: Self = Self { name: "ue4m3", ..Self::E4M3 };

    /// Bits of the exponent field and of the fraction.
    pub const fn fields(self) -> (u32, u32) {
        match self.format {
            Some(Format { kind: FormatKind::Float { exp_bits, man_bits }, .. }) => (exp_bits as u32, man_bits as u32),
            _ => (11, 52),
        }
    }

    /// Bits of a pattern, ignored ones included.
    pub const fn width(self) -> u32 {
        match self.format {
            Some(format) => format.width() + self.ignored_bits,
            None => 64,
        }
    }

    /// Hexadecimal digits of a pattern: 1 to 16.
    pub const fn digits(self) -> usize {
        self.width().div_ceil(4) as usize
    }

    /// Decodes a pattern to a double.
    pub fn number(self, word: u64) -> f64 {
        self.format.map_or(f64::from_bits(word), |format| to_f64(&format, (word >> self.ignored_bits) as u32))
    }

    /// Encodes a double as a pattern, rounded to nearest even; `None` for NaN if the type has no NaN.
    pub fn code(self, number: f64) -> Option<u64> {
        let Some(format) = self.format else { return Some(number.to_bits()) };
        let fits = !number.is_nan() || format.canonical_nan().is_some();
        fits.then(|| u64::from(from_f64(format, number).bits) << self.ignored_bits)
    }

    /// Decodes a pattern; bits above its width are ignored. fp64 cannot be decoded: its unit computes on words.
    pub(crate) fn decode(self, word: u64) -> Value {
        let word = (word >> self.ignored_bits) as u32;
        let word = if self == Self::UE4M3 { word & 0x7f } else { word };
        match self.format.map(|format| unpack(&format, word)) {
            Some(Unpacked::Finite { sign, sig, exp, .. }) => {
                let fraction = self.fields().1;
                let exponent = exp + fraction.cast_signed();
                Value::Finite(Addend { negative: sign, magnitude: sig, exponent, fraction })
            }
            Some(Unpacked::Inf { sign }) => Value::Infinite { negative: sign },
            Some(Unpacked::Nan { .. }) | None => Value::Nan,
        }
    }
}

impl Value {
    /// The number as an addend, if finite and nonzero: sums omit zeros.
    pub(crate) fn addend(self) -> Option<Addend> {
        match self {
            Self::Finite(addend) if addend.magnitude != 0 => Some(addend),
            _ => None,
        }
    }

    fn is_negative(self) -> bool {
        matches!(self, Self::Finite(Addend { negative: true, .. }) | Self::Infinite { negative: true })
    }

    /// The exact product, not normalized; operands have at most 24 bits.
    pub(super) fn times(self, other: Self) -> Self {
        let negative = self.is_negative() != other.is_negative();
        let is_zero = |value| matches!(value, Self::Finite(Addend { magnitude: 0, .. }));
        match (self, other) {
            (Self::Finite(a), Self::Finite(b)) => Self::Finite(Addend {
                negative,
                magnitude: a.magnitude * b.magnitude,
                exponent: a.exponent + b.exponent,
                fraction: a.fraction + b.fraction,
            }),
            (Self::Nan, _) | (_, Self::Nan) => Self::Nan,
            _ if is_zero(self) || is_zero(other) => Self::Nan,
            _ => Self::Infinite { negative },
        }
    }
}

/// The sum if an addend is NaN or infinite: an infinity, or NaN if any addend is NaN or infinities have both signs.
/// `None` if all addends are finite.
pub(super) fn special(addends: impl IntoIterator<Item = Value>) -> Option<Value> {
    addends.into_iter().fold(None, |sum, addend| match (sum, addend) {
        (_, Value::Finite(_)) => sum,
        (None, _) => Some(addend),
        (Some(found), _) if found == addend => sum,
        _ => Some(Value::Nan),
    })
}

/// Type and rounding of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResultFormat {
    /// Description.
    pub name: &'static str,
    /// Type of the word.
    pub element: Element,
    /// Precision and rounding of results, which are stored in the top bits of the word. (Unused for fp64.)
    pub format: Format,
    /// Results of NVIDIA's adders are never -0, and their NaN is 7fffffff or 7fff. The NaN of other adders is not
    /// known; here it is the positive quiet NaN.
    pub is_nvidia: bool,
}

impl ResultFormat {
    /// Single precision, truncated. Magnitudes of `2^128` and more become infinity.
    pub const CUT32: Self = Self { name: "fp32, cut", format: cut(23), ..Self::NEAREST16.with(Element::FP32) };
    /// Single precision, truncated to 13 bits of fraction; the low ten bits of the word are zero.
    pub const CUT22: Self = Self { name: "e8m13, cut", format: cut(13), ..Self::CUT32 };
    /// Half precision, to nearest even. Magnitudes of 65520 and more become infinity.
    pub const NEAREST16: Self =
        Self { name: "fp16, to nearest", element: Element::FP16, format: Format::FP16, is_nvidia: true };
    /// Single precision, to nearest even. A result that rounds to zero keeps its sign.
    pub const NEAREST32: Self =
        Self { name: "fp32, to nearest", element: Element::FP32, format: Format::FP32, is_nvidia: false };
    /// Double precision, to nearest even.
    pub const NEAREST64: Self = Self { name: "fp64, to nearest", ..Self::NEAREST32.with(Element::FP64) };

    const fn with(mut self, element: Element) -> Self {
        self.element = element;
        self
    }

    /// The word of an infinity or a NaN.
    pub(super) fn special(self, value: Value) -> u64 {
        let format = self.element.format.unwrap_or(Format::FP32);
        let nan = if self.is_nvidia { Some(format.sign_bit() - 1) } else { format.canonical_nan() };
        let word = if let Value::Infinite { negative } = value { format.infinity(negative) } else { nan };
        word.unwrap_or(0).into()
    }

    /// The word of `(-1)^negative * magnitude * 2^exponent`, rounded once. An exact zero is +0.
    pub(super) fn round(self, negative: bool, magnitude: u128, exponent: i32) -> u64 {
        let outcome = from_parts(self.format, negative, magnitude, exponent, false);
        if outcome.flags.contains(Flags::OVERFLOW) {
            return self.special(Value::Infinite { negative });
        }
        let word = u64::from(outcome.bits) << (self.element.width() - self.format.width());
        let is_zero = word << (65 - self.element.width()) == 0;
        if magnitude == 0 || self.is_nvidia && is_zero { 0 } else { word }
    }
}

const fn cut(fraction: u8) -> Format {
    match Format::float(8, fraction) {
        Some(format) => format.with_rounding(Rounding::TowardZero),
        None => Format::FP32,
    }
}
