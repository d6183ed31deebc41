//! Lane arithmetic of fixed point and normalized integers that round to odd: one body for all of them, in integers of
//! 128 bits. No card has this rounding, so it need not be fast.

use super::lane::Lane;
use super::power;
use crate::num::{Format, FormatKind, Overflow};

/// The arithmetic of one format of fixed point, normalized or not, that rounds to odd.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OddLane {
    width: u32,
    low: i32,
    high: i32,
    /// Units of 1, which in `s0.F` is no number.
    units: i32,
    one: i32,
    int: u32,
    wraps: bool,
}

/// Magnitudes beyond every format, wrapped numbers of units too: a power of two, so that its residue is 0.
const FAR: f64 = (1u128 << 100) as f64;

impl OddLane {
    /// The arithmetic of a format that is no float.
    pub(crate) fn new(format: &Format) -> Self {
        let int = match format.kind {
            FormatKind::Fixed { int_bits, .. } | FormatKind::Normalized { int_bits, .. } => int_bits,
            FormatKind::Float { .. } => 0,
        };
        let units = match format.kind {
            FormatKind::Fixed { frac_bits, .. } => 1i64 << frac_bits,
            _ => format.denominator().into(),
        };
        let width = format.width();
        let high = ((1i64 << (width - 1)) - 1) as i32;
        Self {
            width,
            low: -high - 1,
            high,
            units: units as i32,
            one: units.min(high.into()) as i32,
            int: int.into(),
            wraps: format.overflow == Overflow::Wrap,
        }
    }

    /// `1` in units, as a dividend or divisor. (2^31 of `s0.31` is negative as an `i32`.)
    fn unit(&self) -> i128 {
        i128::from(self.units.cast_unsigned())
    }

    /// The integer if nothing is `lost`, else the odd one of it and the next; brought into the range.
    fn fit(&self, floor: i128, lost: bool) -> i32 {
        let odd = floor | i128::from(lost);
        if self.wraps {
            let spare = 32 - self.width;
            return (odd as i32) << spare >> spare;
        }
        odd.clamp(self.low.into(), self.high.into()) as i32
    }

    /// `n / d` units; `d` is not 0.
    fn ratio(&self, n: i128, d: i128) -> i32 {
        let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
        self.fit(n.div_euclid(d), n.rem_euclid(d) != 0)
    }

    /// The root of `n / d` units, none of them negative, `n` below 2^62 or `d` 1.
    fn root(&self, n: u128, d: u128) -> i32 {
        let root = (n / d).isqrt();
        self.fit(root.cast_signed(), root * root * d != n)
    }

    /// Returns `a / 0`.
    fn by_zero(&self, a: i32) -> i32 {
        match a {
            0 => 0,
            1.. => self.high,
            _ => self.low,
        }
    }
}

impl Lane for OddLane {
    type T = i32;
    type General = Self;

    fn decode(&self, bits: u32) -> i32 {
        let spare = 32 - self.width;
        bits.cast_signed() << spare >> spare
    }

    fn encode(&self, x: i32) -> u32 {
        x.cast_unsigned() & (u32::MAX >> (32 - self.width))
    }

    /// Exact, or of normalized numbers the nearest double.
    fn to_f64(&self, x: i32) -> f64 {
        f64::from(x) / self.unit() as f64
    }

    /// Numbers of units that a double can't hold exactly are brought to the integer they mean, as in
    /// [`super::normalized`].
    fn round_f64(&self, x: f64) -> i32 {
        const NEAR: f64 = 1.0 / (1u64 << 50) as f64;
        let units = x * self.unit() as f64;
        let integer = units.round_ties_even();
        let inexact = self.unit() & (self.unit() - 1) != 0;
        let meant = if inexact && (units - integer).abs() <= integer.abs() * NEAR { integer } else { units };
        if x.is_nan() {
            return 0;
        }
        if x.is_infinite() {
            return self.by_zero(if x > 0.0 { 1 } else { -1 });
        }
        let clamped = meant.clamp(-FAR, FAR);
        self.fit(clamped.floor() as i128, clamped != clamped.floor())
    }

    /// The product is exact, and so is the quotient where it is an integer.
    fn steps(&self, x: i32, scale: f64, half: f64) -> u32 {
        let low = f64::from(x.max(0)).min(self.unit() as f64);
        (low * scale / self.unit() as f64 + half) as u32
    }

    fn add(&self, a: i32, b: i32) -> i32 {
        self.fit(i128::from(a) + i128::from(b), false)
    }

    fn mul(&self, a: i32, b: i32) -> i32 {
        self.ratio(i128::from(a) * i128::from(b), self.unit())
    }

    fn sub(&self, a: i32, b: i32) -> i32 {
        self.fit(i128::from(a) - i128::from(b), false)
    }

    fn fused_mad(&self, a: i32, b: i32, c: i32) -> i32 {
        self.ratio(i128::from(a) * i128::from(b) + i128::from(c) * self.unit(), self.unit())
    }

    fn exact_dot<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        let products = a.into_iter().zip(b).map(|(a, b)| i128::from(a) * i128::from(b));
        self.ratio(products.sum(), self.unit())
    }

    fn div(&self, a: i32, b: i32) -> i32 {
        if b == 0 { self.by_zero(a) } else { self.ratio(i128::from(a) * self.unit(), b.into()) }
    }

    fn sqrt(&self, a: i32) -> i32 {
        if a <= 0 { 0 } else { self.root(a.unsigned_abs() as u128 * self.unit().unsigned_abs(), 1) }
    }

    fn rcp(&self, a: i32) -> i32 {
        if a == 0 { self.high } else { self.ratio(self.unit() * self.unit(), a.into()) }
    }

    fn rsq(&self, a: i32) -> i32 {
        match a {
            0 => self.high,
            1.. => self.root(self.unit().unsigned_abs().pow(3), a.unsigned_abs().into()),
            _ => 0,
        }
    }

    fn exp2(&self, a: i32) -> i32 {
        // Past the range there is no residue to take.
        if self.wraps && i128::from(a).div_euclid(self.unit()) >= i128::from(self.int) {
            return self.high;
        }
        self.round_f64(power::exp2(self.to_f64(a)))
    }

    fn log2(&self, a: i32) -> i32 {
        match a {
            0 => self.low,
            1.. => self.round_f64(power::log2(self.to_f64(a))),
            _ => 0,
        }
    }

    fn min(&self, a: i32, b: i32) -> i32 {
        a.min(b)
    }

    fn max(&self, a: i32, b: i32) -> i32 {
        a.max(b)
    }

    fn floor(&self, a: i32) -> i32 {
        self.fit(i128::from(a).div_euclid(self.unit()) * self.unit(), false)
    }

    fn frc(&self, a: i32) -> i32 {
        i128::from(a).rem_euclid(self.unit()) as i32
    }

    fn neg(&self, a: i32) -> i32 {
        self.sub(0, a)
    }

    fn abs(&self, a: i32) -> i32 {
        if a < 0 { self.neg(a) } else { a }
    }

    fn scale(&self, a: i32, shift: i32) -> i32 {
        let up = i128::from(a) << shift.max(0);
        self.ratio(up, 1 << shift.min(0).unsigned_abs())
    }

    fn saturate(&self, a: i32) -> i32 {
        a.max(0).min(self.one)
    }

    fn above_half(&self, a: i32) -> bool {
        2 * i128::from(a) > self.unit()
    }

    fn factor(&self, a: i32, _: i32) -> i32 {
        a
    }
}
