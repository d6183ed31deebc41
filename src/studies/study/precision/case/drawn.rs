//! Channel values of a drawn case.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::{Channel, ChannelClass, Image};

use crate::case::{CaseError, Loaded, Setup};
use crate::error::InputError;
use crate::picture::metrics::ScreenPicture;
use crate::picture::{ChannelUnit, Picture, RgbImage, Samples, display, rgb8};

/// Channel values of a drawn case.
#[derive(Debug)]
pub(super) struct DrawnCase {
    pub(super) targets: Vec<DrawnTarget>,
}

/// Stored channels of a target with their values, pixel by pixel.
#[derive(Debug)]
pub(super) struct DrawnTarget {
    pub(super) channels: Vec<Channel>,
    pub(super) values: Vec<f64>,
    /// Displayed red, green and blue per pixel, in linear light.
    linear: Vec<[f32; 3]>,
}

/// Number of codes per unit of a channel with integer codes.
pub(super) fn codes(channel: Channel) -> Option<f64> {
    let most = |bits: u8| ((1_u64 << bits) - 1) as f64;
    match channel.class {
        ChannelClass::Unorm => Some(most(channel.bits)),
        ChannelClass::Snorm => Some(most(channel.bits - 1).max(1.0)),
        _ => None,
    }
}

impl DrawnCase {
    pub(super) fn new(setup: &Setup, executor: &Executor, profile: &Profile) -> Result<Self, CaseError> {
        let setup = setup.on_device(profile.clone())?;
        let mut loaded = Loaded::new(&setup, executor)?;
        loaded.draw()?;
        let targets = loaded.targets()?.into_iter().map(|image| DrawnTarget::new(image, profile)).collect();
        Ok(Self { targets })
    }

    /// Returns `true` if a channel of a target has integer codes.
    pub(super) fn has_codes(&self) -> bool {
        self.targets.iter().flat_map(|target| &target.channels).any(|channel| codes(*channel).is_some())
    }

    /// Target 0 as it appears on a screen.
    pub(super) fn screen(&self, [width, height]: [u32; 2]) -> Result<ScreenPicture, InputError> {
        let plane = |c: usize| Samples::Float(self.targets[0].linear.iter().map(|pixel| pixel[c]).collect());
        let picture = (0..).zip(["R", "G", "B"]).try_fold(Picture::new(width, height), |picture, (c, name)| {
            picture.with(name, ChannelUnit::Unknown, plane(c))
        })?;
        ScreenPicture::new(&picture, 1.0)
    }

    /// Target 0 as displayed.
    pub(super) fn picture(&self, [width, height]: [u32; 2]) -> RgbImage {
        let pixels = self.targets[0].linear.iter();
        rgb8(width, height, pixels.map(|pixel| pixel.map(|channel| display::encode(f64::from(channel)))))
    }
}

impl DrawnTarget {
    fn new(image: &Image, profile: &Profile) -> Self {
        let channels = image.format().record().stored().to_vec();
        let is_encoded = channels.iter().all(|channel| channel.class == ChannelClass::Unorm);
        let (mut values, mut linear) = (Vec::new(), Vec::new());
        for at in 0..image.width() * image.height() {
            let (x, y) = (at % image.width(), at / image.width());
            let texel = image.texel(0, 0, y, x, profile.rules.signed_texel_minimum).to_f64();
            values.extend(channels.iter().map(|channel| texel[usize::from(channel.stored_from)]));
            let [red, green, blue, _] =
                texel.map(|value| if is_encoded { display::decode(value) } else { value } as f32);
            linear.push([red, green, blue]);
        }
        Self { channels, values, linear }
    }
}
