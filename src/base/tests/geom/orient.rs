use crossbar_base::geom::Mesh;

fn mesh(triangles: Vec<[u32; 3]>) -> Mesh {
    let positions = vec![
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [-1.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [2.0, 0.0, 0.0],
        [0.5, 1e-45, 0.0],
        [0.5, 1e-7, 0.0],
    ];
    Mesh::new(positions, triangles).expect("a mesh")
}

#[test]
fn the_smaller_part_is_turned() {
    let tetrahedron = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    assert!(mesh(tetrahedron.to_vec()).misoriented().is_empty());
    for wrong in 0..4 {
        let mut triangles = tetrahedron.to_vec();
        triangles[wrong].swap(1, 2);
        let found = mesh(triangles);
        assert_eq!(found.misoriented(), [wrong as u32]);
        assert_eq!(found.turned_round(&[wrong as u32]).triangles(), tetrahedron);
    }
    let inside_out = tetrahedron.map(|[a, b, c]| [a, c, b]);
    assert!(mesh(inside_out.to_vec()).misoriented().is_empty(), "consistent, so a room perhaps");
}

#[test]
fn what_has_no_orientation_stays() {
    let moebius = vec![[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4], [4, 5, 6], [5, 0, 6], [6, 0, 1]];
    assert!(mesh(moebius.clone()).orientation_conflicts() > 0);
    assert!(mesh(moebius).misoriented().is_empty());
    let fins = vec![[0, 1, 2], [0, 1, 3], [0, 1, 5], [5, 5, 6]];
    assert!(mesh(fins).misoriented().is_empty(), "three triangles on an edge");
}

#[test]
fn triangles_without_area_have_no_say() {
    // The last two triangles have heights below the rounding error of a coordinate of 1. All lie on the edge from 0 to
    // 1 of the only triangle with a certain area.
    for flat in [[0, 1, 0], [0, 1, 6], [0, 1, 7], [0, 1, 8]] {
        assert!(mesh(vec![flat, [0, 1, 2]]).misoriented().is_empty());
        assert_eq!(mesh(vec![flat, [0, 2, 1], [1, 0, 3], [0, 2, 3], [1, 3, 2]]).misoriented(), [1]);
    }
}
