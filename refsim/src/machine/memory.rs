//! Memory of the card: textures, targets and depth buffers.

use super::{BoundTexture, DepthId, MachineError, TextureId};
use crate::device::Profile;
use crate::output::{DepthSurface, TargetTile};
use crate::texture::{Image, TexelFormat};

#[derive(Debug, Default)]
pub(super) struct Memory {
    pub(super) textures: Vec<Option<Image>>,
    pub(super) depths: Vec<Option<DepthSurface>>,
    /// Copies of the resources on a GPU of the host.
    #[cfg(feature = "wgpu")]
    pub(super) card: Option<super::device::Card>,
}

impl Memory {
    /// The host's copy of a texture, which may be outdated ([`Self::current`] is not).
    pub(super) fn texture(&self, id: TextureId) -> Result<&Image, MachineError> {
        let missing = MachineError::NoSuchResource { what: "texture", number: id.0 };
        self.textures.get(id.0).and_then(Option::as_ref).ok_or(missing)
    }

    pub(super) fn current(&self, id: TextureId) -> Result<&Image, MachineError> {
        let image = self.texture(id)?;
        #[cfg(feature = "wgpu")]
        if let Some(card) = &self.card {
            return card.image(id.0, image);
        }
        Ok(image)
    }

    /// Assigns content stamps to the textures of a call, so that executors can cache their decoded form.
    pub(super) fn name_textures(&mut self, samplers: &[Option<BoundTexture>]) {
        for bound in samplers.iter().flatten() {
            if let Some(Some(image)) = self.textures.get_mut(bound.texture.0) {
                image.name_contents();
            }
        }
    }

    /// Mutable access to a texture; invalidates its GPU copy.
    pub(super) fn texture_mut(&mut self, id: TextureId) -> Result<&mut Image, MachineError> {
        #[cfg(feature = "wgpu")]
        if let Some(card) = &mut self.card {
            card.texture_overwritten(id.0);
        }
        let missing = MachineError::NoSuchResource { what: "texture", number: id.0 };
        self.textures.get_mut(id.0).and_then(Option::as_mut).ok_or(missing)
    }

    /// The host's copy of a depth buffer, which may be outdated ([`Self::current_depth`] is not).
    pub(super) fn depth(&self, id: DepthId) -> Result<&DepthSurface, MachineError> {
        let missing = MachineError::NoSuchResource { what: "depth buffer", number: id.0 };
        self.depths.get(id.0).and_then(Option::as_ref).ok_or(missing)
    }

    pub(super) fn current_depth(&self, id: DepthId) -> Result<&DepthSurface, MachineError> {
        let surface = self.depth(id)?;
        #[cfg(feature = "wgpu")]
        if let Some(card) = &self.card {
            return card.surface(id.0, surface);
        }
        Ok(surface)
    }

    /// Mutable access to a depth buffer; invalidates its GPU copy.
    pub(super) fn depth_mut(&mut self, id: DepthId) -> Result<&mut DepthSurface, MachineError> {
        #[cfg(feature = "wgpu")]
        if let Some(card) = &mut self.card {
            card.depth_overwritten(id.0);
        }
        let missing = MachineError::NoSuchResource { what: "depth buffer", number: id.0 };
        self.depths.get_mut(id.0).and_then(Option::as_mut).ok_or(missing)
    }

    #[cfg(feature = "wgpu")]
    pub(super) fn download_newer(&mut self, targets: &[TextureId], depth: Option<DepthId>) -> Result<(), MachineError> {
        for &id in targets {
            let newest = self.current(id)?.clone();
            *self.texture_mut(id)? = newest;
        }
        if let Some(id) = depth {
            let newest = self.current_depth(id)?.clone();
            *self.depth_mut(id)? = newest;
        }
        Ok(())
    }

    /// Discards what the GPU has drawn into targets since [`Self::download_newer`].
    #[cfg(feature = "wgpu")]
    pub(super) fn discard_gpu_contents(
        &mut self,
        targets: &[TextureId],
        depth: Option<DepthId>,
    ) -> Result<(), MachineError> {
        for &id in targets {
            self.texture_mut(id)?;
        }
        depth.map_or(Ok(()), |id| self.depth_mut(id).map(|_| ()))
    }

    /// Copies a finished tile into memory.
    pub(super) fn store(
        &mut self,
        tile: &TargetTile,
        targets: &[TextureId],
        depth: Option<DepthId>,
    ) -> Result<(), MachineError> {
        for (index, &target) in targets.iter().enumerate() {
            tile.store_color(index, self.texture_mut(target)?)?;
        }
        if let Some(id) = depth {
            tile.store_depth(self.depth_mut(id)?);
        }
        Ok(())
    }
}

/// Returns an error if the device cannot sample the format.
pub(super) fn check_texture_format(profile: &Profile, format: TexelFormat) -> Result<(), MachineError> {
    let allowed = &profile.limits.texture_formats;
    if allowed.contains(&format) {
        return Ok(());
    }
    Err(MachineError::TextureFormat { device: profile.name.clone(), format, allowed: listed(allowed) })
}

/// Returns an error if the device cannot draw into the format.
pub(super) fn check_target_format(profile: &Profile, format: TexelFormat) -> Result<(), MachineError> {
    let allowed = &profile.limits.target_formats;
    if allowed.contains(&format) {
        return Ok(());
    }
    Err(MachineError::TargetFormat { device: profile.name.clone(), format, allowed: listed(allowed) })
}

/// Names, separated by spaces.
pub(super) fn listed<T: ToString>(formats: &[T]) -> String {
    formats.iter().map(T::to_string).collect::<Vec<_>>().join(" ")
}
