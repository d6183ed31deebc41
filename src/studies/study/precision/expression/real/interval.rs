//! Intervals: sums, products, quotients, roots.

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::dyadic::{Dyadic, End};

/// Value of an expression over the reals, as far as a given number of bits determines it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Real {
    /// The value lies between the ends.
    Range(RealInterval),
    /// There is no real value: a division by zero, a root or a logarithm of a negative number.
    Undefined,
    /// These bits do not determine the value.
    Unknown,
    /// Truth value.
    Truth(bool),
}

/// A closed interval of reals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RealInterval {
    pub(crate) low: End,
    pub(crate) high: End,
}

impl RealInterval {
    pub(crate) fn point(x: Dyadic) -> Self {
        Self { low: End::At(x.clone()), high: End::At(x) }
    }

    pub(crate) fn integer(x: impl Into<BigInt>) -> Self {
        Self::point(Dyadic::new(x, 0))
    }

    /// From `(middle - error) 2^exponent` to `(middle + error) 2^exponent`.
    pub(super) fn around(middle: &BigInt, error: u64, exponent: i64) -> Self {
        let at = |digits: BigInt, up| End::safe(Dyadic::new(digits, exponent), up);
        Self { low: at(middle - error, false), high: at(middle + error, true) }
    }

    /// The rational `numerator / denominator`; the denominator is positive.
    pub(crate) fn ratio(numerator: &BigInt, denominator: &BigInt, bits: u64) -> Self {
        let [n, d] = [numerator, denominator].map(|x| Dyadic::new(x.clone(), 0));
        Self { low: End::At(n.over(&d, bits, false)), high: End::At(n.over(&d, bits, true)) }
    }

    /// The number, if the interval contains only one.
    pub(crate) fn as_point(&self) -> Option<&Dyadic> {
        match (&self.low, &self.high) {
            (End::At(low), End::At(high)) if low == high => Some(low),
            _ => None,
        }
    }

    /// Returns `true` if the whole interval is below zero.
    pub(super) fn is_negative(&self) -> bool {
        self.high.is_negative()
    }

    /// Returns `true` if the whole interval is above zero.
    pub(super) fn is_positive(&self) -> bool {
        !self.low.is_negative() && !self.low.is_zero()
    }

    pub(super) fn has_zero(&self) -> bool {
        !self.is_negative() && !self.is_positive()
    }

    /// Order of all numbers of one interval relative to all of another; `None` if the intervals overlap.
    pub(crate) fn order(&self, other: &Self) -> Option<Ordering> {
        match (self.as_point(), other.as_point()) {
            (Some(x), Some(y)) if x == y => Some(Ordering::Equal),
            _ if self.high < other.low => Some(Ordering::Less),
            _ if self.low > other.high => Some(Ordering::Greater),
            _ => None,
        }
    }

    pub(crate) fn negated(&self) -> Self {
        Self { low: self.high.negated(), high: self.low.negated() }
    }

    pub(crate) fn abs(&self) -> Self {
        match self {
            _ if !self.low.is_negative() => self.clone(),
            _ if self.is_negative() => self.negated(),
            _ => Self { low: End::At(Dyadic::new(0, 0)), high: self.high.clone().max(self.low.negated()) },
        }
    }

    pub(super) fn plus(&self, other: &Self, bits: u64) -> Self {
        Self { low: self.low.plus(&other.low, bits, false), high: self.high.plus(&other.high, bits, true) }
    }

    pub(super) fn minus(&self, other: &Self, bits: u64) -> Self {
        self.plus(&other.negated(), bits)
    }

    /// `x 2^places`.
    pub(super) fn scaled(&self, places: i64) -> Self {
        let at = |end: &End, up| end.map(|x| End::safe(x.scaled(places), up));
        Self { low: at(&self.low, false), high: at(&self.high, true) }
    }

    /// The pairs of an end of this interval and an end of another.
    fn ends<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (&'a End, &'a End)> {
        [&self.low, &self.high].into_iter().flat_map(move |a| [(a, &other.low), (a, &other.high)])
    }

    pub(super) fn times(&self, other: &Self, bits: u64) -> Self {
        let all = |up| self.ends(other).map(move |(a, b)| a.times(b, bits, up));
        Self { low: all(false).min().unwrap_or(End::Below), high: all(true).max().unwrap_or(End::Above) }
    }

    /// `x^2`, which is not negative.
    pub(super) fn squared(&self, bits: u64) -> Self {
        let x = self.abs();
        Self { low: x.low.times(&x.low, bits, false), high: x.high.times(&x.high, bits, true) }
    }

    /// The quotient; `None` if the divisor may be zero, or both intervals are unbounded.
    pub(super) fn over(&self, other: &Self, bits: u64) -> Option<Self> {
        if other.has_zero() {
            return None;
        }
        let all = |up| self.ends(other).map(|(a, b)| a.over(b, bits, up)).collect::<Option<Vec<End>>>();
        Some(Self { low: all(false)?.into_iter().min()?, high: all(true)?.into_iter().max()? })
    }

    /// The square root of a nonnegative interval, or the cube root of an interval on one side of zero.
    pub(super) fn root(&self, degree: u32, bits: u64) -> Self {
        let of = |x: &Dyadic, up: bool| match x {
            x if x.is_negative() => x.abs().root(degree, bits, !up).0.negated(),
            x if x.is_zero() => x.clone(),
            x => x.root(degree, bits, up).0,
        };
        let at = |end: &End, up| end.map(|x| End::At(of(x, up)));
        Self { low: at(&self.low, false), high: at(&self.high, true) }
    }
}
