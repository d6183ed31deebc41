//! Rasterisation of a triangle within a tile: coverage by exact edge functions, interpolation in single precision with
//! the steps defined by [`crate::raster`].

use refsim_lanes::{AnyLane, LANES, LaneRow, SimdLevel};

use crate::exec::lower::TRUE;
use crate::num::Format;
use crate::raster::{Plane, TriangleSetup, interpolated};
use crate::texture::Region;

/// Shape of a tile of 256 pixels. In `Square` and `Flat`, lanes of a quad differ in bits 0 (across) and 4 (down). In
/// `Line`, quads have no second row, so only programs that do not read neighbouring lanes can run in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum TileShape {
    /// 16 x 16.
    #[default]
    Square,
    /// 128 x 2, as a sequence of 16 x 2 blocks.
    Flat,
    /// 256 x 1.
    Line,
}

/// [`TileShape`] as const generic arguments.
const SQUARE: u8 = 0;
const FLAT: u8 = 1;
const LINE: u8 = 2;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TileFrame {
    /// Column and row of lane 0.
    pub(crate) origin: (u32, u32),
    /// Arrangement of the lanes.
    pub(crate) shape: TileShape,
}

impl TileFrame {
    /// The tile around a region: square if it fits, else flat, else a line. If both square and flat fit, lanes have the
    /// same positions in both.
    pub(crate) fn around(region: Region) -> Self {
        let (shape, height) = match () {
            () if (region.x & 15) + region.width <= 16 => (TileShape::Square, 16),
            () if (region.x & 127) + region.width <= 128 => (TileShape::Flat, 2),
            () => (TileShape::Line, 1),
        };
        let left = if shape == TileShape::Line { region.x & !255 } else { region.x & !15 };
        Self { origin: (left, region.y / height * height), shape }
    }

    /// Column and row of a lane in the target.
    pub(crate) fn pixel(self, lane: usize) -> (u32, u32) {
        let (x, y) = match self.shape {
            TileShape::Square => place::<SQUARE>(lane),
            TileShape::Flat => place::<FLAT>(lane),
            TileShape::Line => place::<LINE>(lane),
        };
        (self.origin.0 + x, self.origin.1 + y)
    }

    /// Lane of a pixel of the tile.
    pub(crate) fn lane(self, x: u32, y: u32) -> usize {
        let (x, y) = ((x - self.origin.0) as usize, (y - self.origin.1) as usize);
        let lane = match self.shape {
            TileShape::Square => y << 4 | x,
            TileShape::Flat => x & 15 | y << 4 | x >> 4 << 5,
            TileShape::Line => x,
        };
        lane & (LANES - 1)
    }
}

/// Column and row of a lane within its tile.
#[inline(always)]
const fn place<const SHAPE: u8>(lane: usize) -> (u32, u32) {
    match SHAPE {
        FLAT => ((lane & 15 | lane >> 5 << 4) as u32, (lane >> 4 & 1) as u32),
        LINE => (lane as u32, 0),
        _ => ((lane & 15) as u32, (lane >> 4) as u32),
    }
}

/// Computes the lanes that a triangle covers within `region`; returns their number.
pub(crate) fn cover(
    setup: &TriangleSetup,
    frame: TileFrame,
    region: Region,
    simd: SimdLevel,
    out: &mut LaneRow,
) -> u64 {
    let origin = frame.origin;
    let inside = region.intersect(setup.bounds);
    if inside.width == 0 || inside.height == 0 {
        out.fill(0);
        return 0;
    }
    // The whole tile is covered, so no lane needs its edge functions.
    if (inside.width * inside.height) as usize == LANES && setup.covers(inside) {
        out.fill(TRUE);
        return LANES as u64;
    }
    // A pixel is covered if value >= bias: after subtracting the bias, only the sign is left to test.
    let edges = setup.edges.map(|e| [e.a, e.b, e.at(origin.0, origin.1) - e.bias]);
    let columns = (inside.x - origin.0, inside.x - origin.0 + inside.width);
    let rows = (inside.y - origin.1, inside.y - origin.1 + inside.height);
    simd.run(
        #[inline(always)]
        || match frame.shape {
            TileShape::Square => cover_lanes::<SQUARE>(&edges, columns, rows, out),
            TileShape::Flat => cover_lanes::<FLAT>(&edges, columns, rows, out),
            TileShape::Line => cover_lanes::<LINE>(&edges, columns, rows, out),
        },
    );
    out.iter().map(|&m| u64::from(m & 1)).sum()
}

#[inline(always)]
fn cover_lanes<const SHAPE: u8>(edges: &[[i64; 3]; 3], columns: (u32, u32), rows: (u32, u32), out: &mut LaneRow) {
    for (i, lane) in out.iter_mut().enumerate() {
        let (x, y) = place::<SHAPE>(i);
        let at = |e: &[i64; 3]| e[0] * i64::from(x) + e[1] * i64::from(y) + e[2];
        let within = (x >= columns.0) & (x < columns.1) & (y >= rows.0) & (y < rows.1);
        // All three non-negative: no sign bit set.
        let signs = at(&edges[0]) | at(&edges[1]) | at(&edges[2]);
        *lane = if within & (signs >= 0) { TRUE } else { 0 };
    }
}

/// Finds the lanes of all quads that contain a covered lane.
pub(crate) fn quads(covered: &LaneRow, out: &mut LaneRow) {
    for (i, lane) in out.iter_mut().enumerate() {
        let (row, column) = (i & !16, i & !1);
        *lane = covered[row & column]
            | covered[(row & column) | 1]
            | covered[(row & column) | 16]
            | covered[(row & column) | 17];
    }
}

/// Weights of vertices 1 and 2 in every lane of a tile.
#[derive(Clone, Debug)]
pub(crate) struct TileWeights {
    simd: SimdLevel,
    linear: [[f32; LANES]; 2],
    perspective: [[f32; LANES]; 2],
    /// Inputs from which the weights were computed: edges 1 and 2, area, reciprocals of w.
    made_from: Option<Origin>,
}

/// Inputs of the weights within a tile.
type Origin = ([[i64; 3]; 2], u32, Option<[u32; 3]>, TileFrame);

impl TileWeights {
    pub(crate) fn new(simd: SimdLevel) -> Self {
        Self { simd, linear: [[0.0; LANES]; 2], perspective: [[0.0; LANES]; 2], made_from: None }
    }

    /// Computes the weights of a triangle, unless they equal the previous triangle's.
    pub(crate) fn make(&mut self, setup: &TriangleSetup, frame: TileFrame) {
        let edges = [1, 2].map(|i: usize| [setup.edges[i].a, setup.edges[i].b, setup.edges[i].c]);
        let w = (!setup.affine).then_some(setup.reciprocal_w);
        let made_from = Some((edges, setup.area_bits, w, frame));
        if self.made_from == made_from {
            return;
        }
        self.made_from = made_from;
        let local = [1, 2].map(|i: usize| {
            let e = &setup.edges[i];
            [e.a, e.b, e.at(frame.origin.0, frame.origin.1)]
        });
        let area = f32::from_bits(setup.area_bits);
        self.simd.run(
            #[inline(always)]
            || match frame.shape {
                TileShape::Square => linear::<SQUARE>(&local, area, &mut self.linear),
                TileShape::Flat => linear::<FLAT>(&local, area, &mut self.linear),
                TileShape::Line => linear::<LINE>(&local, area, &mut self.linear),
            },
        );
        match w {
            Some(w) => {
                let w = w.map(f32::from_bits);
                self.simd.run(
                    #[inline(always)]
                    || perspective(&self.linear, w, &mut self.perspective),
                );
            }
            None => self.perspective = self.linear,
        }
    }

    pub(crate) fn depth(&self, setup: &TriangleSetup, out: &mut LaneRow) {
        if setup.depth_constant {
            out.fill(setup.depth.base);
        } else {
            self.simd.run(
                #[inline(always)]
                || along(&setup.depth, &self.linear, out),
            );
        }
    }

    /// Computes a component of the window position in every lane, in single precision.
    pub(crate) fn position(&self, setup: &TriangleSetup, axis: usize, frame: TileFrame, out: &mut LaneRow) {
        let half = setup.half_pixels() as f32 * 0.5;
        match axis {
            0 | 1 => {
                for (i, slot) in out.iter_mut().enumerate() {
                    let (x, y) = frame.pixel(i);
                    let at = if axis == 0 { x } else { y };
                    *slot = (at as f32 + half).to_bits();
                }
            }
            2 => self.depth(setup, out),
            _ if setup.affine => out.fill(setup.reciprocal_w[0]),
            _ => self.simd.run(
                #[inline(always)]
                || along(&setup.reciprocal_w_plane(), &self.linear, out),
            ),
        }
    }

    /// Computes a varying component in every lane, in single precision; `format` is the format of the plane.
    pub(crate) fn plane(&self, plane: &Plane, format: Format, single: &AnyLane, out: &mut LaneRow) {
        if format == Format::FP32 {
            return self.simd.run(
                #[inline(always)]
                || along(plane, &self.perspective, out),
            );
        }
        for (i, slot) in out.iter_mut().enumerate() {
            let weights = [0, 1].map(|k: usize| single.encode(self.perspective[k][i].to_bits()));
            *slot = single.decode(interpolated(plane, weights, format));
        }
    }
}

/// Copies the lanes in `mask` from `from` to `to`.
#[inline(always)]
pub(crate) fn lay_over(to: &mut LaneRow, from: &LaneRow, mask: &LaneRow) {
    for i in 0..LANES {
        to[i] = (to[i] & !mask[i]) | (from[i] & mask[i]);
    }
}

#[inline(always)]
fn linear<const SHAPE: u8>(edges: &[[i64; 3]; 2], area: f32, out: &mut [[f32; LANES]; 2]) {
    for (e, row) in edges.iter().zip(out) {
        for (i, weight) in row.iter_mut().enumerate() {
            let (x, y) = place::<SHAPE>(i);
            *weight = (e[0] * i64::from(x) + e[1] * i64::from(y) + e[2]) as f32 / area;
        }
    }
}

#[inline(always)]
fn perspective(linear: &[[f32; LANES]; 2], w: [f32; 3], out: &mut [[f32; LANES]; 2]) {
    let [first, second] = out;
    for i in 0..LANES {
        let (l1, l2) = (linear[0][i], linear[1][i]);
        let l0 = (1.0 - l1) - l2;
        let (g0, g1, g2) = (l0 * w[0], l1 * w[1], l2 * w[2]);
        let sum = (g0 + g1) + g2;
        first[i] = g1 / sum;
        second[i] = g2 / sum;
    }
}

#[inline(always)]
fn along(plane: &Plane, weights: &[[f32; LANES]; 2], out: &mut LaneRow) {
    let [base, d1, d2] = [plane.base, plane.d1, plane.d2].map(f32::from_bits);
    for i in 0..LANES {
        out[i] = ((base + weights[0][i] * d1) + weights[1][i] * d2).to_bits();
    }
}
