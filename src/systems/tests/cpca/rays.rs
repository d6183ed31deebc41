//! Rays that are not cast are unblocked.

use crossbar_systems::cpca::transfer::TracedRays;
use crossbar_systems::transfer::{Tangents, Vertices, ray_length};
use glam::DVec3;

use crate::geom::random::CounterRng;
use crate::geom::teapot::teapot;
use crate::geom::vector::{narrow, wide};
use crate::geom::{Hit, Mesh, Ray, Sides};
use crate::scene::built::stand_ins;
use crate::sphere::DirectionRule;
use crate::tracer::{CastError, Caster, HostTracer};

/// A caster that keeps the origins of the rays it was asked for.
struct Asked {
    tracer: HostTracer,
    origins: Vec<[f32; 3]>,
}

impl Caster for Asked {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        self.tracer.cast(rays)
    }

    fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<bool>, CastError> {
        self.origins.extend(rays.iter().map(Ray::origin));
        self.origins.dedup();
        self.tracer.occluded(rays)
    }
}

/// Triangles of any size and position, some of them large, thin, or on a grid.
fn clutter(seed: u64) -> Mesh {
    let random = CounterRng::new(seed);
    let size = [0.05, 0.5, 3.0][seed as usize % 3];
    let corner = |triangle: u64, corner: u64| {
        [0, 1, 2].map(|k| {
            let place = random.unit(triangle, 0, k) + size * (random.unit(triangle, 1 + corner, k) - 0.5);
            (if triangle.is_multiple_of(3) { (8.0 * place).round() / 8.0 } else { place }) as f32
        })
    };
    let positions: Vec<[f32; 3]> = (0..40).flat_map(|triangle| [0, 1, 2].map(|at| corner(triangle, at))).collect();
    let faces = (0..40).map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2]);
    let normals = positions.iter().map(|at| if at[0] == 0.0 { [1.0, 0.0, 0.0] } else { *at }).collect();
    Mesh::new(positions, faces.collect()).and_then(|mesh| mesh.with_normals(normals)).expect("a mesh")
}

/// Every direction's answer is that of a ray from the vertex's origin, or it runs behind all triangles there.
#[test]
fn every_answer_is_that_of_tracing_every_ray() {
    let meshes = (0..30).map(clutter).chain([teapot(2).expect("a teapot"), stand_ins::head()]);
    let (mut unasked, mut all) = (0, 0);
    for (number, mesh) in meshes.enumerate() {
        let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
        let mut caster = Asked { tracer: HostTracer::new(&mesh, Sides::Both), origins: Vec::new() };
        let rule = DirectionRule::hemisphere(if number < 30 { 31 } else { 13 });
        let traced = TracedRays::trace(&vertices, rule, &mut caster, false).expect("traced");
        assert!(traced.counts().traced < traced.counts().rays, "mesh {number}: {:?}", traced.counts());
        let mut around = vec![Vec::new(); vertices.len()];
        for &corners in vertices.triangles() {
            let [a, b, c] = corners.map(|corner| wide(vertices.positions()[corner as usize]));
            corners.iter().for_each(|&corner| around[corner as usize].push((b - a).cross(c - a)));
        }
        let (reach, mut at, mut without) = (ray_length(&vertices), 0, 0);
        for (vertex, frame) in vertices.frames().iter().enumerate() {
            let place = wide(vertices.positions()[vertex]);
            let off = |origin: &[f32; 3]| wide(*origin).distance(place);
            // Vertices were asked for in order; one at the same place as the last has its origin.
            let is_own = |at: usize| caster.origins.get(at).is_some_and(|origin| off(origin) < 1e-4 * reach);
            if !is_own(at) && is_own(at + 1) {
                at += 1;
            }
            if !is_own(at) {
                without += 1;
                continue;
            }
            let origin = caster.origins[at];
            let directions: Vec<DVec3> = traced.rule().directions().iter().map(|&s| frame.to_global(s)).collect();
            let rays: Vec<Ray> =
                directions.iter().map(|&s| Ray::new(origin, narrow(reach * s)).expect("a ray")).collect();
            for (direction, blocked) in caster.tracer.occluded_all(&rays, 1.0).0.into_iter().enumerate() {
                let found = traced.is_blocked(vertex, direction);
                let is_behind = || around[vertex].iter().all(|normal| normal.dot(directions[direction]) < 0.0);
                assert!(
                    found == blocked || found && is_behind(),
                    "mesh {number}, vertex {vertex}, direction {direction}: {found}"
                );
            }
        }
        unasked += without;
        all += vertices.len();
    }
    assert!(4 * unasked < all, "{unasked} of {all} vertices were not asked for");
}
