//! First hits on the host alone, by an octree and the f32 triangle test: "CPU only" in Table 3.

use rayon::prelude::*;

use super::best::{Best, T_MARGIN};
use super::cast::{CastError, Caster};
use super::octree::{Compact, Flow, GpuCells, Octree, OctreeParameters, TraversalCounts, Visit, Waiting};
use super::packet::Packets;
use super::scale::mesh_scale;
use super::triangle_test::{HostRay, HostTriangle};
use crate::geom::exact::{Guess, Sides, filter};
use crate::geom::{Hit, Mesh, Ray};
use refsim::exec::batch::SimdLevel;

/// Rays per parallel task.
const CHUNK: usize = 256;

/// Counters of tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HostCounts {
    /// Number of rays traced.
    pub rays: u64,
    /// Counters of the octree.
    pub traversal: TraversalCounts,
    /// Number of ray-triangle tests.
    pub tests: u64,
}

impl std::ops::AddAssign for HostCounts {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.traversal += other.traversal;
        self.tests += other.tests;
    }
}

/// Mesh with the acceleration structures for tracing on the host.
#[derive(Clone, Debug)]
pub struct HostTracer {
    octree: Octree,
    triangles: Vec<HostTriangle>,
    /// Corners of the triangles in mesh coordinates, for [`filter::guess`].
    corners: Vec<[[f32; 3]; 3]>,
    sides: Sides,
    /// Scale of single-precision coordinates; a power of two.
    scale: f64,
    /// Second copy of the octree and its lists in a compact layout, for rays that the host traces alone.
    compact: Compact,
    packets: Packets,
    level: SimdLevel,
}

impl HostTracer {
    /// Creates a tracer with the tuned octree parameters.
    pub fn new(mesh: &Mesh, sides: Sides) -> Self {
        Self::with_octree(mesh, OctreeParameters::default(), sides)
    }

    /// Creates a tracer with these octree parameters, which affect the time but never a hit.
    pub fn with_octree(mesh: &Mesh, parameters: OctreeParameters, sides: Sides) -> Self {
        let scale = mesh_scale(mesh);
        let (octree, triangles) = (Octree::new(mesh, parameters), HostTriangle::all(mesh, scale));
        let mut packets = Packets::default();
        let compact = Compact::new(&octree, |leaf| packets.add(mesh, scale, leaf));
        let corners = mesh.iter_corners().collect();
        Self { octree, triangles, corners, sides, scale, compact, packets, level: SimdLevel::widest() }
    }

    /// The octree.
    pub fn octree(&self) -> &Octree {
        &self.octree
    }

    /// Scale of single-precision coordinates; a power of two.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Converts a ray to the units of the f32 test.
    pub fn host_ray(&self, ray: &Ray) -> HostRay {
        HostRay::new(ray, self.scale)
    }

    /// Returns the first hit of a ray, and its cost.
    pub fn nearest(&self, ray: &Ray) -> (Option<Hit>, HostCounts) {
        let mut hit = [None];
        let counts = self.nearest_each(std::slice::from_ref(ray), &mut hit);
        (hit[0], counts)
    }

    /// Returns `true` if anything is hit before `t_max`, in multiples of the ray's direction: if the t of the first hit
    /// is smaller. A hit is ignored if its t is smaller by rounding alone, that is, if its triangle lies only in cells
    /// beyond `t_max`. Cheaper than [`Self::nearest`], because any hit suffices.
    pub fn occluded_before(&self, ray: &Ray, t_max: f32) -> (bool, HostCounts) {
        let mut occluded = [false];
        let counts = self.occluded_each(std::slice::from_ref(ray), t_max, &mut occluded);
        (occluded[0], counts)
    }

    fn nearest_each(&self, rays: &[Ray], hits: &mut [Option<Hit>]) -> HostCounts {
        self.search::<false>(rays, f32::INFINITY, |i, hit| hits[i] = hit)
    }

    fn occluded_each(&self, rays: &[Ray], t_max: f32, occluded: &mut [bool]) -> HostCounts {
        self.search::<true>(rays, t_max, |i, hit| occluded[i] = hit.is_some_and(|hit| hit.t < t_max))
    }

    fn search<const ANY: bool>(&self, rays: &[Ray], t_max: f32, answer: impl FnMut(usize, Option<Hit>)) -> HostCounts {
        match self.sides {
            Sides::Front => self.level.run(
                #[inline(always)]
                || self.search_sides::<false, ANY>(rays, t_max, answer),
            ),
            Sides::Both => self.level.run(
                #[inline(always)]
                || self.search_sides::<true, ANY>(rays, t_max, answer),
            ),
        }
    }

    #[inline(always)]
    fn search_sides<const BOTH: bool, const ANY: bool>(
        &self,
        rays: &[Ray],
        t_max: f32,
        mut answer: impl FnMut(usize, Option<Hit>),
    ) -> HostCounts {
        let (mut waiting, mut counts) = (Waiting::default(), HostCounts::default());
        let mut blocker = None;
        for (i, ray) in rays.iter().enumerate() {
            let host = self.host_ray(ray);
            // The leaf that blocked an earlier ray often blocks this ray too. Only a certain hit may replace the walk,
            // because the walk finds rounded hits only in cells that the ray crosses.
            if let Some(leaf) = blocker.filter(|_| ANY) {
                let mut best = Best::default();
                counts.tests += self.packets.test::<BOTH>(leaf, &host, &mut best);
                let hit = best.hit(host.power).filter(|hit| hit.t < t_max);
                if let Some(hit) = hit.filter(|hit| self.is_certain(ray, hit.triangle, t_max)) {
                    answer(i, Some(hit));
                    counts.rays += 1;
                    continue;
                }
            }
            let (hit, cost) = self.walk::<BOTH, ANY>(ray, &host, t_max, &mut blocker, &mut waiting);
            answer(i, hit);
            counts += cost;
        }
        counts
    }

    /// Returns `true` if a ray certainly hits a triangle before `t_max` in exact arithmetic. Then it crosses a cell
    /// that contains the triangle, and traversal would give the same answer.
    fn is_certain(&self, ray: &Ray, triangle: u32, t_max: f32) -> bool {
        let guess = filter::guess(ray, &self.corners[triangle as usize], self.sides);
        matches!(guess, Guess::Hit { high, .. } if high < f64::from(t_max))
    }

    /// Returns the nearest hit. With `ANY`, returns any hit before `t_max` and stores its leaf in `blocker`; `None` if
    /// there is none.
    #[inline(always)]
    fn walk<const BOTH: bool, const ANY: bool>(
        &self,
        ray: &Ray,
        host: &HostRay,
        t_max: f32,
        blocker: &mut Option<u32>,
        waiting: &mut Waiting,
    ) -> (Option<Hit>, HostCounts) {
        let (mut best, mut tests) = (Best::default(), 0);
        let end = f64::from(t_max) * (1.0 + T_MARGIN);
        let traversal = self.compact.walk(
            ray,
            waiting,
            #[inline(always)]
            |leaf, t| {
                if best.settles(t[0], host.power) || (ANY && t[0] > end) {
                    return Flow::Stop;
                }
                tests += self.packets.test::<BOTH>(leaf, host, &mut best);
                let found = ANY && best.hit(host.power).is_some_and(|hit| hit.t < t_max);
                if found {
                    *blocker = Some(leaf);
                }
                if found || best.settles(t[1], host.power) { Flow::Stop } else { Flow::Continue }
            },
        );
        (best.hit(host.power), HostCounts { rays: 1, traversal, tests })
    }

    /// Returns the first hit by [`Octree::traverse`]. In cells marked in `gpu`, every triangle of the cell is tested,
    /// as on the card; without marks, hit and counts are the same as for [`Self::nearest`].
    pub fn nearest_in(&self, ray: &Ray, gpu: Option<&GpuCells>) -> (Option<Hit>, HostCounts) {
        let host = self.host_ray(ray);
        let (mut best, mut tests) = (Best::default(), 0);
        let traversal = self.octree.traverse(ray, gpu, |cell: &Visit<'_>| {
            if best.settles(cell.t[0], host.power) {
                return Flow::Stop;
            }
            self.test(cell.triangles, &host, &mut best);
            tests += cell.triangles.len() as u64;
            if best.settles(cell.t[1], host.power) { Flow::Stop } else { Flow::Continue }
        });
        (best.hit(host.power), HostCounts { rays: 1, traversal, tests })
    }

    /// Returns the first hit of a ray by testing every triangle: the result that the octree must reproduce.
    pub fn nearest_of_all(&self, ray: &Ray) -> Option<Hit> {
        let host = self.host_ray(ray);
        let mut best = Best::default();
        for (id, triangle) in (0..).zip(&self.triangles) {
            if let Some(t) = triangle.hit(&host, self.sides) {
                best.offer(t, id);
            }
        }
        best.hit(host.power)
    }

    /// Returns the first hits of any number of rays, traced on all worker threads; the result does not depend on the
    /// number of threads.
    pub fn nearest_all(&self, rays: &[Ray]) -> (Vec<Option<Hit>>, HostCounts) {
        all(rays, |rays, hits| self.nearest_each(rays, hits))
    }

    /// Runs [`Self::occluded_before`] on any number of rays, on all worker threads, with the same `t_max`, which is 1
    /// for rays whose direction vectors end at a light. Triangles that blocked one ray are tried first for the next, so
    /// neighbouring rays should be consecutive.
    pub fn occluded_all(&self, rays: &[Ray], t_max: f32) -> (Vec<bool>, HostCounts) {
        all(rays, |rays, occluded| self.occluded_each(rays, t_max, occluded))
    }

    /// Tests the triangles with these indices, and offers the hits to `best`.
    pub fn test(&self, triangles: &[u32], ray: &HostRay, best: &mut Best) {
        for &id in triangles {
            if let Some(t) = self.triangles[id as usize].hit(ray, self.sides) {
                best.offer(t, id);
            }
        }
    }
}

/// Traces rays in parallel; returns the results in the order of the rays, and the total cost.
fn all<T: Clone + Default + Send>(
    rays: &[Ray],
    trace: impl Fn(&[Ray], &mut [T]) -> HostCounts + Sync,
) -> (Vec<T>, HostCounts) {
    let mut answers = vec![T::default(); rays.len()];
    // Sums of integers: the order does not matter.
    let add = |mut a: HostCounts, b| {
        a += b;
        a
    };
    let parts = rays.par_chunks(CHUNK).zip(answers.par_chunks_mut(CHUNK));
    let counts = parts.map(|(rays, answers)| trace(rays, answers)).reduce(HostCounts::default, add);
    (answers, counts)
}

impl Caster for HostTracer {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        Ok(self.nearest_all(rays).0)
    }

    fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<bool>, CastError> {
        Ok(self.occluded_all(rays, 1.0).0)
    }
}
