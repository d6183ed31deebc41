//! Unusual meshes and sizes, and invariances.

use crate::support::soup;
use crossbar::atlas::{Atlas, AtlasQuality, Census, MAX_SIDE};
use crossbar::geom::Mesh;
use crossbar::geom::random::CounterRng;
use crossbar::scene::built::meshes;
use glam::DVec3;
use proptest::prelude::*;

use super::meshes::{atlases, ring, round};

#[test]
fn what_has_no_atlas_is_refused() {
    let sphere = round(8, 5);
    assert_eq!(sphere.len(), 64);
    assert!(Atlas::new(&sphere, 8).is_ok(), "as many texels as faces");
    for side in [0, 2, 3, 12, 100, u32::MAX, 2 * MAX_SIDE] {
        assert!(Atlas::new(&sphere, side).is_err(), "{side}");
    }
    assert!(Atlas::new(&Mesh::default(), 8).is_err());
    let flat = Mesh::new(vec![[1.0; 3], [2.0; 3], [3.0; 3]], vec![[0, 1, 2], [0, 0, 1]]).expect("a mesh");
    assert!(Atlas::new(&flat, 8).is_err(), "no area");
}

#[test]
fn one_face_has_the_whole_square() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).expect("a mesh");
    for side in [1, 2, 16] {
        let atlas = Atlas::new(&mesh, side).expect("an atlas");
        assert_eq!(atlas.places()[0].texels(), side * side);
        assert!(atlas.texels().iter().all(|texel| texel.normal == DVec3::Z));
        let top = atlas.cluster(atlas.levels() - 1, 0, 0);
        approx::assert_abs_diff_eq!(top.point.distance(DVec3::new(1.0, 1.0, 0.0) / 3.0), 0.0, epsilon = 1e-15);
    }
}

/// Faces without area, repeated faces, reversed faces, three faces on an edge: all have texels and are counted.
#[test]
fn oddities_are_counted() {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [5.0; 3], [6.0, 5.0, 5.0]];
    let triangles = vec![[0, 1, 2], [2, 1, 0], [0, 1, 3], [0, 1, 2], [4, 5, 5], [4, 4, 4]];
    let atlas = Atlas::new(&Mesh::new(positions, triangles).expect("a mesh"), 8).expect("an atlas");
    let expected = Census {
        faces: 6,
        parts: 3,
        boundary_edges: 3,
        crowded_edges: 3,
        orientation_conflicts: 4,
        faces_without_area: 2,
        duplicate_faces: 2,
    };
    assert_eq!(*atlas.census(), expected);
    assert!(!expected.is_sound());
    // A square that is listed twice, cut along both diagonals, and turned so that its corners are rounded.
    let corner = |[x, y]: [f32; 2]| [0.6 * x + 0.1, 0.64 * x - 0.6 * y, 0.48 * x + 0.8 * y];
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(corner).to_vec();
    let twice = Mesh::new(square, vec![[0, 1, 2], [0, 2, 3], [1, 2, 3], [3, 0, 1]]).expect("a mesh");
    assert_eq!(Atlas::new(&twice, 8).expect("an atlas").census().duplicate_faces, 2);
    assert!(atlas.places().iter().all(|place| place.texels() >= 1));
    assert!(AtlasQuality::of(&atlas).used < 1.0);
}

/// Sizes at the limits of f32.
#[test]
fn the_ends_of_f32_do_no_harm() {
    for size in [f32::MAX, 1e30, 1e-30, f32::MIN_POSITIVE, f32::from_bits(2), f32::from_bits(1)] {
        let corners = vec![[-size, -size, size], [size, -size, size], [0.0, size, size], [0.0, 0.0, -size]];
        let mesh = Mesh::new(corners, vec![[0, 1, 2], [2, 1, 3], [0, 3, 1], [0, 2, 3]]).expect("a mesh");
        let atlas = Atlas::new(&mesh, 16).expect("an atlas");
        assert!(atlas.census().is_sound());
        assert!(atlas.texels().iter().all(|texel| texel.point.is_finite() && texel.area > 0.0), "{size}");
        let top = atlas.cluster(4, 0, 0);
        assert!(top.radius.is_finite() && top.radius >= f64::from(size), "{size}: {top:?}");
        assert_eq!(AtlasQuality::of(&atlas).used, 1.0);
    }
}

/// Thousands of faces on one edge, at the same position, or without any neighbor.
#[test]
fn crowds_are_mapped() {
    let random = CounterRng::new(5);
    let place = |index: u64| [0, 1, 2].map(|axis| random.unit(index, 0, axis) as f32);
    let crowd = |corners: &dyn Fn(u32) -> [u32; 3]| {
        let positions = (0..9000).map(place).collect();
        Mesh::new(positions, (0..3000).map(corners).collect()).expect("a mesh")
    };
    let fan = crowd(&|face| [0, 1, 2 + face]);
    let heap = crowd(&|_| [0, 1, 2]);
    let loose = crowd(&|face| [3 * face, 3 * face + 1, 3 * face + 2]);
    for (mesh, parts) in [(fan, 1), (heap, 1), (loose, 3000)] {
        let atlas = Atlas::new(&mesh, 64).expect("an atlas");
        assert_eq!((atlas.census().parts, atlas.tree().nodes().len()), (parts, 5999));
    }
}

/// Vertices that a file repeats, because normals jump there, do not tear the surface.
#[test]
fn repeated_vertices_are_one_place() {
    let whole = ring([8, 6]);
    let torn = soup(whole.iter_corners().flatten().collect());
    let [whole, torn] = [whole, torn].map(|mesh| Atlas::new(&mesh, 32).expect("an atlas"));
    assert_eq!(whole.tree(), torn.tree());
    assert_eq!(whole.texels(), torn.texels());
    assert!(torn.census().is_sound());
}

#[test]
fn stand_ins_have_the_papers_counts() {
    let counts = ["stand-in-head", "stand-in-dolphin", "stanford-bunny"].map(|name| {
        let mesh = meshes::build(name).expect("a stand-in");
        assert_eq!((mesh.degenerate_count(), mesh.orientation_conflicts()), (0, 0), "{name}");
        // Fronts look outwards: six times the enclosed volume, from a point inside.
        let volume: f64 = mesh
            .iter_corners()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
                a.dot(b.cross(c))
            })
            .sum();
        assert!(volume > 0.0, "{name}");
        (mesh.len(), mesh.boundary_edge_count() > 0)
    });
    assert_eq!(counts, [(7_232, false), (21_952, false), (69_451, true)]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Nothing depends on the unit of length: a mesh scaled by 2^66 or 2^-66 has the same atlas.
    #[test]
    fn the_unit_does_not_matter((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        for exponent in [127 + 66, 127 - 66] {
            let scale = f32::from_bits(exponent << 23);
            let positions = sample.mesh.positions().iter().map(|at| at.map(|value| value * scale)).collect();
            let scaled = Mesh::new(positions, sample.mesh.triangles().to_vec()).expect("a mesh");
            let other = Atlas::new(&scaled, side).expect("an atlas");
            prop_assert_eq!(other.places(), atlas.places());
            prop_assert_eq!(other.census(), atlas.census());
            let scale = f64::from(scale);
            for (own, theirs) in atlas.texels().iter().zip(other.texels()) {
                prop_assert_eq!((own.face, own.point * scale, own.area * scale * scale), (theirs.face, theirs.point, theirs.area));
            }
        }
    }

    /// On any mesh, no number is NaN or infinite and normals have length 1.
    #[test]
    fn nothing_is_nan((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        for texel in atlas.texels() {
            prop_assert!(texel.point.is_finite() && texel.area.is_finite() && texel.area >= 0.0);
            let length = texel.normal.length();
            prop_assert!(length == 0.0 || (length - 1.0).abs() < 1e-12, "{texel:?}");
        }
        for cluster in (0..atlas.levels()).flat_map(|level| atlas.clusters(level)) {
            prop_assert!(cluster.point.is_finite() && cluster.radius.is_finite() && cluster.radius >= 0.0);
        }
        let quality = AtlasQuality::of(&atlas);
        prop_assert!(quality.used > 0.0 && quality.deviation.is_finite() && quality.least <= quality.most);
        prop_assert!(quality.levels.iter().all(|level| level.compactness.is_finite() && level.radius.is_finite()));
    }
}
