//! What is odd about a mesh.

use super::surface::AtlasSurface;
use crate::geom::{Adjacency, Mesh};

/// What is odd about a mesh, counted with vertices at one place as one. Nothing of it keeps a mesh from its atlas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Census {
    /// Faces.
    pub faces: usize,
    /// Parts that share no edge with each other.
    pub parts: usize,
    /// Edges of a single face.
    pub boundary_edges: usize,
    /// Edges of more than two faces.
    pub crowded_edges: usize,
    /// How often a face runs through an edge the same way as another face.
    pub orientation_conflicts: usize,
    /// Faces without area.
    pub faces_without_area: usize,
    /// Faces with the same three corners as a face before them, in any order.
    pub duplicate_faces: usize,
}

impl Census {
    /// The census of a mesh that has one vertex per place.
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

    /// Whether the surface is closed, in one part, oriented alike everywhere and without any other oddity.
    pub fn is_sound(&self) -> bool {
        let plain = Self { faces: self.faces, parts: 1, ..Self::default() };
        *self == plain
    }
}
