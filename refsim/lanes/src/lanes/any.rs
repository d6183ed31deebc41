//! Selects the lane arithmetic of a format.

use super::fixed::FixedLane;
use super::float::{self, ANY, DOUBLE, FloatLane, GENERAL, HOST, SINGLE};
use super::ieee::{self, IeeeLane};
use super::lane::Lane;
use super::normalized::NormalizedLane;
use super::reading::Reading;
use super::round::{AWAY, DOWN, EVEN, ZERO};
use super::row::{LANES, LaneRow};
use super::simd::SimdLevel;
use super::unit::{CardLane, Gt200, Nv};
use crate::num::{Format, FormatKind, Overflow, Rounding, Unit};

/// Defines `Arithmetic`, and `with_any_lane`, which runs a block with the arithmetic of an [`AnyLane`]. The block is
/// compiled once per arithmetic. `$d` is a dollar sign, for the parameters of the inner macro.
macro_rules! arithmetics {
    ($d:tt, $($format:ident($lane:ty),)+) => {
        /// An enum, so that each arithmetic is compiled to its own vector code. Roundings of floats are compiled in;
        /// roundings of fixed point, and all other rules, are constants in registers.
        #[derive(Clone, Copy, Debug)]
        pub(crate) enum Arithmetic {
            $($format($lane),)+
        }

        macro_rules! with_any_lane {
            ($d any:expr, |$d lane:ident| $d body:block) => {
                match $d any.arithmetic() {
                    $($crate::lanes::Arithmetic::$format($d lane) => $d body,)+
                }
            };
        }
    };
}

arithmetics! {
    $,
    Fixed16(FixedLane<false, false>),
    Fixed16Wrap(FixedLane<false, true>),
    Fixed32(FixedLane<true, false>),
    Fixed32Wrap(FixedLane<true, true>),
    Normalized(NormalizedLane<false>),
    NormalizedWrap(NormalizedLane<true>),
    IeeeHost(IeeeLane<HOST>),
    IeeeSingle(IeeeLane<SINGLE>),
    IeeeDouble(IeeeLane<DOUBLE>),
    HostEven(FloatLane<HOST, EVEN>),
    HostAway(FloatLane<HOST, AWAY>),
    HostZero(FloatLane<HOST, ZERO>),
    HostDown(FloatLane<HOST, DOWN>),
    SingleEven(FloatLane<SINGLE, EVEN>),
    SingleAway(FloatLane<SINGLE, AWAY>),
    SingleZero(FloatLane<SINGLE, ZERO>),
    SingleDown(FloatLane<SINGLE, DOWN>),
    DoubleEven(FloatLane<DOUBLE, EVEN>),
    DoubleAway(FloatLane<DOUBLE, AWAY>),
    DoubleZero(FloatLane<DOUBLE, ZERO>),
    DoubleDown(FloatLane<DOUBLE, DOWN>),
    General(FloatLane<GENERAL, ANY>),
    Nv(CardLane<Nv>),
    Gt200(CardLane<Gt200>),
}
#[expect(clippy::single_component_path_imports, reason = "the path of a macro that a macro defines")]
pub(crate) use with_any_lane;

impl Arithmetic {
    fn new(format: Format) -> Self {
        use Rounding::{Down, NearestAway, NearestEven, TowardZero};
        let f = &format;
        match format.unit {
            Unit::Ideal => {}
            Unit::Nv2x | Unit::Nv3xLegacy | Unit::Nv3x => return Self::Nv(CardLane::new(f)),
            Unit::Gt200 | Unit::Gt200ZeroWins => return Self::Gt200(CardLane::new(f)),
        }
        match format.kind {
            FormatKind::Fixed { int_bits: i, frac_bits: b } => {
                match (format.width() > 16, format.overflow == Overflow::Wrap) {
                    (false, false) => Self::Fixed16(FixedLane::new(f, i, b)),
                    (false, true) => Self::Fixed16Wrap(FixedLane::new(f, i, b)),
                    (true, false) => Self::Fixed32(FixedLane::new(f, i, b)),
                    (true, true) => Self::Fixed32Wrap(FixedLane::new(f, i, b)),
                }
            }
            FormatKind::Normalized { int_bits: i, frac_bits: b } => match format.overflow {
                Overflow::Wrap => Self::NormalizedWrap(NormalizedLane::new(f, i, b)),
                _ => Self::Normalized(NormalizedLane::new(f, i, b)),
            },
            FormatKind::Float { exp_bits: x, man_bits: m } => match (float::path(f, x, m), format.rounding) {
                (HOST, _) if ieee::is_plain(f) => Self::IeeeHost(IeeeLane::new(f, x, m)),
                (SINGLE, _) if ieee::is_plain(f) => Self::IeeeSingle(IeeeLane::new(f, x, m)),
                (DOUBLE, _) if ieee::is_plain(f) => Self::IeeeDouble(IeeeLane::new(f, x, m)),
                (HOST, NearestEven) => Self::HostEven(FloatLane::new(f, x, m)),
                (HOST, NearestAway) => Self::HostAway(FloatLane::new(f, x, m)),
                (HOST, TowardZero) => Self::HostZero(FloatLane::new(f, x, m)),
                (HOST, Down) => Self::HostDown(FloatLane::new(f, x, m)),
                (SINGLE, NearestEven) => Self::SingleEven(FloatLane::new(f, x, m)),
                (SINGLE, NearestAway) => Self::SingleAway(FloatLane::new(f, x, m)),
                (SINGLE, TowardZero) => Self::SingleZero(FloatLane::new(f, x, m)),
                (SINGLE, Down) => Self::SingleDown(FloatLane::new(f, x, m)),
                (DOUBLE, NearestEven) => Self::DoubleEven(FloatLane::new(f, x, m)),
                (DOUBLE, NearestAway) => Self::DoubleAway(FloatLane::new(f, x, m)),
                (DOUBLE, TowardZero) => Self::DoubleZero(FloatLane::new(f, x, m)),
                (DOUBLE, Down) => Self::DoubleDown(FloatLane::new(f, x, m)),
                _ => Self::General(FloatLane::new(f, x, m)),
            },
        }
    }
}

/// The arithmetic of a format.
#[derive(Clone, Copy, Debug)]
pub struct AnyLane(Arithmetic);

impl AnyLane {
    /// The arithmetic of a format that registers can have ([`Format::for_registers`]).
    pub fn new(format: Format) -> Self {
        Self(Arithmetic::new(format))
    }

    #[inline(always)]
    pub(crate) fn arithmetic(&self) -> &Arithmetic {
        &self.0
    }

    /// Converts a bit pattern of the format into a slot's bits.
    pub fn decode(&self, bits: u32) -> u32 {
        fn decode<L: Lane>(lane: &L, bits: u32) -> u32 {
            L::store(lane.decode(bits))
        }
        with_any_lane!(self, |lane| { decode(lane, bits) })
    }

    /// Encodes the number in a slot as a bit pattern; NaN becomes the canonical NaN.
    pub fn encode(&self, raw: u32) -> u32 {
        fn encode<L: Lane>(lane: &L, raw: u32) -> u32 {
            lane.encode(L::load(raw))
        }
        with_any_lane!(self, |lane| { encode(lane, raw) })
    }

    /// Rounds a double, exact or rounded to odd, into the format; returns the slot's bits.
    pub fn round(&self, x: f64) -> u32 {
        fn round<L: Lane>(lane: &L, x: f64) -> u32 {
            L::store(lane.round_f64(x))
        }
        with_any_lane!(self, |lane| { round(lane, x) })
    }

    /// Clamps the number in a slot to [0, 1].
    pub fn saturate(&self, raw: u32) -> u32 {
        fn saturate<L: Lane>(lane: &L, raw: u32) -> u32 {
            L::store(lane.saturate(L::load(raw)))
        }
        with_any_lane!(self, |lane| { saturate(lane, raw) })
    }

    /// Interpretation of a slot's bits as a number.
    pub fn reading(&self) -> Reading {
        with_any_lane!(self, |lane| { lane.reading() })
    }

    /// [`Self::round`] for a row.
    pub fn round_row(&self, simd: SimdLevel, values: &[f64; LANES], out: &mut LaneRow) {
        #[inline(never)]
        fn round<L: Lane>(lane: &L, simd: SimdLevel, values: &[f64; LANES], out: &mut LaneRow) {
            simd.run(
                #[inline(always)]
                || narrow(lane, values, out),
            );
        }
        with_any_lane!(self, |lane| { round(lane, simd, values, out) });
    }

    /// Rounds a row of singles, given as their bits.
    pub fn round_singles(&self, simd: SimdLevel, values: &LaneRow, out: &mut LaneRow) {
        #[inline(never)]
        fn round<L: Lane>(lane: &L, simd: SimdLevel, values: &LaneRow, out: &mut LaneRow) {
            simd.run(
                #[inline(always)]
                || narrow_singles(lane, values, out),
            );
        }
        with_any_lane!(self, |lane| { round(lane, simd, values, out) });
    }
}

#[inline(always)]
pub(crate) fn narrow<L: Lane>(lane: &L, values: &[f64; LANES], out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = L::store(lane.round_f64(values[i]));
    }
}

#[inline(always)]
fn narrow_singles<L: Lane>(lane: &L, values: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = L::store(lane.round_single(f32::from_bits(values[i])));
    }
}
