//! A quad over a target, or a part of it, whose textures are read as they say.

use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, TextureId, VertexSource};
use refsim::raster::{PixelCenter, Primitive, Viewport, full_screen_quad};
use refsim::texture::SamplerState;

use super::error::SubsurfaceCardError;

/// A texture and how it is read.
pub(super) type ReadTexture = (TextureId, SamplerState);

/// A quad whose fragments compute a texel each.
#[derive(Clone, Copy, Debug)]
pub(super) struct QuadPass<'a> {
    pub(super) program: &'a CheckedProgram,
    pub(super) constants: &'a Constants,
    /// The textures of samplers 0, 1 and so on.
    pub(super) textures: &'a [ReadTexture],
    pub(super) target: TextureId,
    /// The part of the target; `None`: all.
    pub(super) part: Option<Viewport>,
}

impl QuadPass<'_> {
    /// Draws it; TEX0 counts `size` texels.
    pub(super) fn draw(&self, machine: &mut Machine, size: [u32; 2]) -> Result<(), SubsurfaceCardError> {
        let [width, height] = size.map(|side| side as f32);
        let quad = full_screen_quad(|u, v| [[u * width, v * height, 0.0, 1.0]]);
        let source = VertexSource::Transformed(&quad);
        let mut call = DrawCall::new(source, Primitive::QuadList, self.program, self.constants, self.target);
        for (sampler, &(texture, state)) in self.textures.iter().enumerate() {
            call = call.with_texture(sampler, texture, state);
        }
        call.center = PixelCenter::OpenGl;
        call.viewport = self.part;
        machine.draw(&call)?;
        Ok(())
    }
}

/// Textures that are read without filtering, clamped at their borders.
pub(super) fn nearest<const N: usize>(textures: [TextureId; N]) -> [ReadTexture; N] {
    textures.map(|texture| (texture, SamplerState::NEAREST_CLAMP))
}

/// Constants `c0` or `p[0]` and on.
pub(super) fn constants(values: impl IntoIterator<Item = [f32; 4]>) -> Constants {
    Constants { float: values.into_iter().map(|value| value.map(f32::to_bits)).collect(), ..Constants::default() }
}
