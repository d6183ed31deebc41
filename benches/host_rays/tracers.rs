//! The ray casters under test: ours, and other crates' trees with each of their first-hit traversals.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use bvh::flat_bvh::FlatBvh;
use crossbar::geom::{Mesh, Ray, Sides};
use crossbar::tracer::HostTracer;
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::RayHit;
use rayon::prelude::*;

use crate::rooms::Room;

/// Number of rays that a worker processes at a time.
const CHUNK: usize = 256;

/// A ray caster that runs on the current thread pool.
pub(crate) trait Tracer: Sync {
    /// Finds the nearest hit of each ray, and returns the number of rays that hit anything.
    fn nearest(&self, rays: &[Ray]) -> usize;

    /// Number of rays that hit anything before t = 1.
    fn occluded(&self, rays: &[Ray]) -> usize;
}

pub(crate) fn all(mesh: &Mesh) -> Vec<(&'static str, Box<dyn Tracer>)> {
    let ours = HostTracer::new(mesh, Sides::Front);
    let mut shapes: Vec<Shape> = mesh.iter_corners().map(|c| Shape { corners: c.map(Into::into), node: 0 }).collect();
    let tree = bvh::bvh::Bvh::build(&mut shapes);
    let traversal =
        |traversal| Box::new(BvhTracer { shapes: shapes.clone(), tree: tree.clone(), flat: tree.flatten(), traversal });
    let triangles: Vec<obvhs::triangle::Triangle> = mesh
        .iter_corners()
        .map(|[a, b, c]| obvhs::triangle::Triangle { v0: a.into(), v1: b.into(), v2: c.into() })
        .collect();
    let mut time = std::time::Duration::default();
    let wide = build_cwbvh_from_tris(&triangles, BvhBuildParams::slow_build(), &mut time);
    let two = build_bvh2_from_tris(&triangles, BvhBuildParams::slow_build(), &mut time);
    let ordered = |order: &[u32]| order.iter().map(|&i| triangles[i as usize]).collect::<Vec<_>>();
    vec![
        ("octree", Box::new(ours)),
        ("bvh: traverse_iterator", traversal(Traversal::All)),
        ("bvh: nearest_traverse_iterator", traversal(Traversal::Heap)),
        ("bvh: nearest_child_traverse_iterator", traversal(Traversal::Child)),
        ("bvh: flat", traversal(Traversal::Flat)),
        ("obvhs: CwBvh", Box::new(CwBvhTracer { triangles: ordered(&wide.primitive_indices), tree: wide })),
        ("obvhs: Bvh2", Box::new(Bvh2Tracer { triangles: ordered(&two.primitive_indices), tree: two })),
    ]
}

/// Asserts that all ray casters find about the same number of hits. `bvh` treats triangles below an absolute size as
/// edge-on, and so misses small triangles.
pub(crate) fn compare(tracers: &[(&'static str, Box<dyn Tracer>)], room: &Room) {
    let counts = |tracer: &dyn Tracer| [tracer.nearest(&room.primary), tracer.occluded(&room.shadow)];
    let ours = counts(tracers[0].1.as_ref());
    for (who, tracer) in tracers {
        let theirs = counts(tracer.as_ref());
        for (a, b) in ours.into_iter().zip(theirs) {
            assert!(a.abs_diff(b) * 20 <= room.primary.len(), "{}: {who}: {theirs:?}, expected {ours:?}", room.name);
        }
    }
}

impl Tracer for HostTracer {
    fn nearest(&self, rays: &[Ray]) -> usize {
        self.nearest_all(rays).0.iter().flatten().count()
    }

    fn occluded(&self, rays: &[Ray]) -> usize {
        self.occluded_all(rays, 1.0).0.into_iter().filter(|hit| *hit).count()
    }
}

/// The point type of `bvh`, which it does not re-export.
type Point = <Aabb<f32, 3> as std::ops::Index<usize>>::Output;

/// A triangle for the crate `bvh`.
#[derive(Clone, Debug)]
struct Shape {
    corners: [Point; 3],
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [a, b, c] = &self.corners;
        Aabb::empty().grow(a).grow(b).grow(c)
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

#[derive(Clone, Copy)]
enum Traversal {
    All,
    Heap,
    Child,
    Flat,
}

struct BvhTracer {
    shapes: Vec<Shape>,
    tree: bvh::bvh::Bvh<f32, 3>,
    flat: FlatBvh<f32, 3>,
    traversal: Traversal,
}

fn each<R: Send>(rays: &[Ray], trace: impl Fn(&Ray) -> R + Sync) -> Vec<R> {
    let parts: Vec<Vec<R>> = rays.par_chunks(CHUNK).map(|rays| rays.iter().map(&trace).collect()).collect();
    parts.into_iter().flatten().collect()
}

impl BvhTracer {
    fn distance(ray: &bvh::ray::Ray<f32, 3>, shape: &Shape) -> f32 {
        let [a, b, c] = &shape.corners;
        ray.intersects_triangle(a, b, c).distance
    }

    fn first(&self, ray: &Ray) -> f32 {
        let ray = bvh::ray::Ray::new(ray.origin().into(), ray.direction().into());
        let nearest = |best: f32, shape: &Shape| best.min(Self::distance(&ray, shape));
        match self.traversal {
            Traversal::All => self.tree.traverse_iterator(&ray, &self.shapes).fold(f32::INFINITY, nearest),
            Traversal::Child => {
                self.tree.nearest_child_traverse_iterator(&ray, &self.shapes).fold(f32::INFINITY, nearest)
            }
            Traversal::Flat => self.flat.traverse(&ray, &self.shapes).into_iter().fold(f32::INFINITY, nearest),
            Traversal::Heap => {
                let mut best = f32::INFINITY;
                for shape in self.tree.nearest_traverse_iterator(&ray, &self.shapes) {
                    // Boxes are sorted by entry distance.
                    if ray.intersection_slice_for_aabb(&shape.aabb()).is_some_and(|(entry, _)| entry > best) {
                        break;
                    }
                    best = nearest(best, shape);
                }
                best
            }
        }
    }

    fn any(&self, ray: &Ray) -> bool {
        // The crate normalises directions.
        let length = ray.direction().iter().map(|x| x * x).sum::<f32>().sqrt();
        let ray = bvh::ray::Ray::new(ray.origin().into(), ray.direction().into());
        let before = |shape: &Shape| Self::distance(&ray, shape) < length;
        match self.traversal {
            Traversal::All => self.tree.traverse_iterator(&ray, &self.shapes).any(before),
            Traversal::Child => self.tree.nearest_child_traverse_iterator(&ray, &self.shapes).any(before),
            Traversal::Heap => self.tree.nearest_traverse_iterator(&ray, &self.shapes).any(before),
            Traversal::Flat => self.flat.traverse(&ray, &self.shapes).into_iter().any(before),
        }
    }
}

impl Tracer for BvhTracer {
    fn nearest(&self, rays: &[Ray]) -> usize {
        each(rays, |ray| self.first(ray)).into_iter().filter(|t| *t < f32::INFINITY).count()
    }

    fn occluded(&self, rays: &[Ray]) -> usize {
        each(rays, |ray| self.any(ray)).into_iter().filter(|hit| *hit).count()
    }
}

/// Triangles in the order of their tree.
struct CwBvhTracer {
    triangles: Vec<obvhs::triangle::Triangle>,
    tree: CwBvh,
}

struct Bvh2Tracer {
    triangles: Vec<obvhs::triangle::Triangle>,
    tree: Bvh2,
}

fn ray_to(ray: &Ray, end: f32) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin().into(), ray.direction().into(), 0.0, end)
}

macro_rules! trace_with_obvhs {
    ($($tree:ty),*) => {$(
        impl Tracer for $tree {
            fn nearest(&self, rays: &[Ray]) -> usize {
                let test = |ray: &obvhs::ray::Ray, i: usize| self.triangles[i].intersect(ray);
                let first = |ray: &Ray| {
                    let mut hit = RayHit::none();
                    self.tree.ray_traverse(ray_to(ray, f32::INFINITY), &mut hit, test).then_some(hit)
                };
                each(rays, first).into_iter().flatten().count()
            }

            fn occluded(&self, rays: &[Ray]) -> usize {
                let test = |ray: &obvhs::ray::Ray, i: usize| self.triangles[i].intersect(ray);
                let any = |ray: &Ray| !self.tree.ray_traverse_miss(ray_to(ray, 1.0), test);
                each(rays, any).into_iter().filter(|hit| *hit).count()
            }
        }
    )*};
}

trace_with_obvhs!(CwBvhTracer, Bvh2Tracer);
