//! The octree loses no hit.

use crate::support::soup;
use crossbar::geom::exact::{self, Sides};
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::tracer::HostTracer;
use crossbar::tracer::octree::{Flow, GpuCells, Octree, OctreeParameters};
use proptest::prelude::*;

/// Coordinates on a grid, so that triangles are coplanar, degenerate, doubled, and rays run in the planes of cells.
fn grid() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => (-8i8..=8).prop_map(|i| f32::from(i) / 8.0),
        2 => -1.0f32..1.0,
        1 => Just(-0.0f32),
        1 => prop_oneof![Just(1e-30f32), Just(1e-6), Just(-1e-6)],
    ]
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    [grid(), grid(), grid()]
}

fn mesh() -> impl Strategy<Value = Mesh> {
    (prop::collection::vec([point(), point(), point()], 1..40), prop_oneof![Just(1.0f32), Just(1e6), Just(1e-6)])
        .prop_map(|(triangles, scale)| soup(triangles.into_iter().flatten().map(|p| p.map(|x| x * scale)).collect()))
}

/// Directions along axes and diagonals, and random ones, with zeros of both signs.
fn direction() -> impl Strategy<Value = [f32; 3]> {
    let part = || prop_oneof![Just(0.0f32), Just(-0.0), Just(1.0), Just(-1.0), -1.0f32..1.0];
    [part(), part(), part()].prop_filter("a direction", |d| d.iter().any(|x| *x != 0.0))
}

/// Trees of every shape. Each further level creates up to four times as many cells along a surface, so few trees are
/// deep. From the fourth level on, planes of the grid are planes of cells.
fn parameters() -> impl Strategy<Value = OctreeParameters> {
    (1usize..=4, prop_oneof![16 => 1u32..=5, 3 => Just(6), 1 => Just(8)])
        .prop_map(|(most_triangles, most_depth)| OctreeParameters { most_triangles, most_depth })
}

/// One cell: all pairs.
const WHOLE: OctreeParameters = OctreeParameters { most_triangles: usize::MAX, most_depth: 0 };

proptest! {
    #![proptest_config(ProptestConfig { cases: if cfg!(debug_assertions) { 4_000 } else { 40_000 }, ..ProptestConfig::default() })]

    /// One octree per case for both checks, since building it takes most of the time.
    #[test]
    fn every_hit_is_found_and_gpu_cells_hold_what_their_leaves_hold(
        mesh in mesh(),
        parameters in parameters(),
        rays in prop::collection::vec((point(), direction()), 4),
        both in any::<bool>(),
        end in 0.0f32..4.0,
        least in 1usize..6,
        more in 0usize..10,
    ) {
        let sides = if both { Sides::Both } else { Sides::Front };
        let [low, high] = mesh.bounds().expect("it has corners");
        let reach = (0..3).map(|i| high[i] - low[i]).fold(f32::MIN_POSITIVE, f32::max);
        let (fine, whole) = (HostTracer::with_octree(&mesh, parameters, sides), HostTracer::with_octree(&mesh, WHOLE, sides));
        let mut cast = Vec::new();
        for (i, (origin, d)) in rays.into_iter().enumerate() {
            let origin = if i % 2 == 1 { mesh.positions()[0] } else { origin.map(|x| x * reach) };
            let ray = Ray::new(origin, d).expect("finite, not 0");
            cast.push(ray);
            let (found, counts) = fine.nearest(&ray);
            let (expected, all) = whole.nearest(&ray);
            prop_assert!(all.tests <= mesh.len() as u64);
            if found != expected {
                // Rounding can produce a hit on a triangle that the ray misses; then no cell along the ray needs to
                // hold the triangle.
                let false_hit = expected.expect("what is found in cells is found among all").triangle;
                let corners = mesh.corners(false_hit).expect("a triangle");
                prop_assert!(exact::intersect(&ray, &corners, sides).is_none(), "lost {:?}, found {:?}", expected, found);
            }
            prop_assert_eq!((found, counts), fine.nearest_in(&ray, None), "the plain way");
            let before = found.map_or(1.0, |hit| hit.t);
            for end in [end, reach * end, before, before.next_up(), before * 2.0, f32::INFINITY, 0.0, -1.0, f32::NAN] {
                let (occluded, cost) = fine.occluded_before(&ray, end);
                if occluded != found.is_some_and(|hit| hit.t < end) {
                    // Rounding can move a hit's t in front of the cells that hold the triangle, out of reach of a
                    // search that ends at `end`. Then there is no hit in exact arithmetic either.
                    let hit = found.expect("only a hit can be lost");
                    let corners = mesh.corners(hit.triangle).expect("a triangle");
                    let exact = exact::intersect(&ray, &corners, sides).map(|t| t.to_f64());
                    prop_assert!(!occluded && exact.is_none_or(|t| t >= f64::from(end)), "{hit:?}, {exact:?}, before {end}");
                }
                prop_assert!(cost.tests <= counts.tests);
            }
        }
        // A ray's result does not depend on earlier rays, whose blockers are tried first.
        let bundle: Vec<Ray> = cast.iter().chain(cast.iter().rev()).copied().collect();
        for end in [end, reach * end, f32::INFINITY] {
            let each: Vec<bool> = bundle.iter().map(|ray| fine.occluded_before(ray, end).0).collect();
            prop_assert_eq!(fine.occluded_all(&bundle, end).0, each, "before {}", end);
        }
        let octree = fine.octree();
        let cells = GpuCells::mark(octree, least..=least + more);
        prop_assert_eq!(cells.iter().count(), cells.len());
        for cell in cells.iter() {
            let triangles = cells.triangles(cell).expect("a GPU cell");
            prop_assert!((least..=least + more).contains(&triangles.len()));
            prop_assert!(triangles.windows(2).all(|w| w[0] < w[1]), "rising, none twice");
        }
    }
}

#[test]
fn cells_come_front_to_back_and_cover_the_ray() {
    let octree = Octree::new(&teapot(4).expect("a teapot"), OctreeParameters::default());
    let random = CounterRng::new(3);
    for i in 0..2_000 {
        let point = |s| [0, 1, 2].map(|k| (8.0 * random.unit(i, s, k) - 4.0) as f32);
        let (from, to) = (point(0), point(1));
        let Ok(ray) = Ray::new(from, [to[0] - from[0], to[1] - from[1], to[2] - from[2]]) else { continue };
        let mut last = f64::NEG_INFINITY;
        octree.traverse(&ray, None, |cell| {
            assert!(cell.t[0] >= last - 1e-12 && cell.t[0] <= cell.t[1] + 1e-12, "ray {i}: {:?} after {last}", cell.t);
            last = cell.t[0];
            Flow::Continue
        });
    }
}
