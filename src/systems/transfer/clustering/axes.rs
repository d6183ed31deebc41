//! Points and subspaces projected onto the axes along which most of a signal stands, where a lower bound of a distance
//! costs a fraction of the distance.
//!
//! With orthonormal axes B, no distance grows: |x - x_0 - V c| is at least |B (x - x_0) - B V c| for all weights c, so
//! the distance of B x from the affine span of B V is at most that of x from the subspace. B V is made orthonormal for
//! that. A vector of which less than [`NOTHING`] is left beside those before it is dropped: the best weights are no
//! longer than |x - x_0|, so that moves a distance by less than the estimates' bounds hold.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::AffineSubspace;
use super::estimate::ScaledSubspace;
use super::fit::principal_vectors;
use super::products::{Packed, ROWS, add_block, add_orthonormal, dots};
use crate::linalg::dot;
use crate::transfer::Signal;

/// Signals of fewer dimensions have no axes: their distances cost little more than bounds.
const LEAST_DIMENSION: usize = 128;
/// Dimensions per axis, and axes at most.
const PER_AXIS: usize = 4;
const MOST: usize = 96;
/// Points that the axes are found from.
const SAMPLE: usize = 512;
/// Points that are projected side by side.
const COLUMNS: usize = 8;
const NOTHING: f64 = 1.0 / (1u64 << 30) as f64;

/// Axes of a signal.
#[derive(Debug)]
pub(super) struct Axes {
    dimension: usize,
    /// Orthonormal, one after another.
    axes: Vec<f64>,
}

impl Axes {
    /// Principal axes of some of the points, and all points along them, relative to a center and scaled, one after
    /// another; none where they do not pay.
    pub(super) fn new(signal: &Signal, center: &[f64], scale: f64, level: SimdLevel) -> Option<(Self, Vec<f32>)> {
        let dimension = signal.dimension();
        if dimension < LEAST_DIMENSION {
            return None;
        }
        let count = signal.points().min(SAMPLE);
        let sample: Vec<u32> = (0..count).map(|at| (at * signal.points() / count) as u32).collect();
        // Without principal vectors every distance is estimated in full.
        let axes = principal_vectors(signal, &sample, center, MOST.min(dimension / PER_AXIS), level).ok()?;
        let along = axes.len() / dimension;
        if along == 0 {
            return None;
        }
        let rows = Packed::<f64, ROWS>::new(along, dimension, |at, into| {
            into.copy_from_slice(&axes[at * dimension..][..dimension]);
        });
        let mut points = vec![0.0; signal.points() * along];
        points.par_chunks_mut(COLUMNS * along).enumerate().for_each(|(at, into)| {
            let columns = Packed::<f64, COLUMNS>::new(into.len() / along, dimension, |i, into| {
                let values = signal.point(at * COLUMNS + i).iter().zip(center);
                into.iter_mut().zip(values).for_each(|(into, (&x, g))| *into = (f64::from(x) - g) * scale);
            });
            for (tile, rows) in rows.groups().enumerate() {
                let mut sums = [[0.0; COLUMNS]; ROWS];
                level.run(
                    #[inline(always)]
                    || columns.groups().for_each(|columns| add_block(rows, columns, &mut sums)),
                );
                for (row, sums) in sums.iter().enumerate().take(along - tile * ROWS) {
                    for (point, &sum) in into.chunks_exact_mut(along).zip(sums) {
                        point[tile * ROWS + row] = sum as f32;
                    }
                }
            }
        });
        Some((Self { dimension, axes }, points))
    }

    /// Number of axes.
    pub(super) fn count(&self) -> usize {
        self.axes.len() / self.dimension
    }

    /// A subspace along the axes. `offset` is its mean, relative to the center and scaled; empty if it is 0.
    pub(super) fn project(&self, subspace: &AffineSubspace, offset: &[f64], level: SimdLevel) -> ScaledSubspace {
        let mut vectors = Vec::new();
        for vector in subspace.vectors() {
            add_orthonormal(&mut vectors, self.along(vector, level), NOTHING);
        }
        let projected = if offset.is_empty() { Vec::new() } else { self.along(offset, level) };
        ScaledSubspace { dimension: self.count(), length: dot(offset, offset).sqrt(), offset: projected, vectors }
    }

    fn along(&self, vector: &[f64], level: SimdLevel) -> Vec<f64> {
        let mut found = Vec::with_capacity(self.count());
        level.run(
            #[inline(always)]
            || dots(&self.axes, vector, |along| found.push(along)),
        );
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::synthetic::torus_signal;

    #[test]
    fn axes_are_orthonormal_and_hold_most_of_the_signal() {
        let signal = torus_signal(700, 200, 4);
        let (axes, points) = Axes::new(&signal, &[0.0; 200], 0.01, SimdLevel::widest()).expect("axes");
        assert_eq!((axes.count(), axes.axes.len()), (50, 50 * 200));
        for (i, a) in axes.axes.chunks(200).enumerate() {
            for (j, b) in axes.axes.chunks(200).enumerate() {
                assert!((dot(a, b) - f64::from(u8::from(i == j))).abs() < 1e-13);
            }
        }
        let held: f64 = points.iter().map(|&value| f64::from(value) * f64::from(value) * 1e4).sum();
        let all = signal.sum_of_squares();
        assert!(held < all && held > 0.9 * all, "{held} of {all}");
        assert!(Axes::new(&torus_signal(9, 127, 0), &[0.0; 127], 1.0, SimdLevel::Baseline).is_none(), "few dimensions");
        let dark = Signal::new(200, vec![0.0; 400]).expect("a signal");
        assert!(Axes::new(&dark, &[0.0; 200], 1.0, SimdLevel::Baseline).is_none(), "no axes of zeros");
    }

    #[test]
    fn vectors_that_stand_elsewhere_are_dropped() {
        let mut values = vec![0.0; 200 * 200];
        (0..200).for_each(|point| values[200 * point + point % 3] = 1.0);
        let signal = Signal::new(200, values).expect("a signal");
        let (axes, _) = Axes::new(&signal, &[0.0; 200], 1.0, SimdLevel::widest()).expect("axes");
        assert_eq!(axes.count(), 3);
        let unit = |at: usize| (0..200).map(move |j| f64::from(u8::from(j == at)));
        let vectors: Vec<f64> = unit(150).chain(unit(1)).collect();
        let subspace = AffineSubspace { mean: vec![0.0; 200], vectors, eigenvalues: vec![1.0; 2] };
        let projected = axes.project(&subspace, &[], SimdLevel::widest());
        assert_eq!((projected.vectors.len(), projected.length), (3, 0.0));
    }
}
