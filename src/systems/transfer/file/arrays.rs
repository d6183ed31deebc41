//! Low-frequency transfer as arrays.

use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::kind::{begin_reading, begin_writing, bytes_of, contradiction};
use super::{MeshDigest, PrtFile, PrtKind, PrtMeaning, front, require_mesh};
use crate::clustering::{AffineSubspace, Clustering, Signal};
use crate::error::InputError;
use crate::io::{NpzReader, NpzWriter, WriteError, write_file};

#[derive(Serialize, Deserialize)]
struct Metadata {
    meaning: PrtMeaning,
    points: usize,
    clusters: Option<ClusterSizes>,
    mesh: Option<MeshDigest>,
    provenance: Option<String>,
}

/// Numbers of clusters, of vectors of all clusters, and of weights of all points.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct ClusterSizes {
    count: usize,
    vectors: usize,
    weights: usize,
}

/// Reads a file; if `mesh` is given, it must be the file's mesh.
pub fn load_prt(path: &Path, mesh: Option<&MeshDigest>) -> Result<PrtFile, InputError> {
    let file = parse_prt(&bytes_of(path)?, path)?;
    mesh.map_or(Ok(()), |expected| require_mesh(path, expected, file.mesh))?;
    Ok(file)
}

/// Reads a file from bytes; `name` is its name in messages.
pub fn parse_prt(bytes: &[u8], name: &Path) -> Result<PrtFile, InputError> {
    let (mut arrays, metadata) = begin_reading(bytes, name, PrtKind::LowFrequency)?;
    let Metadata { meaning, points, clusters, mesh, provenance } = metadata;
    if let Some((field, expected, found)) = meaning.fault() {
        return Err(arrays.refuse(field, expected, found));
    }
    let transfer = arrays.has("M_p").then(|| {
        let values = arrays.singles("M_p", &meaning.shape(points))?;
        let signal = Signal::new(meaning.dimension().unwrap_or(0), values);
        signal.map_err(|reason| arrays.refuse("M_p", "a signal", reason.to_string()))
    });
    let transfer = transfer.transpose()?;
    let clustering = clusters.map(|sizes| clustering(&mut arrays, &meaning, points, sizes)).transpose()?;
    let file = PrtFile { meaning, mesh, transfer, clustering, provenance };
    if let Some((field, expected, found)) = file.fault() {
        return Err(arrays.refuse(field, expected, found));
    }
    arrays.finish()?;
    Ok(file)
}

fn clustering(
    arrays: &mut NpzReader<'_>,
    meaning: &PrtMeaning,
    points: usize,
    ClusterSizes { count, vectors, weights }: ClusterSizes,
) -> Result<Clustering, InputError> {
    let counts: Vec<u32> = arrays.integers("n_k", &[count])?;
    let means = arrays.doubles("x_0", &meaning.shape(count))?;
    let eigenvalues = arrays.doubles("D_i_squared", &[vectors])?;
    let components = arrays.doubles("x_i", &meaning.shape(vectors))?;
    let of_point = arrays.integers("k_p", &[points])?;
    let weights = arrays.doubles("w_p", &[weights])?;
    let sum = counts.iter().fold(0_u64, |sum, &count| sum + u64::from(count));
    if sum != vectors as u64 {
        return Err(arrays.refuse("n_k", format!("{vectors} vectors in all"), sum.to_string()));
    }
    let dimension = meaning.dimension().unwrap_or(0);
    let (mut eigenvalues, mut components) = (&eigenvalues[..], &components[..]);
    let subspaces = counts.iter().enumerate().map(|(at, &count)| AffineSubspace {
        mean: means[at * dimension..][..dimension].to_vec(),
        eigenvalues: front(&mut eigenvalues, count as usize),
        vectors: front(&mut components, count as usize * dimension),
    });
    let found = Clustering::new(subspaces.collect(), of_point, weights);
    found.map_err(|reason| arrays.refuse("clusters", "those of a signal", reason.to_string()))
}

/// Writes a file atomically. Fails with [`WriteError`], of kind [`InvalidInput`](std::io::ErrorKind::InvalidInput) if
/// the parts contradict each other.
pub fn save_prt(file: &PrtFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_prt(file, out))
}

/// Writes the bytes of a file. Fails with errors of `out`, and with [`InvalidInput`](std::io::ErrorKind::InvalidInput),
/// before anything is written, if the parts contradict each other.
pub fn write_prt(file: &PrtFile, out: &mut dyn Write) -> std::io::Result<()> {
    if let Some(fault) = file.fault() {
        return Err(contradiction(fault));
    }
    let sizes = |clustering: &Clustering| ClusterSizes {
        count: clustering.subspaces().len(),
        vectors: clustering.subspaces().iter().map(AffineSubspace::len).sum(),
        weights: clustering.all_weights().len(),
    };
    let clusters = file.clustering.as_ref().map(sizes);
    let (meaning, points, mesh) = (file.meaning.clone(), file.points(), file.mesh);
    let metadata = Metadata { meaning, points, clusters, mesh, provenance: file.provenance.clone() };
    let mut arrays = begin_writing(out, PrtKind::LowFrequency, &metadata)?;
    if let Some(transfer) = &file.transfer {
        arrays.singles("M_p", &file.meaning.shape(points), transfer.values().iter())?;
    }
    if let (Some(clustering), Some(sizes)) = (&file.clustering, clusters) {
        write_clustering(clustering, sizes, &file.meaning, &mut arrays)?;
    }
    arrays.finish()
}

fn write_clustering(
    clustering: &Clustering,
    ClusterSizes { count, vectors, weights }: ClusterSizes,
    meaning: &PrtMeaning,
    arrays: &mut NpzWriter<'_>,
) -> std::io::Result<()> {
    let subspaces = || clustering.subspaces().iter();
    arrays.integers("n_k", &[count], subspaces().map(|subspace| subspace.len() as u32))?;
    arrays.doubles("x_0", &meaning.shape(count), subspaces().flat_map(|subspace| &subspace.mean))?;
    arrays.doubles("D_i_squared", &[vectors], subspaces().flat_map(|subspace| &subspace.eigenvalues))?;
    arrays.doubles("x_i", &meaning.shape(vectors), subspaces().flat_map(|subspace| &subspace.vectors))?;
    arrays.integers("k_p", &[clustering.points()], clustering.of_point().iter().copied())?;
    arrays.doubles("w_p", &[weights], clustering.all_weights().iter())
}
