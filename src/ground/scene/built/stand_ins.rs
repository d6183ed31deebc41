//! Models with the face counts of those of the subsurface paper: the Stanford bunny, and stand-ins for a head and a
//! dolphin, which are not available.

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

/// Builds the bunny with the paper's 69,451 faces, 2.5 units high: a closed mesh has an even number of faces, so one
/// is missing, the lowest.
pub fn bunny() -> Mesh {
    let mut surface = of_faces(bunny::bunny, 69_452);
    let height = |face: &[u32; 3]| face.iter().map(|&corner| surface.positions[corner as usize].z).sum::<f64>();
    let heights = surface.triangles.iter().map(height).enumerate();
    if let Some((lowest, _)) = heights.min_by(|one, other| one.1.total_cmp(&other.1)) {
        surface.triangles.remove(lowest);
    }
    plain(surface)
}

/// Surface with an even number of faces: half as many vertices, and two more, or two fewer per handle of its shape.
fn of_faces(build: fn(usize) -> ClosedSurface, faces: usize) -> ClosedSurface {
    let first = build(faces / 2);
    let faces_of_as_many = first.triangles.len();
    build(faces - faces_of_as_many / 2)
}

fn plain(surface: ClosedSurface) -> Mesh {
    let positions = surface.positions.into_iter().map(narrow).collect();
    Mesh::new(positions, surface.triangles).expect("indices are those of vertices, and shapes are finite")
}
