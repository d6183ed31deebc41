//! Graph of the faces of a cluster, linked where they share an edge.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::surface::AtlasSurface;
use crate::geom::vector::wide;
use crate::geom::{Adjacency, Mesh};

pub(super) const UNREACHED: u64 = u64::MAX;

/// Link from a face to a neighbour across an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceLink {
    /// Index of the other face in the graph.
    pub(super) to: u32,
    /// Distance between the faces' centres across the edge, in whole units, at least 1. Sums of integers are exact.
    pub(super) length: u32,
    /// Length of the common edge, in the same units.
    pub(super) edge: u32,
}

/// Faces with their links. The links of a face are the range of `links` from its start to the next face's start.
#[derive(Debug, Clone)]
pub(super) struct FaceGraph {
    faces: Vec<u32>,
    starts: Vec<u32>,
    links: Vec<FaceLink>,
}

impl FaceGraph {
    /// Builds the graph of all faces of a mesh. The faces of an edge are linked in a chain.
    pub(super) fn of_mesh(surface: &AtlasSurface, welded: &Mesh, adjacency: &Adjacency) -> Self {
        let unit_per_length = units_per_length(welded);
        let mut pairs: Vec<(u32, FaceLink)> = Vec::with_capacity(surface.len() * 3);
        for edge in adjacency.edges() {
            let [a, b] = edge.vertices.map(|vertex| wide(welded.positions()[vertex as usize]));
            let middle = (a + b) / 2.0;
            let edge_length = ((b - a).length() * unit_per_length) as u32;
            for pair in edge.triangles.windows(2) {
                let [one, other] = [pair[0], pair[1]].map(|face| (surface.centroid(face) - middle).length());
                let length = (((one + other) * unit_per_length) as u32).max(1);
                pairs.push((pair[0], FaceLink { to: pair[1], length, edge: edge_length }));
                pairs.push((pair[1], FaceLink { to: pair[0], length, edge: edge_length }));
            }
        }
        pairs.sort_unstable_by_key(|(from, link)| (*from, link.to, link.length));
        let mut starts = vec![0; surface.len() + 1];
        pairs.iter().for_each(|(from, _)| starts[*from as usize + 1] += 1);
        for face in 0..surface.len() {
            starts[face + 1] += starts[face];
        }
        let links = pairs.into_iter().map(|(_, link)| link).collect();
        Self { faces: (0..surface.len() as u32).collect(), starts, links }
    }

    pub(super) fn len(&self) -> usize {
        self.faces.len()
    }

    /// Faces of the mesh, by index in the graph.
    pub(super) fn faces(&self) -> &[u32] {
        &self.faces
    }

    pub(super) fn links(&self, of: u32) -> &[FaceLink] {
        let of = of as usize;
        &self.links[self.starts[of] as usize..self.starts[of + 1] as usize]
    }

    /// Lengths of the shortest paths from a face to all faces.
    pub(super) fn distances(&self, from: u32) -> Vec<u64> {
        let mut found = vec![UNREACHED; self.len()];
        let mut open = BinaryHeap::new();
        found[from as usize] = 0;
        open.push(Reverse((0, from)));
        while let Some(Reverse((distance, face))) = open.pop() {
            if distance > found[face as usize] {
                continue;
            }
            for link in self.links(face) {
                let longer = distance + u64::from(link.length);
                if longer < found[link.to as usize] {
                    found[link.to as usize] = longer;
                    open.push(Reverse((longer, link.to)));
                }
            }
        }
        found
    }

    /// Connected parts of the faces on each side: the part of each face, and the number of parts.
    pub(super) fn parts(&self, side: impl Fn(u32) -> bool) -> (Vec<u32>, u32) {
        let mut part = vec![u32::MAX; self.len()];
        let (mut count, mut open) = (0, Vec::new());
        for first in 0..self.len() as u32 {
            if part[first as usize] != u32::MAX {
                continue;
            }
            part[first as usize] = count;
            open.push(first);
            while let Some(face) = open.pop() {
                for link in self.links(face) {
                    if part[link.to as usize] == u32::MAX && side(link.to) == side(first) {
                        part[link.to as usize] = count;
                        open.push(link.to);
                    }
                }
            }
            count += 1;
        }
        (part, count)
    }

    /// Total length of the edges between faces of different sides.
    pub(super) fn cut_length(&self, second: &[bool]) -> u64 {
        let across = |of: u32| {
            let links = self.links(of).iter().filter(move |link| second[link.to as usize]);
            links.map(|link| u64::from(link.edge)).sum::<u64>()
        };
        (0..self.len() as u32).filter(|&face| !second[face as usize]).map(across).sum()
    }

    /// Splits the graph into its two sides, each with the links among its own faces.
    pub(super) fn halves(&self, second: &[bool]) -> [Self; 2] {
        let mut place = vec![0; self.len()];
        let mut counts = [0, 0];
        for (face, &side) in second.iter().enumerate() {
            place[face] = counts[usize::from(side)];
            counts[usize::from(side)] += 1;
        }
        [false, true].map(|side| {
            let count = counts[usize::from(side)] as usize;
            let mut half =
                Self { faces: Vec::with_capacity(count), starts: Vec::with_capacity(count + 1), links: vec![] };
            half.starts.push(0);
            for (face, _) in (0..).zip(second).filter(|(_, own)| **own == side) {
                half.faces.push(self.faces[face as usize]);
                let within = self.links(face).iter().filter(|link| second[link.to as usize] == side);
                half.links.extend(within.map(|link| FaceLink { to: place[link.to as usize], ..*link }));
                half.starts.push(half.links.len() as u32);
            }
            half
        })
    }
}

/// Units per length such that the longest link of a mesh fits into 32 bits: the bounding box's diagonal is 2^30 units.
fn units_per_length(mesh: &Mesh) -> f64 {
    let diagonal = mesh.bounds().map_or(0.0, |[low, high]| (wide(high) - wide(low)).length());
    if diagonal > 0.0 { f64::from(1_u32 << 30) / diagonal } else { 0.0 }
}
