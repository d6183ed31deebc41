//! Search for a nearby ray for which a wrong hit is correct.

use crossbar_base::geom::vector::wide;
use crossbar_base::geom::{Hit, Mesh, Ray, Sides, exact};
use crossbar_base::oracle::{Disagreement, DisagreementKind, Oracle, Tolerance};

/// A square of two triangles from (0, 0) to (1, 1) in the plane z = 0.
fn square() -> Mesh {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh")
}

fn wrong(mesh: &Mesh, ray: &Ray, found: Option<Hit>, ulps: u32) -> Disagreement {
    let oracle = Oracle::new(mesh, Sides::Front, Tolerance::ANY_T).with_nearby_ulps(ulps);
    oracle.judge_one(0, ray, found).1.expect("a wrong answer")
}

/// A miss just inside the square's outline is correct for a ray on the first ring of 1, 2, 4, ... ULPs that reaches
/// beyond the outline. `off` is the ray's distance inside, in ULPs of the direction. If no ring within the limit
/// reaches it, the miss is a leak.
#[test]
fn nearby_directions_are_tried_in_rings_up_to_the_limit() {
    let mesh = square();
    let unit = f64::from(f32::EPSILON);
    for off in [0_u32, 1, 2, 3, 4, 7, 8, 11] {
        // From (0.5, 1, 1) straight down, turned inwards by `off` ULPs of the z component 1.
        let ray = Ray::new([0.5, 1.0, 1.0], [0.0, -(off as f32) * f32::EPSILON, -1.0]).expect("a ray");
        assert!(exact::nearest(&mesh, &ray, Sides::Front).is_some());
        for ulps in [0, 1, 2, 3, 4, 8, 12, 16] {
            let found = wrong(&mesh, &ray, None, ulps);
            // The limit itself is the last ring.
            let rings = [1, 2, 4, 8].into_iter().filter(|&ring| ring < ulps).chain([ulps]);
            let Some(ring) = rings.into_iter().find(|&ring| ring > off) else {
                assert_eq!((found.kind, found.right_for), (DisagreementKind::Leak, None), "{off} of {ulps}");
                continue;
            };
            let right = found.right_for.expect("a ray nearby");
            let by = wide(right.direction()) - wide(ray.direction());
            assert_eq!((found.kind, right.origin()), (DisagreementKind::Silhouette, ray.origin()), "{off} of {ulps}");
            assert_eq!((by.z, by.abs().max_element() / unit), (0.0, f64::from(ring)), "{off} of {ulps}: {right:?}");
            assert_eq!(exact::nearest(&mesh, &right, Sides::Front), None);
        }
    }
}

/// Directions beyond f32 are skipped; nearer ones are still found.
#[test]
fn the_largest_direction_has_nearby_ones() {
    let mesh = square();
    let ray = Ray::new([-0.5, 0.0, 1.0], [f32::MAX, f32::MAX, -f32::MAX]).expect("a ray");
    assert_eq!(wrong(&mesh, &ray, None, 8).kind, DisagreementKind::Silhouette);
}

/// A ray that starts within a few ULPs of a surface, on either side of it, may hit it or not.
#[test]
fn origins_move_along_the_ray() {
    let mesh = Mesh::new(vec![[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], vec![[0, 1, 2]]).expect("a mesh");
    // One ULP of the corners' largest coordinate, 4.
    let unit = 4.0 * f32::EPSILON;
    let start = |steps: f32| Ray::new([1.0, 1.0, steps * unit], [0.0, 0.0, -0.5]).expect("a ray");
    for (steps, ulps, moved) in [(0.0, 2, Some(-1.0)), (1.0, 2, Some(-1.0)), (2.0, 4, Some(-2.0)), (3.0, 2, None)] {
        let found = wrong(&mesh, &start(steps), None, ulps);
        let kind = if moved.is_some() { DisagreementKind::Start } else { DisagreementKind::Leak };
        assert_eq!((found.kind, found.right_for), (kind, moved.map(start)), "{steps} steps in front");
    }
    let behind = wrong(&mesh, &start(-1.0), Some(Hit { triangle: 0, t: 0.0 }), 2);
    assert_eq!((behind.kind, behind.right_for), (DisagreementKind::Start, Some(start(0.0))));
}

/// A neighbour in place of the right triangle is rounding if the ray passes their common edge or corner.
#[test]
fn contacts_are_passed_within_a_few_ulps() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, -1.0, -0.5]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 1, 3], [0, 3, 4]]).expect("a mesh");
    let down = |x: f32, y: f32| Ray::new([x, y, 4.0], [0.0, 0.0, -1.0]).expect("a ray");
    let little = 4.0 * f32::EPSILON;
    let passes = |ray: &Ray, triangle: u32| {
        let found = wrong(&mesh, ray, Some(Hit { triangle, t: 4.0 }), 2);
        found.right_for.is_some() || found.touched_by.is_some()
    };
    assert!(passes(&down(0.5, little), 1), "beside the edge");
    assert!(!passes(&down(0.5, 0.1), 1));
    assert!(!passes(&down(0.5, little), 2), "far from the corner");
    assert!(passes(&down(little, 0.0), 2));
    let none = wrong(&mesh, &down(little, 0.0), Some(Hit { triangle: 7, t: 4.0 }), 2);
    assert_eq!((none.kind, none.touched_by), (DisagreementKind::NoSuchTriangle, None));
}
