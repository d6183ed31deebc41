//! Meshes and rays at the ends of what f32 holds: nobody panics, hangs or invents numbers; and zeros of both signs are one direction.

use crossbar::geom::exact;
use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{Oracle, Tolerance, assert_hits_eq, hard_rays};
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::ray_engine::octree::OctreeParameters;
use crossbar::ray_engine::{Crossbar, HostTracer};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

const FINE: OctreeParameters = OctreeParameters { most_triangles: 1, most_depth: 20 };

/// Every path's answers, by name: the host, the engine on a card, the cards alone.
fn paths(mesh: &Mesh, rays: &[Ray], sides: Sides) -> Vec<(&'static str, Vec<Option<Hit>>)> {
    let profile = |name| Profile::named(name).expect("a profile");
    let mut found = vec![("host", HostTracer::new(mesh, FINE, sides).nearest_all(rays).0)];
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
                assert_hits_eq(&hits, &[None]);
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
                assert!(report.to_string().len() < 5000 && serde_json::to_string(&report).is_ok());
            }
        }
    }
}

/// Squares in the planes x, y and z = -1, 0 and 1: walls, and planes of every cell of the octree.
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

/// All rays of a direction with zeros, from points between walls, in them, on their edges and outside, with the zeros' signs by bits.
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
                println!("{name} {direction:?} {signs}");
                assert_hits_eq(plus, minus);
            }
        }
        // These numbers are all exact in f32: fp32 paths have no excuse.
        let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ulps(0));
        for (name, hits) in plus.iter().filter(|(name, _)| !["r200", "r300"].contains(name)) {
            let report = oracle.judge(&rays_with_zeros(direction, 0), hits).expect("one answer a ray");
            assert!(report.agrees(), "{name} along {direction:?}: {report}");
        }
    }
}
