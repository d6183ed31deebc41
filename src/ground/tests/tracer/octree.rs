//! The fast traversal compared with the plain one, and the triangles that a cell lists.

use crossbar_base::geom::polygon::clipped;
use crossbar_base::geom::random::CounterRng;
use crossbar_base::geom::teapot::teapot;
use crossbar_base::geom::vector::wide;
use crossbar_base::geom::{Mesh, Ray, Sides};
use crossbar_ground::tracer::HostTracer;
use crossbar_ground::tracer::octree::{Flow, Octree, OctreeParameters};
use proptest::prelude::*;

/// Rays between random points within and around the teapot, on a grid that includes the planes of cells and both zeros.
fn rays(mesh: &Mesh, count: u64) -> Vec<Ray> {
    let random = CounterRng::new(17);
    let [low, high] = mesh.bounds().expect("bounds").map(wide);
    let widest = (high - low).max_element();
    // The side of the octree's root, as in `Octree::new`.
    let size = widest * (1.0 + 1e-3) + low.abs().max(high.abs()).max_element() * 1e-6;
    let middle = (low + high) / 2.0;
    let ray = |i: u64| {
        let grid = |sample, k| (16.0 * random.unit(i, sample, k)).floor() - 8.0;
        let number = |sample, k| match i % 3 {
            0 => 16.0 * random.unit(i, sample, k) - 8.0,
            1 => grid(sample, k),
            _ => grid(sample, k) * f64::from(random.unit(i, sample + 2, k) < 0.5),
        };
        let from = [0, 1, 2].map(|k| (middle[k] + size / 8.0 * number(0, k as u64)) as f32);
        Ray::new(from, [0, 1, 2].map(|k| number(1, k as u64) as f32)).ok()
    };
    (0..count).filter_map(ray).collect()
}

/// Hits and all counters are equal: cells and leaves entered, and triangles tested until a hit ends the search.
#[test]
fn the_fast_traversal_visits_what_the_plain_one_visits() {
    let mesh = teapot(3).expect("a teapot");
    for (most_triangles, most_depth) in [(2, 9), (8, 10), (1000, 3), (usize::MAX, 0)] {
        let parameters = OctreeParameters { most_triangles, most_depth };
        for sides in [Sides::Front, Sides::Both] {
            let tracer = HostTracer::with_octree(&mesh, parameters, sides);
            let mut still = 0;
            for ray in rays(&mesh, 30_000) {
                let (hit, counts) = tracer.nearest(&ray);
                assert_eq!((hit, counts), tracer.nearest_in(&ray, None), "{ray:?}");
                still += usize::from(ray.direction().contains(&0.0) && counts.traversal.leaves > 0);
            }
            assert!(still > 3000, "{still} rays in planes");
        }
    }
}

fn corner() -> impl Strategy<Value = [f32; 3]> {
    // Coordinates in quarter steps produce points, needles, and triangles in the planes of cells.
    prop::array::uniform3(prop_oneof![-1.0..1.0_f32, (-4..5_i8).prop_map(|step| f32::from(step) / 4.0)])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_cell_lists_the_triangles_that_touch_it(
        corners in prop::array::uniform3(corner()),
        repeated in 0..4_usize,
    ) {
        let mut corners = corners;
        if repeated < 2 {
            corners[1 + repeated] = corners[0];
        }
        // The second triangle contains the middle, the origin.
        let frame = [[-2.0; 3], [2.0; 3], [-2.0, 2.0, -2.0]];
        let positions = corners.into_iter().chain(frame).collect();
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
        let octree = Octree::new(&mesh, OctreeParameters { most_triangles: 0, most_depth: 1 });
        for octant in 0..8 {
            let sign = [0, 1, 2].map(|axis| if octant >> axis & 1 == 1 { 1.0 } else { -1.0 });
            let touches = |margin: f64| {
                let whole = corners.map(wide).to_vec();
                !(0..3).fold(whole, |part, axis| clipped(&part, |at| sign[axis] * at[axis] + margin)).is_empty()
            };
            let inside = Ray::new(sign.map(|side| side as f32), [1.0, 0.0, 0.0]).expect("a ray");
            let mut listed = None;
            octree.traverse(&inside, None, |cell| {
                if cell.t[0] <= 0.0 {
                    listed = Some(cell.triangles.contains(&0));
                }
                Flow::Stop
            });
            let listed = listed.unwrap_or(false);
            let margin = octree.margin();
            prop_assert!(listed || !touches(0.999 * margin), "octant {}: one is missing", octant);
            prop_assert!(!listed || touches(1.001 * margin), "octant {}: one too many", octant);
        }
    }
}
