//! Beams: volumes that contain all rays of a bucket, tested against cells (section 5.3, after Arvo and Kirk 1987).
//!
//! All rays of a bucket pass through one face of the unit cube, so along the face's axis k they share a sign, and their
//! slopes along the other axes u are bounded. Each bound is a plane with all rays on one side: `p_u - most * p_k` along
//! a ray never exceeds its largest value at an origin. No ray meets a cell on the other side of such a plane.

use glam::DVec3;

use super::cells::{CellId, GpuCells};
use super::{Octree, OctreeNode};
use crate::geom::Ray;
use crate::geom::vector::wide;

/// Bound on the error of traversal, relative to the distance between a ray's origin and the octree: many roundings of
/// f64.
const ROUNDING: f64 = 1e-13;

/// Plane with all rays on its lower side: the points at which `normal . p <= most`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    normal: DVec3,
    most: f64,
}

/// Volume that contains all rays of a bucket.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    planes: Vec<Plane>,
    /// Largest component of an origin.
    reach: f64,
}

/// Result of a beam's search in an octree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BeamCells {
    /// GPU cells and leaves with triangles that rays of the beam may meet, in ascending order.
    pub cells: Vec<CellId>,
    /// Number of cells tested.
    pub tested: u64,
}

impl Beam {
    /// Builds the beam of some rays; `None` if there are no rays, or they share no face of the cube.
    pub fn of(rays: &[Ray]) -> Option<Self> {
        let axis = common_axis(rays)?;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let sign = if rays[0].direction()[axis] < 0.0 { -1.0 } else { 1.0 };
        let mut normals = vec![-sign * DVec3::AXES[axis]];
        for across in [u, v] {
            let slopes = rays.iter().map(|ray| {
                let d = wide(ray.direction());
                d[across] / d[axis].abs()
            });
            let (least, most) = slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
            for (side, slope) in [(1.0, most), (-1.0, -least)] {
                let mut normal = side * DVec3::AXES[across];
                normal[axis] = -slope * sign;
                normals.push(normal);
                // All rays have the same sign along this axis too.
                if slope <= 0.0 {
                    normals.push(side * DVec3::AXES[across]);
                }
            }
        }
        let origins = || rays.iter().map(|ray| wide(ray.origin()));
        let most = |normal: &DVec3| origins().map(|o| normal.dot(o)).fold(f64::NEG_INFINITY, f64::max);
        let planes = normals.iter().map(|normal| Plane { normal: *normal, most: most(normal) }).collect();
        let reach = origins().fold(0.0, |reach: f64, o| reach.max(o.abs().max_element()));
        Some(Self { planes, reach })
    }

    /// Returns `true` if the beam may meet a box grown by `margin`, given by its center and half its side.
    fn meets(&self, middle: DVec3, half: f64, margin: f64) -> bool {
        self.planes.iter().all(|plane| {
            let across = plane.normal.abs().element_sum();
            plane.normal.dot(middle) - (half + margin) * across <= plane.most
        })
    }
}

impl Octree {
    /// Returns the first cell with triangles that a ray of the beam may meet, or all such cells; GPU cells are not
    /// subdivided. Never omits a cell that [`Octree::traverse`] would visit for a ray of the beam.
    pub fn reached(&self, beam: &Beam, gpu: Option<&GpuCells>, all: bool) -> BeamCells {
        let middle = self.corner + self.size / 2.0;
        let extent = beam.reach + self.size + self.corner.abs().max_element();
        let mut search = BeamSearch {
            octree: self,
            gpu,
            beam,
            margin: self.margin + ROUNDING * extent,
            all,
            found: BeamCells::default(),
        };
        search.enter(0, middle, self.size / 2.0);
        search.found
    }

    /// Returns `true` if the beam test is conservative for these rays: from very far away, traversal visits cells that
    /// a ray does not meet.
    pub fn sees(&self, rays: &[Ray]) -> bool {
        !rays.iter().any(|ray| self.is_too_far(ray))
    }
}

struct BeamSearch<'a> {
    octree: &'a Octree,
    gpu: Option<&'a GpuCells>,
    beam: &'a Beam,
    margin: f64,
    all: bool,
    found: BeamCells,
}

impl BeamSearch<'_> {
    fn enter(&mut self, node: u32, middle: DVec3, half: f64) {
        if !self.all && !self.found.cells.is_empty() {
            return;
        }
        self.found.tested += 1;
        if !self.beam.meets(middle, half, self.margin) {
            return;
        }
        let cell = CellId(node);
        let whole = self.gpu.is_some_and(|gpu| gpu.triangles(cell).is_some());
        match self.octree.nodes[node as usize] {
            OctreeNode::Leaf(_, 0) if !whole => {}
            OctreeNode::Inner(first) if !whole => {
                let quarter = half / 2.0;
                for child in 0..8 {
                    let side = |bit: u32| if child >> bit & 1 == 1 { quarter } else { -quarter };
                    let at = middle + DVec3::new(side(2), side(1), side(0));
                    self.enter(first + child, at, quarter);
                }
            }
            OctreeNode::Leaf(..) | OctreeNode::Inner(_) => self.found.cells.push(cell),
        }
    }
}

/// Axis along which every ray has its largest component, with the same sign.
fn common_axis(rays: &[Ray]) -> Option<usize> {
    let first = rays.first()?.direction();
    let longest =
        |d: [f32; 3]| (0..3).fold(0, |best: usize, axis| if d[axis].abs() > d[best].abs() { axis } else { best });
    let axis = longest(first);
    let same = |ray: &Ray| {
        let d = ray.direction();
        longest(d) == axis && (d[axis] < 0.0) == (first[axis] < 0.0)
    };
    rays.iter().all(same).then_some(axis)
}
