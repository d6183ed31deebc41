//! Lane arithmetic of the floats with IEEE 754's rules: nearest even, gradual underflow, infinities. One host
//! operation, then one rounding without branches or comparisons.

use super::float::{FloatLane, GeneralLane};
use super::lane::Lane;
use super::layout::pow2;
use super::odd;
use super::reading::Reading;
use super::round::EVEN;
use crate::num::{Denormals, Format, Overflow, Rounding, Specials};

pub(crate) use super::float::{DOUBLE, HOST, SINGLE};

/// The arithmetic of an IEEE format. `PATH` selects the host format in which operations are computed before the
/// rounding:
///
/// - [`HOST`]: in `f32`, which is the format itself, so there is no second rounding.
/// - [`SINGLE`]: in `f32`, for formats of at most 11 significant bits and 6 exponent bits (see [`SINGLE`]).
/// - [`DOUBLE`]: in `f64`, for all other formats.
///
/// Rounding twice is innocuous in all three. Let the format have `p` significant bits and the host `q`. Products have
/// `2p <= q` bits: they are exact. Sums: `q >= 2p + 2` (Figueroa 1995). Quotients: a rounding depends on how the
/// quotient compares with numbers `k u`, `k < 2^(p+1)`, which are numbers of the format or midpoints. A quotient `A/B`
/// of integers below `2^p` that differs from `k u` does so by at least one part in `k B < 2^(2p+1) < 2^q`, so the
/// host's quotient compares with it in the same way. The host never overflows or underflows where the format doesn't:
/// its range of exponents is at least as large.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IeeeLane<const PATH: u8> {
    /// General, slower arithmetic, for conversions and rare cases.
    general: FloatLane<DOUBLE, EVEN>,
    /// Host bits of the smallest normal number; as integers they compare faster than as floats.
    lowest: (u32, u64),
    /// Bit pattern of the pivot minus that of the binade's power of two, as integers. The pivot is 1.5 times the number
    /// whose last place is the format's unit.
    pivot: (u32, u64),
    /// Factor by which exactly the numbers above the format's largest overflow to infinity; `shrink` is its reciprocal.
    stretch: (f32, f64),
    shrink: (f32, f64),
}

/// Returns `true` if a float format follows IEEE 754 in rounding, overflow, denormals and special values.
pub(crate) fn is_plain(format: &Format) -> bool {
    matches!(format.overflow, Overflow::Infinity | Overflow::Wrap)
        && format.rounding == Rounding::NearestEven
        && format.denormals != Denormals::Flush
        && format.specials != Specials::Nv
}

impl<const PATH: u8> IeeeLane<PATH> {
    /// Creates the arithmetic of a format for which [`super::float::path`] returns `PATH`.
    pub(crate) fn new(format: &Format, exp_bits: u8, man_bits: u8) -> Self {
        let m = u32::from(man_bits);
        let emax = (1 << (exp_bits - 1)) - 1;
        let lowest = pow2(1 - emax);
        let stretch = (pow2(127 - emax) as f32, pow2(1023 - emax));
        Self {
            general: FloatLane::new(format, exp_bits, man_bits),
            lowest: ((lowest as f32).to_bits(), lowest.to_bits()),
            pivot: ((23 - m) << 23 | 1 << 22, u64::from(52 - m) << 52 | 1 << 51),
            stretch,
            shrink: (1.0 / stretch.0, 1.0 / stretch.1),
        }
    }

    /// Rounds a single precision number into the format.
    ///
    /// A pivot, 1.5 times `2^(23-m)` times the binade, is added and subtracted: the sum stays in one binade for either
    /// sign, and its last place is the format's unit. A zero has the sign of the number that became zero. Infinities
    /// and NaN are unchanged, because their pivot is a finite number.
    #[inline(always)]
    fn narrow_single(&self, x: f32) -> f32 {
        let bits = x.to_bits();
        let exponent = (bits & 0x7f80_0000).max(self.lowest.0);
        let pivot = f32::from_bits(exponent.wrapping_add(self.pivot.0));
        let near = (x + pivot) - pivot;
        let signed = f32::from_bits(near.to_bits() | bits & 0x8000_0000);
        (signed * self.stretch.0) * self.shrink.0
    }

    /// [`Self::narrow_single`] for a double.
    #[inline(always)]
    fn narrow_double(&self, x: f64) -> f64 {
        let bits = x.to_bits();
        let exponent = (bits & 0x7ff0_0000_0000_0000).max(self.lowest.1);
        let pivot = f64::from_bits(exponent.wrapping_add(self.pivot.1));
        let near = (x + pivot) - pivot;
        let signed = f64::from_bits(near.to_bits() | bits & odd::SIGN);
        (signed * self.stretch.1) * self.shrink.1
    }
}

impl<const PATH: u8> Lane for IeeeLane<PATH> {
    type T = f32;
    type General = GeneralLane;

    #[inline(always)]
    fn decode(&self, bits: u32) -> f32 {
        self.general.decode(bits)
    }

    #[inline(always)]
    fn encode(&self, x: f32) -> u32 {
        self.general.encode(x)
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
        if PATH == HOST { x as f32 } else { self.narrow_double(x) as f32 }
    }

    #[inline(always)]
    fn round_single(&self, x: f32) -> f32 {
        if PATH == HOST { x } else { self.round_f64(f64::from(x)) }
    }

    fn general(&self) -> Option<GeneralLane> {
        self.general.general()
    }

    #[inline(always)]
    fn add(&self, a: f32, b: f32) -> f32 {
        match PATH {
            HOST => a + b,
            SINGLE => self.narrow_single(a + b),
            _ => self.narrow_double(f64::from(a) + f64::from(b)) as f32,
        }
    }

    #[inline(always)]
    fn mul(&self, a: f32, b: f32) -> f32 {
        match PATH {
            HOST => a * b,
            SINGLE => self.narrow_single(a * b),
            _ => self.narrow_double(f64::from(a) * f64::from(b)) as f32,
        }
    }

    #[inline(always)]
    fn sum<const N: usize>(&self, a: [f32; N], b: [f32; N]) -> f32 {
        if PATH != DOUBLE {
            let mut sum = self.mul(a[0], b[0]);
            for k in 1..N {
                sum = self.add(sum, self.mul(a[k], b[k]));
            }
            return sum;
        }
        let product = |k: usize| self.narrow_double(f64::from(a[k]) * f64::from(b[k]));
        let mut sum = product(0);
        for k in 1..N {
            sum = self.narrow_double(sum + product(k));
        }
        sum as f32
    }

    #[inline(always)]
    fn fused_mad(&self, a: f32, b: f32, c: f32) -> f32 {
        self.round_f64(odd::add_odd(f64::from(a) * f64::from(b), f64::from(c)))
    }

    #[inline(always)]
    fn exact_dot<const N: usize>(&self, a: [f32; N], b: [f32; N]) -> f32 {
        self.general.exact_dot(a, b)
    }

    #[inline(always)]
    fn div(&self, a: f32, b: f32) -> f32 {
        match PATH {
            HOST => a / b,
            SINGLE => self.narrow_single(a / b),
            _ => self.narrow_double(f64::from(a) / f64::from(b)) as f32,
        }
    }

    #[inline(always)]
    fn sqrt(&self, a: f32) -> f32 {
        if PATH == HOST { a.sqrt() } else { self.general.sqrt(a) }
    }

    #[inline(always)]
    fn rcp(&self, a: f32) -> f32 {
        self.div(1.0, a)
    }

    #[inline(always)]
    fn rsq(&self, a: f32) -> f32 {
        self.general.rsq(a)
    }

    fn exp2(&self, a: f32) -> f32 {
        self.general.exp2(a)
    }

    fn log2(&self, a: f32) -> f32 {
        self.general.log2(a)
    }

    #[inline(always)]
    fn min(&self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }

    #[inline(always)]
    fn max(&self, a: f32, b: f32) -> f32 {
        if a >= b { a } else { b }
    }

    #[inline(always)]
    fn frc(&self, a: f32) -> f32 {
        let a = f64::from(a);
        self.round_f64(odd::add_odd(a, -a.floor()))
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
    fn saturate(&self, a: f32) -> f32 {
        let low = if a > 0.0 { a } else { 0.0 };
        if low < 1.0 { low } else { 1.0 }
    }

    #[inline(always)]
    fn above_half(&self, a: f32) -> bool {
        a > 0.5
    }

    #[inline(always)]
    fn factor(&self, a: f32, b: f32) -> f32 {
        self.general.factor(a, b)
    }
}
