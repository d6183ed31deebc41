//! Resources of a machine: creation, clearing, read-back and release.

use super::memory::{check_target_format, check_texture_format, listed};
use super::{DepthId, Machine, MachineError, TextureId};
use crate::device::Profile;
use crate::event::Event;
use crate::num::Format;
use crate::output::{DepthFormat, DepthSurface};
use crate::texture::{Image, TargetRounding, TexelFormat, TextureKind};

/// Creation, update, read-back and release of resources.
impl Machine {
    /// Uploads a texture.
    ///
    /// # Errors
    /// If the device does not support the format, or the texture exceeds its limits.
    pub fn create_texture(&mut self, image: Image) -> Result<TextureId, MachineError> {
        check_texture_format(&self.profile, image.format())?;
        if image.kind() == TextureKind::Volume {
            check_volume(&self.profile, &image)?;
        } else {
            let limit = self.profile.limits.max_texture_size;
            check_size(&self.profile, "texture", limit, "max_texture_size", &image)?;
        }
        check_levels(&self.profile, &image)?;
        let bytes = image.bytes().len() as u64;
        let id = self.keep(image);
        self.note_upload(id, bytes);
        Ok(id)
    }

    /// Creates a zero-filled colour target. Later draws can sample it if the device supports textures of the format.
    ///
    /// # Errors
    /// If the device does not support the format, or the target exceeds its limits.
    pub fn create_target(&mut self, format: TexelFormat, width: u32, height: u32) -> Result<TextureId, MachineError> {
        self.keep_target(Image::new_2d(format, width, height)?)
    }

    /// Creates a colour target with the contents of an image.
    ///
    /// # Errors
    /// As [`Machine::create_target`].
    pub fn create_target_from(&mut self, image: Image) -> Result<TextureId, MachineError> {
        let bytes = image.bytes().len() as u64;
        let id = self.keep_target(image)?;
        self.note_upload(id, bytes);
        Ok(id)
    }

    pub(super) fn keep_target(&mut self, image: Image) -> Result<TextureId, MachineError> {
        check_target_format(&self.profile, image.format())?;
        let limit = self.profile.limits.max_target_size;
        check_size(&self.profile, "target", limit, "max_target_size", &image)?;
        check_levels(&self.profile, &image)?;
        Ok(self.keep(image))
    }

    /// Creates a depth buffer, cleared to 1.
    ///
    /// # Errors
    /// If the device does not support the format, or the size is invalid.
    pub fn create_depth(&mut self, format: DepthFormat, width: u32, height: u32) -> Result<DepthId, MachineError> {
        let allowed = &self.profile.limits.depth_formats;
        if !allowed.contains(&format) {
            let (device, allowed) = (self.profile.name.clone(), listed(allowed));
            return Err(MachineError::DepthFormat { device, format, allowed });
        }
        let surface = DepthSurface::new(format, width, height)?;
        self.memory.depths.push(Some(surface));
        Ok(DepthId(self.memory.depths.len() - 1))
    }

    fn keep(&mut self, image: Image) -> TextureId {
        self.memory.textures.push(Some(image));
        TextureId(self.memory.textures.len() - 1)
    }

    fn note_upload(&self, id: TextureId, bytes: u64) {
        self.recorder.push(|| Event::Upload { resource: id.into(), bytes });
    }

    /// Replaces the contents of a texture or target by an image of the same format and extents.
    ///
    /// # Errors
    /// If the handle is invalid, or the image has another format or other extents.
    pub fn update_texture(&mut self, id: TextureId, image: &Image) -> Result<(), MachineError> {
        let device = self.profile.name.clone();
        let held = self.memory.texture(id)?;
        if held.format() != image.format() {
            let allowed = held.format().to_string();
            return Err(MachineError::TextureFormat { device, format: image.format(), allowed });
        }
        let (region, bytes) = (held.region(), image.bytes());
        if held.bytes().len() == bytes.len() && region == image.region() {
            self.memory.texture_mut(id)?.bytes_mut().copy_from_slice(bytes);
            self.note_upload(id, bytes.len() as u64);
            return Ok(());
        }
        let (expected, found) = (held.bytes().len(), bytes.len());
        Err(crate::texture::TextureError::DataSize { unit: "bytes", expected, found }.into())
    }

    /// Fills level 0 of a target with a colour, given as single-precision patterns, with the device's target rounding.
    /// Other mip levels keep their contents.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn clear_target(&mut self, id: TextureId, color: [u32; 4]) -> Result<(), MachineError> {
        let rounding = self.profile.rules.target_rounding;
        let image = self.memory.texture_mut(id)?;
        image.clear_level(0, Format::FP32, color, rounding);
        let bytes = image.level_bytes(0).len() as u64;
        self.recorder.push(|| Event::Clear { resource: id.into(), bytes });
        Ok(())
    }

    /// Fills a depth buffer with a depth, given as a single-precision pattern and clamped to [0, 1].
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn clear_depth(&mut self, id: DepthId, depth: u32) -> Result<(), MachineError> {
        let rounding: TargetRounding = self.profile.rules.depth_rounding;
        let surface = self.memory.depth_mut(id)?;
        surface.clear(depth, rounding);
        let bytes = surface.bytes();
        self.recorder.push(|| Event::Clear { resource: id.into(), bytes });
        Ok(())
    }

    /// Releases a texture and returns its contents; the handle becomes invalid.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn release_texture(&mut self, id: TextureId) -> Result<Image, MachineError> {
        self.memory.texture(id)?;
        #[cfg(feature = "wgpu")]
        self.release_gpu_texture(id)?;
        let missing = MachineError::NoSuchResource { what: "texture", number: id.0 };
        self.memory.textures.get_mut(id.0).and_then(Option::take).ok_or(missing)
    }

    /// Releases a depth buffer and returns its contents; the handle becomes invalid.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn release_depth(&mut self, id: DepthId) -> Result<DepthSurface, MachineError> {
        #[cfg(feature = "wgpu")]
        self.release_gpu_depth(id)?;
        let missing = MachineError::NoSuchResource { what: "depth buffer", number: id.0 };
        self.memory.depths.get_mut(id.0).and_then(Option::take).ok_or(missing)
    }

    /// Reads a texture or target back. [`Image::bytes`] returns its texels, [`Image::texel`] their values.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn read_back(&self, id: TextureId) -> Result<&Image, MachineError> {
        let image = self.memory.current(id)?;
        self.note_read_back(id.into(), image.bytes().len() as u64);
        Ok(image)
    }

    /// Reads a depth buffer back.
    ///
    /// # Errors
    /// If the handle is invalid.
    pub fn read_depth(&self, id: DepthId) -> Result<&DepthSurface, MachineError> {
        let surface = self.memory.current_depth(id)?;
        self.note_read_back(id.into(), surface.bytes());
        Ok(surface)
    }
}

/// Releases GPU copies along with their resources.
#[cfg(feature = "wgpu")]
impl Machine {
    fn release_gpu_texture(&mut self, id: TextureId) -> Result<(), MachineError> {
        let Some(mut card) = self.memory.card.take() else { return Ok(()) };
        let fresh = match self.memory.texture(id) {
            Ok(image) => card.release_texture(id.0, image),
            Err(_) => Ok(None),
        };
        self.memory.card = Some(card);
        if let (Some(image), Some(slot)) = (fresh?, self.memory.textures.get_mut(id.0)) {
            *slot = Some(image);
        }
        Ok(())
    }

    fn release_gpu_depth(&mut self, id: DepthId) -> Result<(), MachineError> {
        let Some(mut card) = self.memory.card.take() else { return Ok(()) };
        let fresh = match self.memory.depth(id) {
            Ok(surface) => card.release_depth(id.0, surface),
            Err(_) => Ok(None),
        };
        self.memory.card = Some(card);
        if let (Some(surface), Some(slot)) = (fresh?, self.memory.depths.get_mut(id.0)) {
            *slot = Some(surface);
        }
        Ok(())
    }
}

fn check_levels(profile: &Profile, image: &Image) -> Result<(), MachineError> {
    let (levels, format) = (image.levels().len(), image.format());
    if levels > 1 && format.record().is_float() && !profile.limits.float_mipmaps {
        return Err(MachineError::FloatLevels { levels, format, device: profile.name.clone() });
    }
    Ok(())
}

fn check_size(
    profile: &Profile,
    what: &'static str,
    limit: Option<u32>,
    key: &'static str,
    image: &Image,
) -> Result<(), MachineError> {
    let (width, height) = (image.width(), image.height());
    match limit {
        Some(limit) if width > limit || height > limit => {
            Err(MachineError::TooLarge { what, device: profile.name.clone(), width, height, limit, key })
        }
        _ => Ok(()),
    }
}

fn check_volume(profile: &Profile, image: &Image) -> Result<(), MachineError> {
    let [width, height, depth] = [image.width(), image.height(), image.slices()];
    match profile.limits.max_volume_size {
        Some(limit) if [width, height, depth].iter().any(|&side| side > limit) => {
            Err(MachineError::VolumeTooLarge { device: profile.name.clone(), width, height, depth, limit })
        }
        _ => Ok(()),
    }
}
