use crossbar_base::geom::{Contact, Mesh};
use glam::DVec3;

fn square() -> Mesh {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [9.0, 9.0, 9.0]];
    Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh")
}

#[test]
fn a_square_has_area_bounds_and_normals() {
    let mesh = square();
    assert_eq!((mesh.area(0), mesh.area(1), mesh.area(2)), (0.5, 0.5, 0.0));
    assert_eq!(mesh.vertex_normals(), [DVec3::Z, DVec3::Z, DVec3::Z, DVec3::Z, DVec3::ZERO]);
    assert_eq!(mesh.degenerate_count(), 0);
    assert_eq!(mesh.contact(0, 1), Contact::Edge);
    assert_eq!(mesh.bounds(), Some([[0.0; 3], [1.0, 1.0, 0.0]]), "unused vertices do not count");
}

#[test]
fn contact_is_by_place() {
    let positions =
        vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let mesh = Mesh::new(positions, vec![[0, 1, 2], [3, 4, 5], [1, 1, 2]]).expect("a mesh");
    assert_eq!(mesh.contact(0, 1), Contact::Vertex);
    assert_eq!(mesh.contact(1, 2), Contact::None);
    assert_eq!(mesh.contact(0, 99), Contact::None);
    assert_eq!(mesh.degenerate_count(), 1);
}

#[test]
fn attributes_are_one_per_vertex() {
    let found = square().with_normals(vec![[0.0, 0.0, 1.0]; 4]).unwrap_err();
    assert_eq!(found.to_string(), "found 4 normals, expected one per vertex: 5");
    let found = square().with_texcoords(vec![[0.0, f32::NAN]; 5]).unwrap_err().to_string();
    let expected = "among the texture coordinates of vertex 0 (counted from 0) is NaN, expected finite numbers";
    assert_eq!(found, expected);
    let mesh = square().with_texcoords(vec![[0.5, 1.0]; 5]).expect("a pair per vertex");
    assert_eq!((mesh.normals(), mesh.texcoords()), (None, Some(&[[0.5, 1.0]; 5][..])));
}

#[test]
fn welding_joins_what_is_at_one_place() {
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-0.0, 1.0, 0.0]];
    let torn = Mesh::new(vec![a, b, c, a, c, d], vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
    assert_eq!(torn.boundary_edge_count(), 6);
    assert_eq!((torn.welded().triangles(), torn.welded().boundary_edge_count()), (&[[0, 1, 2], [0, 2, 3]][..], 4));
}
