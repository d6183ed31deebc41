//! Types of operands, addends and results, decoded into what the adders see.

use crate::num::Encoding;
use crate::num::aligned::Addend;

/// A type of numbers: sign, exponent and fraction from the top, then bits that the unit ignores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// Name, as the vectors and the command line write it.
    pub name: &'static str,
    /// Bits of the exponent field.
    pub exponent_bits: u32,
    /// Bits of the fraction.
    pub fraction_bits: u32,
    /// Which patterns are infinities, NaN and zeros.
    pub encoding: Encoding,
    /// Bits below the fraction that are ignored: 13 in tf32 and xf32, whose numbers are words of single precision.
    pub ignored_bits: u32,
}

/// A number as an adder sees it: nothing is normalized.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// A number; a subnormal one or a zero has the least exponent.
    Finite(Addend),
    /// An infinity.
    Infinite {
        /// The sign.
        negative: bool,
    },
    /// Not a number.
    Nan,
}

const fn element(name: &'static str, exponent_bits: u32, fraction_bits: u32, encoding: Encoding) -> Element {
    Element { name, exponent_bits, fraction_bits, encoding, ignored_bits: 0 }
}

impl Element {
    /// IEEE binary64.
    pub const FP64: Self = element("fp64", 11, 52, Encoding::Ieee);
    /// IEEE binary32.
    pub const FP32: Self = element("fp32", 8, 23, Encoding::Ieee);
    /// NVIDIA's TF32: a word of single precision whose low 13 bits are ignored.
    pub const TF32: Self = Self { ignored_bits: 13, ..element("tf32", 8, 10, Encoding::Ieee) };
    /// AMD's XF32, the same.
    pub const XF32: Self = Self { name: "xf32", ..Self::TF32 };
    /// IEEE binary16.
    pub const FP16: Self = element("fp16", 5, 10, Encoding::Ieee);
    /// The upper half of binary32.
    pub const BF16: Self = element("bf16", 8, 7, Encoding::Ieee);
    /// OCP E4M3: no infinity, NaN 7f and ff.
    pub const E4M3: Self = element("e4m3", 4, 3, Encoding::Finite);
    /// OCP E5M2: IEEE.
    pub const E5M2: Self = element("e5m2", 5, 2, Encoding::Ieee);
    /// OCP E3M2: numbers only.
    pub const E3M2: Self = element("e3m2", 3, 2, Encoding::Finite);
    /// OCP E2M3: numbers only.
    pub const E2M3: Self = element("e2m3", 2, 3, Encoding::Finite);
    /// OCP E2M1: numbers only.
    pub const E2M1: Self = element("e2m1", 2, 1, Encoding::Finite);
    /// AMD's fp8: bias 8, one NaN, 80.
    pub const FP8: Self = element("fp8", 4, 3, Encoding::UnsignedZero);
    /// AMD's bf8: bias 16, one NaN, 80.
    pub const BF8: Self = element("bf8", 5, 2, Encoding::UnsignedZero);

    /// Bits of a pattern, ignored ones included.
    pub const fn width(self) -> u32 {
        1 + self.exponent_bits + self.fraction_bits + self.ignored_bits
    }

    /// Hexadecimal digits of a pattern: 1 to 16.
    pub const fn digits(self) -> usize {
        self.width().div_ceil(4) as usize
    }

    /// Exponent of subnormal numbers and of the smallest normal one.
    pub const fn least_exponent(self) -> i32 {
        let half = 1 << (self.exponent_bits - 1);
        if matches!(self.encoding, Encoding::UnsignedZero) { 1 - half } else { 2 - half }
    }

    /// The pattern of +infinity in an IEEE type.
    pub const fn infinity(self) -> u64 {
        ((1 << self.exponent_bits) - 1) << (self.fraction_bits + self.ignored_bits)
    }

    /// Decodes a pattern; bits above its width are ignored.
    pub fn decode(self, word: u64) -> Value {
        let word = word >> self.ignored_bits;
        let field = (word >> self.fraction_bits) & ((1 << self.exponent_bits) - 1);
        let fraction = word & ((1 << self.fraction_bits) - 1);
        let negative = (word >> (self.exponent_bits + self.fraction_bits)) & 1 == 1;
        let (largest, all_ones) = (field + 1 == 1 << self.exponent_bits, fraction + 1 == 1 << self.fraction_bits);
        let zero = field == 0 && fraction == 0;
        match self.encoding {
            Encoding::Ieee if largest && fraction == 0 => return Value::Infinite { negative },
            Encoding::Ieee if largest => return Value::Nan,
            Encoding::Finite if self.width() > 6 && largest && all_ones => return Value::Nan,
            Encoding::UnsignedZero if negative && zero => return Value::Nan,
            _ => {}
        }
        Value::Finite(Addend {
            negative,
            magnitude: fraction | u64::from(field > 0) << self.fraction_bits,
            exponent: self.least_exponent() + (field.max(1) - 1) as i32,
            fraction: self.fraction_bits,
        })
    }
}

impl Value {
    /// Returns `true` for zeros of either sign.
    pub fn is_zero(self) -> bool {
        matches!(self, Self::Finite(Addend { magnitude: 0, .. }))
    }

    fn is_negative(self) -> bool {
        matches!(self, Self::Finite(Addend { negative: true, .. }) | Self::Infinite { negative: true })
    }

    /// The number, if it is one and not zero: zeros are left out of sums.
    pub(super) fn addend(self) -> Option<Addend> {
        match self {
            Self::Finite(addend) if addend.magnitude != 0 => Some(addend),
            _ => None,
        }
    }

    /// The exact product, not normalized. It does not overflow; operands have at most 24 bits.
    pub(super) fn times(self, other: Self) -> Self {
        let negative = self.is_negative() != other.is_negative();
        match (self, other) {
            (Self::Finite(a), Self::Finite(b)) => Self::Finite(Addend {
                negative,
                magnitude: a.magnitude * b.magnitude,
                exponent: a.exponent + b.exponent,
                fraction: a.fraction + b.fraction,
            }),
            (Self::Nan, _) | (_, Self::Nan) => Self::Nan,
            _ if self.is_zero() || other.is_zero() => Self::Nan,
            _ => Self::Infinite { negative },
        }
    }
}

/// The sum if an addend is NaN or infinite: NaN, also of infinities of both signs, or an infinity. `None` where all
/// are.
pub(super) fn special(addends: impl IntoIterator<Item = Value>) -> Option<Value> {
    addends.into_iter().fold(None, |sum, addend| match (sum, addend) {
        (_, Value::Finite(_)) => sum,
        (None, _) => Some(addend),
        (Some(found), _) if found == addend => sum,
        _ => Some(Value::Nan),
    })
}
