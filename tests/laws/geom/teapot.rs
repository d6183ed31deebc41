//! The teapot's topology, checked with formulas.

use std::collections::BTreeMap;

use crossbar::geom::Mesh;
use crossbar::geom::teapot;

const RATES: [u32; 6] = [1, 2, 3, 4, 8, 16];

fn part_of(patch: u8) -> &'static str {
    match patch {
        0..=11 => "body",
        12..=15 => "handle",
        16..=19 => "spout",
        20..=27 => "lid",
        _ => "bottom",
    }
}

/// Six times the volume between the origin and the triangles of one part.
fn signed_volume(teapot: &teapot::Teapot, part: &str) -> f64 {
    let triangles = teapot.mesh.iter_corners().zip(&teapot.patch_of);
    triangles
        .filter(|&(_, &patch)| part_of(patch) == part)
        .map(|(corners, _)| {
            let [a, b, c] = corners.map(|corner| corner.map(f64::from));
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        })
        .sum()
}

/// Number of boundary edges of each part.
fn rims(teapot: &teapot::Teapot) -> BTreeMap<&'static str, usize> {
    let mut rims = BTreeMap::new();
    for edge in teapot.mesh.edges() {
        if let [triangle] = edge.triangles[..] {
            let patch = teapot.patch_of[triangle as usize];
            *rims.entry(part_of(patch)).or_default() += 1;
        }
    }
    rims
}

#[test]
fn the_teapot_is_watertight_but_for_its_sixteen_n_rim_edges() {
    for rate in RATES {
        let n = rate as usize;
        let teapot = teapot::tessellate(rate).expect("a teapot");
        let mesh = &teapot.mesh;
        assert_eq!(mesh.degenerate_count(), 0, "degenerate triangles at rate {n}");
        let crowded = mesh.edges().iter().filter(|edge| edge.triangles.len() > 2).count();
        if rate == 1 {
            // Handle and spout are double sheets: see the module's documentation.
            assert_eq!(rims(&teapot), BTreeMap::from([("body", 4), ("lid", 4)]));
            assert_eq!((crowded, mesh.len()), (1, 52));
            continue;
        }
        assert_eq!(mesh.len(), 64 * n * n - 8 * n, "triangles at rate {n}");
        assert_eq!(mesh.boundary_edge_count(), 16 * n, "boundary edges at rate {n}");
        let expected = [("body", 4 * n), ("handle", 4 * n), ("spout", 4 * n), ("lid", 4 * n)];
        assert_eq!(rims(&teapot), BTreeMap::from(expected), "rims at rate {n}");
        assert_eq!((crowded, mesh.orientation_conflicts()), (0, 0), "at rate {n}");
    }
}

#[test]
fn every_vertex_has_a_place_of_its_own_and_a_use() {
    for rate in RATES {
        let mesh = teapot::teapot(rate).expect("a teapot");
        let mut places: Vec<_> = mesh.positions().iter().map(|position| position.map(f32::to_bits)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), mesh.positions().len());
        let mut used: Vec<_> = mesh.triangles().iter().flatten().collect();
        used.sort_unstable();
        used.dedup();
        // At rate 1 the spout's tip vanishes, and with it two vertices.
        assert_eq!(used.len() + if rate == 1 { 2 } else { 0 }, mesh.positions().len());
    }
}

#[test]
fn front_faces_look_outwards() {
    let teapot = teapot::tessellate(8).expect("a teapot");
    for part in ["body", "handle", "spout", "lid"] {
        assert!(signed_volume(&teapot, part) > 0.0, "{part}");
    }
    // The bottom's volume is measured from the origin, which lies on it, so its normals are checked instead.
    let bottom = (0..).zip(&teapot.patch_of).filter(|&(_, &patch)| part_of(patch) == "bottom");
    for (triangle, _) in bottom {
        let [a, b, c] = teapot.mesh.corners(triangle).expect("a triangle");
        let up = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(up < 0.0, "triangle {triangle}");
    }
}

#[test]
fn a_finer_teapot_keeps_the_points_of_a_coarser_one() {
    let coarse = teapot::teapot(4).expect("a teapot");
    let fine: Mesh = teapot::teapot(8).expect("a teapot");
    let places: std::collections::BTreeSet<_> = fine.positions().iter().map(|place| place.map(f32::to_bits)).collect();
    assert!(coarse.positions().iter().all(|place| places.contains(&place.map(f32::to_bits))));
}
