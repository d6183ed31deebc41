//! Triangles after set-up: edge functions, bounds and attribute planes.

use super::clip::ClipVertex;
use super::plane::{Plane, plane, planes};
use super::state::{ClipSpace, Cull, PixelCenter, RasterRules, RasterState};
use super::vertex::{COMPONENTS, ComponentMask};
use super::window::{Corner, doubled_area};
use crate::num::Format;
use crate::texture::{Region, value};

/// An edge function: `a * x + b * y + c` at pixel (x, y), exact, non-negative inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    /// Change from one column to the next.
    pub a: i64,
    /// Change from one row to the next.
    pub b: i64,
    /// Value at pixel (0, 0).
    pub c: i64,
    /// 0 if pixels exactly on the edge are covered (top and left edges), else 1; a pixel is inside if value >= bias.
    pub bias: i64,
}

impl Edge {
    /// The value at a pixel's centre.
    pub fn at(&self, x: u32, y: u32) -> i64 {
        self.a * i64::from(x) + self.b * i64::from(y) + self.c
    }
}

/// A triangle after set-up.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleSetup {
    /// Edge `i` is opposite to vertex `i`; the three functions sum to `area` everywhere.
    pub edges: [Edge; 3],
    /// Twice the area in units of the position grid squared; above 0.
    pub area: i64,
    /// `area` rounded to FP32.
    pub area_bits: u32,
    /// Pixels that may be covered: the bounding box within viewport and scissor; never empty.
    pub bounds: Region,
    /// `true` if the vertices are in clockwise order, seen with +y up.
    pub clockwise: bool,
    /// Depth, in FP32 with any iterator format.
    pub depth: Plane,
    /// `true` if the three depths are bit-equal.
    pub depth_constant: bool,
    /// Texture coordinates, colours and fog, in the order of [`super::COMPONENTS`], bits in `iterator_format`.
    pub planes: [Plane; COMPONENTS],
    /// The components whose three values are bit-equal.
    pub constant: ComponentMask,
    /// Sample position within a pixel.
    pub center: PixelCenter,
    /// `true` if the three w are bit-equal, so that no perspective division is needed.
    pub affine: bool,
    /// 1 / w of each vertex, FP32.
    pub reciprocal_w: [u32; 3],
    /// Format of the planes.
    pub iterator_format: Format,
}

/// Reason for which a triangle, or a part of it after clipping, is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dropped {
    /// A position is NaN or infinite, or overflowed.
    NotFinite,
    /// Outside a clip plane.
    Clipped,
    /// The snapped vertices are collinear, or snapping inverted the clipped polygon.
    Degenerate,
    /// The winding is culled.
    Culled,
    /// The bounding box contains no pixel centre within viewport and scissor.
    NoPixels,
}

/// Result of setting up a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SetupReport {
    /// Number of set-ups appended: 0, 1, or up to 8 if the triangle was clipped.
    pub emitted: u32,
    /// The reason, if nothing was appended.
    pub dropped: Option<Dropped>,
}

/// Sets up a triangle with known window positions.
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

/// [`prepare`] without attribute planes, which are zero.
pub(crate) fn shape(
    corners: [Corner; 3],
    ws: [u32; 3],
    state: &RasterState,
    rules: &RasterRules,
) -> Result<TriangleSetup, Dropped> {
    let lines = i64::from(rules.subpixel_grid.lines());
    let [c0, c1, c2] = corners;
    // Half-integer centres need an even number of lines per pixel.
    let unit = lines.max(2);
    let widen = |c: Corner| (c.x * (unit / lines), c.y * (unit / lines));
    let points = [widen(c0), widen(c1), widen(c2)];
    let signed = doubled_area(corners) * (unit / lines) * (unit / lines);
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
        PixelCenter::OpenGl => unit / 2,
    };
    let bounds = bounding_box(points, center, unit).intersect(state.viewport.region(state.scissor));
    if bounds.width == 0 || bounds.height == 0 {
        return Err(Dropped::NoPixels);
    }
    let sign = signed.signum();
    let edge = |p: (i64, i64), q: (i64, i64)| edge_through(p, q, sign, center, unit);
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

/// The edge function through p and q, with `unit` lines per pixel, as a function of the pixel; positive inside.
fn edge_through(p: (i64, i64), q: (i64, i64), sign: i64, center: i64, unit: i64) -> Edge {
    let a = (p.1 - q.1) * sign;
    let b = (q.0 - p.0) * sign;
    let c = a * (center - p.0) + b * (center - p.1);
    // A left edge has the interior to its right; a top edge is horizontal with the interior at larger rows.
    let top_left = a > 0 || (a == 0 && b > 0);
    Edge { a: a * unit, b: b * unit, c, bias: i64::from(!top_left) }
}

/// The pixels whose centres lie within the bounding box of the points.
fn bounding_box(points: [(i64, i64); 3], center: i64, unit: i64) -> Region {
    let span = |values: [i64; 3]| {
        let low = values.into_iter().fold(i64::MAX, i64::min) - center;
        let high = values.into_iter().fold(i64::MIN, i64::max) - center;
        let first = -(-low).div_euclid(unit); // ceiling
        let last = high.div_euclid(unit);
        let start = first.max(0);
        (start as u32, (last + 1 - start).max(0) as u32)
    };
    let (x, width) = span(points.map(|p| p.0));
    let (y, height) = span(points.map(|p| p.1));
    Region { x, y, width, height }
}
