use approx::abs_diff_eq;
use crossbar_base::geom::Mesh;
use crossbar_base::geom::aimed::{aimed_at_edges, aimed_at_vertices};

#[test]
fn only_shared_edges_are_aimed_at() {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let rays = aimed_at_edges(&mesh, [0.25, 0.5, 2.0], 3, 7);
    assert_eq!(rays.len(), 3);
    assert_eq!(rays, aimed_at_edges(&mesh, [0.25, 0.5, 2.0], 3, 7));
    assert_ne!(rays, aimed_at_edges(&mesh, [0.25, 0.5, 2.0], 3, 8));
    for aimed in &rays {
        let [x, y, z] = aimed.ray.direction();
        assert_eq!(z, -2.0);
        assert!(abs_diff_eq!(x + 0.25, y + 0.5, epsilon = 1e-6), "on the diagonal: {x} {y}");
    }
    let corners = aimed_at_vertices(&mesh, [1.0, 0.0, 0.0]);
    assert_eq!(corners.len(), 3, "the eye's own vertex has no direction");
}
