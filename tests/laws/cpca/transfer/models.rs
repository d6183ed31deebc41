//! The models built by code: counts of Table 1 of both papers, closed, with tangents everywhere.

use crossbar::scene::built::meshes as models;
use crossbar::transfer::{Tangents, Vertices};

#[test]
fn they_have_as_many_vertices_as_table_1_prints() {
    let printed = [
        ("all-frequency-buddha", 54_100, true),
        ("all-frequency-bunny", 11_556, true),
        ("all-frequency-tweety", 32_768, true),
        ("bi-scale-armor", 10_652, true),
        ("bi-scale-bunny", 3_286, true),
        ("bi-scale-bunny-fine", 47_960, true),
        ("bi-scale-bunny-middle", 12_380, true),
        ("bi-scale-chair", 16_101, true),
        ("bi-scale-temple", 32_409, false),
        ("transfer-bumpy", 49_990, true),
        ("transfer-head", 50_060, true),
        ("transfer-polygons", 58_624, false),
        ("transfer-smooth", 48_688, true),
    ];
    let names = models::names()
        .filter(|name| ["transfer-", "all-frequency-", "bi-scale-"].iter().any(|paper| name.starts_with(paper)))
        // It has no texture coordinates.
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
        assert_eq!(mesh, models::build(name).expect("the same"), "no chance in it");
    }
    let teapot = models::build("all-frequency-teapot").expect("a model");
    assert_eq!(Vertices::new(&teapot, Tangents::Any).expect("vertices").len(), 51_361);
    assert!(models::build("transfer-bird").is_none());
}

/// The models of several materials use all of them, and no two of their parts share a vertex.
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
        assert_eq!(vertices.len(), models::build(name).expect("a mesh").positions().len(), "{name}");
    }
    let plain = models::build_with_materials("bi-scale-bunny").expect("a model");
    assert_eq!((plain.materials.len(), plain.material_of.len()), (1, plain.mesh.len()));
}
