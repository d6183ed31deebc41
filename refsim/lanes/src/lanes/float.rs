//! Lane arithmetic of the binary floats `eXmY`: a host `f32` represents each of their values.

use super::lane::Lane;
use super::layout::FloatLayout;
use super::odd::SIGN;
use super::reading::Reading;
use super::round::{AWAY, DOWN, DoubleRounder, EVEN, ODD, ShortRounder, SingleRounder, ZERO, rounding_index};
use super::{odd, power, toward};
use crate::num::{Denormals, Encoding, Format, Overflow, Rounding, Specials};

/// Binary32, in `f32`: nearest even is the host's own rounding.
pub(crate) const HOST: u8 = 0;
/// In `f32`, then rounded once more into the format.
///
/// Rounding to nearest even twice is innocuous for `+ - * / sqrt` if the wider format has at least `2p + 2` bits
/// (Figueroa 1995, "When is double rounding innocuous?"): 24 >= 2 * 11 + 2. That also holds for a subnormal narrow
/// result: the proof needs the distance between a result and a midpoint of at most `p + 1` bits, and subnormal
/// midpoints have fewer bits. The wide result must not be subnormal itself: with six exponent bits and ten mantissa
/// bits the smallest product is 2^-80. Products are exact. The other roundings use [`ShortRounder`], for formats that
/// keep subnormal numbers.
pub(crate) const SINGLE: u8 = 1;
/// Nearest even in `f64`, rounded twice as for [`SINGLE`]: `53 >= 2 * 24 + 2`; the other roundings in `f32`
/// ([`toward`]).
pub(crate) const DOUBLE: u8 = 2;
/// Slow path for every format and rounding: exact results rounded to odd into doubles. Other paths fall back on it.
pub(crate) const GENERAL: u8 = 3;

/// Rounding decided at run time.
pub(crate) const ANY: u8 = ODD + 1;

/// The arithmetic that is correct for every float format.
pub(crate) type GeneralLane = FloatLane<GENERAL, ANY>;

/// The arithmetic of one float format. `PATH` is one of [`HOST`], [`SINGLE`], [`DOUBLE`], [`GENERAL`]; `R` is a
/// [`Rounding`] as a number, or [`ANY`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct FloatLane<const PATH: u8, const R: u8> {
    rounding: u8,
    layout: FloatLayout,
    single: SingleRounder,
    double: DoubleRounder,
    short: ShortRounder,
    /// Magnitude of the results of `1/0` and `log2 0`.
    pole: f32,
    /// The result if an operand is NaN or infinite: NaN, or 0 in formats without NaN.
    nan: f32,
    /// Addend that turns -0 into +0 in encodings without -0; in other encodings -0.
    zero: f64,
    nv: bool,
    guarded: bool,
}

/// Selects the path for a format with these field widths.
pub(crate) fn path(format: &Format, exp_bits: u8, man_bits: u8) -> u8 {
    let common = format.encoding == Encoding::Ieee && !matches!(format.rounding, Rounding::Up | Rounding::Odd);
    match (exp_bits, man_bits) {
        _ if !common => GENERAL,
        // `f32` gives its largest number where `:nvovf` requires infinity. That result is finite, so no guard finds it.
        (8, _) if format.overflow == Overflow::Nv30 && format.rounding != Rounding::NearestEven => GENERAL,
        (8, 23) => HOST,
        (..=6, ..=10) if format.rounding == Rounding::NearestEven || format.denormals == Denormals::Keep => SINGLE,
        // Subnormal results of these roundings would need one bit more than a single has.
        (_, 23) if format.rounding != Rounding::NearestEven => GENERAL,
        _ => DOUBLE,
    }
}

impl<const PATH: u8, const R: u8> FloatLane<PATH, R> {
    /// Creates the arithmetic of a format for which [`path`] returns `PATH`, or with `PATH` = [`GENERAL`].
    pub(crate) fn new(format: &Format, exp_bits: u8, man_bits: u8) -> Self {
        let layout = FloatLayout::new(format, exp_bits, man_bits);
        let bounded = matches!(format.overflow, Overflow::Saturate | Overflow::Nv30);
        let nan = if format.canonical_nan().is_some() { f32::NAN } else { 0.0 };
        let unbounded = if format.encoding == Encoding::Ieee { f32::INFINITY } else { f32::NAN };
        let saturates = format.overflow == Overflow::Saturate || format.canonical_nan().is_none();
        FloatLane {
            rounding: rounding_index(format.rounding),
            layout,
            single: SingleRounder::new(format, man_bits),
            double: DoubleRounder::new(format, man_bits),
            short: ShortRounder::new(exp_bits, man_bits),
            pole: if saturates { layout.decode(format.max_finite()) } else { unbounded },
            nan,
            zero: if format.has_negative_zero() { -0.0 } else { 0.0 },
            nv: format.specials == Specials::Nv,
            guarded: match (PATH, R) {
                (GENERAL, _) | (DOUBLE, EVEN) => false,
                (_, EVEN) => exp_bits == 8 && bounded,
                // The rounder overflows to infinity, where these rules may require the largest number.
                (SINGLE, AWAY) => bounded,
                (SINGLE, ZERO) => format.overflow != Overflow::Nv30,
                (SINGLE, _) => true,
                // The first of two roundings may round a product up to the power of two that overflows.
                (_, DOWN) if format.overflow == Overflow::Nv30 => true,
                _ => exp_bits == 8,
            },
        }
    }

    #[inline(always)]
    fn rounding(&self) -> u8 {
        if R == ANY { self.rounding } else { R }
    }

    /// Rounds to the format a single-precision result that was computed with rounding mode `R`.
    #[inline(always)]
    fn narrow(&self, x: f32) -> f32 {
        match (PATH, R) {
            (HOST, _) => self.single.flushed(x),
            (_, EVEN) => self.single.round(EVEN, x),
            (SINGLE, _) => self.short.round(R, x),
            _ => self.single.cut(R, x),
        }
    }

    /// Stores the result; NaN becomes the format's NaN value.
    #[inline(always)]
    fn number(&self, x: f32) -> f32 {
        if x.is_nan() { self.nan } else { x }
    }

    /// The result at a pole, with a sign.
    #[inline(always)]
    fn pole(&self, sign: u32) -> f32 {
        f32::from_bits(self.pole.to_bits() | sign)
    }

    /// The zero that exact cancellation leaves: `-0` when rounding down, `+0` otherwise; if both operands are zeros
    /// with the same sign, that zero.
    #[inline(always)]
    fn cancel(&self, a: f64, b: f64, sum: f64) -> f64 {
        let plus = (a == 0.0) & (b == 0.0) & !a.is_sign_negative() & !b.is_sign_negative();
        if (self.rounding() == DOWN) & (sum == 0.0) & !plus { -0.0 } else { sum }
    }
}

const SIGN_BIT: u32 = 1 << 31;

impl<const PATH: u8, const R: u8> Lane for FloatLane<PATH, R> {
    type T = f32;
    type General = GeneralLane;

    #[inline(always)]
    fn decode(&self, bits: u32) -> f32 {
        self.layout.decode(bits)
    }

    #[inline(always)]
    fn encode(&self, x: f32) -> u32 {
        self.layout.encode(x)
    }

    #[inline(always)]
    fn to_f64(&self, x: f32) -> f64 {
        f64::from(x)
    }

    fn reading(&self) -> Reading {
        Reading::Float
    }

    #[inline(always)]
    fn round_f64(&self, x: f64) -> f32 {
        if PATH == HOST && R == EVEN {
            self.single.flushed(self.double.convert(x))
        } else {
            let rounded = self.double.round(self.rounding(), x);
            if PATH == GENERAL { self.number((rounded + self.zero) as f32) } else { rounded as f32 }
        }
    }

    #[inline(always)]
    fn round_single(&self, x: f32) -> f32 {
        // Every single that is not flushed is a number of the format, for any rule of overflow.
        if PATH == HOST { self.single.flushed(x) } else { self.round_f64(f64::from(x)) }
    }

    const VECTORS: bool = PATH != GENERAL;

    const GUARDED: bool = !matches!((PATH, R), (GENERAL, _) | (SINGLE | DOUBLE, EVEN));

    #[inline(always)]
    fn is_guarded(&self) -> bool {
        self.guarded
    }

    fn general(&self) -> Option<GeneralLane> {
        let Self { rounding, layout, single, double, short, pole, nan, zero, nv, .. } = *self;
        Some(FloatLane { rounding, layout, single, double, short, pole, nan, zero, nv, guarded: false })
    }

    #[inline(always)]
    fn add(&self, a: f32, b: f32) -> f32 {
        match (PATH, R) {
            (GENERAL, _) => {
                let (a, b) = (f64::from(a), f64::from(b));
                self.round_f64(self.cancel(a, b, odd::add_odd(a, b)))
            }
            (DOUBLE, EVEN) => self.round_f64(f64::from(a) + f64::from(b)),
            (_, EVEN) => self.narrow(a + b),
            (HOST, AWAY) => self.narrow(toward::nearest_sum(a, b)),
            (SINGLE, _) => self.narrow(toward::short_sum::<R>(a, b)),
            _ => self.narrow(toward::sum::<R>(a, b)),
        }
    }

    #[inline(always)]
    fn mul(&self, a: f32, b: f32) -> f32 {
        match (PATH, R) {
            // 24 bits times 24 bits: exact.
            (GENERAL, _) | (DOUBLE, EVEN) => self.round_f64(f64::from(a) * f64::from(b)),
            (SINGLE, _) | (_, EVEN) => self.narrow(a * b),
            (HOST, AWAY) => self.narrow(toward::nearest_product(a, b)),
            _ => self.narrow(toward::product::<R>(a, b)),
        }
    }

    #[inline(always)]
    fn sum<const N: usize>(&self, a: [f32; N], b: [f32; N]) -> f32 {
        if (PATH, R) != (DOUBLE, EVEN) {
            let mut sum = self.mul(a[0], b[0]);
            for k in 1..N {
                sum = self.add(sum, self.mul(a[k], b[k]));
            }
            return sum;
        }
        // Intermediate results remain doubles.
        let product = |k: usize| self.double.round(EVEN, f64::from(a[k]) * f64::from(b[k]));
        let mut sum = product(0);
        for k in 1..N {
            sum = self.double.round(EVEN, sum + product(k));
        }
        sum as f32
    }

    #[inline(always)]
    fn fused_mad(&self, a: f32, b: f32, c: f32) -> f32 {
        let (p, c) = (f64::from(a) * f64::from(b), f64::from(c));
        self.round_f64(self.cancel(p, c, odd::add_odd(p, c)))
    }

    #[inline(always)]
    fn exact_dot<const N: usize>(&self, a: [f32; N], b: [f32; N]) -> f32 {
        let mut products = [0.0f64; N];
        let (mut all_plus, mut all_minus) = (true, true);
        for k in 0..N {
            products[k] = f64::from(a[k]) * f64::from(b[k]);
            all_plus &= products[k].to_bits() == 0;
            all_minus &= products[k].to_bits() == SIGN;
        }
        let sum = odd::sum_odd(products);
        let zero = if all_minus | ((self.rounding() == DOWN) & !all_plus) { -0.0 } else { 0.0 };
        self.round_f64(if sum == 0.0 { zero } else { sum })
    }

    #[inline(always)]
    fn div(&self, a: f32, b: f32) -> f32 {
        let quotient = match (PATH, R) {
            (HOST, EVEN) => return self.narrow(a / b),
            (SINGLE, EVEN) => self.narrow(a / b),
            // A rounding in any direction depends on how the quotient compares with numbers m of one bit more than the
            // format, at most 25 bits. A quotient other than m differs from m by at least 2^-49 of itself, because a -
            // m b is a multiple of the unit of m b. The double differs from the quotient by at most 2^-53, so it
            // compares with m in the same way.
            _ => self.round_f64(f64::from(a) / f64::from(b)),
        };
        let pole = (b == 0.0) & (a.abs() < f32::INFINITY) & (a != 0.0);
        if pole { self.pole((a.to_bits() ^ b.to_bits()) & SIGN_BIT) } else { quotient }
    }

    #[inline(always)]
    fn sqrt(&self, a: f32) -> f32 {
        if PATH == HOST && R == EVEN {
            return a.sqrt();
        }
        // As for a quotient: a root other than m differs from m by at least 2^-51 of itself, because a - m m is a
        // multiple of the unit of m m.
        self.round_f64(f64::from(a).sqrt())
    }

    #[inline(always)]
    fn rcp(&self, a: f32) -> f32 {
        let quotient = match (PATH, R) {
            (GENERAL, _) | (_, EVEN) => return self.div(1.0, a),
            (HOST, AWAY) => 1.0 / a,
            (_, AWAY) => toward::reciprocal::<ZERO>(a),
            _ => toward::reciprocal::<R>(a),
        };
        let rounded = self.narrow(quotient);
        if a == 0.0 { self.pole(a.to_bits() & SIGN_BIT) } else { rounded }
    }

    #[inline(always)]
    fn rsq(&self, a: f32) -> f32 {
        let regular = (a > 0.0) & (a < f32::INFINITY);
        let root = self.round_f64(odd::rsq_odd(if regular { f64::from(a) } else { 1.0 }));
        let special = if a == 0.0 {
            self.pole(a.to_bits() & SIGN_BIT)
        } else if a > 0.0 {
            0.0
        } else if a < 0.0 {
            self.nan
        } else {
            f32::NAN
        };
        if regular { root } else { special }
    }

    fn exp2(&self, a: f32) -> f32 {
        self.round_f64(power::exp2(f64::from(a)))
    }

    fn log2(&self, a: f32) -> f32 {
        if a < 0.0 {
            self.nan
        } else if a == 0.0 {
            self.pole(SIGN_BIT)
        } else {
            self.round_f64(power::log2(f64::from(a)))
        }
    }

    #[inline(always)]
    fn min(&self, a: f32, b: f32) -> f32 {
        let chosen = if a < b { a } else { b };
        let chosen = if self.nv & (a == b) { f32::from_bits(a.to_bits() | b.to_bits()) } else { chosen };
        if self.nv & (a.is_nan() | b.is_nan()) { f32::NAN } else { chosen }
    }

    #[inline(always)]
    fn max(&self, a: f32, b: f32) -> f32 {
        let chosen = if a >= b { a } else { b };
        let chosen = if self.nv & (a == b) { f32::from_bits(a.to_bits() & b.to_bits()) } else { chosen };
        if self.nv & (a.is_nan() | b.is_nan()) { f32::NAN } else { chosen }
    }

    #[inline(always)]
    fn frc(&self, a: f32) -> f32 {
        // `Lane::floor` is not used: short formats can't hold the floor of their most negative number.
        let a = f64::from(a);
        let b = -a.floor();
        self.round_f64(self.cancel(a, b, odd::add_odd(a, b)))
    }

    #[inline(always)]
    fn neg(&self, a: f32) -> f32 {
        if PATH == GENERAL { (self.zero - f64::from(a)) as f32 } else { -a }
    }

    #[inline(always)]
    fn abs(&self, a: f32) -> f32 {
        a.abs()
    }

    #[inline(always)]
    fn saturate(&self, a: f32) -> f32 {
        let low = if a > 0.0 { a } else { 0.0 };
        let clamped = if low < 1.0 { low } else { 1.0 };
        if self.nv & a.is_nan() { a } else { clamped }
    }

    #[inline(always)]
    fn above_half(&self, a: f32) -> bool {
        a > 0.5
    }

    #[inline(always)]
    fn factor(&self, a: f32, b: f32) -> f32 {
        let finite = (a.abs() < f32::INFINITY) & (b.abs() < f32::INFINITY);
        if ((a == 0.0) | (b == 0.0)) & !finite { 0.0 } else { a }
    }
}
