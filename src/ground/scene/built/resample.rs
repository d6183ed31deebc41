//! Closed surfaces with any number of vertices: the longest edges are divided, or the shortest are collapsed.
//!
//! New vertices lie on the curve that the normals at the edge's ends give it (the cubic of a PN triangle: Vlachos,
//! Peters, Boyd, Mitchell 2001, "Curved PN Triangles"), so that a refined surface is rounder and a coarsened one keeps
//! its volume. Triangles keep the order of the triangles that they come from.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use glam::DVec3;

use crate::geom::vector::{area_vector, unit};

/// Cosine of the angle by which a triangle's normal may turn when an edge is collapsed.
const TURN: f64 = 0.3;

/// Triangle mesh in double precision, fronts outwards: closed, except for a scan before [`ClosedSurface::closed`].
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ClosedSurface {
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl ClosedSurface {
    /// Unit normals of the vertices: the area-weighted means of the normals of the triangles around them.
    pub(super) fn normals(&self) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for triangle in &self.triangles {
            let normal = area_vector(triangle.map(|corner| self.positions[corner as usize]));
            triangle.iter().for_each(|&corner| sums[corner as usize] += normal);
        }
        sums.into_iter().map(|sum| unit(sum).unwrap_or(DVec3::Z)).collect()
    }

    /// Returns the surface with `vertices` vertices, or with the fewest that its shape allows.
    pub(super) fn resampled(self, vertices: usize) -> Self {
        if vertices < self.positions.len() {
            Coarsening::new(self).to(vertices)
        } else {
            Refinement::new(self).to(vertices)
        }
    }

    /// The part with the most triangles, without enclosed parts and splinters.
    pub(super) fn outermost(self) -> Self {
        let mut part: Vec<u32> = (0..self.positions.len() as u32).collect();
        let first = |part: &mut Vec<u32>, mut at: u32| {
            while part[at as usize] != at {
                part[at as usize] = part[part[at as usize] as usize];
                at = part[at as usize];
            }
            at
        };
        for &[a, b, c] in &self.triangles {
            for [one, other] in [[a, b], [b, c]] {
                let ends = [first(&mut part, one), first(&mut part, other)];
                part[ends[0].max(ends[1]) as usize] = ends[0].min(ends[1]);
            }
        }
        let parts: Vec<u32> = self.triangles.iter().map(|corners| first(&mut part, corners[0])).collect();
        let mut counts = vec![0_u32; self.positions.len()];
        parts.iter().for_each(|&at| counts[at as usize] += 1);
        let largest = (0..counts.len()).max_by_key(|&at| (counts[at], Reverse(at))).unwrap_or(0) as u32;
        let kept = self.triangles.iter().zip(&parts).filter(|&(_, &at)| at == largest).map(|(&corners, _)| corners);
        Self::renumbered(&self.positions, kept)
    }

    /// Fills each hole with triangles around the mean of its rim.
    pub(super) fn closed(mut self) -> Self {
        let all: BTreeSet<[u32; 2]> = self.triangles.iter().flat_map(|&triangle| edges(triangle)).collect();
        let open = all.iter().filter(|[a, b]| !all.contains(&[*b, *a]));
        // Rims are followed in the direction of the missing triangles.
        let mut next: BTreeMap<u32, u32> = open.map(|&[a, b]| (b, a)).collect();
        while let Some((first, mut at)) = next.pop_first() {
            let mut rim = vec![first];
            while at != first {
                rim.push(at);
                at = next.remove(&at).unwrap_or(first);
            }
            let middle = self.positions.len() as u32;
            let sum: DVec3 = rim.iter().map(|&vertex| self.positions[vertex as usize]).sum();
            self.positions.push(sum / rim.len() as f64);
            let following = rim.iter().cycle().skip(1);
            self.triangles.extend(rim.iter().zip(following).map(|(&from, &to)| [from, to, middle]));
        }
        self
    }

    /// The same triangles in the same order, with vertices in the order of first use and without unused ones.
    pub(super) fn renumbered(positions: &[DVec3], triangles: impl Iterator<Item = [u32; 3]>) -> Self {
        let mut found = Self::default();
        let mut number = vec![u32::MAX; positions.len()];
        for triangle in triangles {
            found.triangles.push(triangle.map(|corner| {
                let number = &mut number[corner as usize];
                if *number == u32::MAX {
                    *number = found.positions.len() as u32;
                    found.positions.push(positions[corner as usize]);
                }
                *number
            }));
        }
        found
    }
}

struct Curved {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl Curved {
    /// Midpoint of the curve between two vertices, and the normal there.
    fn middle(&self, [a, b]: [u32; 2]) -> (DVec3, DVec3) {
        let [a, b] = [a as usize, b as usize];
        let along = self.positions[b] - self.positions[a];
        let bent = along.dot(self.normals[a]) * self.normals[a] - along.dot(self.normals[b]) * self.normals[b];
        let sum = self.normals[a] + self.normals[b];
        (0.5 * (self.positions[a] + self.positions[b]) - 0.125 * bent, unit(sum).unwrap_or(self.normals[a]))
    }

    /// Squared length of an edge as the bits of f64, which have the same order.
    fn length(&self, [a, b]: [u32; 2]) -> u64 {
        self.positions[a as usize].distance_squared(self.positions[b as usize]).to_bits()
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

const fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

struct Refinement {
    vertices: Curved,
    triangles: Vec<[u32; 3]>,
    /// For each triangle, the next one in the order of the result; the last has its own index.
    next: Vec<usize>,
    /// Triangle to the left of each directed edge.
    left: BTreeMap<[u32; 2], usize>,
    /// Max-heap of edges by length; ties go to the smaller pair of vertices.
    longest: BinaryHeap<(u64, Reverse<[u32; 2]>)>,
}

impl Refinement {
    fn new(surface: ClosedSurface) -> Self {
        let normals = surface.normals();
        let ClosedSurface { positions, triangles } = surface;
        let next = (1..triangles.len()).chain([triangles.len().saturating_sub(1)]).collect();
        let left = triangles.iter().zip(0..).flat_map(|(&triangle, at)| edges(triangle).map(|edge| (edge, at)));
        let (left, longest) = (left.collect(), BinaryHeap::new());
        let mut found = Self { vertices: Curved { positions, normals }, triangles, next, left, longest };
        let all: Vec<[u32; 2]> = found.left.keys().copied().filter(|[a, b]| a < b).collect();
        all.into_iter().for_each(|edge| found.push(edge));
        found
    }

    fn push(&mut self, edge: [u32; 2]) {
        let edge = sorted(edge);
        self.longest.push((self.vertices.length(edge), Reverse(edge)));
    }

    fn to(mut self, vertices: usize) -> ClosedSurface {
        while self.vertices.positions.len() < vertices {
            let Some((_, Reverse(edge))) = self.longest.pop() else { break };
            self.divide(edge);
        }
        let last = self.triangles.len();
        let order = std::iter::successors(Some(0), |&at| (self.next[at] != at).then_some(self.next[at])).take(last);
        ClosedSurface::renumbered(&self.vertices.positions, order.map(|at| self.triangles[at]))
    }

    fn divide(&mut self, [a, b]: [u32; 2]) {
        let middle = self.vertices.positions.len() as u32;
        let (position, normal) = self.vertices.middle([a, b]);
        self.vertices.positions.push(position);
        self.vertices.normals.push(normal);
        for [from, to] in [[a, b], [b, a]] {
            let Some(at) = self.left.remove(&[from, to]) else { continue };
            let third = self.triangles[at].into_iter().find(|&corner| corner != from && corner != to).unwrap_or(from);
            let added = self.triangles.len();
            self.triangles[at] = [from, middle, third];
            self.triangles.push([middle, to, third]);
            self.next.push(if self.next[at] == at { added } else { self.next[at] });
            self.next[at] = added;
            for at in [at, added] {
                self.left.extend(edges(self.triangles[at]).map(|edge| (edge, at)));
            }
            self.push([middle, third]);
        }
        self.push([a, middle]);
        self.push([middle, b]);
    }
}

/// Bits of an edge's squared length, its ends, and the change counts of both ends when it had this length.
type RankedEdge = (u64, [u32; 2], [u32; 2]);

struct Coarsening {
    vertices: Curved,
    /// A removed triangle has the same corner three times.
    triangles: Vec<[u32; 3]>,
    /// Triangles around each vertex.
    around: Vec<Vec<usize>>,
    /// For each vertex, the number of changes to its edges.
    changes: Vec<u32>,
    /// Min-heap of edges by length; an entry is stale if the change count of an end differs from the stored one.
    shortest: BinaryHeap<Reverse<RankedEdge>>,
}

impl Coarsening {
    fn new(surface: ClosedSurface) -> Self {
        let normals = surface.normals();
        let ClosedSurface { positions, triangles } = surface;
        let mut around = vec![Vec::new(); positions.len()];
        for (triangle, at) in triangles.iter().zip(0..) {
            triangle.iter().for_each(|&corner| around[corner as usize].push(at));
        }
        let changes = vec![0; positions.len()];
        let vertices = Curved { positions, normals };
        let mut found = Self { vertices, triangles, around, changes, shortest: BinaryHeap::new() };
        for at in 0..found.triangles.len() {
            edges(found.triangles[at]).into_iter().filter(|[a, b]| a < b).for_each(|edge| found.push(edge));
        }
        found
    }

    fn push(&mut self, edge: [u32; 2]) {
        let edge = sorted(edge);
        self.shortest.push(Reverse((self.vertices.length(edge), edge, self.changes_of(edge))));
    }

    fn changes_of(&self, edge: [u32; 2]) -> [u32; 2] {
        edge.map(|end| self.changes[end as usize])
    }

    fn to(mut self, vertices: usize) -> ClosedSurface {
        let mut left = self.vertices.positions.len();
        while left > vertices {
            let Some(Reverse((_, edge, changes))) = self.shortest.pop() else { break };
            if changes == self.changes_of(edge) && self.draws_together(edge) {
                left -= 1;
            }
        }
        let kept = self.triangles.iter().copied().filter(|[a, b, _]| a != b);
        ClosedSurface::renumbered(&self.vertices.positions, kept)
    }

    fn neighbors(&self, vertex: u32) -> BTreeSet<u32> {
        let corners = self.around[vertex as usize].iter().flat_map(|&at| self.triangles[at]);
        corners.filter(|&corner| corner != vertex).collect()
    }

    /// Collapses an edge into its first vertex, unless this would fold the surface or join parts of it.
    fn draws_together(&mut self, [a, b]: [u32; 2]) -> bool {
        let (of_a, of_b) = (self.neighbors(a), self.neighbors(b));
        let common: Vec<u32> = of_a.intersection(&of_b).copied().collect();
        // Dey, Edelsbrunner, Guha, Nekhayev 1999: the topology is kept if the ends share no other neighbour.
        if common.len() != 2 || common.iter().any(|&vertex| self.around[vertex as usize].len() < 4) {
            return false;
        }
        let (position, normal_of) = self.vertices.middle([a, b]);
        let is_moved = |corner: u32| corner == a || corner == b;
        let holds = |&at: &usize| {
            let corners = self.triangles[at];
            let before = area_vector(corners.map(|corner| self.vertices.positions[corner as usize]));
            let moved = corners.map(|at| if is_moved(at) { position } else { self.vertices.positions[at as usize] });
            let after = area_vector(moved);
            corners.iter().filter(|&&corner| is_moved(corner)).count() == 2
                || after.dot(before) > TURN * after.length() * before.length()
        };
        let both = [a, b].map(|end| end as usize);
        if !both.iter().flat_map(|&end| &self.around[end]).all(holds) {
            return false;
        }
        (self.vertices.positions[both[0]], self.vertices.normals[both[0]]) = (position, normal_of);
        for at in std::mem::take(&mut self.around[both[1]]) {
            let corners = self.triangles[at];
            if corners.contains(&a) {
                corners.iter().for_each(|&corner| self.around[corner as usize].retain(|&other| other != at));
                self.triangles[at] = [a; 3];
            } else {
                self.triangles[at] = corners.map(|corner| if corner == b { a } else { corner });
                self.around[both[0]].push(at);
            }
        }
        both.iter().for_each(|&end| self.changes[end] += 1);
        self.neighbors(a).into_iter().for_each(|other| self.push([a, other]));
        true
    }
}
