//! Dyadic numbers, `digits * 2^exponent`, and ends of intervals.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_traits::{Signed, Zero};

/// Magnitudes above `2^LIMIT` become infinite; those below `2^-LIMIT` become zero or `2^-LIMIT`, rounded outward.
pub(super) const LIMIT: i64 = 1 << 60;

/// A dyadic number.
#[derive(Clone, Debug)]
pub(crate) struct Dyadic {
    pub(crate) digits: BigInt,
    pub(crate) exponent: i64,
}

impl Dyadic {
    pub(crate) fn new(digits: impl Into<BigInt>, exponent: i64) -> Self {
        Self { digits: digits.into(), exponent }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.digits.is_zero()
    }

    pub(crate) fn is_negative(&self) -> bool {
        self.digits.is_negative()
    }

    /// Smallest `t` such that the magnitude is below `2^t`; a very negative integer for zero.
    pub(super) fn top(&self) -> i64 {
        if self.is_zero() { i64::MIN / 2 } else { self.exponent + self.digits.bits().cast_signed() }
    }

    pub(super) fn negated(&self) -> Self {
        Self { digits: -&self.digits, exponent: self.exponent }
    }

    pub(super) fn abs(&self) -> Self {
        Self { digits: self.digits.abs(), exponent: self.exponent }
    }

    /// `x 2^places`.
    pub(super) fn scaled(&self, places: i64) -> Self {
        Self { digits: self.digits.clone(), exponent: self.exponent + places }
    }

    /// `floor(x 2^places)`.
    pub(super) fn floor_at(&self, places: i64) -> BigInt {
        shifted(&self.digits, self.exponent + places)
    }

    /// The nearest number with at most `bits` bits, above or below.
    pub(super) fn rounded(self, bits: u64, up: bool) -> Self {
        let length = self.digits.bits();
        if length <= bits {
            return self;
        }
        let drop = length - bits;
        let digits = if up { -((-self.digits) >> drop) } else { self.digits >> drop };
        Self { digits, exponent: self.exponent + drop.cast_signed() }
    }

    /// The sum, rounded to `bits` bits. An operand far below the last bit is replaced by one unit far below it.
    pub(super) fn plus(&self, other: &Self, bits: u64, up: bool) -> Self {
        let (large, small) = if self.top() >= other.top() { (self, other) } else { (other, self) };
        if small.is_zero() {
            return large.clone().rounded(bits, up);
        }
        let spare = large.top().min(large.exponent) - bits.cast_signed() - 8;
        if small.top() < spare {
            let unit = match small.is_negative() == up {
                true => BigInt::zero(),
                false => BigInt::from(if up { 1 } else { -1 }),
            };
            return large.plus_exactly(&Self::new(unit, spare)).rounded(bits, up);
        }
        large.plus_exactly(small).rounded(bits, up)
    }

    fn plus_exactly(&self, other: &Self) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let at = |x: &Self| &x.digits << (x.exponent - exponent).unsigned_abs();
        Self { digits: at(self) + at(other), exponent }
    }

    pub(super) fn times(&self, other: &Self, bits: u64, up: bool) -> Self {
        Self { digits: &self.digits * &other.digits, exponent: self.exponent + other.exponent }.rounded(bits, up)
    }

    /// The quotient, rounded to about `bits` bits; the divisor is not zero.
    pub(super) fn over(&self, other: &Self, bits: u64, up: bool) -> Self {
        let places = (bits + 2 + other.digits.bits()).saturating_sub(self.digits.bits());
        let (dividend, divisor) = if other.is_negative() {
            (-&self.digits << places, -&other.digits)
        } else {
            (&self.digits << places, other.digits.clone())
        };
        let (quotient, rest) = num_integer::Integer::div_mod_floor(&dividend, &divisor);
        let digits = if up && !rest.is_zero() { quotient + 1 } else { quotient };
        Self { digits, exponent: self.exponent - other.exponent - places.cast_signed() }.rounded(bits, up)
    }

    /// The square or cube root of a nonnegative number, rounded to about `bits` bits, and `true` if it is exact.
    pub(super) fn root(&self, degree: u32, bits: u64, up: bool) -> (Self, bool) {
        let degree_bits = u64::from(degree);
        let mut places = (degree_bits * (bits + 2)).saturating_sub(self.digits.bits()).cast_signed();
        places += (self.exponent - places).rem_euclid(degree.into());
        let radicand = &self.digits << places.unsigned_abs();
        let root = if degree == 2 { radicand.sqrt() } else { radicand.cbrt() };
        let exact = root.pow(degree) == radicand;
        let digits = if up && !exact { root + 1 } else { root };
        (Self { digits, exponent: (self.exponent - places) / i64::from(degree) }.rounded(bits, up), exact)
    }

    /// The number as an integer, if it is one.
    pub(super) fn whole(&self) -> Option<BigInt> {
        let zeros = self.digits.trailing_zeros().unwrap_or(u64::MAX);
        (self.exponent >= 0 || zeros >= self.exponent.unsigned_abs()).then(|| self.floor_at(0))
    }
}

/// `floor(x 2^places)`.
pub(super) fn shifted(x: &BigInt, places: i64) -> BigInt {
    if places >= 0 { x << places.unsigned_abs() } else { x >> places.unsigned_abs() }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let sign = |x: &Self| match x.digits.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        };
        let signs = sign(self).cmp(&sign(other));
        if signs.is_ne() || self.is_zero() {
            return signs;
        }
        let tops = self.top().cmp(&other.top());
        if tops.is_ne() {
            return if self.is_negative() { tops.reverse() } else { tops };
        }
        let exponent = self.exponent.min(other.exponent);
        let at = |x: &Self| &x.digits << (x.exponent - exponent).unsigned_abs();
        at(self).cmp(&at(other))
    }
}

/// End of an interval.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum End {
    /// Minus infinity.
    Below,
    /// A number.
    At(Dyadic),
    /// Plus infinity.
    Above,
}

impl End {
    /// An end for a number, moved outward if its exponent is out of range: `up` for upper ends.
    pub(super) fn safe(x: Dyadic, up: bool) -> Self {
        let one = BigInt::from(if x.is_negative() { -1 } else { 1 });
        let outward = x.is_negative() != up;
        match x.top() {
            top if top > LIMIT && !outward => Self::At(Dyadic::new(one, LIMIT)),
            top if top > LIMIT => Self::infinity(!up),
            top if !x.is_zero() && top < -LIMIT => {
                Self::At(Dyadic::new(if outward { one } else { BigInt::ZERO }, -LIMIT))
            }
            _ => Self::At(x),
        }
    }

    pub(crate) fn is_negative(&self) -> bool {
        match self {
            Self::Below => true,
            Self::At(x) => x.is_negative(),
            Self::Above => false,
        }
    }

    pub(crate) fn is_zero(&self) -> bool {
        matches!(self, Self::At(x) if x.is_zero())
    }

    pub(super) fn negated(&self) -> Self {
        match self {
            Self::Below => Self::Above,
            Self::At(x) => Self::At(x.negated()),
            Self::Above => Self::Below,
        }
    }

    /// A function of the number; an infinite end stays.
    pub(super) fn map(&self, of: impl FnOnce(&Dyadic) -> Self) -> Self {
        if let Self::At(x) = self { of(x) } else { self.clone() }
    }

    fn infinity(negative: bool) -> Self {
        if negative { Self::Below } else { Self::Above }
    }

    /// A sum of two lower or two upper ends.
    pub(super) fn plus(&self, other: &Self, bits: u64, up: bool) -> Self {
        match (self, other) {
            (Self::At(x), Self::At(y)) => Self::safe(x.plus(y, bits, up), up),
            (Self::At(_), end) | (end, _) => end.clone(),
        }
    }

    /// A product; zero times infinity is zero, as required for ends.
    pub(super) fn times(&self, other: &Self, bits: u64, up: bool) -> Self {
        match (self, other) {
            (Self::At(x), Self::At(y)) => Self::safe(x.times(y, bits, up), up),
            _ if self.is_zero() || other.is_zero() => Self::At(Dyadic::new(0, 0)),
            _ => Self::infinity(self.is_negative() != other.is_negative()),
        }
    }

    /// A quotient by a nonzero end; `None` for infinity divided by infinity.
    pub(super) fn over(&self, other: &Self, bits: u64, up: bool) -> Option<Self> {
        Some(match (self, other) {
            (Self::At(x), Self::At(y)) => Self::safe(x.over(y, bits, up), up),
            (Self::At(_), _) => Self::At(Dyadic::new(0, 0)),
            (_, Self::At(y)) => Self::infinity(self.is_negative() != y.is_negative()),
            _ => return None,
        })
    }
}
