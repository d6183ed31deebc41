//! The models of the papers on transfer have the counts of the papers' tables, and tangents everywhere.

use crate::environment::is_full;
use std::path::Path;

use crossbar::geom::Mesh;
use crossbar::io::load_mesh;
use crossbar::scene::built::meshes as models;
use crossbar::transfer::{Tangents, Vertices};

/// Number of vertices above which models are built a second time only with `CROSSBAR_FULL=1`.
const SMALL: usize = 20_000;

#[test]
fn they_have_as_many_vertices_as_table_1_prints() {
    let full = is_full();
    let printed = [
        ("all-frequency-buddha", 54_100, true),
        ("all-frequency-bunny", 11_556, true),
        ("all-frequency-tweety", 32_768, true),
        ("bi-scale-armor", 10_652, true),
        ("bi-scale-bunny", 3_286, true),
        ("bi-scale-bunny-fine", 47_960, true),
        ("bi-scale-bunny-middle", 12_380, true),
        ("bi-scale-chair", 16_101, false),
        ("bi-scale-temple", 32_409, false),
        ("transfer-bird", 48_688, true),
        ("transfer-buddha", 49_990, true),
        ("transfer-head", 50_060, true),
        ("transfer-polygons", 58_624, false),
    ];
    let names = models::names()
        .filter(|name| ["transfer-", "all-frequency-", "bi-scale-"].iter().any(|paper| name.starts_with(paper)))
        // This teapot has no texture coordinates.
        .filter(|&name| name != "all-frequency-teapot");
    assert!(names.eq(printed.map(|(name, ..)| name)));
    for (name, count, closed) in printed {
        let mesh = models::build(name).expect("a model");
        let vertices = Vertices::new(&mesh, Tangents::Texture).expect("vertices");
        assert_eq!(vertices.len(), count, "{name}");
        assert!(models::description(name).expect("a line").contains(&format!("{},{:03}", count / 1000, count % 1000)));
        assert_eq!((vertices.unused, &vertices.replaced_tangents[..]), (0, &[][..]), "{name}");
        let welded = mesh.welded();
        assert_eq!(welded.boundary_edge_count() == 0, closed, "{name}");
        assert_eq!((welded.orientation_conflicts(), welded.degenerate_count()), (0, 0), "{name}");
        if full || count <= SMALL {
            assert_eq!(mesh, models::build(name).expect("the same"), "no chance in it");
        }
    }
    let teapot = models::build("all-frequency-teapot").expect("a model");
    assert_eq!(Vertices::new(&teapot, Tangents::Any).expect("vertices").len(), 51_361);
    assert!(models::build("transfer-dodo").is_none());
}

/// The subsurface paper's bunny is the scan in the file, rotated, moved and scaled; the bi-scale paper's finest bunny
/// keeps its vertices.
#[test]
fn bunnies_are_of_the_scan() {
    let scanned = load_mesh(Path::new("src/ground/scene/built/bunny.ply")).expect("a model");
    assert_eq!((scanned.positions().len(), scanned.len()), (35_947, 69_451));
    let [bunny, fine] = ["stanford-bunny", "bi-scale-bunny-fine"].map(|name| models::build(name).expect("a model"));
    assert_eq!((bunny.positions().len(), bunny.len(), bunny.boundary_edge_count()), (34_834, 69_451, 223));
    let side = |from: [f32; 3], to: [f32; 3]| [0, 1, 2].map(|axis| f64::from(to[axis] - from[axis]));
    let size = |mesh: &Mesh, axis: usize| mesh.bounds().map(|[low, high]| side(low, high)[axis]).expect("a box");
    // The unused vertices of the file lie inside its box.
    let scale = size(&bunny, 0) / size(&scanned, 0);
    for ([a, b, _], [first, second, _]) in bunny.iter_corners().zip(scanned.iter_corners()) {
        let [x, y, z] = side(first, second);
        let off = side(a, b).into_iter().zip([x, -z, y]).map(|(ours, file)| (ours - scale * file).abs());
        assert!(off.fold(0.0, f64::max) < 1e-5, "{a:?}, {first:?}");
    }
    for place in bunny.positions().iter().step_by(100) {
        assert!(fine.positions().iter().any(|&other| side(*place, other).iter().all(|off| off.abs() < 0.02)));
    }
}

/// Models with several materials use all of them.
#[test]
fn flat_models_have_their_materials() {
    for (name, expected) in [
        ("bi-scale-chair", &["frame", "seat", "back"][..]),
        ("bi-scale-temple", &["steps", "pillars", "walls", "eaves", "roof"]),
    ] {
        let model = models::build_with_materials(name).expect("a model");
        assert!(model.materials.iter().map(|material| material.name.as_str()).eq(expected.iter().copied()));
        for number in 0..expected.len() as u32 {
            assert!(model.material_of.contains(&number), "{name} is nowhere of {number}");
        }
        assert_eq!(model.material_of.len(), model.mesh.len());
        let vertices = Vertices::with_materials(&model.mesh, &model.material_of, Tangents::Texture).expect("vertices");
        // Vertices that the file repeats at the seams of tubes count once.
        assert!(vertices.len() <= models::build(name).expect("a mesh").positions().len(), "{name}");
    }
    let plain = models::build_with_materials("bi-scale-bunny").expect("a model");
    assert_eq!((plain.materials.len(), plain.material_of.len()), (1, plain.mesh.len()));
}
