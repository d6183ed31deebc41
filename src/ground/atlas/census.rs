//! Irregularities of a mesh.

use super::surface::AtlasSurface;
use crate::geom::{Adjacency, Mesh};

/// Irregularities of a mesh, counted with vertices at the same position merged. None of them prevents an atlas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Census {
    /// Number of faces.
    pub faces: usize,
    /// Number of parts that share no edge with each other.
    pub parts: usize,
    /// Number of edges of a single face.
    pub boundary_edges: usize,
    /// Number of edges of more than two faces.
    pub crowded_edges: usize,
    /// Number of times that a face traverses an edge in the same direction as another face.
    pub orientation_conflicts: usize,
    /// Number of faces without area.
    pub faces_without_area: usize,
    /// Number of faces with the same three corners as an earlier face, in any order.
    pub duplicate_faces: usize,
}

impl Census {
    /// Counts the irregularities of a mesh whose vertices are merged by position.
    pub(super) fn new(surface: &AtlasSurface, welded: &Mesh, adjacency: &Adjacency, parts: usize) -> Self {
        let mut corners: Vec<[u32; 3]> = welded.triangles().to_vec();
        corners.iter_mut().for_each(|corners| corners.sort_unstable());
        corners.sort_unstable();
        let edges = adjacency.edges();
        Self {
            faces: surface.len(),
            parts,
            boundary_edges: edges.iter().filter(|edge| edge.is_boundary()).count(),
            crowded_edges: edges.iter().filter(|edge| !edge.is_manifold()).count(),
            orientation_conflicts: welded.orientation_conflicts(),
            faces_without_area: surface.areas().iter().filter(|area| **area == 0.0).count(),
            duplicate_faces: corners.windows(2).filter(|pair| pair[0] == pair[1]).count(),
        }
    }

    /// Returns `true` if the surface is closed, connected, consistently oriented and without any other irregularity.
    pub fn is_sound(&self) -> bool {
        let plain = Self { faces: self.faces, parts: 1, ..Self::default() };
        *self == plain
    }
}
