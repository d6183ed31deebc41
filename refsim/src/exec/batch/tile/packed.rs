//! Packing of small triangles: their fragments share the lanes of a batch, as hardware packs quads. A triangle of a few
//! pixels then costs a few lanes instead of a whole tile.
//!
//! A lane holds a pixel of some triangle, with the values of that triangle. Several lanes may hold the same pixel, so
//! the output stage processes fragments in order of submission. For programs that read neighbouring lanes, whole quads
//! are packed, including helper lanes.

use refsim_lanes::{LANES, LaneRow, SimdLevel};

use super::raster::TileFrame;
use crate::exec::Overrun;
use crate::exec::batch::vertex::Surfaces;
use crate::raster::TriangleSetup;
use crate::texture::Region;

/// Maximum size in pixels of a packed triangle's bounding box within the tile.
const SMALL: u32 = 64;
/// Minimum number of consecutive small triangles for packing.
const MIN_TRIANGLES: usize = 4;
/// Number of used lanes above which a batch is shaded without waiting, if the next triangle does not fit.
const WORTH: usize = 3 * LANES / 4;

/// A lane's pixel and inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedFragment {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) triangle: u32,
    pub(crate) tile_lane: u8,
    /// `false` for helper lanes of a quad.
    pub(crate) covered: bool,
    pub(super) shape: u32,
    pub(super) planes: u32,
    /// Screen-space weights of vertices 1 and 2.
    pub(super) linear: [f32; 2],
    /// Interpolated depth, single precision.
    pub(crate) depth: u32,
}

/// Lanes of a batch of small triangles.
#[derive(Debug)]
pub(crate) struct PackedLanes {
    pub(super) simd: SimdLevel,
    /// `true` if lanes form quads, by bits 0 (across) and 4 (down) of their indices, as in a tile.
    quads: bool,
    fragments: Vec<PackedFragment>,
    /// Number of leading fragments that passed the early depth test.
    pub(crate) tested: usize,
    pub(crate) covered: LaneRow,
    pub(crate) run: LaneRow,
    pub(crate) depth: LaneRow,
    pub(super) linear: [[f32; LANES]; 2],
    pub(super) perspective: [[f32; LANES]; 2],
}

/// Number of leading triangles of `order` that are small and may share a batch; 0 if packing them is not worthwhile.
pub(crate) fn packable(surfaces: &Surfaces, order: &[u32], region: Region, given: &[Vec<u32>]) -> usize {
    let Some(&first) = order.first() else { return 0 };
    let shares = |&triangle: &u32| {
        // Most draws of large triangles end here, before the triangles' values are compared.
        setup(surfaces, triangle).is_some_and(|(_, setup)| is_small(region.intersect(setup.bounds)))
            && given.iter().all(|values| values[triangle as usize] == values[first as usize])
    };
    let count = order.iter().take_while(|triangle| shares(triangle)).count();
    if count < MIN_TRIANGLES { 0 } else { count }
}

fn is_small(part: Region) -> bool {
    part.width * part.height <= SMALL
}

fn setup(surfaces: &Surfaces, triangle: u32) -> Option<((u32, u32), &TriangleSetup)> {
    let found = surfaces.triangles.get(triangle as usize)?;
    Some(((found.shape, found.planes), surfaces.shapes.get(found.shape as usize)?))
}

impl PackedLanes {
    pub(crate) fn new(simd: SimdLevel) -> Self {
        Self {
            simd,
            quads: false,
            fragments: Vec::with_capacity(LANES),
            tested: 0,
            covered: [0; LANES],
            run: [0; LANES],
            depth: [0; LANES],
            linear: [[0.0; LANES]; 2],
            perspective: [[0.0; LANES]; 2],
        }
    }

    pub(crate) fn clear(&mut self, quads: bool) {
        self.quads = quads;
        self.tested = 0;
        self.fragments.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.fragments.is_empty()
    }

    /// Returns `true` if enough lanes are in use for shading.
    pub(crate) fn is_worth_shading(&self) -> bool {
        self.fragments.len() > WORTH
    }

    /// Returns `true` if a triangle's fragments are guaranteed to fit.
    pub(crate) fn has_room(&self, surfaces: &Surfaces, triangle: u32, region: Region) -> bool {
        let Some((_, setup)) = setup(surfaces, triangle) else { return true };
        let part = region.intersect(setup.bounds);
        let lanes = match self.quads {
            false => part.width * part.height,
            true => {
                let span = |first: u32, count: u32| (first + count).div_ceil(2) - first / 2;
                4 * span(part.x, part.width) * span(part.y, part.height)
            }
        };
        self.fragments.len() + lanes as usize <= LANES
    }

    /// Adds a triangle, which must fit; returns the number of its fragments.
    pub(crate) fn add(&mut self, surfaces: &Surfaces, triangle: u32, frame: TileFrame, region: Region) -> u64 {
        let Some(((shape, planes), setup)) = setup(surfaces, triangle) else { return 0 };
        let part = region.intersect(setup.bounds);
        let area = f32::from_bits(setup.area_bits);
        let [base, d1, d2] = [setup.depth.base, setup.depth.d1, setup.depth.d2].map(f32::from_bits);
        let fragment = |x: u32, y: u32, edges: [i64; 3], covered: bool| {
            let linear = [1, 2].map(|i: usize| (edges[i] + setup.edges[i].bias) as f32 / area);
            let along = (base + linear[0] * d1) + linear[1] * d2;
            let depth = if setup.depth_constant { setup.depth.base } else { along.to_bits() };
            let tile_lane = frame.lane(x, y) as u8;
            PackedFragment { x, y, triangle, tile_lane, covered, shape, planes, linear, depth }
        };
        // Non-negative at pixels inside the triangle.
        let edges = |x: u32, y: u32| [0, 1, 2].map(|i: usize| setup.edges[i].at(x, y) - setup.edges[i].bias);
        let right = |e: [i64; 3]| [0, 1, 2].map(|i: usize| e[i] + setup.edges[i].a);
        let inside = |e: [i64; 3]| (e[0] | e[1] | e[2]) >= 0;
        let mut count = 0;
        if !self.quads {
            for y in part.y..part.y + part.height {
                let mut e = edges(part.x, y);
                for x in part.x..part.x + part.width {
                    if inside(e) {
                        self.fragments.push(fragment(x, y, e, true));
                        count += 1;
                    }
                    e = right(e);
                }
            }
            return count;
        }
        let within = |x: u32, y: u32| x.wrapping_sub(part.x) < part.width && y.wrapping_sub(part.y) < part.height;
        for y in (part.y & !1..part.y + part.height).step_by(2) {
            for x in (part.x & !1..part.x + part.width).step_by(2) {
                let lanes = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| {
                    let e = edges(x, y);
                    fragment(x, y, e, within(x, y) && inside(e))
                });
                let covered = lanes.iter().filter(|lane| lane.covered).count() as u64;
                if covered > 0 {
                    self.fragments.extend(lanes);
                    count += covered;
                }
            }
        }
        count
    }

    /// Keeps the untested fragments for which `passes` returns `true`, given their index among the untested.
    pub(crate) fn retain(&mut self, mut passes: impl FnMut(usize, &PackedFragment) -> bool) {
        let mut kept = self.tested;
        for at in self.tested..self.fragments.len() {
            let fragment = self.fragments[at];
            if passes(at - self.tested, &fragment) {
                self.fragments[kept] = fragment;
                kept += 1;
            }
        }
        self.fragments.truncate(kept);
        self.tested = kept;
    }

    pub(crate) fn untested_depths(&self) -> LaneRow {
        let mut row = [0; LANES];
        for (depth, fragment) in row.iter_mut().zip(&self.fragments[self.tested..]) {
            *depth = fragment.depth;
        }
        row
    }

    /// Fragments in order of submission, each with its lane.
    pub(crate) fn fragments(&self) -> impl Iterator<Item = (usize, &PackedFragment)> {
        let quads = self.quads;
        let lane = move |at: usize| match quads {
            false => at,
            // Eight quads per 32 lanes.
            true => at >> 5 << 5 | (at >> 2 & 7) << 1 | at & 1 | (at >> 1 & 1) << 4,
        };
        self.fragments.iter().enumerate().map(move |(at, fragment)| (lane(at), fragment))
    }

    /// The first fragment that was stopped by the step budget; `cut` is by lane.
    pub(crate) fn overrun(&self, cut: &[(usize, usize)]) -> Option<Overrun> {
        let of = |(lane, &PackedFragment { x, y, triangle, .. }): (usize, &PackedFragment)| {
            let (_, instruction) = *cut.iter().find(|(of, _)| *of == lane)?;
            Some(Overrun { triangle, y, x, instruction })
        };
        if cut.is_empty() { None } else { self.fragments().filter_map(of).min() }
    }
}
