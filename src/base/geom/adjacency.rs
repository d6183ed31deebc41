//! Edges of a mesh and the triangles that share them.

use super::Mesh;

/// Edge with its triangles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edge {
    /// The edge's two vertices, smaller index first.
    pub vertices: [u32; 2],
    /// Triangles that contain the edge, in ascending order: one on a boundary, two inside a surface.
    pub triangles: Vec<u32>,
}

impl Edge {
    /// Returns `true` if the edge belongs to a single triangle.
    pub fn is_boundary(&self) -> bool {
        self.triangles.len() == 1
    }

    /// Returns `true` if the edge belongs to at most two triangles.
    pub fn is_manifold(&self) -> bool {
        self.triangles.len() <= 2
    }
}

/// Edges of a mesh, and the edges of each triangle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Adjacency {
    edges: Vec<Edge>,
    /// Edges of each triangle from its first, second and third corner; `None` for an edge from a vertex to itself.
    edges_of: Vec<[Option<u32>; 3]>,
}

impl Adjacency {
    /// All edges in ascending order of their vertices. Edges from a vertex to itself are omitted.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Edges of a triangle from its first, second and third corner, as indices into [`Adjacency::edges`]; `None` for an
    /// edge from a vertex to itself, and for a triangle that does not exist.
    pub fn edges_of(&self, triangle: u32) -> [Option<u32>; 3] {
        self.edges_of.get(triangle as usize).copied().unwrap_or_default()
    }

    /// Iterates over the other triangles on the edges of a triangle, edge by edge.
    pub fn neighbors(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        let edges = self.edges_of(triangle).into_iter().flatten();
        let on_edge = edges.flat_map(|edge| self.edges[edge as usize].triangles.iter().copied());
        on_edge.filter(move |&other| other != triangle)
    }
}

impl Mesh {
    /// Computes which triangles share each edge. Vertices are compared by index; see [`Mesh::welded`].
    pub fn adjacency(&self) -> Adjacency {
        let mut sides: Vec<([u32; 2], u32, usize)> = Vec::with_capacity(self.len() * 3);
        for (id, &[a, b, c]) in (0_u32..).zip(self.triangles()) {
            for (side, [from, to]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                if from != to {
                    sides.push(([from.min(to), from.max(to)], id, side));
                }
            }
        }
        sides.sort_unstable();
        let mut edges: Vec<Edge> = Vec::with_capacity(sides.len() / 2);
        let mut edges_of = vec![[None; 3]; self.len()];
        for (vertices, id, side) in sides {
            match edges.last_mut() {
                Some(edge) if edge.vertices == vertices => {
                    if edge.triangles.last() != Some(&id) {
                        edge.triangles.push(id);
                    }
                }
                _ => edges.push(Edge { vertices, triangles: vec![id] }),
            }
            edges_of[id as usize][side] = Some(edges.len() as u32 - 1);
        }
        Adjacency { edges, edges_of }
    }

    /// Returns the edges of [`Mesh::adjacency`].
    pub fn edges(&self) -> Vec<Edge> {
        self.adjacency().edges
    }

    /// Number of edges that belong to only one triangle: 0 for a closed surface.
    pub fn boundary_edge_count(&self) -> usize {
        self.edges().iter().filter(|edge| edge.is_boundary()).count()
    }

    /// Number of edges that more than one triangle traverses in the same direction: 0 where the surface is oriented
    /// consistently and no edge has three triangles. Edges from a vertex to itself are omitted.
    pub fn orientation_conflicts(&self) -> usize {
        let mut directed: Vec<[u32; 2]> = Vec::with_capacity(self.len() * 3);
        for &[a, b, c] in self.triangles() {
            directed.extend([[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to));
        }
        directed.sort_unstable();
        directed.windows(2).filter(|pair| pair[0] == pair[1]).count()
    }
}
