//! First hits on the host alone: the octree and the f32 test. What Table 3 calls "CPU only".

use rayon::prelude::*;

use super::Hit;
use super::host_test::{HostRay, HostTriangle};
use super::octree::{Flow, GpuCells, Octree, OctreeParameters, TraversalCounts, Visit};
use crate::geom::exact::Sides;
use crate::geom::{CastError, Caster, Mesh, Ray};

/// A ray goes on a little beyond its best hit, in shares of t: an fp32 t is no better than that, and the next cell may hold a
/// triangle whose rounded t is smaller.
const BEYOND: f64 = 1e-5;
/// Rays that one worker traces at a time.
const CHUNK: usize = 256;

/// What tracing cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HostCounts {
    /// Rays traced.
    pub rays: u64,
    /// The octree's.
    pub traversal: TraversalCounts,
    /// Ray-triangle tests.
    pub tests: u64,
}

impl std::ops::AddAssign for HostCounts {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.traversal += other.traversal;
        self.tests += other.tests;
    }
}

/// The nearest hit so far: of equal t the lowest triangle, as a card keeps that draws triangles in order and tests `less`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Best(Option<(f32, u32)>);

impl Best {
    /// An infinite t is none: it fails the depth test of a card.
    pub(crate) fn offer(&mut self, t: f32, triangle: u32) {
        if t < f32::INFINITY && self.0.is_none_or(|(best, first)| t < best || (t == best && triangle < first)) {
            self.0 = Some((t, triangle));
        }
    }

    /// Whether cells that the ray enters at `t` of its own direction can't hold anything nearer.
    pub(crate) fn settles(&self, t: f64, power: f64) -> bool {
        self.0.is_some_and(|(best, _)| f64::from(best) * power * (1.0 + BEYOND) < t)
    }

    pub(crate) fn hit(&self, power: f64) -> Option<Hit> {
        // A depth buffer knows one zero.
        self.0.map(|(t, triangle)| Hit { triangle, t: (f64::from(t) * power) as f32 + 0.0 })
    }
}

/// A mesh, ready to be traced on the host.
#[derive(Clone, Debug)]
pub struct HostTracer {
    octree: Octree,
    triangles: Vec<HostTriangle>,
    sides: Sides,
}

impl HostTracer {
    /// A mesh with its octree.
    pub fn new(mesh: &Mesh, parameters: OctreeParameters, sides: Sides) -> Self {
        Self { octree: Octree::new(mesh, parameters), triangles: HostTriangle::all(mesh), sides }
    }

    /// The octree.
    pub fn octree(&self) -> &Octree {
        &self.octree
    }

    /// The first hit of a ray, and what it cost.
    pub fn nearest(&self, ray: &Ray) -> (Option<Hit>, HostCounts) {
        self.nearest_in(ray, None)
    }

    /// The same with the cells that `gpu` marks tested as the card tests them: every triangle of the cell.
    pub fn nearest_in(&self, ray: &Ray, gpu: Option<&GpuCells>) -> (Option<Hit>, HostCounts) {
        let host = HostRay::new(ray);
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

    /// The first hit of a ray among all triangles, each one tested: what the octree must not change.
    pub fn nearest_of_all(&self, ray: &Ray) -> Option<Hit> {
        let host = HostRay::new(ray);
        let mut best = Best::default();
        for (id, triangle) in (0..).zip(&self.triangles) {
            if let Some(t) = triangle.hit(&host, self.sides) {
                best.offer(t, id);
            }
        }
        best.hit(host.power)
    }

    /// The first hits of rays in any number, on all worker threads: the same for any number of them.
    pub fn nearest_all(&self, rays: &[Ray]) -> (Vec<Option<Hit>>, HostCounts) {
        let trace = |rays: &[Ray]| {
            let mut counts = HostCounts::default();
            let hits: Vec<_> = rays
                .iter()
                .map(|ray| {
                    let (hit, cost) = self.nearest(ray);
                    counts += cost;
                    hit
                })
                .collect();
            (hits, counts)
        };
        let parts: Vec<_> = rays.par_chunks(CHUNK).map(trace).collect();
        let mut hits = Vec::with_capacity(rays.len());
        let mut counts = HostCounts::default();
        for (part, cost) in parts {
            hits.extend(part);
            counts += cost;
        }
        (hits, counts)
    }

    pub(crate) fn test(&self, triangles: &[u32], ray: &HostRay, best: &mut Best) {
        for &id in triangles {
            if let Some(t) = self.triangles[id as usize].hit(ray, self.sides) {
                best.offer(t, id);
            }
        }
    }
}

impl Caster for HostTracer {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        Ok(self.nearest_all(rays).0)
    }
}
