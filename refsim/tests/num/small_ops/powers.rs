//! `exp2`, `log2` and `pow`, by comparison of powers of fractions.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::Pow;
use refsim::num::{Flags, FormatKind, Outcome, Overflow};

use super::Val::{Inf, Nan, Num};
use super::{ONE, Reference, Val, signed};
use crate::rational::{self, Q};

impl Reference {
    pub(crate) fn exp2(&self, a: Val) -> Outcome {
        let (negative, q) = match a {
            Nan { .. } => return self.nan(&[a]).expect("a NaN"),
            Inf(true) => return self.zero(false),
            Inf(false) => return self.infinity(false),
            Num(negative, q) => (negative, q),
        };
        if let (FormatKind::Fixed { int_bits, .. } | FormatKind::Normalized { int_bits, .. }, Overflow::Wrap) =
            (self.f.kind, self.f.overflow)
            && signed(negative, q).floor() >= i128::from(int_bits)
        {
            return Outcome::new(self.f.max_finite(), Flags::OVERFLOW | Flags::INEXACT);
        }
        // Compares 2^(n/d) with c by comparing 2^n with c^d.
        rational::round(&self.f, self.tininess, false, |c| power_of_two(negative, q.n).cmp_power(c, q.d))
    }

    pub(crate) fn log2(&self, a: Val) -> Outcome {
        let q = match a {
            Nan { .. } => return self.nan(&[a]).expect("a NaN"),
            Num(_, q) if q.n == 0 => return self.pole(true),
            Num(true, _) | Inf(true) => return self.invalid(),
            Inf(_) => return self.infinity(false),
            Num(_, q) => q,
        };
        let negative = q.cmp(ONE).is_lt();
        if q.cmp(ONE).is_eq() {
            return self.zero(false);
        }
        // Compares |log2 q| with n/d by comparing q^d, or (1/q)^d, with 2^n.
        let q = if negative { Q::new(q.d, q.n) } else { q };
        rational::round(&self.f, self.tininess, negative, |c| power_of_two(false, c.n).cmp_power(q, c.d).reverse())
    }

    pub(crate) fn pow(&self, x: u32, y: u32) -> Outcome {
        let log = self.log2(self.val(x));
        let product = self.mul(self.val(y), self.val(log.bits));
        self.exp2(self.val(product.bits)).also(log.flags | product.flags)
    }
}

/// `2^n`, or its reciprocal.
struct Power {
    inverse: bool,
    value: BigInt,
}

fn power_of_two(inverse: bool, n: i128) -> Power {
    Power { inverse, value: BigInt::from(1) << n }
}

impl Power {
    /// Compares this power with `(n/d)^k`.
    fn cmp_power(&self, c: Q, k: i128) -> Ordering {
        let power = |n: i128| Pow::pow(BigInt::from(n), u32::try_from(k).expect("a small exponent"));
        let (n, d) = (power(c.n), power(c.d));
        if self.inverse { d.cmp(&(n * &self.value)) } else { (d * &self.value).cmp(&n) }
    }
}
