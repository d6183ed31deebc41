//! Triangle meshes with shared vertices.

use std::collections::BTreeMap;

use thiserror::Error;

use super::exact;

/// Triangles that share vertices. Every index is in range and every coordinate finite: [`Mesh::new`] has checked it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Why positions and indices make no mesh.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshError {
    /// A corner names a vertex that does not exist.
    #[error("triangle {triangle} uses vertex {index}, expected an index below {vertices} (counted from 0)")]
    IndexOutOfRange {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The index it used.
        index: u32,
        /// Number of vertices there are.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} (counted from 0) has the coordinate {value}, expected a finite number")]
    NotFinite {
        /// The vertex, counted from 0.
        vertex: usize,
        /// What was found.
        value: f32,
    },
    /// More triangles than 31 bits can name.
    #[error("found {found} triangles, expected at most {}", i32::MAX)]
    TooMany {
        /// Number of triangles given.
        found: usize,
    },
}

/// How two triangles touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Contact {
    /// They have no corner in common.
    None,
    /// They have one corner in common.
    Vertex,
    /// They have two corners in common, or all three.
    Edge,
}

/// An edge with the triangles on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edge {
    /// Its two vertices, the smaller index first.
    pub vertices: [u32; 2],
    /// The triangles that have it, in rising order: one on a boundary, two inside a surface.
    pub triangles: Vec<u32>,
}

impl Mesh {
    /// A mesh of positions and corner indices (counted from 0). Triangles keep their order: a triangle's place is its id.
    /// Degenerate triangles are accepted (nothing ever hits them); count them with [`Mesh::degenerate_count`].
    ///
    /// # Errors
    /// [`MeshError`] names the first index out of range, or the first coordinate that is not finite.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.len() > i32::MAX as usize {
            return Err(MeshError::TooMany { found: triangles.len() });
        }
        for (vertex, position) in positions.iter().enumerate() {
            if let Some(&value) = position.iter().find(|value| !value.is_finite()) {
                return Err(MeshError::NotFinite { vertex, value });
            }
        }
        let vertices = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange { triangle, index, vertices });
            }
        }
        Ok(Self { positions, triangles })
    }

    /// Vertex positions.
    #[must_use]
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Corner indices of each triangle; the front is the side from which they run counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is no triangle.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The three corners of a triangle, or `None` where there is no triangle of that id.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> Option<[[f32; 3]; 3]> {
        let indices = self.triangles.get(triangle as usize)?;
        Some(indices.map(|index| self.positions[index as usize]))
    }

    /// The corners of all triangles, in order of id.
    pub fn iter_corners(&self) -> impl ExactSizeIterator<Item = [[f32; 3]; 3]> + '_ {
        self.triangles.iter().map(|indices| indices.map(|index| self.positions[index as usize]))
    }

    /// Smallest and largest coordinates of the vertices that triangles use; `None` without a triangle.
    #[must_use]
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let mut corners = self.iter_corners().flatten();
        let first = corners.next()?;
        let mut bounds = [first, first];
        for corner in corners {
            for axis in 0..3 {
                if corner[axis] < bounds[0][axis] {
                    bounds[0][axis] = corner[axis];
                }
                if corner[axis] > bounds[1][axis] {
                    bounds[1][axis] = corner[axis];
                }
            }
        }
        Some(bounds)
    }

    /// All edges in rising order of their vertices. A triangle's edge from a vertex to itself is left out.
    #[must_use]
    pub fn edges(&self) -> Vec<Edge> {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(self.triangles.len() * 3);
        for (id, &[a, b, c]) in (0_u32..).zip(&self.triangles) {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                if from != to {
                    sides.push(([from.min(to), from.max(to)], id));
                }
            }
        }
        sides.sort_unstable();
        sides.dedup();
        let mut edges: Vec<Edge> = Vec::with_capacity(sides.len() / 2);
        for (vertices, id) in sides {
            match edges.last_mut() {
                Some(edge) if edge.vertices == vertices => edge.triangles.push(id),
                _ => edges.push(Edge { vertices, triangles: vec![id] }),
            }
        }
        edges
    }

    /// Number of edges that only one triangle has: 0 for a closed surface.
    #[must_use]
    pub fn boundary_edge_count(&self) -> usize {
        self.edges().iter().filter(|edge| edge.triangles.len() == 1).count()
    }

    /// Number of edges through which more than one triangle runs the same way: 0 where the surface is oriented
    /// consistently and no edge has three triangles.
    #[must_use]
    pub fn orientation_conflicts(&self) -> usize {
        let mut directed: Vec<[u32; 2]> = Vec::with_capacity(self.triangles.len() * 3);
        for &[a, b, c] in &self.triangles {
            directed.extend([[a, b], [b, c], [c, a]]);
        }
        directed.sort_unstable();
        directed.windows(2).filter(|pair| pair[0] == pair[1]).count()
    }

    /// Number of triangles without area: two corners at one place, or three on one line, exactly.
    #[must_use]
    pub fn degenerate_count(&self) -> usize {
        self.iter_corners().filter(exact::is_degenerate).count()
    }

    /// How two triangles touch. Corners are compared by position, so a mesh whose file repeats its vertices is judged
    /// like one that shares them. `None` also for an id that does not exist.
    #[must_use]
    pub fn contact(&self, a: u32, b: u32) -> Contact {
        let (Some(a), Some(b)) = (self.corners(a), self.corners(b)) else {
            return Contact::None;
        };
        match a.iter().filter(|corner| b.contains(corner)).count() {
            0 => Contact::None,
            1 => Contact::Vertex,
            _ => Contact::Edge,
        }
    }

    /// Whether two triangles share an edge or a vertex.
    #[must_use]
    pub fn are_adjacent(&self, a: u32, b: u32) -> bool {
        self.contact(a, b) != Contact::None
    }
}

/// Collects triangles and shares their vertices: corners at the bit-identical place become one vertex.
#[derive(Debug, Default)]
pub(crate) struct Welder {
    positions: Vec<[f32; 3]>,
    index: BTreeMap<[u32; 3], u32>,
}

impl Welder {
    /// The vertex at a place, new or known. -0 and +0 are one place.
    pub(crate) fn vertex(&mut self, position: [f32; 3]) -> u32 {
        let position = position.map(|value| value + 0.0);
        let next = self.positions.len() as u32;
        let index = *self.index.entry(position.map(f32::to_bits)).or_insert(next);
        if index == next {
            self.positions.push(position);
        }
        index
    }

    /// The place of a vertex that [`Welder::vertex`] has named.
    pub(crate) fn position(&self, index: u32) -> [f32; 3] {
        self.positions[index as usize]
    }

    /// The vertices in the order in which they were first seen.
    pub(crate) fn into_positions(self) -> Vec<[f32; 3]> {
        self.positions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Mesh {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [9.0, 9.0, 9.0]];
        Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh")
    }

    #[test]
    fn a_square_has_four_boundary_edges() {
        let mesh = square();
        assert_eq!(mesh.boundary_edge_count(), 4);
        assert_eq!(mesh.orientation_conflicts(), 0);
        assert_eq!(mesh.degenerate_count(), 0);
        assert_eq!(mesh.contact(0, 1), Contact::Edge);
        assert_eq!(mesh.bounds(), Some([[0.0; 3], [1.0, 1.0, 0.0]]), "unused vertices do not count");
        let shared: Vec<_> = mesh.edges().into_iter().filter(|edge| edge.triangles.len() == 2).collect();
        assert_eq!(shared, [Edge { vertices: [0, 2], triangles: vec![0, 1] }]);
    }

    #[test]
    fn contact_is_by_place() {
        let positions =
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [3, 4, 5], [1, 1, 2]]).expect("a mesh");
        assert_eq!(mesh.contact(0, 1), Contact::Vertex);
        assert_eq!(mesh.contact(1, 2), Contact::None);
        assert_eq!(mesh.contact(0, 99), Contact::None);
        assert_eq!(mesh.degenerate_count(), 1);
    }

    #[test]
    fn two_triangles_the_same_way_round_conflict() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 1, 3]]).expect("a mesh");
        assert_eq!(mesh.orientation_conflicts(), 1);
    }

    #[test]
    fn bad_input_is_named() {
        let found = Mesh::new(vec![[0.0; 3]], vec![[0, 0, 1]]).unwrap_err();
        assert_eq!(found.to_string(), "triangle 0 uses vertex 1, expected an index below 1 (counted from 0)");
        let found = Mesh::new(vec![[0.0; 3], [0.0, f32::INFINITY, 0.0]], vec![]).unwrap_err();
        assert_eq!(found.to_string(), "vertex 1 (counted from 0) has the coordinate inf, expected a finite number");
    }
}
