//! Bitwise comparison of two surfaces, with the size of the differences.

use refsim::{
    num::Format,
    output::{DepthFormat, DepthSurface},
    texture::{Channel, ChannelClass, Image},
};
use serde::Serialize;

use super::number::{Compared, channel_double};

/// Difference of two surfaces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceDifference {
    /// Name: `target 0`, `depth`.
    pub surface: String,
    /// Number of pixels of the surface.
    pub pixels: u64,
    /// Number of pixels with a differing bit.
    pub different: u64,
    /// Largest difference between two numbers, with the first pixel that has it. A difference is infinite if one value
    /// is not finite.
    pub largest: Option<Largest>,
    /// For each pixel, row by row, `true` if it differs.
    #[serde(skip)]
    pub map: Vec<bool>,
}

/// Largest difference of a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Largest {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Absolute difference; infinite if a value is not finite.
    #[serde(serialize_with = "finite_or_text")]
    pub difference: f64,
    /// Both values.
    #[serde(flatten)]
    pub values: Compared,
}

/// Serializes a number that may be infinite or NaN, which JSON lacks.
fn finite_or_text<S: serde::Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if number.is_finite() { serializer.serialize_f64(*number) } else { serializer.serialize_str(&number.to_string()) }
}

const CHANNELS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// Iterates over the channels of two texels that differ: their names, formats and bits.
pub(super) fn differing_channels(
    channels: &[Channel],
    left: u128,
    right: u128,
) -> impl Iterator<Item = (&'static str, Channel, u32, u32)> {
    channels.iter().filter_map(move |&channel| {
        let [left, right] = [left, right].map(|raw| channel.code(raw));
        let name = CHANNELS[usize::from(channel.stored_from & 3)];
        (left != right).then_some((name, channel, left, right))
    })
}

fn distance(left: f64, right: f64) -> f64 {
    if left == right || (left.is_nan() && right.is_nan()) {
        return 0.0;
    }
    let distance = (left - right).abs();
    if distance.is_nan() { f64::INFINITY } else { distance }
}

/// Compares the stored bits of two images at level 0. `None` if size or format differ.
pub fn images(name: &str, left: &Image, right: &Image) -> Option<SurfaceDifference> {
    let (width, height) = (left.width(), left.height());
    if (right.width(), right.height(), right.format()) != (width, height, left.format()) {
        return None;
    }
    let channels = left.format().record().stored();
    Some(surface(name, [width, height], |x, y| {
        let (a, b) = (left.raw(0, 0, y, x), right.raw(0, 0, y, x));
        let farther = |name: &str, channel: Channel, l, r| {
            let apart = distance(channel_double(channel, l), channel_double(channel, r));
            (apart, Compared::channels(name, channel, l, r))
        };
        let all = differing_channels(channels, a, b).map(|(name, channel, l, r)| farther(name, channel, l, r));
        let largest = all.reduce(|most, next| if next.0 > most.0 { next } else { most });
        (a != b, largest)
    }))
}

/// Compares the bits of two depth buffers. `None` if size or format differ.
pub fn depths(name: &str, left: &DepthSurface, right: &DepthSurface) -> Option<SurfaceDifference> {
    let (width, height) = (left.width(), left.height());
    if (right.width(), right.height(), right.format()) != (width, height, left.format()) {
        return None;
    }
    let number = |bits| depth_number(left.format(), bits);
    Some(surface(name, [width, height], |x, y| {
        let (a, b) = (left.get(x, y).unwrap_or_default(), right.get(x, y).unwrap_or_default());
        let apart = || (distance(number(a), number(b)), compared_depths("depth", left.format(), a, b));
        (a != b, (a != b).then(apart))
    }))
}

/// Depth format as a channel of a texel; a 24-bit float is converted to the f32 of equal value.
fn depth_channel(format: DepthFormat) -> Channel {
    let (bits, class) = match format {
        DepthFormat::Unorm16 => (16, ChannelClass::Unorm),
        DepthFormat::Unorm24 => (24, ChannelClass::Unorm),
        DepthFormat::Unorm32 => (32, ChannelClass::Unorm),
        DepthFormat::Float32 | DepthFormat::Float24 => (32, ChannelClass::Float(Format::FP32)),
    };
    Channel { shift: 0, bits, class, stored_from: 0 }
}

fn depth_bits(format: DepthFormat, stored: u32) -> u32 {
    if format == DepthFormat::Float24 { format.to_format(stored, Format::FP32) } else { stored }
}

fn depth_number(format: DepthFormat, stored: u32) -> f64 {
    channel_double(depth_channel(format), depth_bits(format, stored))
}

/// Pair of depth-buffer values.
pub(super) fn compared_depths(name: &str, format: DepthFormat, left: u32, right: u32) -> Compared {
    let bits = |stored| depth_bits(format, stored);
    let mut compared = Compared::channels(name, depth_channel(format), bits(left), bits(right));
    compared.unit = format.name().to_owned();
    // Bit patterns of a depth format are ordered like the depths.
    compared.ulps = Some(f64::from(left.abs_diff(right)));
    if format == DepthFormat::Float24 {
        (compared.left_bits, compared.right_bits) = (format!("0x{left:06x}"), format!("0x{right:06x}"));
    }
    compared
}

/// Compares a surface pixel by pixel; `look` returns whether a pixel differs, and its largest difference.
fn surface(
    name: &str,
    [width, height]: [u32; 2],
    look: impl Fn(u32, u32) -> (bool, Option<(f64, Compared)>),
) -> SurfaceDifference {
    let mut map = Vec::with_capacity(width as usize * height as usize);
    let mut largest: Option<Largest> = None;
    for y in 0..height {
        for x in 0..width {
            let (differs, apart) = look(x, y);
            map.push(differs);
            if let Some((difference, values)) = apart
                && largest.as_ref().is_none_or(|most| difference > most.difference)
            {
                largest = Some(Largest { pixel: [x, y], difference, values });
            }
        }
    }
    SurfaceDifference {
        surface: name.to_owned(),
        pixels: map.len() as u64,
        different: map.iter().filter(|&&differs| differs).count() as u64,
        largest,
        map,
    }
}
