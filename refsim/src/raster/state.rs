//! State of the rasteriser: viewport, conventions, culling, and the device's precision.

use serde::Deserialize;

use super::RasterError;
use crate::device::{Rules, SubpixelGrid, SubpixelRounding};
use crate::num::Format;
use crate::texture::{Region, value};

/// Maximum extent of a viewport and maximum distance from the origin, in pixels.
const MAX_PIXELS: u32 = 16_384;

/// A device's rasterisation rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterRules {
    /// Grid of window positions.
    pub subpixel_grid: SubpixelGrid,
    /// Rounding of a window position to the grid.
    pub subpixel_rounding: SubpixelRounding,
    /// Format in which components are interpolated. The weights are always FP32.
    pub iterator_format: Format,
}

impl From<&Rules> for RasterRules {
    fn from(rules: &Rules) -> Self {
        Self {
            subpixel_grid: rules.subpixel_grid,
            subpixel_rounding: rules.subpixel_rounding,
            iterator_format: rules.iterator_format,
        }
    }
}

/// The rectangle of a target that clip space maps to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    /// Left edge in pixels.
    pub x: i32,
    /// Smallest row, in pixels.
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
    /// A viewport at the origin with depth range 0 to 1.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { x: 0, y: 0, width, height, min_depth: value::ZERO, max_depth: value::ONE }
    }

    /// Validates the viewport.
    ///
    /// # Errors
    /// If an extent is zero or above 16384, or the viewport starts further than 16384 pixels from the origin.
    pub fn check(&self) -> Result<(), RasterError> {
        let sides = (1..=MAX_PIXELS).contains(&self.width) && (1..=MAX_PIXELS).contains(&self.height);
        if sides && self.x.unsigned_abs() <= MAX_PIXELS && self.y.unsigned_abs() <= MAX_PIXELS {
            return Ok(());
        }
        let Self { x, y, width, height, .. } = *self;
        Err(RasterError::Viewport { most: MAX_PIXELS, x, y, width, height })
    }

    /// The intersection of the viewport with a target of `region`.
    pub(super) fn region(&self, target: Region) -> Region {
        let low = |at: i32| at.max(0).unsigned_abs();
        let high = |at: i32, size: u32| (i64::from(at) + i64::from(size)).clamp(0, i64::from(u32::MAX)) as u32;
        let (x, y) = (low(self.x), low(self.y));
        let width = high(self.x, self.width).saturating_sub(x);
        let height = high(self.y, self.height).saturating_sub(y);
        Region { x, y, width, height }.intersect(target)
    }
}

/// Sample position within a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PixelCenter {
    /// At integer window coordinates (Direct3D 8 and 9).
    #[default]
    Direct3d,
    /// At integer plus one half (OpenGL).
    OpenGl,
}

/// Clip space convention of the vertex stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ClipSpace {
    /// `0 <= z <= w`; +y is up, row 0 is the upper row.
    #[default]
    Direct3d,
    /// `-w <= z <= w`; +y is up, row 0 is the lower row, as in `glReadPixels`.
    OpenGl,
}

/// Triangles to be culled, by their winding as seen with +y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Triangles with clockwise vertices.
    Clockwise,
    /// Triangles with counter-clockwise vertices (Direct3D's default).
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
    /// The only pixels that are drawn: the target's region, or a scissor rectangle within it.
    pub scissor: Region,
}
