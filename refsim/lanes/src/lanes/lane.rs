//! Interface of the arithmetic of a number format, in which the tile interpreter runs programs.

use std::fmt::Debug;

use super::layout::pow2;
use super::reading::Reading;
use crate::num::NumberOperation;

/// Representation of a number in registers: an integer or a float of the host.
pub(crate) trait RegisterNumber: Copy + Default + Send + Sync + Debug + PartialOrd {
    fn from_bits(bits: u32) -> Self;
    /// The host bits of a number.
    fn to_bits(self) -> u32;
}

impl RegisterNumber for f32 {
    #[inline(always)]
    fn from_bits(bits: u32) -> f32 {
        f32::from_bits(bits)
    }

    #[inline(always)]
    fn to_bits(self) -> u32 {
        f32::to_bits(self)
    }
}

impl RegisterNumber for i32 {
    #[inline(always)]
    fn from_bits(bits: u32) -> i32 {
        bits.cast_signed()
    }

    #[inline(always)]
    fn to_bits(self) -> u32 {
        self.cast_unsigned()
    }
}

/// The arithmetic of one number format on single lanes: exact results, rounded once, as `refsim::num` defines them.
///
/// No code is shared with `num`, so that agreement between the two is evidence. Methods that matter for speed have no
/// data-dependent branches, so that the compiler vectorizes plain loops over fixed arrays.
///
/// Registers hold `T`: the number itself, as a host integer or a host float that represents every value of the format.
/// Bit patterns are made only when a value leaves the executor ([`Lane::encode`]); all NaN are one value here.
pub(crate) trait Lane: Copy + Send + Sync {
    type T: RegisterNumber;
    /// Type of [`Lane::general`].
    type General: Lane;

    fn decode(&self, bits: u32) -> Self::T;
    /// Encodes a number as a bit pattern; NaN becomes the canonical NaN.
    fn encode(&self, x: Self::T) -> u32;
    /// The number that a slot holds.
    #[inline(always)]
    fn load(raw: u32) -> Self::T {
        Self::T::from_bits(raw)
    }
    /// Converts a number to a slot's bits: its host bits, in any format.
    #[inline(always)]
    fn store(x: Self::T) -> u32 {
        x.to_bits()
    }
    /// Converts a number to a double: exact, except that a number of a normalized format is rounded to nearest.
    fn to_f64(&self, x: Self::T) -> f64;
    /// Rounds a double into the format. The double is exact, or rounded to odd (see [`super::odd`]), or a result of
    /// [`Lane::to_f64`].
    fn round_f64(&self, x: f64) -> Self::T;
    #[inline(always)]
    fn round_single(&self, x: f32) -> Self::T {
        self.round_f64(f64::from(x))
    }
    /// Interpretation of a slot's bits as a number.
    fn reading(&self) -> Reading;

    /// True for units of cards, whose rows have separate loops.
    const CARD: bool = false;

    /// False if vector instructions do not make the arithmetic faster.
    const VECTORS: bool = true;

    /// True if [`Lane::is_guarded`] can return true.
    const GUARDED: bool = false;
    /// Returns `true` if finite results of this arithmetic are correct and others may be wrong; [`Lane::general`]
    /// recomputes these.
    #[inline(always)]
    fn is_guarded(&self) -> bool {
        false
    }
    /// The arithmetic that is always correct, for formats that have infinities and NaN.
    fn general(&self) -> Option<Self::General> {
        None
    }

    fn add(&self, a: Self::T, b: Self::T) -> Self::T;
    #[inline(always)]
    fn sub(&self, a: Self::T, b: Self::T) -> Self::T {
        self.add(a, self.neg(b))
    }
    fn mul(&self, a: Self::T, b: Self::T) -> Self::T;
    /// Products added in order, each product and each sum rounded; `N` at least 1.
    #[inline(always)]
    fn sum<const N: usize>(&self, a: [Self::T; N], b: [Self::T; N]) -> Self::T {
        let mut sum = self.mul(a[0], b[0]);
        for k in 1..N {
            sum = self.add(sum, self.mul(a[k], b[k]));
        }
        sum
    }
    /// True if [`Lane::is_fused`] can return true.
    const FUSED: bool = false;
    /// Returns `true` if [`Lane::fused_sum`] and [`Lane::fused_div`] equal [`Lane::sum`] and [`Lane::div`], in fewer
    /// instructions on a host with fused multiply-add.
    #[inline(always)]
    fn is_fused(&self) -> bool {
        false
    }
    /// [`Lane::sum`], if [`Lane::is_fused`].
    #[inline(always)]
    fn fused_sum<const N: usize>(&self, a: [Self::T; N], b: [Self::T; N]) -> Self::T {
        self.sum(a, b)
    }
    /// [`Lane::div`], if [`Lane::is_fused`].
    #[inline(always)]
    fn fused_div(&self, a: Self::T, b: Self::T) -> Self::T {
        self.div(a, b)
    }
    /// `a b + c`, rounded once.
    fn fused_mad(&self, a: Self::T, b: Self::T, c: Self::T) -> Self::T;
    /// The sum of `N` products, rounded once.
    fn exact_dot<const N: usize>(&self, a: [Self::T; N], b: [Self::T; N]) -> Self::T;
    fn div(&self, a: Self::T, b: Self::T) -> Self::T;
    fn sqrt(&self, a: Self::T) -> Self::T;
    fn rcp(&self, a: Self::T) -> Self::T;
    /// `1 / sqrt(a)`
    fn rsq(&self, a: Self::T) -> Self::T;
    /// `2^a`
    fn exp2(&self, a: Self::T) -> Self::T;
    /// The logarithm of `a` to base 2.
    fn log2(&self, a: Self::T) -> Self::T;

    fn min(&self, a: Self::T, b: Self::T) -> Self::T;
    fn max(&self, a: Self::T, b: Self::T) -> Self::T;
    /// The largest integer not above `a`.
    #[inline(always)]
    fn floor(&self, a: Self::T) -> Self::T {
        self.round_f64(self.to_f64(a).floor())
    }
    /// `a - floor(a)`
    fn frc(&self, a: Self::T) -> Self::T;
    fn neg(&self, a: Self::T) -> Self::T;
    fn abs(&self, a: Self::T) -> Self::T;
    /// `a 2^shift`, with `shift` from -3 to 3.
    #[inline(always)]
    fn scale(&self, a: Self::T, shift: i32) -> Self::T {
        self.round_f64(self.to_f64(a) * pow2(shift))
    }
    /// `a` clamped to [0, 1].
    fn saturate(&self, a: Self::T) -> Self::T;
    /// `a > 1/2` with an exact 1/2; false for NaN.
    fn above_half(&self, a: Self::T) -> bool;
    /// `a`, or 0 where one of `a`, `b` is zero and the other isn't finite; `a` if the format has no infinity.
    #[inline(always)]
    fn factor(&self, a: Self::T, _: Self::T) -> Self::T {
        a
    }
}

/// Returns `true` if the float in a slot is neither infinite nor NaN.
#[inline(always)]
pub(crate) fn is_finite(raw: u32) -> bool {
    raw & 0x7fff_ffff < 0x7f80_0000
}

pub(crate) fn apply<L: Lane>(lane: &L, operation: NumberOperation, [a, b, c]: [L::T; 3]) -> Option<L::T> {
    use NumberOperation as Op;
    Some(match operation {
        Op::Add => lane.add(a, b),
        Op::Sub => lane.sub(a, b),
        Op::Mul => lane.mul(a, b),
        Op::Mad => lane.add(lane.mul(a, b), c),
        Op::FusedMad => lane.fused_mad(a, b, c),
        Op::Div => lane.div(a, b),
        Op::Sqrt => lane.sqrt(a),
        Op::Rcp => lane.rcp(a),
        Op::Rsq => lane.rsq(a),
        Op::Exp2 => lane.exp2(a),
        Op::Log2 => lane.log2(a),
        Op::Min => lane.min(a, b),
        Op::Max => lane.max(a, b),
        Op::Floor => lane.floor(a),
        Op::Frc => lane.frc(a),
        Op::Neg => lane.neg(a),
        Op::Abs => lane.abs(a),
        Op::Saturate => lane.saturate(a),
        _ => return None,
    })
}
