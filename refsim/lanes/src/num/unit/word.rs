//! Fields of single floats: sign, exponent field, mantissa.

/// The NaN that the units generate.
pub const NAN: u32 = 0x7fff_ffff;

pub(super) const ONE: u32 = 0x3f80_0000;
pub(super) const INFINITY: u32 = 0x7f80_0000;
/// The largest finite number.
pub(super) const LARGEST: u32 = 0x7f7f_ffff;
pub(super) const SIGN: u32 = 0x8000_0000;

#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    /// Bit 31.
    pub(super) negative: bool,
    /// Bits 30 to 23.
    pub(super) field: i32,
    /// Bits 22 to 0.
    pub(super) mantissa: u32,
}

impl Word {
    pub(super) const fn of(word: u32) -> Self {
        Self { negative: word & SIGN != 0, field: (word >> 23 & 0xff).cast_signed(), mantissa: word & 0x7f_ffff }
    }

    pub(super) const fn is_nan(self) -> bool {
        self.field == 255 && self.mantissa != 0
    }

    pub(super) const fn is_infinite(self) -> bool {
        self.field == 255 && self.mantissa == 0
    }

    pub(super) const fn is_zero(self) -> bool {
        self.field == 0
    }

    /// The significand with its leading one, in units of `2^(field - 150)`.
    pub(super) const fn significand(self) -> u64 {
        1 << 23 | self.mantissa as u64
    }

    /// Bits `[low, low + count)` of the mantissa.
    pub(super) const fn bits(self, low: u32, count: u32) -> usize {
        (self.mantissa >> low & ((1 << count) - 1)) as usize
    }
}

/// `magnitude` with a sign.
pub(super) const fn signed(negative: bool, magnitude: u32) -> u32 {
    if negative { magnitude | SIGN } else { magnitude }
}

/// The word with an exponent field from 1 to 254 and a mantissa of 23 bits.
pub(super) const fn assemble(negative: bool, field: i32, mantissa: u32) -> u32 {
    signed(negative, field.cast_unsigned() << 23 | mantissa)
}

/// The top 24 bits of an integer above 0, truncated: the bit position of the leading one, and the 23 bits below it.
pub(super) const fn top24(magnitude: u64) -> (i32, u32) {
    let place = magnitude.ilog2();
    let kept = if place > 23 { magnitude >> (place - 23) } else { magnitude << (23 - place) };
    (place.cast_signed(), kept as u32 & 0x7f_ffff)
}

/// Truncates `magnitude * 2^-fraction`, below `2^127`, to a float of 24 bits; 0 becomes a zero with the sign.
pub(super) const fn cut(negative: bool, magnitude: u64, fraction: i32) -> u32 {
    if magnitude == 0 {
        return signed(negative, 0);
    }
    let (place, mantissa) = top24(magnitude);
    assemble(negative, 127 + place - fraction, mantissa)
}

/// [`cut`] with a sign: as in the units, a negative number is represented by its one's complement; 0 gives +0.
pub(super) const fn cut_signed(value: i64, fraction: i32) -> u32 {
    let magnitude = if value < 0 { !value } else { value };
    cut(value < 0, magnitude.cast_unsigned(), fraction)
}
