//! A bucket's beam covers every cell that one of its rays visits.

use crate::environment::by_form;
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::tracer::octree::{Beam, Flow, GpuCells, Octree, OctreeParameters};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Rays through one face of the cube: they start in a box and mostly point into a cone; some components are zero, equal
/// or tiny.
fn bucket(random: CounterRng, count: u64, [distance, origins, directions]: [f64; 3]) -> Vec<Ray> {
    let at = |i: u64, k: u64| 2.0 * random.unit(i, 1, k) - 1.0;
    let (axis, sign) =
        (random.bits(0, 2, 0) as usize % 3, if random.bits(0, 2, 1).is_multiple_of(2) { 1.0 } else { -1.0 });
    let middle = [0, 1].map(|k| 0.9 * at(0, 10 + k));
    let ray = |i: u64| {
        let origin = [0, 1, 2].map(|k| (distance * at(0, k) + origins * at(1 + i, k)) as f32);
        let slope = |k: usize| match random.bits(i, 3, k as u64) % 12 {
            0 => 0.0,
            1 => -0.0,
            2 => 1.0,
            3 => -1.0,
            4 => 1e-40,
            _ => (middle[k] + directions * at(1 + i, 20 + k as u64)).clamp(-1.0, 1.0) as f32,
        };
        let mut d = [0.0_f32; 3];
        d[axis] = sign as f32;
        (d[(axis + 1) % 3], d[(axis + 2) % 3]) = (slope(0), slope(1));
        Ray::new(origin, d).ok()
    };
    (0..count).filter_map(ray).collect()
}

fn scene() -> Mesh {
    teapot(2).expect("a teapot")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(by_form(600, 20_000)))]

    #[test]
    fn no_cell_that_a_ray_visits_is_passed_by(
        seed in any::<u64>(), gpu in any::<bool>(),
        distance in prop::sample::select(vec![0.0, 1.0, 4.0, 1e5, 1e8]),
        origins in prop::sample::select(vec![0.0, 1e-6, 0.1, 2.0]),
        directions in prop::sample::select(vec![0.0, 1e-6, 0.05, 1.0]),
    ) {
        let octree = Octree::new(&scene(), OctreeParameters { most_triangles: 4, most_depth: 7 });
        let cells = GpuCells::mark(&octree, 5..=15);
        let gpu = gpu.then_some(&cells);
        let rays = bucket(CounterRng::new(seed), 40, [distance, origins, directions]);
        // A ray with equal components passes through the first of two faces.
        for face in 0..6 {
            let looks = |ray: &&Ray| {
                let d = ray.direction();
                let axis = (1..3).fold(0, |best: usize, axis| if d[axis].abs() > d[best].abs() { axis } else { best });
                2 * axis + usize::from(d[axis] < 0.0) == face
            };
            let rays: Vec<Ray> = rays.iter().filter(looks).copied().collect();
            let Some(beam) = Beam::of(&rays) else { continue };
            let reached: BTreeSet<_> = octree.reached(&beam, gpu, true).cells.into_iter().collect();
            let first = octree.reached(&beam, gpu, false);
            prop_assert_eq!(first.cells.is_empty(), reached.is_empty());
            for ray in &rays {
                let mut missed = None;
                octree.traverse(ray, gpu, |cell| {
                    if !reached.contains(&cell.cell) {
                        missed = Some(cell.cell);
                    }
                    Flow::Continue
                });
                prop_assert_eq!(missed, None, "{:?}", ray);
            }
        }
    }
}

#[test]
fn a_narrow_beam_reaches_few_cells_and_rays_of_many_ways_make_none() {
    let octree = Octree::new(&scene(), OctreeParameters { most_triangles: 4, most_depth: 7 });
    let to = |d: [f32; 3]| Ray::new([0.0, -8.0, 0.5], d).expect("a ray");
    let rays: Vec<Ray> = (0..16).map(|i| to([0.01 * i as f32, 1.0, 0.0])).collect();
    let beam = Beam::of(&rays).expect("one face");
    let (near, leaves) = (octree.reached(&beam, None, true), octree.leaves());
    assert!(!near.cells.is_empty() && near.cells.len() * 4 < leaves, "{} of {leaves}", near.cells.len());
    let away: Vec<Ray> = rays.iter().map(|ray| to(ray.direction().map(|x| -x))).collect();
    let past = octree.reached(&Beam::of(&away).expect("one face"), None, true);
    assert!(past.cells.is_empty() && past.tested == 1, "{past:?}");
    assert_eq!(Beam::of(&[rays[0], away[0]]), None);
    assert_eq!(Beam::of(&[]), None);
}
