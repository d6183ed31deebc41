//! OpenEXR files: floats and integers are kept to the bit.

use std::io::Cursor;
use std::ops::Range;

use exr::meta::MetaData;
use exr::meta::attribute::IntegerBounds;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, ReadChannels as _, ReadLayers as _,
    SmallVec, Text, WritableImage as _,
};

use super::channels::{ChannelUnit, Picture, PictureChannel, Samples};
use super::error::{PictureFormat, decode_error, encode_error, require_length, require_size};
use super::notes::PictureNotes;
use crate::error::InputError;

/// Encodes a picture as an EXR file with its named channels, losslessly compressed. The same picture gives the same
/// bytes. Fails with [`InputError`] if it has no channels, or a name cannot be represented.
pub fn exr(picture: &Picture) -> Result<Vec<u8>, InputError> {
    exr_with_notes(picture, &PictureNotes::default())
}

/// Like [`exr()`], with notes as attributes; characters beyond Latin-1 are escaped. Fails as [`exr()`] does.
pub fn exr_with_notes(picture: &Picture, notes: &PictureNotes) -> Result<Vec<u8>, InputError> {
    let refused = |reason: String| encode_error(PictureFormat::Exr, reason);
    let channel = |channel: &PictureChannel| {
        let name = Text::new_or_none(&channel.name)
            .ok_or_else(|| refused("a channel's name must be plain ASCII".to_owned()))?;
        let samples = match &channel.samples {
            Samples::Float(samples) => FlatSamples::F32(samples.clone()),
            Samples::Uint(samples) => FlatSamples::U32(samples.clone()),
        };
        Ok(AnyChannel::new(name, samples))
    };
    let list: SmallVec<_> = picture.channels().iter().map(channel).collect::<Result<_, InputError>>()?;
    if list.is_empty() || picture.width() == 0 || picture.height() == 0 {
        return Err(refused("the picture has no samples".to_owned()));
    }
    let layer = Layer::new(
        (picture.width() as usize, picture.height() as usize),
        LayerAttributes {
            software_name: text(&notes.software),
            comments: text(&notes.comments),
            world_to_camera: notes.world_to_camera,
            ..LayerAttributes::default()
        },
        // Run-length packing is lossless for every type of sample.
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(list),
    );
    let mut file = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().non_parallel().to_buffered(&mut file);
    written.map_err(|error| refused(error.to_string()))?;
    Ok(file.into_inner())
}

/// Converts text to the file format's text type; `None` if it is empty.
fn text(text: &str) -> Option<Text> {
    let escaped = |c: char| if u8::try_from(c).is_ok() { c.to_string() } else { c.escape_unicode().to_string() };
    Text::new_or_none(text.chars().map(escaped).collect::<String>()).filter(|_| !text.is_empty())
}

fn broken(error: exr::error::Error) -> InputError {
    decode_error(PictureFormat::Exr, error.to_string())
}

/// Rejects a file whose headers state a data or display window that would take too much memory.
pub(super) fn check_size(bytes: &[u8]) -> Result<(), InputError> {
    /// Bytes of a chunk besides its data: entry in the offset table, coordinate and length.
    const PER_CHUNK: u64 = 16;
    for header in &MetaData::read_from_buffered(bytes, true).map_err(broken)?.headers {
        for window in [header.layer_size, header.shared_attributes.display_window.size] {
            let [width, height] = [window.width(), window.height()].map(|side| side as u64);
            require_size(width, height, header.channels.list.len(), 4)?;
            require_length(PictureFormat::Exr, [width, height], header.chunk_count as u64 * PER_CHUNK, bytes.len())?;
        }
    }
    Ok(())
}

/// Decodes the first layer of an EXR file, at its largest resolution. Callers run [`check_size`] first, because the
/// reader allocates the stated size. Halves become singles. The picture is the display window: samples outside the data
/// window are 0, and pixels outside the display window are dropped.
pub(super) fn decode(bytes: &[u8]) -> Result<Picture, InputError> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let layer = image.layer_data;
    let windows = Windows {
        data: IntegerBounds::new(layer.attributes.layer_position, layer.size),
        display: image.attributes.display_window,
    };
    if (0..2).any(|axis| windows.shared(axis).is_empty()) {
        let [data, display] = [windows.data, windows.display].map(|IntegerBounds { position, size }| {
            format!("{}x{} at {}, {}", size.width(), size.height(), position.x(), position.y())
        });
        let reason = format!("no pixel of the data window ({data}) lies in the display window ({display})");
        return Err(decode_error(PictureFormat::Exr, reason));
    }
    // Sizes are within the limit, which is below 2^32.
    let mut picture = Picture::new(windows.display.size.width() as u32, windows.display.size.height() as u32);
    for channel in layer.channel_data.list {
        let name = channel.name.to_string();
        let unit =
            if matches!(name.as_str(), "R" | "G" | "B" | "Y") { ChannelUnit::Linear } else { ChannelUnit::Unknown };
        let samples = match channel.sample_data {
            FlatSamples::U32(samples) => Samples::Uint(windows.displayed(samples)),
            FlatSamples::F32(samples) => Samples::Float(windows.displayed(samples)),
            halves @ FlatSamples::F16(_) => Samples::Float(windows.displayed(halves.values_as_f32().collect())),
        };
        picture = picture.with(&name, unit, samples)?;
    }
    Ok(picture)
}

/// Data window of a layer and display window, in the coordinates of the file.
struct Windows {
    data: IntegerBounds,
    display: IntegerBounds,
}

impl Windows {
    fn shared(&self, axis: usize) -> Range<i64> {
        let [[from, to], [first, last]] = [self.data, self.display].map(|window| {
            let (start, size) = if axis == 0 {
                (window.position.x(), window.size.width())
            } else {
                (window.position.y(), window.size.height())
            };
            [i64::from(start), i64::from(start).saturating_add(i64::try_from(size).unwrap_or(i64::MAX))]
        });
        from.max(first)..to.min(last)
    }

    /// Samples of the display window, row by row, taken from the data window.
    fn displayed<T: Copy + Default>(&self, samples: Vec<T>) -> Vec<T> {
        if self.data == self.display {
            return samples;
        }
        let (columns, mut shown) = (self.shared(0), vec![T::default(); self.display.size.area()]);
        let width = (columns.end - columns.start) as usize;
        // Not negative, because both windows contain the position.
        let at = |window: &IntegerBounds, row: i64| {
            let [x, y] = [columns.start - i64::from(window.position.x()), row - i64::from(window.position.y())];
            y as usize * window.size.width() + x as usize
        };
        for row in self.shared(1) {
            let (from, to) = (at(&self.data, row), at(&self.display, row));
            shown[to..to + width].copy_from_slice(&samples[from..from + width]);
        }
        shown
    }
}
