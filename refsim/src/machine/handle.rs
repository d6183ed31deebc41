//! Handles of textures and depth buffers.

use crate::event::ResourceId;

/// Handle of a texture of one machine. A colour target is a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureId(pub(super) usize);

/// Handle of a depth buffer of one machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DepthId(pub(super) usize);

impl From<TextureId> for ResourceId {
    fn from(id: TextureId) -> Self {
        Self::Texture(id.0)
    }
}

impl From<DepthId> for ResourceId {
    fn from(id: DepthId) -> Self {
        Self::Depth(id.0)
    }
}
