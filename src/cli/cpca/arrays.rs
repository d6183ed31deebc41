//! The contents of a file of low-frequency transfer as NumPy arrays.

use std::io;
use std::path::{Path, PathBuf};

use crate::cli::Problem;
use crate::io::atomic::FileSet;
use crate::io::{NumberTable, write_npy};
use crate::transfer::clustering::Clustering;
use crate::transfer::file::PrtFile;

/// Writes them into a folder, whole or not at all: the transfer of each point; of clusters their means, vectors, and
/// the weights and cluster of each point.
pub(super) fn write(file: &PrtFile, folder: &Path) -> Result<Vec<PathBuf>, Problem> {
    let mut set = FileSet::new(folder)?;
    let mut put = |name: &str, columns: usize, values: Vec<f32>| {
        let table = NumberTable { columns, values };
        set.write(Path::new(name), |out: &mut dyn io::Write| write_npy(&table, out))
    };
    if let Some(transfer) = &file.transfer {
        put("transfer.npy", transfer.dimension(), transfer.values().to_vec())?;
    }
    if let Some(clustering) = &file.clustering {
        let dimension = clustering.dimension();
        let means = clustering.subspaces().iter().flat_map(|subspace| singles(&subspace.mean));
        put("means.npy", dimension, means.collect())?;
        put("vectors.npy", 1 + dimension, vectors(clustering))?;
        let most = clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0).max(1);
        put("weights.npy", most, weights(clustering, most))?;
        put("clusters.npy", 1, clustering.of_point().iter().map(|&cluster| cluster as f32).collect())?;
    }
    Ok(set.commit()?)
}

fn singles(values: &[f64]) -> impl Iterator<Item = f32> {
    values.iter().map(|&value| value as f32)
}

/// A row per vector: its cluster's number, then the vector.
fn vectors(clustering: &Clustering) -> Vec<f32> {
    let mut rows = Vec::new();
    for (cluster, subspace) in clustering.subspaces().iter().enumerate() {
        for vector in subspace.vectors() {
            rows.push(cluster as f32);
            rows.extend(singles(vector));
        }
    }
    rows
}

/// A row per point, with zeros behind the weights of clusters of fewer vectors.
fn weights(clustering: &Clustering, columns: usize) -> Vec<f32> {
    let mut rows = vec![0.0; clustering.points() * columns];
    for (point, row) in rows.chunks_exact_mut(columns).enumerate() {
        row.iter_mut().zip(singles(clustering.weights(point))).for_each(|(into, weight)| *into = weight);
    }
    rows
}
