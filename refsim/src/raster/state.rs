//! The state of the rasteriser: viewport, conventions, culling, and what a device says about precision.

use serde::Deserialize;

use super::RasterError;
use crate::device::Rules;
use crate::num::Format;
use crate::texture::{Region, value};

/// The largest viewport side, and how far it may lie from the origin.
const MAX_PIXELS: u32 = 16_384;

/// What a device says about rasterisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterRules {
    /// Fraction bits of a window position, 0 to 8.
    pub subpixel_bits: u8,
    /// Format in which components are interpolated. The weights are FP32 in any case.
    pub iterator_format: Format,
}

impl From<&Rules> for RasterRules {
    fn from(rules: &Rules) -> Self {
        Self { subpixel_bits: rules.subpixel_bits, iterator_format: rules.iterator_format }
    }
}

/// The part of a target that clip space maps to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    /// Left edge in pixels.
    pub x: i32,
    /// Edge with the smallest row, in pixels.
    pub y: i32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Depth of the near plane, FP32 bits.
    pub min_depth: u32,
    /// Depth of the far plane, FP32 bits.
    pub max_depth: u32,
}

impl Viewport {
    /// A viewport from the origin with depths 0 to 1.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { x: 0, y: 0, width, height, min_depth: value::ZERO, max_depth: value::ONE }
    }

    /// Whether the set-up can use it.
    ///
    /// # Errors
    /// If a side is zero or above 16384, or it lies further than that from the origin.
    pub fn check(&self) -> Result<(), RasterError> {
        let sides = (1..=MAX_PIXELS).contains(&self.width) && (1..=MAX_PIXELS).contains(&self.height);
        if sides && self.x.unsigned_abs() <= MAX_PIXELS && self.y.unsigned_abs() <= MAX_PIXELS {
            return Ok(());
        }
        let Self { x, y, width, height, .. } = *self;
        Err(RasterError::Viewport { most: MAX_PIXELS, x, y, width, height })
    }

    /// The pixels of the viewport that a target of `region` has.
    pub(super) fn region(&self, target: Region) -> Region {
        let low = |at: i32| at.max(0).unsigned_abs();
        let high = |at: i32, size: u32| (i64::from(at) + i64::from(size)).clamp(0, i64::from(u32::MAX)) as u32;
        let (x, y) = (low(self.x), low(self.y));
        let width = high(self.x, self.width).saturating_sub(x);
        let height = high(self.y, self.height).saturating_sub(y);
        Region { x, y, width, height }.intersect(target)
    }
}

/// Where within a pixel it is decided whether the pixel is covered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelCenter {
    /// At integer window coordinates (Direct3D 8 and 9).
    #[default]
    Direct3d,
    /// At integer plus one half (OpenGL).
    OpenGl,
}

/// Which clip space the vertex stage writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ClipSpace {
    /// `0 <= z <= w`; +y is up, row 0 is the upper row.
    #[default]
    Direct3d,
    /// `-w <= z <= w`; +y is up, row 0 is the lower row, as `glReadPixels` has it.
    OpenGl,
}

/// Which triangles are left out, by their winding as seen with +y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those with clockwise vertices.
    Clockwise,
    /// Those with counter-clockwise vertices (Direct3D's default).
    CounterClockwise,
}

/// The state of the rasteriser.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterState {
    /// The viewport.
    pub viewport: Viewport,
    /// Pixel centres.
    pub center: PixelCenter,
    /// Clip space.
    pub clip_space: ClipSpace,
    /// Culling.
    pub cull: Cull,
    /// Pixels outside are never drawn: the target, or a scissor within it.
    pub scissor: Region,
}
