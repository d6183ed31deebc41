//! The unit of a matrix's values.

use crate::error::{InputError, input_error};

/// A unit 2^-b. Entries of a matrix, and of its biclusters, are whole numbers of it: shares of visibility are multiples
/// of 2^-2m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueUnit {
    fraction_bits: u32,
    unit: f64,
}

impl ValueUnit {
    /// The largest number of fraction bits: more than the difference of two f32 numbers in [0, 1] needs.
    pub const MOST_FRACTION_BITS: u32 = 30;

    /// The unit 2^-`fraction_bits`.
    ///
    /// # Panics
    /// If `fraction_bits` exceeds [`Self::MOST_FRACTION_BITS`].
    pub fn new(fraction_bits: u32) -> Self {
        assert!(fraction_bits <= Self::MOST_FRACTION_BITS, "a unit of 2^-30 or more, not 2^-{fraction_bits}");
        Self { fraction_bits, unit: 1.0 / f64::from(1_u32 << fraction_bits) }
    }

    /// The largest unit of which all numbers are multiples that 32 bits hold.
    ///
    /// # Errors
    /// [`InputError`] if there is no such unit.
    pub(super) fn of_numbers(numbers: impl Iterator<Item = f64> + Clone) -> Result<Self, InputError> {
        let finest = Self::new(Self::MOST_FRACTION_BITS);
        let mut fraction_bits = 0;
        for number in numbers.clone() {
            // Exact: the unit is a power of two. Numbers beyond 64 bits are refused below, in any unit.
            let scaled = number / finest.unit;
            let zeros = (scaled as i64).trailing_zeros();
            if scaled.fract() != 0.0 {
                return Err(no_unit(number));
            }
            fraction_bits = fraction_bits.max(Self::MOST_FRACTION_BITS.saturating_sub(zeros));
        }
        let unit = Self::new(fraction_bits);
        let mut numbers = numbers;
        numbers.find(|&number| unit.entry(number).is_none()).map_or(Ok(unit), |number| Err(no_unit(number)))
    }

    /// b.
    pub fn fraction_bits(self) -> u32 {
        self.fraction_bits
    }

    /// The number that an entry stands for.
    #[inline]
    pub fn value(self, entry: i32) -> f64 {
        self.unit * f64::from(entry)
    }

    /// The entry of a number; `None` if it is no multiple of the unit that 32 bits hold.
    pub(super) fn entry(self, value: f64) -> Option<i32> {
        // Exact: the unit is a power of two.
        let units = value / self.unit;
        (units == f64::from(units as i32)).then_some(units as i32)
    }
}

impl std::fmt::Display for ValueUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.fraction_bits {
            0 => f.write_str("whole numbers"),
            bits => write!(f, "whole numbers of 2^-{bits}"),
        }
    }
}

fn no_unit(found: f64) -> InputError {
    input_error!(
        "expected values that are multiples of one power of two, 2^-{} or more, that 32 bits hold, found {found}",
        ValueUnit::MOST_FRACTION_BITS;
        help "round the values, or scale the matrix by a power of two"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_get_the_largest_unit() {
        let of = |numbers: &[f64]| ValueUnit::of_numbers(numbers.iter().copied()).map(ValueUnit::fraction_bits);
        assert_eq!([of(&[0.5, -3.0, 0.25]), of(&[6e8]), of(&[])], [Ok(2), Ok(0), Ok(0)]);
        assert_eq!(of(&[f64::from(i32::MIN), 1.0]), Ok(0));
        for numbers in [[0.1, 0.25], [6e8, 0.25], [1e200, 1.0], [1.0, f64::from_bits(1)], [f64::MAX, 1.0]] {
            assert!(of(&numbers).is_err(), "{numbers:?}");
        }
        let quarters = ValueUnit::new(2);
        assert_eq!((quarters.value(-14), quarters.entry(-3.5)), (-3.5, Some(-14)));
        assert_eq!([0.3, 1e9].map(|number| quarters.entry(number)), [None; 2]);
    }
}
