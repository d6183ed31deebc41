//! EXR files: floats and whole numbers kept to the bit.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, WritableImage as _,
};

use super::{ReportError, expect_samples};

/// The samples of one channel, rows from the top.
#[derive(Clone, Copy, Debug)]
pub enum Channel<'a> {
    /// IEEE singles; NaN and infinity are kept.
    Float(&'a [f32]),
    /// Whole numbers: ids, counts, bit patterns.
    Uint(&'a [u32]),
}

impl Channel<'_> {
    const fn len(&self) -> usize {
        match self {
            Self::Float(samples) => samples.len(),
            Self::Uint(samples) => samples.len(),
        }
    }
}

/// An EXR file with named channels, for example `t` and `id`. Losslessly packed; the same input gives the same bytes.
///
/// # Errors
/// If a channel has not `width * height` samples, or a name cannot be written.
pub fn exr(width: usize, height: usize, channels: &[(&str, Channel<'_>)]) -> Result<Vec<u8>, ReportError> {
    let mut list = SmallVec::new();
    for (name, channel) in channels {
        expect_samples(width, height, 1, channel.len())?;
        let samples = match *channel {
            Channel::Float(samples) => FlatSamples::F32(samples.to_vec()),
            Channel::Uint(samples) => FlatSamples::U32(samples.to_vec()),
        };
        let name = exr::meta::attribute::Text::new_or_none(name)
            .ok_or_else(|| ReportError::encode("EXR")(&"a channel's name must be plain ASCII"))?;
        list.push(AnyChannel::new(name, samples));
    }
    let layer = Layer::new(
        (width, height),
        LayerAttributes::default(),
        // Run-length packing is lossless for every type of sample.
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(list),
    );
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(|error| ReportError::encode("EXR")(&error))?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use exr::prelude::{FlatSamples, ReadChannels as _, ReadLayers as _};

    use super::*;

    #[test]
    fn floats_and_ids_come_back_to_the_bit() {
        let t = [0.1_f32, f32::NAN, f32::INFINITY, -0.0, 1e-40, 3.0];
        let id = [0, 1, u32::MAX, 4, 5, 6];
        let file = exr(3, 2, &[("t", Channel::Float(&t)), ("id", Channel::Uint(&id))]).expect("six samples each");
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .expect("our own EXR");
        for channel in &image.layer_data.channel_data.list {
            match &channel.sample_data {
                FlatSamples::F32(samples) => {
                    assert_eq!(channel.name.to_string(), "t");
                    let bits = |s: &[f32]| s.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(samples), bits(&t));
                }
                FlatSamples::U32(samples) => {
                    assert_eq!(channel.name.to_string(), "id");
                    assert_eq!(samples, &id);
                }
                FlatSamples::F16(_) => panic!("no half was written"),
            }
        }
    }

    #[test]
    fn a_short_channel_is_an_error() {
        assert!(exr(2, 2, &[("t", Channel::Float(&[0.0; 3]))]).is_err());
    }
}
