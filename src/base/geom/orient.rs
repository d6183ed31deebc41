//! Consistent orientation of surfaces.

use super::rounded::has_certain_area;
use super::{Adjacency, Mesh};

impl Mesh {
    /// Returns the triangles to flip so that neighbours traverse their common edge in opposite directions, in ascending
    /// order. Corners at the same position count as one vertex. In each connected surface, the triangles of the rarer
    /// orientation are flipped; on ties, those unlike the first triangle. Triangles are connected only by edges of
    /// exactly two triangles. A surface without a consistent orientation (a Moebius strip) is left unchanged. Triangles
    /// whose area is uncertain after rounding of their corners are ignored.
    pub fn misoriented(&self) -> Vec<u32> {
        let (welded, ids) = self.welded_with_area();
        let adjacency = welded.adjacency();
        // `Some(true)` if a triangle has the orientation of its surface's first triangle.
        let mut same_way: Vec<Option<bool>> = vec![None; welded.len()];
        let mut wrong = Vec::new();
        for first in 0..welded.len() as u32 {
            if same_way[first as usize].is_none() {
                wrong.extend(smaller_part(&welded, &adjacency, first, &mut same_way));
            }
        }
        wrong.sort_unstable();
        wrong.into_iter().map(|triangle| ids[triangle as usize]).collect()
    }

    /// [`Mesh::welded`] without the triangles that fail [`has_certain_area`], and the ids of the remaining triangles.
    pub fn welded_with_area(&self) -> (Self, Vec<u32>) {
        let mut welded = self.welded();
        let with_area = (0..).zip(self.iter_corners()).filter(|(_, corners)| has_certain_area(corners));
        let ids: Vec<u32> = with_area.map(|(id, _)| id).collect();
        welded.keep(&ids);
        (welded, ids)
    }
}

/// Returns the triangles to flip in the surface of triangle `first`; empty if there are none.
fn smaller_part(mesh: &Mesh, adjacency: &Adjacency, first: u32, same_way: &mut [Option<bool>]) -> Vec<u32> {
    let (mut parts, mut orientable, mut waiting) = ([Vec::new(), Vec::new()], true, vec![first]);
    same_way[first as usize] = Some(true);
    while let Some(triangle) = waiting.pop() {
        let way = same_way[triangle as usize].unwrap_or(true);
        parts[usize::from(!way)].push(triangle);
        for edge in adjacency.edges_of(triangle).into_iter().flatten() {
            let edge = &adjacency.edges()[edge as usize];
            let &[a, b] = &edge.triangles[..] else { continue };
            let other = if a == triangle { b } else { a };
            let agree = runs_forward(mesh, triangle, edge.vertices) != runs_forward(mesh, other, edge.vertices);
            match same_way[other as usize] {
                None => {
                    same_way[other as usize] = Some(way == agree);
                    waiting.push(other);
                }
                Some(known) => orientable &= known == (way == agree),
            }
        }
    }
    let [kept, turned] = parts;
    match orientable {
        false => Vec::new(),
        true if turned.len() <= kept.len() => turned,
        true => kept,
    }
}

/// Returns `true` if a triangle traverses an edge from its first vertex to its second.
fn runs_forward(mesh: &Mesh, triangle: u32, [from, to]: [u32; 2]) -> bool {
    let [a, b, c] = mesh.triangles()[triangle as usize];
    [[a, b], [b, c], [c, a]].contains(&[from, to])
}
