use crossbar_base::geom::Mesh;
use crossbar_base::geom::vector::narrow;

/// Two squares that meet at a right angle, the first of two triangles.
fn corner() -> Mesh {
    let positions =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    let mesh = Mesh::new(positions.to_vec(), vec![[0, 1, 2], [0, 2, 3], [0, 3, 5], [0, 5, 4]]).expect("a mesh");
    mesh.with_texcoords(positions.map(|[x, y, z]| [x + z, y]).to_vec()).expect("coordinates")
}

#[test]
fn sharp_edges_have_two_normals() {
    let sharp = corner().creased(0.5);
    assert_eq!((sharp.len(), sharp.positions().len()), (4, 8));
    for (triangle, corners) in sharp.triangles().iter().enumerate() {
        let expected = if triangle < 2 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        for &at in corners {
            assert_eq!(sharp.normals().expect("normals")[at as usize], expected);
        }
        let of = |mesh: &Mesh| mesh.triangles()[triangle].map(|at| mesh.texcoords().expect("coordinates")[at as usize]);
        assert_eq!(of(&sharp), of(&corner()));
    }
    assert!(sharp.iter_corners().eq(corner().iter_corners()));
}

#[test]
fn flat_edges_have_one() {
    let smooth = corner().creased(-1.0);
    assert_eq!(smooth.positions().len(), 6);
    let expected: Vec<[f32; 3]> = corner().vertex_normals().into_iter().map(narrow).collect();
    let at = |mesh: &Mesh, triangle: usize, corner: usize| mesh.triangles()[triangle][corner] as usize;
    for (triangle, corner_at) in (0..4).flat_map(|triangle| (0..3).map(move |corner| (triangle, corner))) {
        let found = smooth.normals().expect("normals")[at(&smooth, triangle, corner_at)];
        assert_eq!(found, expected[at(&corner(), triangle, corner_at)]);
    }
}
