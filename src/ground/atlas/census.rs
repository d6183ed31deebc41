//! Irregularities of a mesh.

use glam::DVec3;

use super::surface::AtlasSurface;
use crate::elementary::atan2;
use crate::geom::rounded::{has_certain_area, may_overlap};
use crate::geom::vector::wide;
use crate::geom::{Adjacency, Mesh};

/// Irregularities of a mesh, counted with vertices at the same position merged. None of them prevents an atlas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Census {
    /// Number of faces.
    pub faces: usize,
    /// Number of parts that share no edge with each other.
    pub parts: usize,
    /// Number of edges that belong to a single face.
    pub boundary_edges: usize,
    /// Number of edges that belong to more than two faces.
    pub crowded_edges: usize,
    /// Number of face pairs that traverse a common edge in the same direction.
    pub orientation_conflicts: usize,
    /// Number of faces without area.
    pub faces_without_area: usize,
    /// Number of faces that lie on an earlier face: with the same three corners, or in its plane and on the same side
    /// of a common edge, as when a polygon is listed twice and cut along different diagonals. Differences within the
    /// rounding of coordinates to f32 are ignored.
    pub duplicate_faces: usize,
}

impl Census {
    /// Counts the irregularities of a mesh whose vertices are merged by position.
    pub(super) fn new(surface: &AtlasSurface, welded: &Mesh, adjacency: &Adjacency, parts: usize) -> Self {
        let edges = adjacency.edges();
        Self {
            faces: surface.len(),
            parts,
            boundary_edges: edges.iter().filter(|edge| edge.is_boundary()).count(),
            crowded_edges: edges.iter().filter(|edge| !edge.is_manifold()).count(),
            orientation_conflicts: welded.orientation_conflicts(),
            faces_without_area: surface.areas().iter().filter(|area| **area == 0.0).count(),
            duplicate_faces: duplicate_faces(welded, adjacency),
        }
    }

    /// Returns `true` if the surface is closed, connected, consistently oriented and without any other irregularity.
    pub fn is_sound(&self) -> bool {
        let plain = Self { faces: self.faces, parts: 1, ..Self::default() };
        *self == plain
    }
}

/// Counts the faces that coincide with an earlier one, comparing each face of an edge with the next by angle.
fn duplicate_faces(welded: &Mesh, adjacency: &Adjacency) -> usize {
    let place = |vertex: u32| wide(welded.positions()[vertex as usize]);
    let with_area: Vec<bool> = welded.iter_corners().map(|corners| has_certain_area(&corners)).collect();
    let mut lies_on_another = vec![false; welded.len()];
    for edge in adjacency.edges().iter().filter(|edge| !edge.is_boundary()) {
        let [a, b] = edge.vertices.map(place);
        let normal = |apex: DVec3| (b - a).cross(apex - a);
        let apex = |&face: &u32| {
            let corners = welded.triangles()[face as usize];
            corners.into_iter().find(|corner| !edge.vertices.contains(corner)).map(place)
        };
        let faces = edge.triangles.iter().filter(|face| with_area[**face as usize]);
        let apexes: Vec<(u32, DVec3)> = faces.filter_map(|face| Some((*face, apex(face)?))).collect();
        let Some(first) = apexes.first().map(|(_, apex)| normal(*apex)) else { continue };
        let angle = |apex: DVec3| {
            let normal = normal(apex);
            atan2(first.cross(normal).dot(b - a) / (b - a).length(), first.dot(normal))
        };
        let mut around: Vec<_> = apexes.into_iter().map(|(face, apex)| (angle(apex), face, apex)).collect();
        around.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        for (at, &(_, face, apex)) in around.iter().enumerate() {
            let (_, next, beside) = around[(at + 1) % around.len()];
            if face != next && may_overlap([a, b], [apex, beside]) {
                lies_on_another[face.max(next) as usize] = true;
            }
        }
    }
    lies_on_another.into_iter().filter(|lies| *lies).count()
}
