//! Window positions: viewport transform and snapping to the grid.

use super::state::{ClipSpace, PixelCenter, RasterRules, RasterState};
use crate::device::SubpixelRounding;
use crate::texture::value;

/// Limit at which positions saturate, in pixels from the origin. With 256 grid lines per pixel, an edge function is
/// below 2^56.
pub(crate) const FARTHEST: i64 = 1 << 17;

const SIGN: u32 = 1 << 31;

/// A corner in window space.
#[derive(Clone, Copy)]
pub(crate) struct Corner {
    /// Column and row in units of the snapping grid, at most [`FARTHEST`] pixels in magnitude.
    pub(crate) x: i64,
    pub(crate) y: i64,
    /// Depth and 1 / w, as FP32 bits.
    pub(crate) depth: u32,
    pub(crate) reciprocal_w: u32,
}

/// Applies the viewport transform in FP32 operations and snaps to the grid.
pub(super) fn to_window([x, y, z, w]: [u32; 4], state: &RasterState, rules: &RasterRules) -> Option<Corner> {
    let v = &state.viewport;
    // Half extents and centre are exact in FP32.
    let halves = |n: i64| value::mul(value::from_integer(n), value::HALF);
    let half = |size: u32| halves(i64::from(size));
    let middle = |at: i32, size: u32| halves(2 * i64::from(at) + i64::from(size));
    let (dx, dy) = (value::mul(value::div(x, w), half(v.width)), value::mul(value::div(y, w), half(v.height)));
    let window_x = value::add(middle(v.x, v.width), dx);
    let (window_y, ndc_z) = match state.clip_space {
        ClipSpace::Direct3d => (value::sub(middle(v.y, v.height), dy), value::div(z, w)),
        ClipSpace::OpenGl => {
            let halved = value::mul(value::div(z, w), value::HALF);
            (value::add(middle(v.y, v.height), dy), value::add(halved, value::HALF))
        }
    };
    let depth = value::add(value::mul(ndc_z, value::sub(v.max_depth, v.min_depth)), v.min_depth);
    let reciprocal_w = value::div(value::ONE, w);
    if [window_x, window_y, depth, reciprocal_w].into_iter().any(value::is_not_finite) {
        return None;
    }
    let lines = rules.subpixel_grid.lines();
    let far = FARTHEST * i64::from(lines);
    let snap = |c: u32| {
        let line = match rules.subpixel_rounding {
            SubpixelRounding::Nearest => value::scaled_floor(c, lines, 0, true),
            SubpixelRounding::Cut if c > cut_origin(state.center) => -value::scaled_floor(c ^ SIGN, lines, 0, false),
            SubpixelRounding::Cut => value::scaled_floor(c, lines, 0, false),
        };
        line.clamp(-far, far)
    };
    Some(Corner { x: snap(window_x), y: snap(window_y), depth, reciprocal_w })
}

/// The column or row toward which [`SubpixelRounding::Cut`] rounds, as an FP32 pattern with its sign set: the corner of
/// the first pixel, where the hardware's window begins. Among such patterns, a smaller number has a larger pattern.
pub(crate) fn cut_origin(center: PixelCenter) -> u32 {
    match center {
        PixelCenter::Direct3d => SIGN | value::HALF,
        PixelCenter::OpenGl => SIGN | value::ZERO,
    }
}

/// Twice the signed area in units of the squared snapping grid; positive is clockwise with rows downward.
pub(super) fn doubled_area([c0, c1, c2]: [Corner; 3]) -> i64 {
    (c1.x - c0.x) * (c2.y - c0.y) - (c2.x - c0.x) * (c1.y - c0.y)
}
