//! Exact sums and differences of f64 numbers: residuals of a matrix, which no f64 may hold.

use std::cmp::Ordering;
use std::fmt;

use num_bigint::{BigInt, Sign};
use refsim::num::power_of_two;

/// A real number without rounding: an odd integer times a power of two, or 0. Every finite f64 is one, and so is every
/// sum of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactNumber {
    whole: BigInt,
    exponent: i32,
}

impl ExactNumber {
    /// The exponent of the finest f64: 2^-1074.
    pub const LEAST_EXPONENT: i32 = -1074;

    /// A finite f64.
    ///
    /// # Panics
    /// If the value is not finite.
    pub fn of(value: f64) -> Self {
        assert!(value.is_finite(), "a finite number, not {value}");
        let (bits, fraction) = (value.to_bits(), value.to_bits() & ((1 << 52) - 1));
        let (whole, exponent) = match (bits >> 52 & 0x7ff) as i32 {
            0 => (fraction, Self::LEAST_EXPONENT),
            biased => (fraction | 1 << 52, biased - 1075),
        };
        let whole = BigInt::from(whole);
        Self::new(if value < 0.0 { -whole } else { whole }, exponent)
    }

    /// `whole` times 2^`exponent`.
    pub fn new(whole: BigInt, exponent: i32) -> Self {
        match whole.trailing_zeros() {
            None => Self { whole, exponent: 0 },
            Some(zeros) => Self { whole: whole >> zeros, exponent: exponent + zeros as i32 },
        }
    }

    /// The odd integer, or 0.
    pub fn whole(&self) -> &BigInt {
        &self.whole
    }

    /// The power of two that it is multiplied by; 0 of 0.
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The number in units of 2^`exponent`, if it is a multiple.
    pub fn in_units(&self, exponent: i32) -> Option<BigInt> {
        if self.whole.sign() == Sign::NoSign {
            return Some(BigInt::ZERO);
        }
        let shift = u32::try_from(self.exponent - exponent).ok()?;
        Some(&self.whole << shift)
    }

    /// The nearest f64, of two the even one; infinite beyond the range of f64.
    pub fn nearest(&self) -> f64 {
        let magnitude = self.whole.magnitude();
        let cut = magnitude.bits().saturating_sub(64);
        let mut head = (magnitude >> cut).iter_u64_digits().next().unwrap_or(0);
        // What is cut off is not 0, because the number is odd: one bit stands for it when 64 bits are rounded to 53.
        head |= u64::from(cut > 0);
        // Subnormal results have no bits to round: all numbers are multiples of 2^-1074.
        let value = scaled(head as f64, self.exponent + cut as i32);
        if self.whole.sign() == Sign::Minus { -value } else { value }
    }

    /// The f64 that equals it, if there is one.
    pub fn double(&self) -> Option<f64> {
        let nearest = self.nearest();
        (nearest.is_finite() && Self::of(nearest) == *self).then_some(nearest)
    }

    /// Numbers of f64 that sum to it, each the nearest to what those before it leave.
    pub fn terms(&self) -> Vec<f64> {
        let mut rest = self.clone();
        let mut terms = Vec::new();
        while rest.whole.sign() != Sign::NoSign {
            let term = rest.nearest().clamp(f64::MIN, f64::MAX);
            terms.push(term);
            let (whole, taken, exponent) = aligned(&rest, &Self::of(term));
            rest = Self::new(whole - taken, exponent);
        }
        terms
    }
}

/// Both numbers in units of the finer of their powers of two, and its exponent.
fn aligned(a: &ExactNumber, b: &ExactNumber) -> (BigInt, BigInt, i32) {
    let exponent = a.exponent.min(b.exponent);
    let units = |number: &ExactNumber| &number.whole << (number.exponent - exponent).unsigned_abs();
    (units(a), units(b), exponent)
}

impl Ord for ExactNumber {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b, _) = aligned(self, other);
        a.cmp(&b)
    }
}

impl PartialOrd for ExactNumber {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Decimal digits that read back to the same number; a sum, such as `1e300-0.25`, where no f64 holds it.
impl fmt::Display for ExactNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let terms = self.terms();
        if terms.is_empty() {
            return f.write_str("0");
        }
        for (at, term) in terms.into_iter().enumerate() {
            if at > 0 && term > 0.0 {
                f.write_str("+")?;
            }
            if (1e-5..1e16).contains(&term.abs()) { write!(f, "{term}") } else { write!(f, "{term:e}") }?;
        }
        Ok(())
    }
}

/// `value` of at least 1 times 2^`exponent`, rounded at most once.
fn scaled(mut value: f64, mut exponent: i32) -> f64 {
    while exponent > 1023 {
        value *= power_of_two(1023);
        exponent -= 1023;
    }
    while exponent < -1022 {
        value *= power_of_two(-1022);
        exponent += 1022;
    }
    value * power_of_two(exponent)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn difference(a: f64, b: f64) -> ExactNumber {
        let (a, b, exponent) = aligned(&ExactNumber::of(a), &ExactNumber::of(b));
        ExactNumber::new(a - b, exponent)
    }

    #[test]
    fn ends_of_the_range_are_exact() {
        for value in [f64::from_bits(1), f64::MIN_POSITIVE, 1e-310, 0.1, -1.0, 1e300, f64::MAX, 0.0] {
            let exact = ExactNumber::of(value);
            assert_eq!((exact.double(), exact.nearest().to_bits()), (Some(value), value.to_bits()));
        }
        assert_eq!(difference(f64::MAX, f64::MIN).nearest(), f64::INFINITY);
        assert_eq!(difference(f64::MAX, f64::MIN).terms(), [f64::MAX; 2]);
        assert_eq!(difference(1e300, 0.25).to_string(), "1e300-0.25");
        assert_eq!(difference(0.25, 0.25).to_string(), "0");
        assert_eq!(ExactNumber::of(-0.5).to_string(), "-0.5");
        // Halfway between two f64 numbers, and a little beyond.
        let halfway = difference(1.0, -f64::EPSILON / 2.0);
        assert_eq!((halfway.nearest(), halfway.double()), (1.0, None));
        let (a, b, exponent) = aligned(&halfway, &ExactNumber::of(f64::from_bits(1)));
        assert_eq!(ExactNumber::new(a + b, exponent).nearest(), 1.0 + f64::EPSILON);
    }

    proptest! {
        #[test]
        fn differences_round_as_those_of_f64(a in any::<u64>(), b in any::<u64>()) {
            let (a, b) = (f64::from_bits(a), f64::from_bits(b));
            prop_assume!(a.is_finite() && b.is_finite());
            let exact = difference(a, b);
            prop_assert_eq!(exact.nearest(), a - b);
            prop_assert_eq!(ExactNumber::of(a).cmp(&ExactNumber::of(b)), a.partial_cmp(&b).expect("numbers"));
            let sum = exact.terms().into_iter().rev().fold(0.0, |sum, term| sum + term);
            prop_assert_eq!(sum, a - b);
        }
    }
}
