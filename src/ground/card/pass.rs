//! Passes: one quad over a whole target, whose program computes a texel per fragment.

use refsim::event::DrawEvents;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, MachineError, TextureId, VertexSource};
use refsim::output::WriteMask;
use refsim::raster::{PixelCenter, Primitive, Viewport, full_screen_quad};
use refsim::texture::{AddressMode, Filter, SamplerState, TexelFormat};

use super::new_target;

/// A texture and the sampler state with which it is read.
pub type ReadTexture = (TextureId, SamplerState);

/// Linear filtering within a level, clamped at the border.
pub const BILINEAR: SamplerState = SamplerState {
    min: Filter::Linear,
    mag: Filter::Linear,
    address_u: AddressMode::Clamp,
    address_v: AddressMode::Clamp,
    ..SamplerState::NEAREST_CLAMP
};

/// Pairs textures with a sampler state without filtering that clamps at borders.
pub fn nearest<const N: usize>(textures: [TextureId; N]) -> [ReadTexture; N] {
    textures.map(|texture| (texture, SamplerState::NEAREST_CLAMP))
}

/// Constants of a program: the first is `c0` or `p[0]`.
pub fn constants(values: impl IntoIterator<Item = [f32; 4]>) -> Constants {
    Constants { float: values.into_iter().map(|value| value.map(f32::to_bits)).collect(), ..Constants::default() }
}

/// A draw of one quad over a whole target, or a part of it.
#[derive(Clone, Copy, Debug)]
pub struct FullScreenPass<'a> {
    /// The pixel program.
    pub program: &'a CheckedProgram,
    /// The program's constants.
    pub constants: &'a Constants,
    /// The textures of samplers 0, 1 and so on.
    pub textures: &'a [ReadTexture],
    /// The target of the results.
    pub target: TextureId,
    /// The components that are written.
    pub mask: WriteMask,
    /// The part of the target that the quad covers; `None`: all.
    pub part: Option<Viewport>,
}

impl FullScreenPass<'_> {
    /// Draws the quad with the texture coordinates of [`full_screen_quad`].
    pub fn draw<const SETS: usize>(
        &self,
        machine: &mut Machine,
        coordinates: impl Fn(f32, f32) -> [[f32; 4]; SETS],
    ) -> Result<DrawEvents, MachineError> {
        let quad = full_screen_quad(coordinates);
        let source = VertexSource::Transformed(&quad);
        let mut call = DrawCall::new(source, Primitive::QuadList, self.program, self.constants, self.target);
        for (sampler, &(texture, state)) in self.textures.iter().enumerate() {
            call = call.with_texture(sampler, texture, state);
        }
        call.center = PixelCenter::OpenGl;
        call.masks[0] = self.mask;
        call.viewport = self.part;
        machine.draw(&call)
    }

    /// Draws the quad with one set of coordinates, TEX0, from 0 to `size` in texels. Fails as [`Self::draw`] does.
    pub fn draw_counting(&self, machine: &mut Machine, size: [usize; 2]) -> Result<DrawEvents, MachineError> {
        let [width, height] = size.map(|side| side as f32);
        self.draw(machine, |u, v| [[u * width, v * height, 0.0, 1.0]])
    }
}

/// Two targets that passes write alternately; each pass reads the output of the previous pass. Passes count from 0.
#[derive(Clone, Copy, Debug)]
pub struct PingPong([TextureId; 2]);

impl PingPong {
    /// Two targets of zeros. Fails as [`new_target`] does.
    pub fn new(machine: &mut Machine, format: TexelFormat, size: [usize; 2]) -> Result<Self, MachineError> {
        Ok(Self([new_target(machine, format, size)?, new_target(machine, format, size)?]))
    }

    /// The target that a pass writes.
    pub fn written_by(&self, pass: usize) -> TextureId {
        self.0[pass % 2]
    }

    /// The target that a pass may read: the output of the previous pass.
    pub fn read_by(&self, pass: usize) -> TextureId {
        self.0[(pass + 1) % 2]
    }

    /// Swaps the target that a pass has written with `other`.
    pub fn exchange(&mut self, pass: usize, other: &mut TextureId) {
        std::mem::swap(&mut self.0[pass % 2], other);
    }
}
