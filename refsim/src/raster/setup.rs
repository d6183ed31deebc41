//! Triangle set-up: viewport transform, snapping, edge functions, attribute planes.

use super::RasterError;
use super::clip::{ClipVertex, clip, is_inside};
use super::fan::clipped_setup;
use super::interpolate::ComponentMask;
use super::plane::{plane, planes};
use super::vertex::{COMPONENTS, Vertex};
use crate::device::Rules;
use crate::num::Format;
use crate::texture::{Region, value};

/// How far past the viewport a triangle may reach before it is clipped, in viewports: 8 (FP32 bits).
pub(crate) const GUARD_BAND: u32 = 0x4100_0000;
/// Positions saturate here, in pixels either way. With 8 subpixel bits an edge function stays below 2^56.
pub(crate) const FARTHEST: i64 = 1 << 17;
/// The largest viewport side, and how far it may lie from the origin.
const MOST_PIXELS: u32 = 16_384;

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
        let sides = (1..=MOST_PIXELS).contains(&self.width) && (1..=MOST_PIXELS).contains(&self.height);
        if sides && self.x.unsigned_abs() <= MOST_PIXELS && self.y.unsigned_abs() <= MOST_PIXELS {
            return Ok(());
        }
        let Self { x, y, width, height, .. } = *self;
        Err(RasterError::Viewport { most: MOST_PIXELS, x, y, width, height })
    }

    /// The pixels of the viewport that a target of `region` has.
    fn region(&self, target: Region) -> Region {
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
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

/// One edge function: `a * x + b * y + c` at pixel (x, y), exact, at least 0 inside and growing inward.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    /// Change from one column to the next.
    pub a: i64,
    /// Change from one row to the next.
    pub b: i64,
    /// Value at pixel (0, 0).
    pub c: i64,
    /// 0 if pixels exactly on the edge are covered (a top or left edge), else 1: covered means value >= bias.
    pub bias: i64,
}

impl Edge {
    /// The value at a pixel's centre.
    pub fn at(&self, x: u32, y: u32) -> i64 {
        self.a * i64::from(x) + self.b * i64::from(y) + self.c
    }
}

/// One component over a triangle: `(base + l1 * d1) + l2 * d2`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane {
    /// Value at vertex 0; for a constant component the FP32 value delivered everywhere.
    pub base: u32,
    /// Value at vertex 1 less that at vertex 0, rounded.
    pub d1: u32,
    /// Value at vertex 2 less that at vertex 0, rounded.
    pub d2: u32,
}

/// A triangle ready to be walked.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleSetup {
    /// Edge `i` lies opposite vertex `i`; the three sum to `area` everywhere.
    pub edges: [Edge; 3],
    /// Twice the area in units of the position grid squared; above 0.
    pub area: i64,
    /// `area` rounded to FP32.
    pub area_bits: u32,
    /// The pixels that can be covered: bounding box within viewport and scissor; never empty.
    pub bounds: Region,
    /// Whether the vertices are clockwise as seen with +y up.
    pub clockwise: bool,
    /// Depth, in FP32 whatever the iterator format.
    pub depth: Plane,
    /// Whether the three depths are bit-equal.
    pub depth_constant: bool,
    /// Texture coordinates, colours and fog, in the order of [`super::COMPONENTS`], bits in `iterator_format`.
    pub planes: [Plane; COMPONENTS],
    /// The components whose three values are bit-equal.
    pub constant: ComponentMask,
    /// Where within a pixel its centre lies.
    pub center: PixelCenter,
    /// Whether the three w are bit-equal, so that nothing needs dividing by w.
    pub affine: bool,
    /// 1 / w of each vertex, FP32.
    pub reciprocal_w: [u32; 3],
    /// Format of the planes.
    pub iterator_format: Format,
}

/// Why a triangle, or what was left of it, is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dropped {
    /// A position is NaN or infinite, or became so.
    NotFinite,
    /// It lies outside a clip plane.
    Clipped,
    /// Its snapped vertices lie on a line, or snapping folded over what the clipper left.
    Degenerate,
    /// Its winding is culled.
    Culled,
    /// Its bounding box holds no pixel centre of viewport and scissor.
    NoPixels,
}

/// What became of a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SetupReport {
    /// Set-ups appended: 0, 1, or up to 8 if it was clipped.
    pub emitted: u32,
    /// Why nothing was appended, if so.
    pub dropped: Option<Dropped>,
}

/// Sets a triangle up and appends the result, or the results if clipping leaves more than three corners.
pub fn setup(
    triangle: [&Vertex; 3],
    state: &RasterState,
    rules: &RasterRules,
    out: &mut Vec<TriangleSetup>,
) -> SetupReport {
    match unclipped(triangle, state, rules) {
        Some(Ok(done)) => {
            out.push(done);
            SetupReport { emitted: 1, dropped: None }
        }
        Some(Err(why)) => SetupReport { emitted: 0, dropped: Some(why) },
        None => clipped_setup(&clip(triangle, state.clip_space), state, rules, out),
    }
}

/// Sets a triangle up if no clip plane cuts it; `None` if one does.
fn unclipped(
    triangle: [&Vertex; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Option<Result<TriangleSetup, Dropped>> {
    if triangle.iter().any(|v| v.position.iter().any(|&p| value::is_not_finite(p))) {
        return Some(Err(Dropped::NotFinite));
    }
    is_inside(&triangle, state.clip_space).then(|| whole(&triangle.map(ClipVertex::new), state, rules))
}

/// A corner in window space.
#[derive(Clone, Copy)]
pub(crate) struct Corner {
    /// Column and row in units of the snapping grid, at most [`FARTHEST`] pixels either way.
    pub(crate) x: i64,
    pub(crate) y: i64,
    /// FP32 bits, as is the other one.
    pub(crate) depth: u32,
    pub(crate) reciprocal_w: u32,
}

/// Viewport transform in FP32 steps, then snapping to the grid (nearest, halves up).
pub(super) fn to_window([x, y, z, w]: [u32; 4], state: &RasterState, subpixel_bits: u32) -> Option<Corner> {
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
    let far = FARTHEST << subpixel_bits;
    let snap = |c: u32| value::scaled_floor(c, 1, subpixel_bits, true).clamp(-far, far);
    Some(Corner { x: snap(window_x), y: snap(window_y), depth, reciprocal_w })
}

/// Sets up a triangle that needs no clipping.
fn whole(vertices: &[ClipVertex; 3], state: &RasterState, rules: &RasterRules) -> Result<TriangleSetup, Dropped> {
    let subpixel_bits = u32::from(rules.subpixel_bits.min(8));
    let [Some(c0), Some(c1), Some(c2)] = vertices.map(|v| to_window(v.position, state, subpixel_bits)) else {
        return Err(Dropped::NotFinite);
    };
    prepare(vertices, [c0, c1, c2], state, rules)
}

/// Twice the signed area in units of the snapping grid squared: positive is clockwise with rows downward.
pub(super) fn doubled_area([c0, c1, c2]: [Corner; 3]) -> i64 {
    (c1.x - c0.x) * (c2.y - c0.y) - (c2.x - c0.x) * (c1.y - c0.y)
}

/// Sets up a triangle whose window positions are known.
pub(super) fn prepare(
    vertices: &[ClipVertex; 3],
    corners: [Corner; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Result<TriangleSetup, Dropped> {
    let mut done = shape(corners, vertices.map(|v| v.position[3]), state, rules)?;
    (done.planes, done.constant) = planes(vertices, rules.iterator_format);
    Ok(done)
}

/// [`prepare`] without the planes, which are left zero.
pub(crate) fn shape(
    corners: [Corner; 3],
    ws: [u32; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Result<TriangleSetup, Dropped> {
    let subpixel_bits = u32::from(rules.subpixel_bits.min(8));
    let [c0, c1, c2] = corners;
    // Half-integer centres need one fraction bit.
    let unit_bits = subpixel_bits.max(1);
    let widen = |c: Corner| (c.x << (unit_bits - subpixel_bits), c.y << (unit_bits - subpixel_bits));
    let points = [widen(c0), widen(c1), widen(c2)];
    let signed = doubled_area(corners) << (2 * (unit_bits - subpixel_bits));
    if signed == 0 {
        return Err(Dropped::Degenerate);
    }
    // With rows downward a positive area is clockwise.
    let clockwise = (signed > 0) == (state.clip_space == ClipSpace::Direct3d);
    match state.cull {
        Cull::Clockwise if clockwise => return Err(Dropped::Culled),
        Cull::CounterClockwise if !clockwise => return Err(Dropped::Culled),
        _ => {}
    }
    let center = match state.center {
        PixelCenter::Direct3d => 0,
        PixelCenter::OpenGl => 1 << (unit_bits - 1),
    };
    let bounds = bounding_box(points, center, unit_bits).intersect(state.viewport.region(state.scissor));
    if bounds.width == 0 || bounds.height == 0 {
        return Err(Dropped::NoPixels);
    }
    let sign = signed.signum();
    let edge = |p: (i64, i64), q: (i64, i64)| edge_through(p, q, sign, center, unit_bits);
    let area = signed.abs();
    let depths = [c0.depth, c1.depth, c2.depth];
    Ok(TriangleSetup {
        edges: [edge(points[1], points[2]), edge(points[2], points[0]), edge(points[0], points[1])],
        area,
        area_bits: value::from_integer(area),
        bounds,
        clockwise,
        depth: plane(depths, Format::FP32),
        depth_constant: depths[0] == depths[1] && depths[1] == depths[2],
        planes: [Plane::default(); COMPONENTS],
        constant: ComponentMask::NONE,
        center: state.center,
        affine: ws[0] == ws[1] && ws[1] == ws[2],
        reciprocal_w: [c0.reciprocal_w, c1.reciprocal_w, c2.reciprocal_w],
        iterator_format: rules.iterator_format,
    })
}

/// The edge function through p and q, turned so that it grows inward, as a function of the pixel.
fn edge_through(p: (i64, i64), q: (i64, i64), sign: i64, center: i64, unit_bits: u32) -> Edge {
    let a = (p.1 - q.1) * sign;
    let b = (q.0 - p.0) * sign;
    let c = a * (center - p.0) + b * (center - p.1);
    // A left edge has the inside to its right; a top edge is horizontal with the inside at larger rows.
    let top_left = a > 0 || (a == 0 && b > 0);
    Edge { a: a << unit_bits, b: b << unit_bits, c, bias: i64::from(!top_left) }
}

/// The pixels whose centres lie within the box of the points.
fn bounding_box(points: [(i64, i64); 3], center: i64, unit_bits: u32) -> Region {
    let span = |values: [i64; 3]| {
        let low = values.into_iter().fold(i64::MAX, i64::min) - center;
        let high = values.into_iter().fold(i64::MIN, i64::max) - center;
        let first = -((-low) >> unit_bits); // ceiling
        let last = high >> unit_bits;
        let start = first.max(0);
        (start as u32, (last + 1 - start).max(0) as u32)
    };
    let (x, width) = span(points.map(|p| p.0));
    let (y, height) = span(points.map(|p| p.1));
    Region { x, y, width, height }
}
