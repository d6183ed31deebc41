//! Primitive assembly.

use super::{Primitive, Provoking, RasterError};

/// Index of the provoking vertex for triangle `i` of [`assemble`].
pub fn provoking(primitive: Primitive, i: usize, convention: Provoking) -> usize {
    let (first, last) = match primitive {
        Primitive::TriangleStrip => (i, i + 2),
        Primitive::TriangleFan => (i + 1, i + 2),
        Primitive::QuadList => (i / 2 * 4, i / 2 * 4 + 3),
        Primitive::QuadStrip => (i / 2 * 2, i / 2 * 2 + 3),
        _ => (3 * i, 3 * i + 2),
    };
    match convention {
        Provoking::First => first,
        Provoking::Last => last,
    }
}

/// Assembles `count` vertices into triangles of vertex indices; left-over vertices are ignored.
///
/// A quad of vertices 0 1 2 3 becomes the triangles (0, 1, 2) and (0, 2, 3). Odd triangles of a strip are reordered to
/// (n, n+2, n+1), so that all have the same winding and keep their first vertex.
///
/// # Errors
/// For points and lines, which are not supported.
pub fn assemble(primitive: Primitive, count: usize) -> Result<impl Iterator<Item = [usize; 3]> + Clone, RasterError> {
    let triangles = match primitive {
        Primitive::TriangleList => count / 3,
        Primitive::TriangleStrip | Primitive::TriangleFan => count.saturating_sub(2),
        Primitive::QuadList => count / 4 * 2,
        Primitive::QuadStrip => (count / 2).saturating_sub(1) * 2,
        Primitive::PointList | Primitive::LineList | Primitive::LineStrip => {
            return Err(RasterError::UnsupportedPrimitive { primitive });
        }
    };
    Ok((0..triangles).map(move |i| triangle(primitive, i)))
}

fn triangle(primitive: Primitive, i: usize) -> [usize; 3] {
    // A quad is split along the diagonal from its first corner.
    let half = |[a, b, c, d]: [usize; 4]| if i.is_multiple_of(2) { [a, b, c] } else { [a, c, d] };
    match primitive {
        Primitive::TriangleStrip if i % 2 == 1 => [i, i + 2, i + 1],
        Primitive::TriangleStrip => [i, i + 1, i + 2],
        Primitive::TriangleFan => [0, i + 1, i + 2],
        Primitive::QuadList => {
            let first = i / 2 * 4;
            half([first, first + 1, first + 2, first + 3])
        }
        Primitive::QuadStrip => {
            let first = i / 2 * 2;
            half([first, first + 1, first + 3, first + 2])
        }
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    }
}
