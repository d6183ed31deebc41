//! The adder of graphics cards and matrix units: addends are aligned to the largest exponent, truncated, and added
//! exactly.

/// An addend `(-1)^negative * magnitude * 2^(exponent - fraction)`. The exponent is the one that the hardware sees: an
/// operand's exponent, or the sum of two for a product. Nothing is normalized: the magnitude may be below or above
/// `2^fraction`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Addend {
    /// The sign.
    pub negative: bool,
    /// The significand, an integer below `2^64`.
    pub magnitude: u64,
    /// The exponent by which addends are aligned.
    pub exponent: i32,
    /// Fraction bits of the magnitude.
    pub fraction: u32,
}

/// Treatment of an addend's bits below the last kept bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Alignment {
    /// They are dropped from the magnitude.
    Cut,
    /// The addend is rounded down, toward minus infinity.
    Floor,
}

/// A sum of aligned addends: `sum * 2^(top - bits)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AlignedSum {
    /// The sum, in units of the last bit that was kept.
    pub sum: i128,
    /// The largest exponent.
    pub top: i32,
}

/// The exact sum of addends, each truncated to `bits` bits below the largest exponent. If `least` is given and exceeds
/// the largest exponent, it takes its place. The sum is not rounded; the caller rounds or cuts it.
///
/// `bits` is at most 60, so that 2^32 addends cannot overflow. Without addends and `least`, sum and exponent are 0.
/// Addends of magnitude zero count in the largest exponent: the caller omits those that its hardware ignores.
pub fn aligned(
    addends: impl IntoIterator<Item = Addend> + Clone,
    bits: u32,
    least: Option<i32>,
    alignment: Alignment,
) -> AlignedSum {
    let exponents = addends.clone().into_iter().map(|addend| addend.exponent);
    let Some(top) = exponents.chain(least).max() else { return AlignedSum { sum: 0, top: 0 } };
    let kept = |addend: Addend| {
        // Magnitudes have 64 bits, so a right shift by 127 leaves nothing; a left shift is at most 60.
        let left = i64::from(bits) - i64::from(addend.fraction) + i64::from(addend.exponent) - i64::from(top);
        let magnitude = i128::from(addend.magnitude);
        let shifted =
            |value: i128| if left >= 0 { value << left.min(60) } else { value >> left.unsigned_abs().min(127) };
        match (addend.negative, alignment) {
            (false, _) => shifted(magnitude),
            (true, Alignment::Cut) => -shifted(magnitude),
            (true, Alignment::Floor) => shifted(-magnitude),
        }
    };
    AlignedSum { sum: addends.into_iter().map(kept).sum(), top }
}
