//! The host's part of a frame (section 6): the products of the light with the mean and vectors of every cluster, M_i l
//! or t_i . l.

use rayon::prelude::*;

use super::model::TransferSize;
use super::transfer::CompressedTransfer;
use super::weights::CardWeights;
use crate::card::CardError;
use crate::linalg::dot;
use crate::sphere::HarmonicLight;

/// The products of all clusters, in single precision, as the card reads them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Products {
    rows: usize,
    /// For each cluster, vector by vector with the mean first: three channels of one number per row.
    clusters: Vec<Vec<f32>>,
}

impl Products {
    /// Computes products in double precision, multiplied by `factor` and by the ranges of weights, and rounded once.
    /// Light coefficients beyond the matrices' columns are ignored.
    pub fn new(
        transfer: &CompressedTransfer<'_>,
        weights: &CardWeights,
        light: &HarmonicLight,
        factor: f64,
    ) -> Result<Self, CardError> {
        let size = transfer.size()?;
        let expected = size.columns.isqrt();
        if light.order() < expected {
            return Err(CardError::input(format!(
                "expected light of order {expected} or more, found {}",
                light.order()
            )));
        }
        let of_cluster = |cluster: usize| {
            let subspace = &transfer.clustering.subspaces()[cluster];
            let mut mean = of_vector(&subspace.mean, light, size, factor);
            let mut vectors: Vec<Vec<f64>> =
                subspace.vectors().map(|vector| of_vector(vector, light, size, factor)).collect();
            for (vector, &[low, extent]) in vectors.iter_mut().zip(weights.ranges(cluster)) {
                for (mean, value) in mean.iter_mut().zip(vector) {
                    *mean += low * *value;
                    *value *= extent;
                }
            }
            std::iter::once(mean).chain(vectors).flatten().map(|value| value as f32).collect()
        };
        let clusters: Vec<Vec<f32>> =
            (0..transfer.clustering.subspaces().len()).into_par_iter().map(of_cluster).collect();
        match clusters.iter().flatten().find(|value| !value.is_finite()) {
            Some(&found) => Err(CardError::figure("products of finite size", f64::from(found))),
            None => Ok(Self { rows: size.rows, clusters }),
        }
    }

    /// The products of a cluster's mean and vectors, in this order: each has the rows of three channels. Panics if
    /// there is no such cluster.
    pub fn vectors(&self, cluster: usize) -> impl ExactSizeIterator<Item = [&[f32]; 3]> {
        let vectors = self.clusters[cluster].chunks_exact(3 * self.rows);
        vectors.map(|vector| [0, 1, 2].map(|channel| &vector[channel * self.rows..(channel + 1) * self.rows]))
    }
}

/// The product of each channel's matrix and the light, row by row.
fn of_vector(vector: &[f64], light: &HarmonicLight, size: TransferSize, factor: f64) -> Vec<f64> {
    let TransferSize { rows, columns, .. } = size;
    let count = rows * columns;
    let channels = light.channels().iter().enumerate();
    let products = channels.flat_map(|(channel, light)| {
        let matrix = &vector[if vector.len() > count { channel * count } else { 0 }..][..count];
        matrix.chunks_exact(columns).map(|row| factor * dot(row, &light[..columns]))
    });
    products.collect()
}
