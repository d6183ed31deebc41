//! Shading of one tile: rows of previous triangles are reused while valid.
//!
//! A *part* is a sequence of triangles with equal constant components that cover disjoint pixels of the tile: the two
//! halves of a quad, or neighbours in a mesh. One pass of the program processes all of them, each lane with the
//! components of its triangle. Bits and counts are the same as for processing the triangles one by one.

use refsim_lanes::{LANES, LaneRow, SimdLevel, Slots};

use super::packed::PackedLanes;
use super::raster::{TileFrame, TileShape, TileWeights, cover, lay_over, quads};
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::vertex::Surfaces;
use crate::exec::lower::{Arith, Slot};
use crate::raster::Plane;
use crate::texture::Region;

/// Maximum number of triangles per part.
const MAX_MEMBERS: usize = 16;

/// A triangle of a part, within the tile.
#[derive(Debug)]
struct Member {
    shape: u32,
    planes: u32,
    cover: LaneRow,
    weights: TileWeights,
}

/// Buffers of a worker, used for one tile after the other.
#[derive(Debug)]
pub(crate) struct TileShader {
    simd: SimdLevel,
    frame: TileFrame,
    region: Region,
    pub(crate) slots: Slots,
    members: Vec<Member>,
    /// Number of members in the part.
    used: usize,
    /// Shape of the next triangle, if it did not fit because it overlaps pixels of the part.
    closed_by: Option<u32>,
    /// Pixels of the part, their number, and the lanes of quads that contain such a pixel.
    pub(crate) covered: LaneRow,
    pub(crate) covered_count: u64,
    pub(crate) run: LaneRow,
    pub(crate) depth: LaneRow,
    /// `true` if the rows of varying components are valid for the part.
    inputs_hold: bool,
    /// Lanes of small triangles.
    pub(crate) packed: PackedLanes,
}

/// Slots of the varying inputs.
#[derive(Clone, Debug, Default)]
pub(crate) struct InputSlots {
    /// For each component: its row in the surfaces, and its slot.
    pub(crate) rows: Vec<(usize, Slot)>,
    /// For each component of the window position: its index, and its slot.
    pub(crate) position: Vec<(usize, Slot)>,
}

/// Rules for grouping triangles into parts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartMode {
    /// `true` if triangles may share a pass.
    pub(crate) together: bool,
    /// `true` if the interpolated depth is needed.
    pub(crate) depth: bool,
    /// Components that are constant over every triangle, passed to the program per triangle.
    pub(crate) given: u64,
}

impl TileShader {
    pub(crate) fn new(slots: usize, simd: SimdLevel) -> Self {
        Self {
            simd,
            frame: TileFrame::default(),
            region: Region::default(),
            slots: Slots::new(slots),
            members: Vec::new(),
            used: 0,
            closed_by: None,
            covered: [0; LANES],
            covered_count: 0,
            run: [0; LANES],
            depth: [0; LANES],
            inputs_hold: false,
            packed: PackedLanes::new(simd),
        }
    }

    pub(crate) fn simd(&self) -> SimdLevel {
        self.simd
    }

    pub(crate) fn frame(&self) -> TileFrame {
        self.frame
    }

    /// Starts a tile; discards results for other tiles and other surfaces.
    pub(crate) fn start(&mut self, region: Region) {
        self.frame = TileFrame::around(region);
        self.region = region;
        self.used = 0;
        self.inputs_hold = false;
    }

    /// Takes triangles from the start of `order`, at least one; returns their number.
    pub(crate) fn take(&mut self, surfaces: &Surfaces, order: &[u32], manner: PartMode) -> usize {
        let most = if manner.together { joined(surfaces, order) } else { order.len().min(1) };
        let shape = |i: usize| surfaces.triangles.get(order[i] as usize).map_or(0, |t| t.shape);
        let planes = |i: usize| surfaces.triangles.get(order[i] as usize).map_or(0, |t| t.planes);
        let closed = |used: usize| most == used || (most > used && self.closed_by == Some(shape(used)));
        let same = self.used > 0 && closed(self.used) && (0..self.used).all(|i| self.members[i].shape == shape(i));
        // The next triangles cover the same lanes as the current part, so coverage and weights stay valid.
        if same {
            for (i, member) in self.members[..self.used].iter_mut().enumerate() {
                let new = planes(i);
                self.inputs_hold &= new == member.planes || same_inputs(surfaces, (new, member.planes), manner.given);
                member.planes = new;
            }
            return self.used;
        }
        self.inputs_hold = false;
        self.used = 0;
        self.closed_by = None;
        for i in 0..most {
            if !self.add(surfaces, shape(i), planes(i)) {
                self.closed_by = Some(shape(i));
                break;
            }
        }
        // A line has no complete quads, hence no helper lanes.
        match self.frame.shape {
            TileShape::Line => self.run = self.covered,
            TileShape::Square | TileShape::Flat => quads(&self.covered, &mut self.run),
        }
        if manner.depth {
            self.interpolate_depth(surfaces);
        }
        self.used
    }

    /// Adds a triangle to the part, unless it overlaps pixels of the part.
    fn add(&mut self, surfaces: &Surfaces, shape: u32, planes: u32) -> bool {
        if self.members.len() == self.used {
            let weights = TileWeights::new(self.simd);
            self.members.push(Member { shape, planes, cover: [0; LANES], weights });
        }
        let member = &mut self.members[self.used];
        (member.shape, member.planes) = (shape, planes);
        let setup = &surfaces.shapes[shape as usize];
        let count = cover(setup, self.frame, self.region, self.simd, &mut member.cover);
        if self.used == 0 {
            self.covered = member.cover;
            self.covered_count = count;
        } else {
            let overlap = self.covered.iter().zip(&member.cover).fold(0, |any, (a, b)| any | (a & b));
            if overlap != 0 {
                return false;
            }
            self.covered.iter_mut().zip(&member.cover).for_each(|(a, b)| *a |= b);
            self.covered_count += count;
        }
        self.used += 1;
        true
    }

    fn interpolate_depth(&mut self, surfaces: &Surfaces) {
        for (i, member) in self.members[..self.used].iter_mut().enumerate() {
            let setup = &surfaces.shapes[member.shape as usize];
            if !setup.depth_constant {
                member.weights.make(setup, self.frame);
            }
            // The first member fills all lanes; the others overwrite the lanes that they cover.
            if i == 0 {
                member.weights.depth(setup, &mut self.depth);
            } else {
                let mut row = [0; LANES];
                member.weights.depth(setup, &mut row);
                lay_over(&mut self.depth, &row, &member.cover);
            }
        }
    }

    /// Fills the slots of varying components; returns `false` if the slots were valid already.
    pub(crate) fn fill_inputs(&mut self, surfaces: &Surfaces, inputs: &InputSlots, formats: &LaneFormats) -> bool {
        if self.inputs_hold {
            return false;
        }
        self.inputs_hold = true;
        let single = formats.lane(Arith::Single);
        let mut spare = [0; LANES];
        for (i, member) in self.members[..self.used].iter_mut().enumerate() {
            let setup = &surfaces.shapes[member.shape as usize];
            if !inputs.rows.is_empty() || !inputs.position.is_empty() {
                member.weights.make(setup, self.frame);
            }
            for &(axis, slot) in &inputs.position {
                member.weights.position(setup, axis, self.frame, &mut spare);
                if i == 0 {
                    *self.slots.row_mut(slot) = spare;
                } else {
                    lay_over(self.slots.row_mut(slot), &spare, &member.cover);
                }
            }
            for &(number, slot) in &inputs.rows {
                let (plane, constant) = plane(surfaces, number, member.planes);
                let to = if i == 0 { self.slots.row_mut(slot) } else { &mut spare };
                if constant {
                    to.fill(single.decode(plane.base));
                } else {
                    member.weights.plane(&plane, surfaces.iterator_format, single, to);
                }
                if i > 0 {
                    lay_over(self.slots.row_mut(slot), &spare, &member.cover);
                }
            }
        }
        true
    }

    /// Invalidates the rows of varying components.
    pub(crate) fn forget_inputs(&mut self) {
        self.inputs_hold = false;
    }
}

/// Number of leading triangles that are consecutive in the draw and share their constant components.
fn joined(surfaces: &Surfaces, order: &[u32]) -> usize {
    let joins = |pair: &[u32]| pair[1] == pair[0] + 1 && surfaces.joins.get(pair[1] as usize) == Some(&true);
    let more = order.windows(2).take(MAX_MEMBERS - 1).take_while(|pair| joins(pair)).count();
    (1 + more).min(order.len())
}

/// Plane of a component, and `true` if it is constant.
fn plane(surfaces: &Surfaces, row: usize, planes: u32) -> (Plane, bool) {
    let Some(row) = surfaces.rows.get(row) else { return (Plane::default(), true) };
    let constant = surfaces.constant.get(planes as usize).is_some_and(|c| c >> row.component & 1 == 1);
    (row.plane(planes), constant)
}

/// Returns `true` if two triangles of the same shape have the same components, except for `given` ones. Components that
/// are constant over both but not over all triangles are stored in rows like varying components, and must be equal too.
fn same_inputs(surfaces: &Surfaces, (a, b): (u32, u32), given: u64) -> bool {
    let constant = |planes: u32| surfaces.constant.get(planes as usize).copied().unwrap_or_default();
    constant(a) == constant(b)
        && surfaces.rows.iter().all(|row| given >> row.component & 1 == 1 || row.plane(a) == row.plane(b))
}
