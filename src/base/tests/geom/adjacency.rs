use crossbar_base::geom::{Edge, Mesh};

fn mesh(triangles: Vec<[u32; 3]>) -> Mesh {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Mesh::new(positions, triangles).expect("a mesh")
}

#[test]
fn a_square_has_four_boundary_edges() {
    let mesh = mesh(vec![[0, 1, 2], [0, 2, 3]]);
    assert_eq!((mesh.boundary_edge_count(), mesh.orientation_conflicts()), (4, 0));
    let adjacency = mesh.adjacency();
    let shared: Vec<_> = adjacency.edges().iter().filter(|edge| !edge.is_boundary()).collect();
    assert_eq!(shared, [&Edge { vertices: [0, 2], triangles: vec![0, 1] }]);
    assert_eq!(adjacency.edges_of(0)[2], adjacency.edges_of(1)[0], "the diagonal");
    assert_eq!(adjacency.neighbors(0).collect::<Vec<_>>(), [1]);
    assert_eq!(adjacency.neighbors(7).count(), 0, "no such triangle");
}

#[test]
fn two_triangles_the_same_way_round_conflict() {
    let mesh = mesh(vec![[0, 1, 2], [0, 1, 3]]);
    assert_eq!(mesh.orientation_conflicts(), 1);
}

#[test]
fn three_triangles_on_an_edge_are_no_manifold_and_a_point_has_no_edge() {
    let fins = mesh(vec![[0, 1, 2], [1, 0, 3], [0, 1, 4], [3, 3, 3], [2, 3, 2]]).adjacency();
    let crowded: Vec<_> = fins.edges().iter().filter(|edge| !edge.is_manifold()).collect();
    assert_eq!(crowded, [&Edge { vertices: [0, 1], triangles: vec![0, 1, 2] }]);
    assert_eq!(fins.edges_of(3), [None; 3]);
    assert_eq!(fins.neighbors(4).count(), 0, "its two sides are one edge");
}
