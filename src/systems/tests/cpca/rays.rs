//! Rays that are not cast are unblocked.

use crossbar_systems::cpca::transfer::{TracedRays, ray_origins};
use crossbar_systems::transfer::{Tangents, Vertices, ray_length};
use glam::DVec3;

use crate::geom::random::CounterRng;
use crate::geom::teapot::teapot;
use crate::geom::vector::{narrow, wide};
use crate::geom::{Mesh, Ray, Sides};
use crate::scene::built::stand_ins;
use crate::sphere::DirectionRule;
use crate::tracer::HostTracer;

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

/// Normals of the triangles on which a point lies, up to a few rounding errors of its coordinates.
fn planes(vertices: &Vertices, place: DVec3) -> Vec<DVec3> {
    let corners = vertices.triangles().iter();
    let corners = corners.map(|corners| corners.map(|corner| wide(vertices.positions()[corner as usize])));
    let on = |[a, b, c]: [DVec3; 3]| {
        let normal = (b - a).cross(c - a).try_normalize()?;
        let largest = [a, b, c, place].into_iter().fold(0.0_f64, |most, at| most.max(at.abs().max_element()));
        let reach = 8.0 / f64::from(1 << 24) * largest;
        let inside = |from: DVec3, to: DVec3| (to - from).cross(place - from).dot(normal) >= -reach * from.distance(to);
        let on = normal.dot(place - a).abs() <= reach && inside(a, b) && inside(b, c) && inside(c, a);
        on.then_some(normal)
    };
    corners.filter_map(on).collect()
}

/// Every direction's result equals the result of a ray from the vertex's origin, or the direction points behind all
/// triangles there.
#[test]
fn every_answer_is_that_of_tracing_every_ray() {
    let meshes = (0..30).map(clutter).chain([teapot(2).expect("a teapot"), stand_ins::head()]);
    for (number, mesh) in meshes.enumerate() {
        let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
        let mut caster = HostTracer::new(&mesh, Sides::Both);
        let rule = DirectionRule::hemisphere(if number < 30 { 31 } else { 13 });
        let traced = TracedRays::trace(&vertices, rule, &mut caster, false).expect("traced");
        assert!(traced.counts().traced < traced.counts().rays, "mesh {number}: {:?}", traced.counts());
        let reach = ray_length(&vertices);
        let origins = ray_origins(&vertices);
        for vertex in (0..vertices.len()).step_by(if number < 30 { 1 } else { 1 + vertices.len() / 16 }) {
            let (frame, origin) = (&vertices.frames()[vertex], origins[vertex]);
            let planes = planes(&vertices, wide(vertices.positions()[vertex]));
            let directions: Vec<DVec3> = traced.rule().directions().iter().map(|&s| frame.to_global(s)).collect();
            let rays: Vec<Ray> =
                directions.iter().map(|&s| Ray::new(origin, narrow(reach * s)).expect("a ray")).collect();
            for (direction, blocked) in caster.occluded_all(&rays, 1.0).0.into_iter().enumerate() {
                let found = traced.is_blocked(vertex, direction);
                let is_behind = || planes.iter().all(|normal| normal.dot(directions[direction]) < 0.0);
                assert!(
                    found == blocked || found && is_behind(),
                    "mesh {number}, vertex {vertex}, direction {direction}: {found}"
                );
            }
        }
    }
}
