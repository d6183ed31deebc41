//! Pictures as named channels of samples.

use image::RgbImage;

use super::display;
use super::png::rgb8;
use crate::error::InputError;
use crate::picture::error::{no_color_error, samples_error};

/// Meaning of a channel's samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChannelUnit {
    /// Linear light: radiance, or proportional to it.
    Linear,
    /// Value of the sRGB curve, 0 to 1.
    Srgb,
    /// Multiples of the length of a pixel's ray.
    RayLength,
    /// Identifiers, of triangles for example.
    Id,
    /// Not specified.
    #[default]
    Unknown,
}

/// Samples of a channel, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Single-precision floats; NaN and infinity are kept.
    Float(Vec<f32>),
    /// Unsigned integers: ids, counts, bit patterns.
    Uint(Vec<u32>),
}

/// Channel of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureChannel {
    /// Name, `R` for example.
    pub name: String,
    /// Meaning of its samples.
    pub unit: ChannelUnit,
    /// Samples, one per pixel.
    pub samples: Samples,
}

/// Named channels of samples, one per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    channels: Vec<PictureChannel>,
}

impl Samples {
    /// Number of samples.
    pub const fn len(&self) -> usize {
        match self {
            Self::Float(samples) => samples.len(),
            Self::Uint(samples) => samples.len(),
        }
    }

    /// Returns `true` if there are no samples.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Picture {
    /// Creates a picture without channels.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height, channels: Vec::new() }
    }

    /// Creates a picture of linear red, green and blue, rows from the top; missing pixels are black.
    pub fn rgb(width: u32, height: u32, pixels: &[[f32; 3]]) -> Self {
        let channel = |(channel, name): (usize, &str)| {
            let mut samples: Vec<f32> = pixels.iter().map(|pixel| pixel[channel]).collect();
            samples.resize(width as usize * height as usize, 0.0);
            PictureChannel { name: name.to_owned(), unit: ChannelUnit::Linear, samples: Samples::Float(samples) }
        };
        Self { width, height, channels: ["R", "G", "B"].into_iter().enumerate().map(channel).collect() }
    }

    /// Adds a channel. Fails with [`InputError`] unless it has one sample per pixel, and at least one sample.
    pub fn with(mut self, name: &str, unit: ChannelUnit, samples: Samples) -> Result<Self, InputError> {
        let (width, height, found) = (self.width, self.height, samples.len() as u64);
        let expected = u64::from(width) * u64::from(height);
        if found != expected || expected == 0 {
            return Err(samples_error(width, height, expected, found));
        }
        self.channels.push(PictureChannel { name: name.to_owned(), unit, samples });
        Ok(self)
    }

    /// Width in pixels.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Channels, in the order of addition, or in the file's order.
    pub fn channels(&self) -> &[PictureChannel] {
        &self.channels
    }

    /// Returns the channel with this name, if its samples are floats.
    pub fn floats(&self, name: &str) -> Option<(ChannelUnit, &[f32])> {
        self.channels.iter().find(|channel| channel.name == name).and_then(|channel| match &channel.samples {
            Samples::Float(samples) => Some((channel.unit, samples.as_slice())),
            Samples::Uint(_) => None,
        })
    }

    /// Returns linear red, green and blue per pixel; a picture with only the channel `Y` gives `Y` three times.
    pub fn linear(&self) -> Result<Vec<[f32; 3]>, InputError> {
        let found = || self.channels.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>().join(", ");
        let color = |names: [&str; 3]| Some([self.floats(names[0])?, self.floats(names[1])?, self.floats(names[2])?]);
        let channels = color(["R", "G", "B"]).or_else(|| color(["Y"; 3]));
        let channels = channels.ok_or_else(|| no_color_error(&found()))?;
        let linear = |(unit, samples): (ChannelUnit, &[f32]), pixel: usize| match unit {
            ChannelUnit::Srgb => display::decode(f64::from(samples[pixel])) as f32,
            _ => samples[pixel],
        };
        let pixels = self.width as usize * self.height as usize;
        Ok((0..pixels).map(|pixel| channels.map(|channel| linear(channel, pixel))).collect())
    }

    /// Tone-maps to 8 bits: linear light times `exposure` through the sRGB curve, clipped at 1.
    pub fn display(&self, exposure: f64) -> Result<RgbImage, InputError> {
        let pixels = self.linear()?;
        let shown = pixels.iter().map(|pixel| pixel.map(|channel| display::encode(f64::from(channel) * exposure)));
        Ok(rgb8(self.width, self.height, shown))
    }
}
