//! Assembly of primitives.

use refsim::raster::{Primitive, Provoking, assemble, provoking};

/// Sources: Direct3D 9 reference, triangle strips, fans and shading modes; OpenGL 2.1, table 2.12;
/// `EXT_provoking_vertex` for the first vertices of quads.
#[test]
fn provoking_vertices_are_those_of_the_documentation() {
    let of = |primitive| [Provoking::First, Provoking::Last].map(|c| [0, 1, 2].map(|i| provoking(primitive, i, c)));
    assert_eq!(of(Primitive::TriangleList), [[0, 3, 6], [2, 5, 8]]);
    assert_eq!(of(Primitive::TriangleStrip), [[0, 1, 2], [2, 3, 4]]);
    assert_eq!(of(Primitive::TriangleFan), [[1, 2, 3], [2, 3, 4]]);
    assert_eq!(of(Primitive::QuadList), [[0, 0, 4], [3, 3, 7]]);
    assert_eq!(of(Primitive::QuadStrip), [[0, 0, 2], [3, 3, 5]]);
}

fn all(primitive: Primitive, count: usize) -> Vec<[usize; 3]> {
    assemble(primitive, count).unwrap().collect()
}

#[test]
fn orders_are_those_of_the_documentation() {
    assert_eq!(all(Primitive::TriangleList, 7), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(all(Primitive::TriangleStrip, 5), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
    assert_eq!(all(Primitive::TriangleFan, 4), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(all(Primitive::QuadList, 8), [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]);
    assert_eq!(all(Primitive::QuadStrip, 6), [[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]]);
    assert_eq!(all(Primitive::TriangleStrip, 1), [[0; 3]; 0]);
    assert!(assemble(Primitive::LineList, 2).is_err());
}
