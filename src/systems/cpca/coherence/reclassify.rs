//! Reclassification: fewer drawn triangles for slightly more error.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::{check_shape, check_triangles, distinct, overdraw};
use crate::clustering::{Clustering, Signal};
use crate::error::{InputError, ensure};

/// A clustering with fewer triangles across clusters.
#[derive(Clone, Debug, PartialEq)]
pub struct Reclassified {
    /// The subspaces of the input, with new weights for moved points.
    pub clustering: Clustering,
    /// Number of moves of points between clusters.
    pub moved: usize,
    /// The squared error that the moves added; below 0 if they reduced the error.
    pub added_error: f64,
    /// Triangles drawn before and after.
    pub drawn: [u64; 2],
}

/// Moves vertices to clusters of their neighbours (section 5). The next move is always the one with the greatest
/// reduction of overdraw per increase of squared error (infinite if the error does not increase); ties go to the lowest
/// vertex. Moves add at most `budget` times the initial squared error; a move that would exceed it is skipped. The
/// paper uses 0.05 to 0.1.
pub fn reclassify(
    signal: &Signal,
    clustering: &Clustering,
    triangles: &[[u32; 3]],
    budget: f64,
) -> Result<Reclassified, InputError> {
    check_shape(signal, clustering)?;
    check_triangles(triangles, signal.points())?;
    ensure!(
        budget.is_finite() && budget >= 0.0,
        "expected an error budget of at least 0, as a share of the error, found {budget}"
    );
    let mut search = Search::new(signal, clustering, triangles);
    let limit = budget * search.errors.iter().sum::<f64>();
    let (moved, added_error) = search.run(limit);
    let drawn = [clustering.of_point(), &search.of_point].map(|of_point| overdraw(triangles, of_point));
    let clustering = Clustering::project(signal, clustering.subspaces().to_vec(), search.of_point);
    Ok(Reclassified { clustering, moved, added_error, drawn })
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Move {
    vertex: u32,
    to: u32,
    reduction: u64,
    increase: f64,
    /// Number of earlier computations of the vertex's best move; moves of earlier rounds are outdated.
    round: u32,
}

impl Move {
    /// Reduction divided by increase; infinite if the error does not grow.
    fn quotient(&self) -> f64 {
        if self.increase <= 0.0 { f64::INFINITY } else { self.reduction as f64 / self.increase }
    }
}

impl Eq for Move {}

impl PartialOrd for Move {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The better move is greater.
impl Ord for Move {
    fn cmp(&self, other: &Self) -> Ordering {
        self.quotient()
            .total_cmp(&other.quotient())
            .then(self.reduction.cmp(&other.reduction))
            .then(other.increase.total_cmp(&self.increase))
            .then((other.vertex, other.to).cmp(&(self.vertex, self.to)))
    }
}

struct Search<'a> {
    signal: &'a Signal,
    clustering: &'a Clustering,
    triangles: &'a [[u32; 3]],
    /// The triangles of each vertex.
    around: Vec<Vec<u32>>,
    of_point: Vec<u32>,
    errors: Vec<f64>,
    rounds: Vec<u32>,
    residual: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(signal: &'a Signal, clustering: &'a Clustering, triangles: &'a [[u32; 3]]) -> Self {
        let mut around = vec![Vec::new(); signal.points()];
        for (triangle, corners) in (0..).zip(triangles) {
            for &corner in corners {
                if around[corner as usize].last() != Some(&triangle) {
                    around[corner as usize].push(triangle);
                }
            }
        }
        let of_point = clustering.of_point().to_vec();
        let (errors, rounds) = (Vec::new(), vec![0; signal.points()]);
        let mut search = Self { signal, clustering, triangles, around, of_point, errors, rounds, residual: Vec::new() };
        search.errors = (0..signal.points()).map(|p| search.error(p, search.of_point[p])).collect();
        search
    }

    fn error(&mut self, point: usize, cluster: u32) -> f64 {
        let subspace = &self.clustering.subspaces()[cluster as usize];
        subspace.squared_error(self.signal.point(point), &mut self.residual)
    }

    /// Makes moves within a limit of added error; returns their number and the added error.
    fn run(&mut self, limit: f64) -> (usize, f64) {
        let mut heap: BinaryHeap<Move> = (0..self.of_point.len()).filter_map(|p| self.best_move(p)).collect();
        let (mut moved, mut added) = (0, 0.0);
        while let Some(best) = heap.pop() {
            let vertex = best.vertex as usize;
            let exceeds = best.increase > 0.0 && added + best.increase > limit;
            if best.round != self.rounds[vertex] || exceeds {
                continue;
            }
            self.of_point[vertex] = best.to;
            self.errors[vertex] += best.increase;
            added += best.increase;
            moved += 1;
            for affected in self.neighbours(vertex) {
                heap.extend(self.best_move(affected as usize));
            }
        }
        (moved, added)
    }

    /// A vertex and its neighbours, in increasing order.
    fn neighbours(&self, vertex: usize) -> Vec<u32> {
        let triangles = self.around[vertex].iter().map(|&triangle| self.triangles[triangle as usize]);
        let mut found: Vec<u32> = triangles.flatten().chain([vertex as u32]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The best move of a vertex to a cluster of a neighbour, if one reduces overdraw. Earlier moves of the vertex
    /// become outdated.
    fn best_move(&mut self, vertex: usize) -> Option<Move> {
        self.rounds[vertex] += 1;
        let mut clusters: Vec<u32> =
            self.neighbours(vertex).into_iter().map(|other| self.of_point[other as usize]).collect();
        clusters.sort_unstable();
        clusters.dedup();
        let drawn = self.drawn(vertex, self.of_point[vertex]);
        let mut best: Option<Move> = None;
        for to in clusters {
            let reduction = drawn.saturating_sub(self.drawn(vertex, to));
            if reduction > 0 {
                let increase = self.error(vertex, to) - self.errors[vertex];
                let next = Move { vertex: vertex as u32, to, reduction, increase, round: self.rounds[vertex] };
                best = best.max(Some(next));
            }
        }
        best
    }

    /// Number of draws of the triangles around a vertex if the vertex belongs to `cluster`.
    fn drawn(&self, vertex: usize, cluster: u32) -> u64 {
        let of = |corner: u32| if corner as usize == vertex { cluster } else { self.of_point[corner as usize] };
        let triangles = self.around[vertex].iter().map(|&triangle| self.triangles[triangle as usize]);
        triangles.map(|corners| distinct(corners.map(of))).sum()
    }
}
