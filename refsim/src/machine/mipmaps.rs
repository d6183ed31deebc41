//! Generation of mip levels: the fixed function of SGIS_generate_mipmap, adopted by OpenGL 1.4.

use super::{Machine, MachineError, TextureId};
use crate::device::Profile;
use crate::event::{Event, MipmapLevel, MipmapRecord};
use crate::texture::{Image, MipmapRules, TexelFormat, TextureKind, texels_under};

impl Machine {
    /// Creates a zero-filled colour target with mip levels. Draws write level 0, [`Machine::generate_mipmaps`] fills
    /// the other levels, and samplers and [`Machine::read_back`] see all. `levels` includes level 0; its maximum is
    /// [`Image::most_levels`].
    ///
    /// Fails like [`Machine::create_target`], and if the device does not support mip levels of the format or `levels`
    /// is too large.
    pub fn create_target_with_levels(
        &mut self,
        format: TexelFormat,
        width: u32,
        height: u32,
        levels: u32,
    ) -> Result<TextureId, MachineError> {
        self.keep_target(Image::new(format, TextureKind::D2, [width, height, 1], levels)?)
    }

    /// Fills levels 1 and up of a texture or target from its level 0, as `glGenerateMipmap` does. (OpenGL's
    /// `GENERATE_MIPMAP` does so whenever level 0 changes; here the caller does.) Every executor gives the bits of
    /// [`Image::generate_mipmaps`]. Returns the texels read and written.
    ///
    /// Fails if the handle is invalid, if the texture has one level although it could have more, or if the device
    /// cannot filter textures of the format.
    pub fn generate_mipmaps(&mut self, id: TextureId) -> Result<MipmapRecord, MachineError> {
        let rules = MipmapRules::from(&self.profile.rules);
        let record = record(&self.profile, id, self.memory.texture(id)?)?;
        #[cfg(feature = "wgpu")]
        self.memory.download_newer(&[id], None)?;
        self.memory.texture_mut(id)?.generate_mipmaps(rules);
        self.recorder.push(|| Event::GenerateMipmaps(record.clone()));
        Ok(record)
    }
}

/// The record of generating mip levels, or the error that prevents it.
fn record(profile: &Profile, id: TextureId, image: &Image) -> Result<MipmapRecord, MachineError> {
    let (format, kind, device) = (image.format(), image.kind(), || profile.name.clone());
    if kind == TextureKind::Rectangle {
        return Err(MachineError::RectangleMipmaps { number: id.0 });
    }
    let limits = &profile.limits;
    if format.record().is_float() && !(limits.float_mipmaps && limits.float_filtering) {
        let key = if limits.float_mipmaps { "float_filtering" } else { "float_mipmaps" };
        return Err(MachineError::FloatMipmaps { number: id.0, format, device: device(), key });
    }
    let possible = Image::most_levels(kind, [image.width(), image.height(), image.slices()]);
    if image.levels().len() == 1 && possible > 1 {
        return Err(MachineError::NoLevels { number: id.0, possible });
    }
    let generated = image.levels().windows(2).map(|pair| {
        let [finer, level] = [pair[0], pair[1]].map(|l| [l.width, l.height, l.slices]);
        let under = |axis: usize| texels_under(finer[axis], level[axis], 0).len() as u64 * u64::from(level[axis]);
        MipmapLevel { extents: level, texels_read: (0..3).map(under).product() }
    });
    Ok(MipmapRecord { texture: id.into(), texel_bytes: format.bytes() as u32, levels: generated.collect() })
}
