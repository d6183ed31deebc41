//! Meshes and rays at the limits of f32 cause no panic, hang or wrong number; zeros of both signs mean the same
//! direction.

use crate::support::{bits, profile, soup};
use crossbar::geom::exact;
use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{Oracle, Tolerance, hard_rays};
use crossbar::ray_engine::Crossbar;
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::tracer::HostTracer;
use crossbar::tracer::octree::OctreeParameters;
use refsim::machine::ExecutorKind;

const FINE: OctreeParameters = OctreeParameters { most_triangles: 1, most_depth: 20 };

/// Hits of every path, by name: the host, the Ray Engine on a card, the cards alone.
fn paths(mesh: &Mesh, rays: &[Ray], sides: Sides) -> Vec<(&'static str, Vec<Option<Hit>>)> {
    let mut found = vec![("host", HostTracer::with_octree(mesh, FINE, sides).nearest_all(rays).0)];
    let parameters = EngineParameters { octree: FINE, triangles: 1..=4, rays: 2, sides, ..EngineParameters::default() };
    let mut engine = RayEngine::new(mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
    found.push(("engine", engine.trace(rays).expect("the card works")));
    for name in ["ideal-fp32", "r200", "r300"] {
        let card = Crossbar::new(profile(name), ExecutorKind::Batch);
        found.push((name, card.intersect_list(mesh, rays, sides).expect("the card works")));
    }
    found
}

fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray::new(origin, direction).expect("a ray")
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let one = [ray([0.0; 3], [0.0, 0.0, 1.0])];
    let empty = Mesh::default();
    let points = Mesh::new(vec![[1.0; 3]; 3], vec![[0, 1, 2], [0, 0, 0]]).expect("a mesh");
    let unused = Mesh::new(vec![[1.0; 3]; 3], vec![]).expect("a mesh");
    for mesh in [&empty, &points, &unused] {
        for sides in [Sides::Front, Sides::Both] {
            for (name, hits) in paths(mesh, &one, sides) {
                assert_eq!(hits, [None], "{name}");
                assert!(exact::nearest(mesh, &one[0], sides).is_none(), "{name}");
            }
            paths(mesh, &[], sides).into_iter().for_each(|(_, hits)| assert!(hits.is_empty()));
        }
    }
}

#[test]
fn the_ends_of_f32_do_no_harm() {
    let (most, least) = (f32::MAX, f32::from_bits(1));
    let corner = |x: f32| [[-x, -x, x], [x, -x, x], [0.0, x, x], [0.0, 0.0, -x]];
    for size in [most, most / 2.0, 1e30, 1e-30, f32::MIN_POSITIVE, least] {
        let mesh = Mesh::new(corner(size).to_vec(), vec![[0, 1, 2], [2, 1, 3], [0, 3, 1], [0, 2, 3]]).expect("a mesh");
        let mut rays: Vec<Ray> = hard_rays(&mesh, 24, 1).iter().map(|hard| hard.ray).collect();
        for origin in [[most; 3], [-most, 0.0, least], [0.0; 3], [size; 3]] {
            for direction in [[-1.0, -1.0, -1.0], [most; 3], [least, 0.0, -0.0], [least, -most, 1.0], [0.0, -0.0, most]]
            {
                rays.push(ray(origin, direction));
            }
        }
        for sides in [Sides::Front, Sides::Both] {
            let oracle = Oracle::new(&mesh, sides, Tolerance::ANY_T);
            for (name, hits) in paths(&mesh, &rays, sides) {
                assert_eq!(hits.len(), rays.len(), "{name}");
                for hit in hits.iter().flatten() {
                    assert!(hit.t >= 0.0 && !hit.t.is_nan() && (hit.triangle as usize) < mesh.len(), "{name}, {hit:?}");
                }
                let report = oracle.judge(&rays, &hits).expect("one answer a ray");
                let text = report.to_string();
                let longest = text.lines().map(str::len).max().unwrap_or(0);
                assert!(longest < 400 && text.lines().count() < 30, "{longest} bytes in a line of\n{text}");
            }
        }
    }
}

/// Squares in the planes x, y and z = -1, 0 and 1, which are also planes of the octree's cells.
fn walls() -> Mesh {
    let mut positions = Vec::new();
    for axis in 0..3 {
        for level in [-1.0f32, 0.0, 1.0] {
            for [u, v] in [[-1.0f32, -1.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 0.0]] {
                for [du, dv] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                    let mut corner = [level, u + du, v + dv];
                    corner.rotate_right(axis);
                    positions.push(corner);
                }
            }
        }
    }
    let triangles =
        (0..positions.len() as u32 / 4).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
    let triangles = triangles.collect();
    Mesh::new(positions, triangles).expect("a mesh")
}

/// Rays along a direction with zeros, from points between walls, in walls, on their edges and outside; the bits of
/// `signs` are the signs of the zeros.
fn rays_with_zeros(direction: [f32; 3], signs: usize) -> Vec<Ray> {
    let mut rays = Vec::new();
    let mut zeros = 0;
    let direction = direction.map(|x| {
        if x != 0.0 {
            return x;
        }
        zeros += 1;
        if signs >> (zeros - 1) & 1 == 1 { -0.0 } else { 0.0 }
    });
    let places = [-2.0f32, -1.0, -0.625, -0.0, 0.0, 0.25, 1.0, 3.0];
    for x in places {
        for y in places {
            rays.extend(places.map(|z| ray([x, y, z], direction)));
        }
    }
    rays
}

#[test]
fn the_signs_of_zeros_do_not_show_on_any_path() {
    let mesh = walls();
    let directions =
        [[1.0, 0.0, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 0.5], [1.0, 1.0, 0.0], [0.0, -1.0, 0.5], [-1.0, 0.0, 1.0]];
    for direction in directions {
        let zeros = direction.iter().filter(|&&x| x == 0.0).count();
        let plus = paths(&mesh, &rays_with_zeros(direction, 0), Sides::Both);
        for signs in 1..1 << zeros {
            let minus = paths(&mesh, &rays_with_zeros(direction, signs), Sides::Both);
            for ((name, plus), (_, minus)) in plus.iter().zip(&minus) {
                assert_eq!(bits(plus), bits(minus), "{name} along {direction:?}, signs {signs:b}");
            }
        }
        // All these numbers are exact in f32, so fp32 paths must be exact.
        let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ulps(0));
        for (name, hits) in plus.iter().filter(|(name, _)| !["r200", "r300"].contains(name)) {
            let report = oracle.judge(&rays_with_zeros(direction, 0), hits).expect("one answer a ray");
            assert!(report.agrees(), "{name} along {direction:?}: {report}");
        }
    }
}

/// Compares the fp32 paths with exact arithmetic, and their bits with each other.
fn right_everywhere(mesh: &Mesh, rays: &[Ray], sides: Sides) {
    let oracle = Oracle::new(mesh, sides, Tolerance::ulps(1));
    let found = paths(mesh, rays, sides);
    for (name, hits) in found.iter().filter(|(name, _)| !["r200", "r300"].contains(name)) {
        let report = oracle.judge(rays, hits).expect("one answer a ray");
        assert!(report.agrees(), "{name}: {report}");
        assert_eq!(bits(&found[0].1), bits(hits), "{name}");
    }
}

/// Depth 1 means no hit, so the farthest corner that a batch can meet must not have depth 1.
#[test]
fn the_farthest_corner_is_hit() {
    for size in [1.0f32, 8.0, 0.75, 5.0, 1024.0] {
        let corners = vec![[size; 3], [0.0, size, size], [size, 0.0, size]];
        let mesh = Mesh::new(corners, vec![[0, 1, 2]]).expect("a mesh");
        for length in [1.0f32, 0.75, 3.0, size] {
            right_everywhere(&mesh, &[ray([0.0; 3], [length; 3])], Sides::Both);
        }
    }
}

/// At a distance of 2^80 times the size of the mesh, f64 cannot distinguish cells.
#[test]
fn a_ray_from_far_away_finds_the_first_of_many() {
    let unit = 1.0 / (1u64 << 42) as f32;
    let far = (1u64 << 40) as f32;
    let mut corners = Vec::new();
    for sheet in 0..6 {
        let corner = |x: f32, y: f32, z: f32| [x, y, z].map(|x| unit * (x - 4.0 * sheet as f32));
        corners.extend([corner(3.0, 0.0, 0.0), corner(0.0, 3.0, 0.0), corner(0.0, 0.0, 3.0)]);
    }
    let mesh = soup(corners);
    right_everywhere(&mesh, &[ray([far; 3], [-far; 3]), ray([far; 3], [-1.0; 3])], Sides::Front);
}

/// The host's t must not be -0, because a depth buffer stores +0.
#[test]
fn a_ray_that_starts_on_a_back_face_starts_at_plus_zero() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).expect("a mesh");
    let rays = [ray([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]), ray([0.25, 0.25, 0.0], [0.0, 0.0, -1.0])];
    right_everywhere(&mesh, &rays, Sides::Both);
    let hits = HostTracer::with_octree(&mesh, FINE, Sides::Both).nearest_all(&rays).0;
    assert!(hits.iter().flatten().all(|hit| hit.t.to_bits() == 0), "{hits:?}");
}
