//! Viewport transform and clip tests of vertices in rows, in single precision with the steps defined by
//! [`crate::raster`].

use rayon::prelude::*;
use refsim_lanes::SimdLevel;

use super::rows::VertexRows;
use crate::device::SubpixelRounding;
use crate::raster::{ClipSpace, Corner, FARTHEST, GUARD_BAND, LEAST_W, RasterRules, RasterState, cut_origin};

/// Vertices per task.
const SPAN: usize = 4096;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ClipResult {
    /// Inside all planes.
    Inside,
    /// Outside at least one plane.
    Outside,
    /// The position is not finite.
    NotFinite,
    /// Inside all planes, but the window position is not finite.
    Lost,
}

impl ClipResult {
    const ALL: [ClipResult; 4] = [Self::Inside, Self::Lost, Self::Outside, Self::NotFinite];
}

/// Window positions of a range of vertices.
#[derive(Debug, Default)]
struct WindowSpan {
    /// Index into [`ClipResult::ALL`].
    flags: Vec<u32>,
    x: Vec<i32>,
    y: Vec<i32>,
    depth: Vec<u32>,
    reciprocal_w: Vec<u32>,
}

/// Window positions of all vertices.
#[derive(Debug)]
pub(crate) struct Window {
    spans: Vec<WindowSpan>,
}

/// Parameters shared by all vertices.
#[derive(Clone, Copy)]
struct ViewportTransform {
    half: [f32; 2],
    middle: [f32; 2],
    depths: [f32; 2],
    least_w: f32,
    band: f32,
    snap: Snap,
}

/// Snapping of positions to the grid.
#[derive(Clone, Copy)]
struct Snap {
    /// Grid lines per pixel, and the largest index of a grid line.
    grid: f64,
    far: f64,
    /// Number that is added before rounding down, in grid units.
    half: f64,
    /// Positions below this are rounded up.
    origin: f64,
}

impl Window {
    pub(crate) fn new(rows: &VertexRows, state: &RasterState, rules: &RasterRules, simd: SimdLevel) -> Self {
        let v = &state.viewport;
        let grid = f64::from(rules.subpixel_grid.lines());
        let (half, origin) = match rules.subpixel_rounding {
            SubpixelRounding::Nearest => (0.5, f64::NEG_INFINITY),
            SubpixelRounding::Cut => (0.0, f32::from_bits(cut_origin(state.center)).into()),
        };
        let transform = ViewportTransform {
            half: [v.width, v.height].map(|size| size as f32 * 0.5),
            middle: [(v.x, v.width), (v.y, v.height)]
                .map(|(at, size)| (2 * i64::from(at) + i64::from(size)) as f32 * 0.5),
            depths: [v.min_depth, v.max_depth].map(f32::from_bits),
            least_w: f32::from_bits(LEAST_W),
            band: f32::from_bits(GUARD_BAND),
            snap: Snap { grid, far: FARTHEST as f64 * grid, half, origin },
        };
        let total = rows.position[3].len();
        let span = |i: usize| {
            let part = |row: &'_ Vec<u32>| i * SPAN..row.len().min((i + 1) * SPAN);
            let [x, y, z, w] = rows.position.each_ref().map(|row| &row[part(row)]);
            let mut out = WindowSpan::zeros(x.len());
            simd.run(
                #[inline(always)]
                || match state.clip_space {
                    ClipSpace::Direct3d => out.fill::<false>([x, y, z, w], &transform),
                    ClipSpace::OpenGl => out.fill::<true>([x, y, z, w], &transform),
                },
            );
            out
        };
        let count = total.div_ceil(SPAN);
        let spans = match count {
            0 | 1 => (0..count).map(span).collect(),
            _ => (0..count).into_par_iter().map(span).collect(),
        };
        Self { spans }
    }

    pub(crate) fn clipped(&self, vertex: usize) -> ClipResult {
        ClipResult::ALL[self.spans[vertex / SPAN].flags[vertex % SPAN] as usize & 3]
    }

    /// Window position of a vertex that is inside all clip planes.
    pub(crate) fn corner(&self, vertex: usize) -> Corner {
        let (span, i) = (&self.spans[vertex / SPAN], vertex % SPAN);
        Corner { x: span.x[i].into(), y: span.y[i].into(), depth: span.depth[i], reciprocal_w: span.reciprocal_w[i] }
    }
}

impl WindowSpan {
    fn zeros(count: usize) -> Self {
        Self {
            flags: vec![0; count],
            x: vec![0; count],
            y: vec![0; count],
            depth: vec![0; count],
            reciprocal_w: vec![0; count],
        }
    }

    #[inline(always)]
    fn fill<const GL: bool>(&mut self, [xs, ys, zs, ws]: [&[u32]; 4], transform: &ViewportTransform) {
        let count = xs.len();
        let (ys, zs, ws) = (&ys[..count], &zs[..count], &ws[..count]);
        let (flags, to_x, to_y) = (&mut self.flags[..count], &mut self.x[..count], &mut self.y[..count]);
        let (depths, reciprocals) = (&mut self.depth[..count], &mut self.reciprocal_w[..count]);
        let ViewportTransform { half, middle, least_w, band, snap, depths: [near, distant] } = *transform;
        for i in 0..count {
            let [x, y, z, w] = [xs[i], ys[i], zs[i], ws[i]].map(f32::from_bits);
            let finite = is_finite(x) & is_finite(y) & is_finite(z) & is_finite(w);
            let edge = w * band;
            let front = if GL { z + w } else { z };
            let inside = (w - least_w >= 0.0)
                & (front >= 0.0)
                & (w - z >= 0.0)
                & (edge + x >= 0.0)
                & (edge - x >= 0.0)
                & (edge + y >= 0.0)
                & (edge - y >= 0.0);
            let (dx, dy) = (x / w * half[0], y / w * half[1]);
            let window_x = middle[0] + dx;
            let window_y = if GL { middle[1] + dy } else { middle[1] - dy };
            let ndc_z = if GL { z / w * 0.5 + 0.5 } else { z / w };
            let depth = ndc_z * (distant - near) + near;
            let reciprocal = 1.0 / w;
            let arrived = is_finite(window_x) & is_finite(window_y) & is_finite(depth) & is_finite(reciprocal);
            // Index into `ClipResult::ALL`: 1 lost, 2 outside, 3 not finite.
            flags[i] = u32::from(inside & !arrived) | (u32::from(!inside) << 1) | (u32::from(!finite) * 3);
            to_x[i] = snapped(window_x, snap);
            to_y[i] = snapped(window_y, snap);
            depths[i] = depth.to_bits();
            reciprocals[i] = reciprocal.to_bits();
        }
    }
}

#[inline(always)]
fn is_finite(x: f32) -> bool {
    x.abs() < f32::INFINITY
}

/// Snaps a window coordinate to a line of the subpixel grid, clamped to ±`far`. Near a rounding boundary
/// `x * grid + half` is exact in double precision.
#[inline(always)]
fn snapped(x: f32, Snap { grid, far, half, origin }: Snap) -> i32 {
    let x = f64::from(x);
    let line = if x < origin { (x * grid).ceil() } else { (x * grid + half).floor() };
    let low = if line > -far { line } else { -far };
    (if low < far { low } else { far }) as i32
}
