//! Blending of targets in rows: fixed-point channels of equal width in integers, floats in single precision. Signed
//! channels and channels of different widths are blended by [`crate::output`].

use std::ops::Sub;

use refsim_lanes::AnyLane;

use crate::exec::batch::formats::LaneFormats;
use crate::exec::lower::Arith;
use crate::output::{BlendEquation, BlendFactor, BlendOp, BlendState};
use crate::texture::{ChannelClass, ComponentSource, TargetRounding, TexelFormat};

/// Maximum channel width: products with the square of the range fit in 64-bit integers.
const WIDEST: u8 = 16;

/// Position of a channel that is written: word and shift in the texel, and color component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChannelPlace {
    pub(crate) word: usize,
    pub(crate) shift: u32,
    pub(crate) component: usize,
}

#[derive(Clone, Debug)]
pub(crate) struct Blender {
    state: BlendState,
    values: BlendValues,
    /// Sources of the four components of a stored texel.
    components: [StoredComponent; 4],
}

#[derive(Clone, Debug)]
enum BlendValues {
    /// Fixed point with this denominator; `true` if results are rounded to nearest, halves up, else truncated.
    Steps(i64, bool),
    /// Floats of a format.
    Floats(Box<AnyLane>),
}

#[derive(Clone, Copy, Debug)]
enum StoredComponent {
    Zero,
    One,
    /// Word, shift, mask.
    Channel(usize, u32, u32),
}

impl Blender {
    /// Creates a blender; `None` if only [`crate::output`] can blend.
    pub(crate) fn new(format: TexelFormat, state: &BlendState, rounding: TargetRounding) -> Option<Self> {
        let record = format.record();
        let first = record.stored().first()?;
        let like_first = |c: &crate::texture::Channel| c.class == first.class && c.bits == first.bits;
        if !record.stored().iter().all(like_first) {
            return None;
        }
        let mask = u32::MAX >> (32 - first.bits);
        let values = match first.class {
            ChannelClass::Unorm if first.bits <= WIDEST => {
                BlendValues::Steps(mask.into(), rounding == TargetRounding::Nearest)
            }
            ChannelClass::Float(format) => BlendValues::Floats(Box::new(AnyLane::new(format))),
            _ => return None,
        };
        let components = record.components.map(|source| match source {
            ComponentSource::Zero => StoredComponent::Zero,
            ComponentSource::One => StoredComponent::One,
            ComponentSource::Channel(i) => {
                let shift = record.channels[usize::from(i)].shift;
                StoredComponent::Channel(usize::from(shift / 32), u32::from(shift % 32), mask)
            }
        });
        Some(Self { state: *state, values, components })
    }

    /// Blends a raw colour over a texel; returns the words of the texel, in which all bits outside the written channels
    /// are zero.
    pub(crate) fn blend(
        &self,
        color: &[u32; 4],
        old: [u32; 4],
        channels: impl Iterator<Item = ChannelPlace>,
        formats: &LaneFormats,
    ) -> [u32; 4] {
        let main = formats.lane(Arith::Main).reading();
        let mut new = [0; 4];
        let mut put = |channel: ChannelPlace, bits: u32| new[channel.word] |= bits << channel.shift;
        let stored = |zero: u32, one: u32| {
            self.components.map(|component| match component {
                StoredComponent::Zero => zero,
                StoredComponent::One => one,
                StoredComponent::Channel(word, shift, mask) => old[word] >> shift & mask,
            })
        };
        match &self.values {
            BlendValues::Steps(one, nearest) => {
                let half = if *nearest { 0.5 } else { 0.0 };
                let source = color.map(|raw| main.to_steps(raw, *one as f64, half).into());
                let destination = stored(0, *one as u32).map(i64::from);
                for channel in channels {
                    let code = self.steps((*one, *nearest), source, destination, channel.component);
                    put(channel, code);
                }
            }
            BlendValues::Floats(lane) => {
                let source = color.map(|raw| main.to_f64(raw) as f32);
                // The pattern of 0 is 0 in every format; the pattern of 1 depends on the format.
                let encoded = |value: f64| lane.encode(lane.round(value));
                let destination = stored(0, encoded(1.0)).map(|bits| f32::from_bits(lane.decode(bits)));
                for channel in channels {
                    let value = f64::from(self.floats(source, destination, channel.component));
                    put(channel, encoded(value));
                }
            }
        }
        new
    }

    fn equation(&self, component: usize) -> &BlendEquation {
        if component == 3 { &self.state.alpha } else { &self.state.color }
    }

    /// Blends in units of `1 / one`; over the common denominator `one^2` every step is exact.
    fn steps(&self, (one, nearest): (i64, bool), source: [i64; 4], destination: [i64; 4], component: usize) -> u32 {
        let equation = self.equation(component);
        let (s, d) = (source[component], destination[component]);
        let term = |value: i64, by| value * factor(by, source, destination, component, [0, one]);
        let (from, to) = (term(s, equation.source), term(d, equation.destination));
        let squares = match equation.op {
            BlendOp::Add => from + to,
            BlendOp::Subtract => from - to,
            BlendOp::ReverseSubtract => to - from,
            BlendOp::Min => return s.min(d) as u32,
            BlendOp::Max => return s.max(d) as u32,
        };
        let half = if nearest { one } else { 0 };
        ((2 * squares.clamp(0, one * one) + half) / (2 * one)) as u32
    }

    /// Blends in single precision. A factor of 0 removes its term.
    fn floats(&self, source: [f32; 4], destination: [f32; 4], component: usize) -> f32 {
        let equation = self.equation(component);
        let (s, d) = (source[component], destination[component]);
        match equation.op {
            BlendOp::Min => return if d < s { d } else { s },
            BlendOp::Max => return if s < d { d } else { s },
            BlendOp::Add | BlendOp::Subtract | BlendOp::ReverseSubtract => {}
        }
        let term = |value: f32, by| {
            (by != BlendFactor::Zero).then(|| value * factor(by, source, destination, component, [0.0, 1.0]))
        };
        match (equation.op, term(s, equation.source), term(d, equation.destination)) {
            (BlendOp::Subtract, Some(s), Some(d)) => s - d,
            (BlendOp::Subtract, None, Some(d)) => 0.0 - d,
            (BlendOp::ReverseSubtract, Some(s), Some(d)) => d - s,
            (BlendOp::ReverseSubtract, Some(s), None) => 0.0 - s,
            (_, Some(s), Some(d)) => s + d,
            (_, Some(one), None) | (_, None, Some(one)) => one,
            (_, None, None) => 0.0,
        }
    }
}

fn factor<T: Copy + PartialOrd + Sub<Output = T>>(
    factor: BlendFactor,
    source: [T; 4],
    destination: [T; 4],
    component: usize,
    [zero, one]: [T; 2],
) -> T {
    match factor {
        BlendFactor::Zero => zero,
        BlendFactor::One => one,
        BlendFactor::SrcColor => source[component],
        BlendFactor::InvSrcColor => one - source[component],
        BlendFactor::SrcAlpha => source[3],
        BlendFactor::InvSrcAlpha => one - source[3],
        BlendFactor::DestAlpha => destination[3],
        BlendFactor::InvDestAlpha => one - destination[3],
        BlendFactor::DestColor => destination[component],
        BlendFactor::InvDestColor => one - destination[component],
        BlendFactor::SrcAlphaSat if component == 3 => one,
        BlendFactor::SrcAlphaSat => {
            let free = one - destination[3];
            if free < source[3] { free } else { source[3] }
        }
    }
}
