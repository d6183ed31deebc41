//! Single floats as words: fields, and the numbers that units make.

/// The sign bit.
pub(super) const SIGN: u32 = 1 << 31;
/// The exponent field; alone, infinity.
pub(super) const FIELD: u32 = 0x7f80_0000;
/// The mantissa.
pub(super) const MANTISSA: u32 = 0x7f_ffff;
/// 1.0.
pub(super) const ONE: u32 = 0x3f80_0000;
/// The NaN that units make.
pub(super) const NAN: u32 = 0x7fff_ffff;

/// The exponent field.
#[inline(always)]
pub(super) fn field(w: u32) -> i32 {
    (w >> 23 & 0xff).cast_signed()
}

#[inline(always)]
pub(super) fn is_nan(w: u32) -> bool {
    (w & !SIGN).cast_signed() > FIELD.cast_signed()
}

/// Returns `true` for zeros and subnormals.
#[inline(always)]
pub(super) fn is_zero(w: u32) -> bool {
    w & FIELD == 0
}

/// The significand of a normal number, in units of `2^(field - 150)`.
#[inline(always)]
pub(super) fn significand(w: u32) -> u32 {
    w & MANTISSA | 1 << 23
}

/// The word without a subnormal number.
#[inline(always)]
pub(super) fn flushed(w: u32) -> u32 {
    if is_zero(w) { w & SIGN } else { w }
}

/// All ones if a condition holds: a mask that loops can gather.
#[inline(always)]
pub(super) fn mask(condition: bool) -> u32 {
    if condition { u32::MAX } else { 0 }
}

/// The single of `magnitude * 2^-bits`, its top 24 bits cut; `magnitude` above 0, the result normal.
pub(super) fn cut(negative: bool, magnitude: u64, bits: i32) -> u32 {
    // The leading one goes to the top of the word.
    let zeros = magnitude.leading_zeros();
    let place = 63 - zeros.cast_signed();
    let fraction = ((magnitude << zeros) >> 40) as u32 & MANTISSA;
    u32::from(negative) << 31 | (127 + place - bits).cast_unsigned() << 23 | fraction
}

/// [`cut`] of a number below zero as its one's complement; 0 gives +0.
pub(super) fn cut_complement(value: i64, bits: i32) -> u32 {
    let negative = value < 0;
    match (if negative { !value } else { value }).cast_unsigned() {
        0 => u32::from(negative) << 31,
        magnitude => cut(negative, magnitude, bits),
    }
}
