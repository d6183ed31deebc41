//! Coherence of clusters over a mesh (section 5 of the paper): a triangle whose vertices are in different clusters is
//! drawn once for each.
//!
//! - [`overdraw`]: how many triangles are drawn;
//! - [`reclassify`]: vertices go to clusters of their neighbours, within a budget of error;
//! - [`Superclusters`]: clusters that are drawn as one, as many as the constant registers hold. They change no error.

mod reclassify;
mod supercluster;

pub use reclassify::{Reclassified, reclassify};
pub use supercluster::{ConstantRegisters, Superclusters};

use thiserror::Error;

use crate::transfer::Signal;
use crate::transfer::clustering::Clustering;

/// Contradictions between clusters and a mesh. Triangles, vertices and clusters count from 0.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CoherenceError {
    /// A triangle names a vertex without a cluster.
    #[error("triangle {triangle} has the vertex {found}, expected one of the clustering's {points} points")]
    Vertex { triangle: usize, found: u32, points: usize },
    /// The clustering is of another signal.
    #[error("expected a signal of {points} x {dimension} numbers, found {found_points} x {found_dimension}")]
    Shape { points: usize, dimension: usize, found_points: usize, found_dimension: usize },
    /// A fraction of the error that is negative or not finite.
    #[error("expected an error budget of at least 0, as a share of the error, found {found}")]
    Budget { found: f64 },
    /// One cluster has more constants than there are registers.
    #[error("cluster {cluster} needs {needed} constant registers, expected at most {limit}; take fewer vectors")]
    Registers { cluster: usize, needed: usize, limit: usize },
}

/// The number of triangles drawn: for each triangle the number of different clusters of its vertices, summed. Divided
/// by the number of triangles it is the overdraw that the paper prints.
///
/// # Panics
/// If a triangle names a vertex without a cluster.
pub fn overdraw(triangles: &[[u32; 3]], of_point: &[u32]) -> u64 {
    triangles.iter().map(|corners| distinct(corners.map(|corner| of_point[corner as usize]))).sum()
}

/// The number of different values among three.
fn distinct([a, b, c]: [u32; 3]) -> u64 {
    1 + u64::from(b != a) + u64::from(c != a && c != b)
}

fn check_triangles(triangles: &[[u32; 3]], points: usize) -> Result<(), CoherenceError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&found) = corners.iter().find(|&&corner| corner as usize >= points) {
            return Err(CoherenceError::Vertex { triangle, found, points });
        }
    }
    Ok(())
}

fn check_shape(signal: &Signal, clustering: &Clustering) -> Result<(), CoherenceError> {
    let (found_points, found_dimension) = (signal.points(), signal.dimension());
    let (points, dimension) = (clustering.points(), clustering.dimension());
    if (points, dimension) == (found_points, found_dimension) {
        Ok(())
    } else {
        Err(CoherenceError::Shape { points, dimension, found_points, found_dimension })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overdraw_counts_clusters_of_triangles() {
        let of_point = [0, 0, 1, 2];
        let triangles = [[0, 1, 1], [0, 1, 2], [2, 1, 0], [1, 2, 3], [3, 3, 3]];
        assert_eq!(overdraw(&triangles, &of_point), 1 + 2 + 2 + 3 + 1);
    }
}
