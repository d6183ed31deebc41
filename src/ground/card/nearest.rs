//! Targets that keep the nearest fragment by a depth test.

use refsim::machine::{DepthId, DrawCall, Machine, MachineError, TextureId};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::PixelCenter;
use refsim::texture::TexelFormat;

/// A color target and its depth buffer.
#[derive(Clone, Copy, Debug)]
pub struct NearestTarget {
    /// Color target.
    pub color: TextureId,
    /// The depths, 1 where nothing was drawn.
    pub depth: DepthId,
}

impl NearestTarget {
    /// A target and a depth buffer of its size.
    pub fn new(
        machine: &mut Machine,
        color: TexelFormat,
        depth: DepthFormat,
        [width, height]: [u32; 2],
    ) -> Result<Self, MachineError> {
        let color = machine.create_target(color, width, height)?;
        Ok(Self { color, depth: machine.create_depth(depth, width, height)? })
    }

    /// Clears the colors to 0 and the depths to the largest depth.
    pub fn clear(&self, machine: &mut Machine) -> Result<(), MachineError> {
        machine.clear_target(self.color, [0; 4])?;
        machine.clear_depth(self.depth, 1.0_f32.to_bits())
    }

    /// Sets up a draw into the color target to keep the nearest fragment, with pixel centers as in OpenGL.
    pub fn keep_nearest(&self, call: &mut DrawCall<'_>) {
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::Less), write: true };
        call.depth_buffer = Some(self.depth);
    }
}

/// The target of pictures, reused while format and size do not change.
#[derive(Debug, Default)]
pub(super) struct ViewTarget(Option<(NearestTarget, TexelFormat, [u32; 2])>);

impl ViewTarget {
    /// The target for a picture, with a depth buffer of 24 bits: the previous target, if it has this format and size.
    pub(super) fn of(
        &mut self,
        machine: &mut Machine,
        format: TexelFormat,
        size: [u32; 2],
    ) -> Result<NearestTarget, MachineError> {
        match self.0.take() {
            Some(last) if (last.1, last.2) == (format, size) => {
                self.0 = Some(last);
                return Ok(last.0);
            }
            Some((last, ..)) => {
                machine.release_texture(last.color)?;
                machine.release_depth(last.depth)?;
            }
            None => {}
        }
        let target = NearestTarget::new(machine, format, DepthFormat::Unorm24, size)?;
        self.0 = Some((target, format, size));
        Ok(target)
    }
}
