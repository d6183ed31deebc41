//! Ray-triangle tests of other crates on one thread of the same machine: f32, scalar, every ray against every triangle.

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::geom::Mesh;
use crossbar::ray_engine::RayBatch;
use std::hint::black_box;

type Corners = [[f32; 3]; 3];

pub(crate) fn run(criterion: &mut Criterion, mesh: &Mesh, rays: &RayBatch) {
    let corners: Vec<Corners> = (0..mesh.len() as u32).filter_map(|id| mesh.corners(id)).collect();
    let rays: Vec<[[f32; 3]; 2]> = rays.rays().iter().map(|r| [r.origin(), r.direction()]).collect();
    let mut group = criterion.benchmark_group("executors");
    group.sample_size(10);
    group.throughput(Throughput::Elements((corners.len() * rays.len()) as u64));
    group.bench_function(BenchmarkId::new("256 rays x 256 triangles fp32", "crate bvh"), |b| {
        let triangles: Vec<[_; 3]> = corners.iter().map(|c| c.map(Into::into)).collect();
        let rays: Vec<bvh::ray::Ray<f32, 3>> =
            rays.iter().map(|[o, d]| bvh::ray::Ray::new((*o).into(), (*d).into())).collect();
        b.iter(|| hits(&rays, &triangles, |ray, [a, b, c]| ray.intersects_triangle(a, b, c).distance < f32::INFINITY));
    });
    group.bench_function(BenchmarkId::new("256 rays x 256 triangles fp32", "crate obvhs"), |b| {
        let triangles: Vec<obvhs::triangle::Triangle> = corners
            .iter()
            .map(|&[a, b, c]| obvhs::triangle::Triangle { v0: a.into(), v1: b.into(), v2: c.into() })
            .collect();
        let rays: Vec<obvhs::ray::Ray> =
            rays.iter().map(|[o, d]| obvhs::ray::Ray::new_inf((*o).into(), (*d).into())).collect();
        b.iter(|| hits(&rays, &triangles, |ray, triangle| triangle.intersect(ray) < f32::INFINITY));
    });
    group.bench_function(BenchmarkId::new("256 rays x 256 triangles fp32", "crate parry3d"), |b| {
        use parry3d::query::Ray;
        use parry3d::query::details::local_ray_intersection_with_triangle as intersection;
        let triangles: Vec<_> = corners.iter().map(|&[a, b, c]| [a.into(), b.into(), c.into()]).collect();
        let rays: Vec<Ray> = rays.iter().map(|[o, d]| Ray::new((*o).into(), (*d).into())).collect();
        b.iter(|| hits(&rays, &triangles, |ray, &[a, b, c]| intersection(a, b, c, ray).is_some()));
    });
    group.finish();
}

/// Number of pairs that intersect.
fn hits<R, T>(rays: &[R], triangles: &[T], meet: impl Fn(&R, &T) -> bool) -> usize {
    let (rays, triangles) = (black_box(rays), black_box(triangles));
    triangles.iter().map(|triangle| rays.iter().filter(|ray| meet(ray, triangle)).count()).sum()
}
