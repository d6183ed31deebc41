//! Lower bounds of the distances of centers from subspaces, carried over from one search to the next.
//!
//! A point z away from the old mean m has the distance |(I - P) z| from the old subspace, where P projects onto its
//! vectors. From the new one, with mean m' and projection P', its distance is at least that minus |P' - P| |z| + |(I -
//! P') (m - m')|. The norm of the difference of P and P' is the larger of those of (I - P) P' and (I - P') P; [`moved`]
//! takes the root of the sum of squares, which is no less. |z| is at most 1 + M, as points have at most length 1.

use super::estimate::{LANES, ScaledSubspace};
use crate::linalg::dot;

/// Bound of the rounding error of each move and of the centers, relative to 1 + M.
const ROUNDED: f64 = 1.0 / (1u64 << 22) as f64;

/// State that a search leaves to the next.
#[derive(Debug, Default)]
pub(super) struct Carried {
    /// The subspaces of the last search.
    subspaces: Vec<ScaledSubspace>,
    /// Per batch of groups and per cluster, lower bounds of the distances of the centers.
    distances: Vec<Vec<[f32; LANES]>>,
}

impl Carried {
    /// The lower bounds for the new subspaces: the old ones minus the moves of the subspaces, or minus infinity if the
    /// numbers of batches or subspaces have changed.
    pub(super) fn follow(&mut self, batches: usize, subspaces: Vec<ScaledSubspace>) -> &mut [Vec<[f32; LANES]>] {
        if (self.distances.len(), self.subspaces.len()) == (batches, subspaces.len()) {
            let pairs = self.subspaces.iter().zip(&subspaces);
            let moves: Vec<f64> = pairs.map(|(old, new)| moved(old, new)).collect();
            for distances in &mut self.distances {
                for (distances, &moved) in distances.iter_mut().zip(&moves).filter(|&(_, &moved)| moved > 0.0) {
                    // The move is rounded up and the difference down, so that distances stay lower bounds.
                    let moved = (moved as f32).next_up();
                    *distances = distances.map(|distance| (distance - moved).next_down());
                }
            }
        } else {
            self.distances = vec![vec![[f32::NEG_INFINITY; LANES]; subspaces.len()]; batches];
        }
        self.subspaces = subspaces;
        &mut self.distances
    }
}

/// Upper bound of the decrease of a point's distance when the subspace moves; 0 if it does not.
fn moved(old: &ScaledSubspace, new: &ScaledSubspace) -> f64 {
    if old == new {
        return 0.0;
    }
    let turned = beside(old, &new.vectors).max(beside(new, &old.vectors)).sqrt().min(1.0);
    let shift: Vec<f64> = match (&old.offset[..], &new.offset[..]) {
        ([], new) => new.to_vec(),
        (old, []) => old.to_vec(),
        (old, new) => old.iter().zip(new).map(|(old, new)| old - new).collect(),
    };
    let shifted = if shift.is_empty() { 0.0 } else { beside(new, &shift).sqrt() };
    (turned + ROUNDED) * (1.0 + old.length) + shifted + ROUNDED * new.length
}

/// The sum of squared lengths of the vectors' components orthogonal to a subspace.
fn beside(subspace: &ScaledSubspace, vectors: &[f64]) -> f64 {
    let (mut sum, length) = (0.0, subspace.dimension.max(1));
    for vector in vectors.chunks_exact(length) {
        let mut rest = vector.to_vec();
        for axis in subspace.vectors.chunks_exact(length) {
            let along = dot(axis, vector);
            rest.iter_mut().zip(axis).for_each(|(rest, axis)| *rest -= along * axis);
        }
        sum += dot(&rest, &rest);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random::CounterRng;
    use crate::transfer::clustering::products::add_orthonormal;

    const DIMENSION: usize = 6;

    fn subspace(offset: Vec<f64>, vectors: Vec<f64>) -> ScaledSubspace {
        ScaledSubspace { dimension: DIMENSION, length: dot(&offset, &offset).sqrt(), offset, vectors }
    }

    fn distance(subspace: &ScaledSubspace, point: &[f64]) -> f64 {
        let offset = subspace.offset.iter().copied().chain(std::iter::repeat(0.0));
        let from: Vec<f64> = point.iter().zip(offset).map(|(x, m)| x - m).collect();
        beside(subspace, &from).sqrt()
    }

    #[test]
    fn no_distance_falls_by_more_than_the_move() {
        let mut tight = 0;
        for seed in 0..3000 {
            let random = CounterRng::new(seed);
            let numbers = |what: u64| (0..DIMENSION as u64).map(move |j| random.unit(what, 0, j) - 0.5);
            let drawn = |what: u64, size: f64, near: &[f64]| -> Vec<f64> {
                numbers(what).zip(near).map(|(value, near)| near + size * value).collect()
            };
            let share = [1e-6, 1e-3, 0.1, 1.0][seed as usize % 4];
            let (mut old, mut new) = (Vec::new(), Vec::new());
            for what in 0..random.bits(0, 1, 0) % 5 {
                let vector = drawn(what, 1.0, &[0.0; DIMENSION]);
                add_orthonormal(&mut new, drawn(10 + what, share, &vector), 1e-3);
                add_orthonormal(&mut old, vector, 1e-3);
            }
            if random.bits(0, 2, 0).is_multiple_of(4) {
                new.truncate(DIMENSION);
            }
            let at = drawn(20, 1.0, &[0.0; DIMENSION]);
            let to = drawn(21, share, &at);
            let linear = |one: bool, at| if one { Vec::new() } else { at };
            let old = subspace(linear(seed % 3 == 0, at), old);
            let new = subspace(linear(seed % 3 == 0 || seed % 7 == 0, to), new);
            let by = moved(&old, &new);
            for what in 30..60 {
                let point = drawn(what, 0.8, &[0.0; DIMENSION]);
                let fall = distance(&old, &point) - distance(&new, &point);
                assert!(fall <= by, "{fall} by {by}, seed {seed}");
                tight += usize::from(fall > 0.2 * by);
            }
            assert_eq!(moved(&new, &new), 0.0);
        }
        assert!(tight > 3000, "moves that are too large by far would pass: {tight}");
    }

    #[test]
    fn nothing_is_known_of_other_batches_or_clusters() {
        let (mut carried, all) = (Carried::default(), vec![subspace(vec![0.5; DIMENSION], Vec::new()); 3]);
        carried.follow(2, all.clone()).iter_mut().flatten().for_each(|distances| *distances = [0.25; LANES]);
        assert_eq!(carried.follow(2, all.clone())[1][2], [0.25; LANES]);
        assert_eq!(carried.follow(2, all[..2].to_vec())[1][1], [f32::NEG_INFINITY; LANES]);
        assert_eq!(carried.follow(1, all[..2].to_vec())[0][1], [f32::NEG_INFINITY; LANES]);
    }
}
