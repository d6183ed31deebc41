//! Lane arithmetic of the binary floats `eXmY`: all of them live in a host `f32`, which holds each of their values.

use super::lane::Lane;
use super::odd::SIGN;
use super::{odd, power};
use crate::exec::lower::{FloatLayout, pow2};
use crate::num::{Denormals, Format, FormatKind, Overflow, Rounding, Specials};

/// Host `f32` operations are the format's own: binary32, nearest even, IEEE overflow.
pub(crate) const HOST: u8 = 0;
/// Through one `f32` operation and a second rounding, nearest even only.
///
/// Rounding twice is innocuous for `+ - * / sqrt` if the wider format has at least `2p + 2` bits (Figueroa 1995, "When
/// is double rounding innocuous?"): 24 >= 2 * 11 + 2. It stays so where the narrow result is subnormal, because the
/// argument is about the distance between a result and a midpoint of at most `p + 1` bits, and subnormal midpoints have
/// fewer. The wide result must not be subnormal itself: with six exponent bits and ten mantissa bits the smallest
/// product is 2^-80.
pub(crate) const SINGLE: u8 = 1;
/// Through a double, rounded to odd: every format, every rounding.
pub(crate) const DOUBLE: u8 = 2;

/// As [`HOST`], but for what lies between the largest number and `2^128`: NV30's binary32.
pub(crate) const HOST_NV: u8 = 3;

/// Rounding decided at run time.
pub(crate) const ANY: u8 = 4;

/// The arithmetic of one float format. `PATH` is one of [`HOST`], [`SINGLE`], [`DOUBLE`], [`HOST_NV`]; `R` is a
/// [`Rounding`] as a number, or [`ANY`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct FloatLane<const PATH: u8, const R: u8> {
    rounding: u8,
    layout: FloatLayout,
    /// Numbers below this become zero: the smallest normal number under [`Denormals::Flush`], else 0.
    flush: f64,
    /// `2^(52 - m)`: a binade times this is the number to round against.
    magic: f64,
    /// Largest finite number, and what larger ones become, by sign; the same for exact magnitudes of `2^(emax+1)` and
    /// more.
    max: f64,
    over: [f32; 2],
    huge_from: f64,
    huge: [f32; 2],
    /// What `1/0` and `log2 0` give, by sign.
    pole: [f32; 2],
    nv: bool,
}

/// The arithmetic number of a rounding.
pub(crate) fn rounding_index(rounding: Rounding) -> u8 {
    match rounding {
        Rounding::NearestEven => 0,
        Rounding::NearestAway => 1,
        Rounding::TowardZero => 2,
        Rounding::Down => 3,
    }
}

/// The path that fits the format, and the only one that [`FloatLane::new`] may be built with besides [`DOUBLE`].
pub(crate) fn path(format: &Format) -> u8 {
    let FormatKind::Float { exp_bits, man_bits } = format.kind else { return DOUBLE };
    let ieee = matches!(format.overflow, Overflow::Infinity | Overflow::Wrap);
    if format.rounding != Rounding::NearestEven {
        DOUBLE
    } else if (exp_bits, man_bits) == (8, 23) && ieee {
        HOST
    } else if (exp_bits, man_bits) == (8, 23) && format.overflow == Overflow::Nv30 {
        HOST_NV
    } else if exp_bits <= 6 && man_bits <= 10 {
        SINGLE
    } else {
        DOUBLE
    }
}

impl<const PATH: u8, const R: u8> FloatLane<PATH, R> {
    /// The arithmetic of a float format with these bits.
    pub(crate) fn new(format: &Format, exp_bits: u8, man_bits: u8) -> Self {
        let (x, m) = (i32::from(exp_bits), i32::from(man_bits));
        let emax = (1 << (x - 1)) - 1;
        let layout = FloatLayout::new(exp_bits, man_bits, format.denormals);
        let max = pow2(emax) * (2.0 - pow2(-m));
        let (inf, largest) = ([f32::INFINITY, f32::NEG_INFINITY], [max as f32, -max as f32]);
        let (over, huge) = match format.overflow {
            Overflow::Saturate => (largest, largest),
            Overflow::Nv30 => (largest, inf),
            Overflow::Infinity | Overflow::Wrap => {
                let both = match format.rounding {
                    Rounding::NearestEven | Rounding::NearestAway => inf,
                    Rounding::TowardZero => largest,
                    Rounding::Down => [largest[0], inf[1]],
                };
                (both, both)
            }
        };
        FloatLane {
            rounding: rounding_index(format.rounding),
            layout,
            flush: if format.denormals == Denormals::Flush { layout.min_normal } else { 0.0 },
            magic: pow2(52 - m),
            max,
            over,
            huge_from: pow2(emax) * 2.0,
            huge,
            pole: if format.overflow == Overflow::Saturate { largest } else { inf },
            nv: format.specials == Specials::Nv,
        }
    }

    #[inline(always)]
    fn rounding(&self) -> u8 {
        if R == ANY { self.rounding } else { R }
    }

    /// Rounds a double, exact or rounded to odd, into the format; infinities and NaN pass.
    #[inline(always)]
    fn narrow(&self, x: f64) -> f32 {
        let mag = x.abs();
        let negative = x.is_sign_negative();
        let binade = f64::from_bits(mag.to_bits() & 0x7ff0_0000_0000_0000);
        let scale = if binade > self.layout.min_normal { binade } else { self.layout.min_normal };
        // Adding a number whose unit in the last place is the format's there rounds to nearest even.
        let pivot = scale * self.magic;
        let near = (mag + pivot) - pivot;
        let unit = scale * self.layout.unit;
        let kept = match self.rounding() {
            0 => near,
            1 => {
                if mag - near == 0.5 * unit {
                    near + unit
                } else {
                    near
                }
            }
            2 => {
                if near > mag {
                    near - unit
                } else {
                    near
                }
            }
            _ => {
                let (up, down) = (negative & (near < mag), !negative & (near > mag));
                if up {
                    near + unit
                } else if down {
                    near - unit
                } else {
                    near
                }
            }
        };
        let kept = if kept < self.flush { 0.0 } else { kept };
        let too_large = if mag >= self.huge_from { &self.huge } else { &self.over };
        let over = if negative { too_large[1] } else { too_large[0] };
        let signed = if negative { -(kept as f32) } else { kept as f32 };
        let fits = if kept > self.max { over } else { signed };
        if mag < f64::INFINITY { fits } else { x as f32 }
    }

    /// [`FloatLane::narrow`] for [`SINGLE`]: the same rounding against a pivot, in `f32`.
    #[inline(always)]
    fn narrow_single(&self, x: f32) -> f32 {
        let mag = x.abs();
        let binade = f32::from_bits(mag.to_bits() & 0x7f80_0000);
        let min_normal = self.layout.min_normal as f32;
        let scale = if binade > min_normal { binade } else { min_normal };
        let pivot = scale * (self.magic * SINGLE_MAGIC) as f32;
        let near = (mag + pivot) - pivot;
        let kept = if near < self.flush as f32 { 0.0 } else { near };
        let negative = x.is_sign_negative();
        let too_large = if mag >= self.huge_from as f32 { &self.huge } else { &self.over };
        let over = if negative { too_large[1] } else { too_large[0] };
        let signed = if negative { -kept } else { kept };
        let fits = if kept > self.max as f32 { over } else { signed };
        if mag < f32::INFINITY { fits } else { x }
    }

    /// A host result under NV30's overflow: infinite only if the exact one is `2^128` or more. As a double the exact
    /// one is no smaller than that unless it really is: products have 48 bits, and what a sum of two singles lacks to
    /// `2^128` is a multiple of `2^80`.
    #[inline(always)]
    fn below_huge(&self, x: f32, exact: f64) -> f32 {
        let over = if exact < 0.0 { self.over[1] } else { self.over[0] };
        if (x.abs() == f32::INFINITY) & (exact.abs() < self.huge_from) { over } else { x }
    }

    /// Flushes a host result.
    #[inline(always)]
    fn flushed(&self, x: f32) -> f32 {
        if x.abs() < self.flush as f32 { f32::from_bits(x.to_bits() & 0x8000_0000) } else { x }
    }

    /// A pole's value, by sign.
    #[inline(always)]
    fn pole(&self, negative: bool) -> f32 {
        if negative { self.pole[1] } else { self.pole[0] }
    }

    /// The zero that exact cancellation leaves: `-0` when rounding down, `+0` otherwise; the zero of both operands
    /// if they are zeros of one sign.
    #[inline(always)]
    fn cancel(&self, a: f64, b: f64, sum: f64) -> f64 {
        let plus = (a == 0.0) & (b == 0.0) & !a.is_sign_negative() & !b.is_sign_negative();
        if (self.rounding() == 3) & (sum == 0.0) & !plus { -0.0 } else { sum }
    }
}

/// `2^(23-m)` from `2^(52-m)`.
const SINGLE_MAGIC: f64 = 1.0 / 536_870_912.0;

impl<const PATH: u8, const R: u8> Lane for FloatLane<PATH, R> {
    type T = f32;

    #[inline(always)]
    fn decode(&self, bits: u32) -> f32 {
        self.layout.decode(bits)
    }

    #[inline(always)]
    fn encode(&self, x: f32) -> u32 {
        self.layout.encode(x)
    }

    #[inline(always)]
    fn load(raw: u32) -> f32 {
        f32::from_bits(raw)
    }

    #[inline(always)]
    fn store(x: f32) -> u32 {
        x.to_bits()
    }

    #[inline(always)]
    fn to_f64(&self, x: f32) -> f64 {
        f64::from(x)
    }

    #[inline(always)]
    fn round_f64(&self, x: f64) -> f32 {
        if PATH == HOST_NV { self.flushed(self.below_huge(x as f32, x)) } else { self.narrow(x) }
    }

    #[inline(always)]
    fn add(&self, a: f32, b: f32) -> f32 {
        match PATH {
            HOST => self.flushed(a + b),
            HOST_NV => self.flushed(self.below_huge(a + b, f64::from(a) + f64::from(b))),
            SINGLE => self.narrow_single(a + b),
            _ => {
                let (a, b) = (f64::from(a), f64::from(b));
                self.narrow(self.cancel(a, b, odd::add_odd(a, b)))
            }
        }
    }

    #[inline(always)]
    fn sub(&self, a: f32, b: f32) -> f32 {
        self.add(a, -b)
    }

    #[inline(always)]
    fn mul(&self, a: f32, b: f32) -> f32 {
        match PATH {
            HOST => self.flushed(a * b),
            HOST_NV => self.flushed(self.below_huge(a * b, f64::from(a) * f64::from(b))),
            SINGLE => self.narrow_single(a * b),
            // 24 bits times 24 bits: exact.
            _ => self.narrow(f64::from(a) * f64::from(b)),
        }
    }

    #[inline(always)]
    fn fused_mad(&self, a: f32, b: f32, c: f32) -> f32 {
        let (p, c) = (f64::from(a) * f64::from(b), f64::from(c));
        self.narrow(self.cancel(p, c, odd::add_odd(p, c)))
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
        let zero = if all_minus | ((self.rounding() == 3) & !all_plus) { -0.0 } else { 0.0 };
        self.narrow(if sum == 0.0 { zero } else { sum })
    }

    #[inline(always)]
    fn div(&self, a: f32, b: f32) -> f32 {
        if PATH == HOST && self.pole[0] == f32::INFINITY {
            return self.flushed(a / b);
        }
        let quotient = odd::div_odd(f64::from(a), f64::from(b));
        let pole = (b == 0.0) & (a.abs() < f32::INFINITY) & (a != 0.0);
        let negative = a.is_sign_negative() != b.is_sign_negative();
        if pole { self.pole(negative) } else { self.narrow(quotient) }
    }

    #[inline(always)]
    fn sqrt(&self, a: f32) -> f32 {
        if PATH == HOST {
            return a.sqrt();
        }
        self.narrow(odd::sqrt_odd(f64::from(a)))
    }

    #[inline(always)]
    fn rcp(&self, a: f32) -> f32 {
        self.div(1.0, a)
    }

    #[inline(always)]
    fn rsq(&self, a: f32) -> f32 {
        let mag = f64::from(a.abs());
        let regular = (mag > 0.0) & (mag < f64::INFINITY);
        let root = self.narrow(odd::rsq_odd(if regular { mag } else { 1.0 }));
        let zero = self.pole(self.nv & a.is_sign_negative());
        let special = if mag == 0.0 {
            zero
        } else if mag > 0.0 {
            0.0
        } else {
            f32::NAN
        };
        let value = if regular { root } else { special };
        if self.nv & (a < 0.0) { f32::NAN } else { value }
    }

    fn exp2(&self, a: f32) -> f32 {
        self.narrow(power::exp2(f64::from(a)))
    }

    fn log2(&self, a: f32) -> f32 {
        let mag = f64::from(a.abs());
        if self.nv & (a < 0.0) {
            f32::NAN
        } else if mag == 0.0 {
            self.pole(true)
        } else {
            self.narrow(power::log2(mag))
        }
    }

    #[inline(always)]
    fn min(&self, a: f32, b: f32) -> f32 {
        let chosen = if a < b { a } else { b };
        if self.nv & (a.is_nan() | b.is_nan()) { f32::NAN } else { chosen }
    }

    #[inline(always)]
    fn max(&self, a: f32, b: f32) -> f32 {
        let chosen = if a >= b { a } else { b };
        if self.nv & (a.is_nan() | b.is_nan()) { f32::NAN } else { chosen }
    }

    #[inline(always)]
    fn floor(&self, a: f32) -> f32 {
        self.narrow(f64::from(a).floor())
    }

    #[inline(always)]
    fn frc(&self, a: f32) -> f32 {
        // Not through `floor`: short formats can't hold the floor of their most negative number.
        let a = f64::from(a);
        let b = -a.floor();
        self.narrow(self.cancel(a, b, odd::add_odd(a, b)))
    }

    #[inline(always)]
    fn neg(&self, a: f32) -> f32 {
        -a
    }

    #[inline(always)]
    fn abs(&self, a: f32) -> f32 {
        a.abs()
    }

    #[inline(always)]
    fn scale(&self, a: f32, shift: i32) -> f32 {
        self.narrow(f64::from(a) * pow2(shift))
    }

    #[inline(always)]
    fn saturate(&self, a: f32) -> f32 {
        let low = if a > 0.0 { a } else { 0.0 };
        let clamped = if low < 1.0 { low } else { 1.0 };
        if self.nv & a.is_nan() { a } else { clamped }
    }

    #[inline(always)]
    fn lt(&self, a: f32, b: f32) -> bool {
        a < b
    }

    #[inline(always)]
    fn le(&self, a: f32, b: f32) -> bool {
        a <= b
    }

    #[inline(always)]
    fn eq(&self, a: f32, b: f32) -> bool {
        a == b
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
