//! Models with the face counts of the models in the subsurface paper: the Stanford bunny, and stand-ins for a head and
//! a dolphin, which are not available.

use super::resample::ClosedSurface;
use super::{bodies, bunny};
use crate::geom::Mesh;
use crate::geom::vector::narrow;

/// Builds a stand-in for the paper's head: 7,232 faces, closed, about 2.5 units high.
pub fn head() -> Mesh {
    plain(of_faces(bodies::head, 7_232))
}

/// Builds a stand-in for the paper's dolphin: 21,952 faces, closed, about 4 units long, with thin fins.
pub fn dolphin() -> Mesh {
    plain(of_faces(bodies::dolphin, 21_952))
}

/// Builds the Stanford bunny as scanned: the paper's 69,451 faces, five holes, a box of 2.5 units.
pub fn bunny() -> Mesh {
    plain(bunny::scanned())
}

/// Surface with an even number of faces. It has faces / 2 + 2 vertices, minus two per handle of its shape.
fn of_faces(build: fn(usize) -> ClosedSurface, faces: usize) -> ClosedSurface {
    let first = build(faces / 2);
    let faces_of_as_many = first.triangles.len();
    build(faces - faces_of_as_many / 2)
}

fn plain(surface: ClosedSurface) -> Mesh {
    let positions = surface.positions.into_iter().map(narrow).collect();
    Mesh::new(positions, surface.triangles).expect("indices are those of vertices, and shapes are finite")
}
