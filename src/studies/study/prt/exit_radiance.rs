//! Exit radiance of vertices under a light.

use glam::DVec3;
use rayon::prelude::*;

use crate::clustering::{Clustering, Signal};
use crate::geom::vector::wide;
use crate::sphere::{HarmonicLight, MAX_ORDER, harmonics};
use crate::study::StudyError;
use crate::transfer::Vertices;
use crate::transfer::file::PrtMeaning;

/// Meaning of the numbers at a vertex, and a light with the same number of functions.
pub(in crate::study) struct Lit<'a> {
    channels: usize,
    functions: &'a [u16],
    columns: usize,
    light: &'a HarmonicLight,
}

impl<'a> Lit<'a> {
    /// Returns `None` if the numbers are not transfer.
    pub(in crate::study) fn new(meaning: &'a PrtMeaning, light: &'a HarmonicLight) -> Option<Self> {
        let PrtMeaning::Transfer { channels, exit_functions, light_order, .. } = meaning else { return None };
        let columns = (light_order * light_order) as usize;
        Some(Self { channels: *channels as usize, functions: exit_functions, columns, light })
    }

    /// Exit coefficients M l for a matrix, or for some of its rows: red, green and blue per row.
    fn product(&self, matrix: &[f64]) -> Vec<[f64; 3]> {
        let rows = self.functions.len();
        let dot = |row: usize, channel: usize| -> f64 {
            let first = (channel % self.channels * rows + row) * self.columns;
            let row = &matrix[first..first + self.columns];
            row.iter().zip(&self.light.channels()[channel]).map(|(m, l)| m * l).sum()
        };
        (0..rows).map(|row| [0, 1, 2].map(|channel| dot(row, channel))).collect()
    }

    /// The exit coefficients of every vertex, from uncompressed transfer.
    pub(in crate::study) fn of_signal(&self, signal: &Signal) -> Vec<Vec<[f64; 3]>> {
        let exit = |point: usize| {
            let matrix: Vec<f64> = signal.point(point).iter().map(|&value| f64::from(value)).collect();
            self.product(&matrix)
        };
        (0..signal.points()).into_par_iter().map(exit).collect()
    }

    /// The exit coefficients from clusters, as in section 6: products with the mean and the vectors of each cluster,
    /// then weighted sums per vertex.
    pub(in crate::study) fn of_clusters(&self, clustering: &Clustering) -> Vec<Vec<[f64; 3]>> {
        let products: Vec<Vec<Vec<[f64; 3]>>> = (clustering.subspaces().par_iter())
            .map(|subspace| {
                std::iter::once(&subspace.mean[..]).chain(subspace.vectors()).map(|part| self.product(part)).collect()
            })
            .collect();
        let exit = |point: usize| {
            let [mean, vectors @ ..] = &products[clustering.of_point()[point] as usize][..] else { return Vec::new() };
            let mut sum = mean.clone();
            for (weight, vector) in clustering.weights(point).iter().zip(vectors) {
                for (sum, part) in sum.iter_mut().zip(vector) {
                    (0..3).for_each(|channel| sum[channel] += weight * part[channel]);
                }
            }
            sum
        };
        (0..clustering.points()).into_par_iter().map(exit).collect()
    }

    /// Radiance of every vertex towards the eye.
    pub(in crate::study) fn radiance(&self, exit: &[Vec<[f64; 3]>], vertices: &Vertices, eye: DVec3) -> Vec<[f64; 3]> {
        let order = usize::from(self.functions.iter().copied().max().unwrap_or(0)).isqrt() + 1;
        let towards = |vertex: usize| {
            if self.functions == [0] {
                return exit[vertex].first().copied().unwrap_or_default();
            }
            let view = (eye - wide(vertices.positions()[vertex])).normalize_or_zero();
            let mut y = [0.0; MAX_ORDER * MAX_ORDER];
            harmonics(order, vertices.frames()[vertex].to_local(view), &mut y[..order * order]);
            let mut sum = [0.0; 3];
            for (coefficients, &function) in exit[vertex].iter().zip(self.functions) {
                (0..3).for_each(|channel| sum[channel] += y[usize::from(function)] * coefficients[channel]);
            }
            sum
        };
        (0..vertices.len()).into_par_iter().map(towards).collect()
    }
}

/// Error for a signal that is not transfer.
pub(super) fn no_transfer() -> StudyError {
    let help = "compress a file that `crossbar cpca precompute` wrote";
    StudyError::new("crossbar::prt::meaning", "expected transfer, found a signal that is not transfer").with_help(help)
}
