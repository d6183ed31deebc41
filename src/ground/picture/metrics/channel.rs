//! Differences of samples, channel by channel.

use super::super::channels::{ChannelUnit, Picture, PictureChannel, Samples};
use super::super::display;
use super::error_sums::{ErrorSums, value_error};
use crate::error::{InputError, ensure, input_error};

fn channels_error(left: String, right: String) -> InputError {
    input_error!("crossbar::picture::mismatch" =>
        "expected the same channels in both pictures, found {left} and {right}";
        help "choose channels that both have with `--channel`")
}

/// Position and values of the largest difference between two channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstSample {
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
    /// Sample of the first picture.
    pub left: f64,
    /// Sample of the second picture.
    pub right: f64,
}

/// Difference between two channels with the same name. NaN equals NaN, and -0 equals +0.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelDifference {
    /// Name of the channel.
    pub name: String,
    /// `true` if the samples are integers: ids, which are only compared for equality.
    pub whole: bool,
    /// Number of samples that differ.
    pub differing: u64,
    /// Number of NaN samples in each picture.
    pub nan: [u64; 2],
    /// Number of differing samples of which at least one is not finite.
    pub not_finite: u64,
    /// Root mean squared difference, over samples that are finite in both.
    pub rmse: f64,
    /// Mean of second minus first, over samples that are finite in both.
    pub mean: f64,
    /// Largest absolute difference; infinite if one of two differing samples is not finite.
    pub maximum: f64,
    /// Position of the largest difference, the first from the top; `None` if the channels are equal.
    pub worst: Option<WorstSample>,
}

/// Compares the channels of two pictures, or only those that `names` lists, in the order of the first picture. If one
/// channel is sRGB-encoded and the other linear, the encoded one is decoded.
pub fn channels(left: &Picture, right: &Picture, names: &[String]) -> Result<Vec<ChannelDifference>, InputError> {
    let pairs = pairs(left, right, names)?;
    Ok(pairs.into_iter().map(|pair| difference(pair, left.width())).collect())
}

/// Computes second minus first, sample by sample: the difference of floats; for integers, 1 where they differ and 0
/// elsewhere. Fails as [`channels`] does.
pub fn signed_differences(
    left: &Picture,
    right: &Picture,
    names: &[String],
) -> Result<Vec<(String, Vec<f32>)>, InputError> {
    let signed = |pair: ChannelPair<'_>| {
        let of = |[a, b]: [f64; 2]| match pair.whole() {
            true => f32::from(u8::from(a != b)),
            false if value_error(b, a) == 0.0 => 0.0,
            false => (b - a) as f32,
        };
        (pair.left.name.clone(), (0..pair.left.samples.len()).map(|i| of(pair.samples(i))).collect())
    };
    Ok(pairs(left, right, names)?.into_iter().map(signed).collect())
}

#[derive(Clone, Copy)]
struct ChannelPair<'a> {
    left: &'a PictureChannel,
    right: &'a PictureChannel,
}

impl ChannelPair<'_> {
    fn whole(&self) -> bool {
        matches!(self.left.samples, Samples::Uint(_))
    }

    fn samples(&self, index: usize) -> [f64; 2] {
        let mixed = self.left.unit != self.right.unit;
        [self.left, self.right].map(|channel| match &channel.samples {
            Samples::Float(samples) if mixed && channel.unit == ChannelUnit::Srgb => {
                display::decode(f64::from(samples[index]))
            }
            Samples::Float(samples) => f64::from(samples[index]),
            Samples::Uint(samples) => f64::from(samples[index]),
        })
    }
}

fn pairs<'a>(left: &'a Picture, right: &'a Picture, names: &[String]) -> Result<Vec<ChannelPair<'a>>, InputError> {
    let [here, there] = [left, right].map(|picture| [picture.width(), picture.height()]);
    ensure!(here == there, "crossbar::picture::mismatch" =>
        "expected two pictures of the same size, found {}x{} and {}x{}", here[0], here[1], there[0], there[1]);
    let list = |picture: &Picture| {
        picture.channels().iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>().join(", ")
    };
    let find = |picture: &'a Picture, name: &str| picture.channels().iter().find(|channel| channel.name == name);
    let asked: Vec<&str> = match names {
        [] if left.channels().len() != right.channels().len() => {
            return Err(channels_error(list(left), list(right)));
        }
        [] => left.channels().iter().map(|channel| channel.name.as_str()).collect(),
        names => names.iter().map(String::as_str).collect(),
    };
    let pair = |name: &str| match (find(left, name), find(right, name)) {
        (Some(left), Some(right))
            if matches!(left.samples, Samples::Uint(_)) != matches!(right.samples, Samples::Uint(_)) =>
        {
            Err(input_error!("crossbar::picture::mismatch" =>
                    "expected samples of the same type in channel `{name}`, found floats and whole numbers"))
        }
        (Some(left), Some(right)) => Ok(ChannelPair { left, right }),
        _ if names.is_empty() => Err(channels_error(list(left), list(right))),
        _ => Err(input_error!("crossbar::picture::mismatch" =>
                "expected a channel `{name}` in both pictures, found {} and {}", list(left), list(right))),
    };
    asked.into_iter().map(pair).collect()
}

fn difference(pair: ChannelPair<'_>, width: u32) -> ChannelDifference {
    let mut found = ChannelDifference {
        name: pair.left.name.clone(),
        whole: pair.whole(),
        differing: 0,
        nan: [0; 2],
        not_finite: 0,
        rmse: 0.0,
        mean: 0.0,
        maximum: 0.0,
        worst: None,
    };
    let mut sums = ErrorSums::default();
    for index in 0..pair.left.samples.len() {
        let [a, b] = pair.samples(index);
        found.nan[0] += u64::from(a.is_nan());
        found.nan[1] += u64::from(b.is_nan());
        let error = value_error(b, a);
        // Means exclude infinities and NaN, even if they are equal.
        if error != 0.0 || a.is_finite() {
            sums.add(error, 1.0);
        }
        found.differing += u64::from(error != 0.0);
        let off = if found.whole { error.abs().min(1.0) } else { error.abs() };
        if off > found.maximum {
            let (x, y) = ((index % width as usize) as u32, (index / width as usize) as u32);
            (found.maximum, found.worst) = (off, Some(WorstSample { x, y, left: a, right: b }));
        }
    }
    let finite = sums.of_finite();
    ChannelDifference { not_finite: sums.not_finite, mean: finite.mean(), rmse: finite.rms(), ..found }
}
