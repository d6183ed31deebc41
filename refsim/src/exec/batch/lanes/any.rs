//! Which lane arithmetic a format gets.

use super::fixed::FixedLane;
use super::float::{self, ANY, DOUBLE, FloatLane, HOST, HOST_NV, SINGLE};
use super::ieee::{self, IeeeLane};
use super::lane::Lane;
use crate::num::{Format, FormatKind, Overflow, Rounding};

/// The arithmetic of a format: a closed list, so that each member is compiled to vector code of its own. The common
/// formats have their rounding and overflow compiled in; the rest decide at run time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AnyLane {
    Fixed16Even(FixedLane<0, false, 0>),
    Fixed16Away(FixedLane<1, false, 0>),
    Fixed16Zero(FixedLane<2, false, 0>),
    Fixed16Down(FixedLane<3, false, 0>),
    Fixed16Wrap(FixedLane<ANY, false, 1>),
    Fixed32(FixedLane<ANY, true, 2>),
    IeeeHost(IeeeLane<HOST>),
    IeeeSingle(IeeeLane<SINGLE>),
    IeeeDouble(IeeeLane<DOUBLE>),
    Host(FloatLane<HOST, 0>),
    HostNv(FloatLane<HOST_NV, 0>),
    Single(FloatLane<SINGLE, 0>),
    DoubleEven(FloatLane<DOUBLE, 0>),
    Double(FloatLane<DOUBLE, ANY>),
}

impl AnyLane {
    /// The arithmetic of a format.
    pub(crate) fn new(format: Format) -> Self {
        let f = &format;
        match format.kind {
            FormatKind::Fixed { int_bits: i, frac_bits: b } => {
                match (format.width() > 16, format.overflow, format.rounding) {
                    (true, ..) => Self::Fixed32(FixedLane::new(f, i, b)),
                    (_, Overflow::Wrap, _) => Self::Fixed16Wrap(FixedLane::new(f, i, b)),
                    (.., Rounding::NearestEven) => Self::Fixed16Even(FixedLane::new(f, i, b)),
                    (.., Rounding::NearestAway) => Self::Fixed16Away(FixedLane::new(f, i, b)),
                    (.., Rounding::TowardZero) => Self::Fixed16Zero(FixedLane::new(f, i, b)),
                    (.., Rounding::Down) => Self::Fixed16Down(FixedLane::new(f, i, b)),
                }
            }
            FormatKind::Float { exp_bits: x, man_bits: m } => match (ieee::path(f), float::path(f)) {
                (Some(HOST), _) => Self::IeeeHost(IeeeLane::new(f, x, m)),
                (Some(SINGLE), _) => Self::IeeeSingle(IeeeLane::new(f, x, m)),
                (Some(_), _) => Self::IeeeDouble(IeeeLane::new(f, x, m)),
                (_, HOST) => Self::Host(FloatLane::new(f, x, m)),
                (_, HOST_NV) => Self::HostNv(FloatLane::new(f, x, m)),
                (_, SINGLE) => Self::Single(FloatLane::new(f, x, m)),
                _ if format.rounding == Rounding::NearestEven => Self::DoubleEven(FloatLane::new(f, x, m)),
                _ => Self::Double(FloatLane::new(f, x, m)),
            },
        }
    }
}

/// Runs a block with the arithmetic of an [`AnyLane`], once compiled for each.
macro_rules! with_any_lane {
    ($any:expr, |$lane:ident| $body:block) => {
        match $any {
            $crate::exec::batch::lanes::AnyLane::Fixed16Even($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Fixed16Away($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Fixed16Zero($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Fixed16Down($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Fixed16Wrap($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Fixed32($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::IeeeHost($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::IeeeSingle($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::IeeeDouble($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Host($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::HostNv($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Single($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::DoubleEven($lane) => $body,
            $crate::exec::batch::lanes::AnyLane::Double($lane) => $body,
        }
    };
}
pub(crate) use with_any_lane;

impl AnyLane {
    /// A bit pattern of the format as a slot holds it.
    pub(crate) fn decode(&self, bits: u32) -> u32 {
        fn decode<L: Lane>(lane: &L, bits: u32) -> u32 {
            L::store(lane.decode(bits))
        }
        with_any_lane!(self, |lane| { decode(lane, bits) })
    }

    /// The bit pattern of what a slot holds.
    pub(crate) fn encode(&self, raw: u32) -> u32 {
        fn encode<L: Lane>(lane: &L, raw: u32) -> u32 {
            lane.encode(L::load(raw))
        }
        with_any_lane!(self, |lane| { encode(lane, raw) })
    }
}
