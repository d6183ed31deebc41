//! Passes: one quad over a whole target, whose program computes a texel per fragment.

use refsim::event::DrawEvents;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Machine, MachineError, TextureId, VertexSource};
use refsim::output::WriteMask;
use refsim::raster::{PixelCenter, Primitive, full_screen_quad};
use refsim::texture::{SamplerState, TexelFormat};

use super::new_target;

/// A draw of one quad over a whole target. Textures are read without filtering and clamped at their borders.
#[derive(Clone, Copy, Debug)]
pub struct FullScreenPass<'a> {
    /// The pixel program.
    pub program: &'a CheckedProgram,
    /// Its constants.
    pub constants: &'a Constants,
    /// The textures of samplers 0, 1 and so on.
    pub textures: &'a [TextureId],
    /// Where the results go.
    pub target: TextureId,
    /// The components that are written.
    pub mask: WriteMask,
}

impl FullScreenPass<'_> {
    /// Draws it, with the texture coordinates of [`full_screen_quad`].
    ///
    /// # Errors
    /// [`MachineError`] if the card refuses the draw.
    pub fn draw<const SETS: usize>(
        &self,
        machine: &mut Machine,
        coordinates: impl Fn(f32, f32) -> [[f32; 4]; SETS],
    ) -> Result<DrawEvents, MachineError> {
        let quad = full_screen_quad(coordinates);
        let source = VertexSource::Transformed(&quad);
        let mut call = DrawCall::new(source, Primitive::QuadList, self.program, self.constants, self.target);
        for (sampler, texture) in self.textures.iter().enumerate() {
            call = call.with_texture(sampler, *texture, SamplerState::NEAREST_CLAMP);
        }
        call.center = PixelCenter::OpenGl;
        call.masks[0] = self.mask;
        machine.draw(&call)
    }
}

/// Two targets that passes write in turn, each pass reading what the one before wrote. Passes count from 0.
#[derive(Clone, Copy, Debug)]
pub struct PingPong([TextureId; 2]);

impl PingPong {
    /// Two targets of zeros.
    ///
    /// # Errors
    /// As [`new_target`].
    pub fn new(machine: &mut Machine, format: TexelFormat, size: [usize; 2]) -> Result<Self, MachineError> {
        Ok(Self([new_target(machine, format, size)?, new_target(machine, format, size)?]))
    }

    /// The target that a pass writes.
    pub fn written_by(&self, pass: usize) -> TextureId {
        self.0[pass % 2]
    }

    /// The target that a pass may read: the one that the pass before has written.
    pub fn read_by(&self, pass: usize) -> TextureId {
        self.0[(pass + 1) % 2]
    }

    /// Takes the target that a pass has written, and gives another one for it.
    pub fn exchange(&mut self, pass: usize, other: &mut TextureId) {
        std::mem::swap(&mut self.0[pass % 2], other);
    }
}
