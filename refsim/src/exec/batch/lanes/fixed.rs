//! Lane arithmetic of the fixed-point formats `sI.F`, in host integers.

use super::float::rounding_index;
use super::lane::Lane;
use super::power;
use crate::num::{Format, Overflow};

/// The overflow rule decided at run time; the other two are 0 (saturate) and 1 (wrap).
const ANY_OVERFLOW: u8 = 2;

/// How to divide by a power of two with rounding: the constants of one shift.
#[derive(Clone, Copy, Debug)]
struct Shift {
    count: u32,
    /// One half unit, less one, and the mask of what is dropped; all zero if nothing is.
    half: i64,
    half_less_one: i64,
    dropped: i64,
    /// One if anything is dropped.
    some: i64,
}

impl Shift {
    const fn new(count: u32) -> Shift {
        let half = if count == 0 { 0 } else { 1 << (count - 1) };
        let some = if count == 0 { 0 } else { 1 };
        Shift { count, half, half_less_one: half - some, dropped: (1 << count) - 1, some }
    }
}

/// The arithmetic of one fixed-point format: `R` a rounding as a number or [`super::float::ANY`], `WIDE` whether the
/// format has more than 16 bits, `O` 0 to saturate, 1 to wrap, 2 to decide at run time.
///
/// Up to 16 bits a product, and a product plus a shifted addend, fits an `i32`: both factors are at most 2^15, so
/// `|a b| <= 2^30`, `|c 2^F| <= 2^30` with `+2^30` impossible for the latter, and half a unit is at most 2^14. Wider
/// ones use `i64`, where the same holds with 2^62.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedLane<const R: u8, const WIDE: bool, const O: u8> {
    rounding: u8,
    wrap: bool,
    frac: u32,
    int: u32,
    width: u32,
    low: i32,
    high: i32,
    one: i32,
    product: Shift,
}

/// Divides by `2^count`, rounding: one body for both widths.
macro_rules! round_shift {
    ($name:ident, $t:ty, $sign:literal) => {
        #[inline(always)]
        fn $name(&self, v: $t, shift: &Shift) -> $t {
            let count = shift.count;
            match self.rounding() {
                // floor((v + half - 1 + odd) / 2^count): ties move up only from odd floors.
                0 => (v + shift.half_less_one as $t + (v >> count & shift.some as $t)) >> count,
                1 => (v + shift.half as $t + (v >> $sign & -(shift.some as $t))) >> count,
                2 => (v + (v >> $sign & shift.dropped as $t)) >> count,
                _ => v >> count,
            }
        }
    };
}

impl<const R: u8, const WIDE: bool, const O: u8> FixedLane<R, WIDE, O> {
    /// The arithmetic of a fixed-point format with these bits.
    pub(crate) fn new(format: &Format, int_bits: u8, frac_bits: u8) -> Self {
        let bits = u32::from(int_bits) + u32::from(frac_bits);
        let high = ((1i64 << bits) - 1) as i32;
        let one = (1i64 << frac_bits).min(i64::from(high)) as i32;
        FixedLane {
            rounding: rounding_index(format.rounding),
            wrap: format.overflow == Overflow::Wrap,
            frac: u32::from(frac_bits),
            int: u32::from(int_bits),
            width: bits + 1,
            low: -high - 1,
            high,
            one,
            product: Shift::new(u32::from(frac_bits)),
        }
    }

    #[inline(always)]
    fn rounding(&self) -> u8 {
        if R == super::float::ANY { self.rounding } else { R }
    }

    #[inline(always)]
    fn wraps(&self) -> bool {
        if O == ANY_OVERFLOW { self.wrap } else { O == 1 }
    }

    round_shift!(round32, i32, 31);
    round_shift!(round64, i64, 63);
    round_shift!(round128, i128, 127);

    /// The low bits of the width, sign-extended.
    #[inline(always)]
    fn residue(&self, v: i32) -> i32 {
        let spare = 32 - self.width;
        v << spare >> spare
    }

    #[inline(always)]
    fn fit32(&self, v: i32) -> i32 {
        if self.wraps() { self.residue(v) } else { v.max(self.low).min(self.high) }
    }

    #[inline(always)]
    fn fit64(&self, v: i64) -> i32 {
        if self.wraps() { self.residue(v as i32) } else { v.max(i64::from(self.low)).min(i64::from(self.high)) as i32 }
    }

    fn fit128(&self, v: i128) -> i32 {
        if self.wraps() { self.residue(v as i32) } else { v.clamp(self.low.into(), self.high.into()) as i32 }
    }

    fn extreme(&self, negative: bool) -> i32 {
        if negative { self.low } else { self.high }
    }

    /// What `a / 0` gives.
    #[inline(always)]
    fn by_zero(&self, a: i32) -> i32 {
        let extreme = self.extreme(a < 0);
        if a == 0 { 0 } else { extreme }
    }

    /// `n / d` units for `|n| <= 2^30` and `|d| <= 2^15`, rounded and saturated; anything if `d` is zero.
    ///
    /// A quotient that lies between two numbers with a half lies at least one part in `2^16` away from all of them, and
    /// the double errs by one in `2^22` at most: it rounds as the quotient does. Clamping first keeps the integer
    /// small.
    #[inline(always)]
    fn quotient(&self, n: i32, d: i32) -> i32 {
        /// Adding it leaves the nearest integer, ties to even, in the low bits of a double.
        const PIVOT: f64 = 6_755_399_441_055_744.0;
        let exact = f64::from(n) / f64::from(d);
        let (low, high) = (f64::from(self.low) - 1.0, f64::from(self.high) + 1.0);
        let above = if exact > low { exact } else { low };
        let near = ((if above < high { above } else { high }) + PIVOT).to_bits() as i32;
        let rest = n - near * d;
        // Whether the exact quotient is positive, and on which side of the integer it is.
        let positive = (n < 0) == (d < 0);
        let beyond = (rest != 0) & ((rest < 0) == (d < 0));
        let below = (rest != 0) & ((rest < 0) != (d < 0));
        let tie = rest.unsigned_abs() * 2 == d.unsigned_abs();
        let (up, down) = match self.rounding() {
            0 => (false, false),
            1 => (tie & beyond & positive, tie & below & !positive),
            2 => (beyond & !positive, below & positive),
            _ => (false, below),
        };
        self.fit32(near + i32::from(up) - i32::from(down))
    }

    /// `magnitude / 2^guard` units, and a bit more if `sticky`, rounded and fitted; `guard` at least 2 with `sticky`.
    fn finish(&self, negative: bool, magnitude: u128, guard: u32, sticky: bool) -> i32 {
        // Two guard bits and the sticky bit beneath them say all; the rest folds into the last.
        let (kept, guard, sticky) = if guard > 3 {
            let drop = (guard - 3).min(127);
            (magnitude >> drop, 3, sticky || magnitude & ((1 << drop) - 1) != 0)
        } else {
            (magnitude, guard, sticky)
        };
        let exact = (kept << 1 | u128::from(sticky)).cast_signed();
        self.fit128(self.round128(if negative { -exact } else { exact }, &Shift::new(guard + 1)))
    }
}

impl<const R: u8, const WIDE: bool, const O: u8> Lane for FixedLane<R, WIDE, O> {
    type T = i32;

    #[inline(always)]
    fn decode(&self, bits: u32) -> i32 {
        self.residue(bits.cast_signed())
    }

    #[inline(always)]
    fn encode(&self, x: i32) -> u32 {
        x as u32 & (u32::MAX >> (32 - self.width))
    }

    #[inline(always)]
    fn load(raw: u32) -> i32 {
        raw.cast_signed()
    }

    #[inline(always)]
    fn store(x: i32) -> u32 {
        x as u32
    }

    #[inline(always)]
    fn to_f64(&self, x: i32) -> f64 {
        f64::from(x) / (1u64 << self.frac) as f64
    }

    #[inline(always)]
    fn round_f64(&self, x: f64) -> i32 {
        // In units; scaling by a power of two, floors and the rest below are exact.
        let units = x * (1u64 << self.frac) as f64;
        let floor = units.floor();
        let rest = units - floor;
        let up = match self.rounding() {
            // An odd floor has a half that isn't whole.
            0 => (rest > 0.5) | ((rest == 0.5) & (floor * 0.5 != (floor * 0.5).floor())),
            1 => (rest > 0.5) | ((rest == 0.5) & (units > 0.0)),
            2 => (rest > 0.0) & (units < 0.0),
            _ => false,
        };
        let rounded = if up { floor + 1.0 } else { floor };
        let (low, high) = (f64::from(self.low), f64::from(self.high));
        let above_low = if rounded > low { rounded } else { low };
        let clamped = if above_low < high { above_low } else { high };
        let size = (1u64 << self.width) as f64;
        let residue = rounded - (rounded / size).floor() * size;
        let finite = units.abs() < f64::INFINITY;
        let value = if self.wraps() & finite { residue } else { clamped };
        let number = if x.is_nan() { 0.0 } else { value };
        // The residue lies in [0, 2^width): one more fold makes it signed.
        let folded = if number > high { number - size } else { number };
        folded as i32
    }

    #[inline(always)]
    fn add(&self, a: i32, b: i32) -> i32 {
        if WIDE { self.fit64(i64::from(a) + i64::from(b)) } else { self.fit32(a + b) }
    }

    #[inline(always)]
    fn sub(&self, a: i32, b: i32) -> i32 {
        if WIDE { self.fit64(i64::from(a) - i64::from(b)) } else { self.fit32(a - b) }
    }

    #[inline(always)]
    fn mul(&self, a: i32, b: i32) -> i32 {
        if WIDE {
            self.fit64(self.round64(i64::from(a) * i64::from(b), &self.product))
        } else {
            self.fit32(self.round32(a * b, &self.product))
        }
    }

    #[inline(always)]
    fn fused_mad(&self, a: i32, b: i32, c: i32) -> i32 {
        if WIDE {
            let sum = i64::from(a) * i64::from(b) + (i64::from(c) << self.frac);
            self.fit64(self.round64(sum, &self.product))
        } else {
            self.fit32(self.round32(a * b + (c << self.frac), &self.product))
        }
    }

    #[inline(always)]
    fn exact_dot<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        if WIDE {
            let mut sum = 0i128;
            for k in 0..N {
                sum += i128::from(a[k]) * i128::from(b[k]);
            }
            self.fit128(self.round128(sum, &self.product))
        } else {
            let mut sum = 0i64;
            for k in 0..N {
                sum += i64::from(a[k] * b[k]);
            }
            self.fit64(self.round64(sum, &self.product))
        }
    }

    #[inline(always)]
    fn div(&self, a: i32, b: i32) -> i32 {
        if !WIDE && !self.wraps() {
            let quotient = self.quotient(a << self.frac, b);
            return if b == 0 { self.by_zero(a) } else { quotient };
        }
        if b == 0 {
            return self.by_zero(a);
        }
        let dividend = u128::from(a.unsigned_abs()) << (self.frac + 2);
        let divisor = u128::from(b.unsigned_abs());
        self.finish((a < 0) != (b < 0), dividend / divisor, 2, !dividend.is_multiple_of(divisor))
    }

    fn sqrt(&self, a: i32) -> i32 {
        if a <= 0 {
            return 0;
        }
        // sqrt(a 2^F) units, with 16 guard bits.
        let square = (a as u128) << (self.frac + 32);
        let root = square.isqrt();
        self.finish(false, root, 16, root * root != square)
    }

    #[inline(always)]
    fn rcp(&self, a: i32) -> i32 {
        if a == 0 {
            return self.high;
        }
        if !WIDE && !self.wraps() {
            return self.quotient(1 << (2 * self.frac), a);
        }
        let dividend = 1u128 << (2 * self.frac + 2);
        let divisor = u128::from(a.unsigned_abs());
        self.finish(a < 0, dividend / divisor, 2, !dividend.is_multiple_of(divisor))
    }

    fn rsq(&self, a: i32) -> i32 {
        if a <= 0 {
            return if a == 0 { self.high } else { 0 };
        }
        // sqrt(2^3F / a) units; the guard bits fill what 127 bits leave, 16 at least.
        let guard = (126 - 3 * self.frac) / 2;
        let (dividend, divisor) = (1u128 << (3 * self.frac + 2 * guard), a as u128);
        let square = dividend / divisor;
        let root = square.isqrt();
        let exact = dividend.is_multiple_of(divisor) && root * root == square;
        self.finish(false, root, guard, !exact)
    }

    fn exp2(&self, a: i32) -> i32 {
        // Past the range there is no residue to take.
        if a >> self.frac >= self.int.cast_signed() && self.wraps() {
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

    #[inline(always)]
    fn min(&self, a: i32, b: i32) -> i32 {
        a.min(b)
    }

    #[inline(always)]
    fn max(&self, a: i32, b: i32) -> i32 {
        a.max(b)
    }

    #[inline(always)]
    fn floor(&self, a: i32) -> i32 {
        a & !(self.product.dropped as i32)
    }

    #[inline(always)]
    fn frc(&self, a: i32) -> i32 {
        a & self.product.dropped as i32
    }

    #[inline(always)]
    fn neg(&self, a: i32) -> i32 {
        self.sub(0, a)
    }

    #[inline(always)]
    fn abs(&self, a: i32) -> i32 {
        let negated = self.sub(0, a);
        if a < 0 { negated } else { a }
    }

    #[inline(always)]
    fn scale(&self, a: i32, shift: i32) -> i32 {
        if !WIDE && shift >= 0 {
            self.fit32(a << shift)
        } else if !WIDE {
            self.fit32(self.round32(a, &Shift::new(shift.unsigned_abs())))
        } else if shift >= 0 {
            self.fit64(i64::from(a) << shift)
        } else {
            self.fit64(self.round64(i64::from(a), &Shift::new(shift.unsigned_abs())))
        }
    }

    #[inline(always)]
    fn saturate(&self, a: i32) -> i32 {
        a.max(0).min(self.one)
    }

    #[inline(always)]
    fn lt(&self, a: i32, b: i32) -> bool {
        a < b
    }

    #[inline(always)]
    fn le(&self, a: i32, b: i32) -> bool {
        a <= b
    }

    #[inline(always)]
    fn eq(&self, a: i32, b: i32) -> bool {
        a == b
    }

    #[inline(always)]
    fn above_half(&self, a: i32) -> bool {
        a > self.product.half as i32
    }

    #[inline(always)]
    fn factor(&self, a: i32, _: i32) -> i32 {
        a
    }
}
