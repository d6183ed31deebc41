//! The models built by code: counts of Table 1, closed, with tangents everywhere.

use crossbar::prt::transfer::{Tangents, Vertices};
use crossbar::scene::built::meshes as models;

#[test]
fn they_have_as_many_vertices_as_table_1_prints() {
    let printed = [
        ("transfer-bumpy", 49_990, true),
        ("transfer-head", 50_060, true),
        ("transfer-polygons", 58_624, false),
        ("transfer-smooth", 48_688, true),
    ];
    let names = models::names().filter(|name| name.starts_with("transfer-"));
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
    assert!(models::build("transfer-bird").is_none());
}
