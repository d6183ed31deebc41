//! Coherence of clusters over a mesh (section 5 of the paper): a triangle whose vertices are in different clusters is
//! drawn once for each of them.
//!
//! - [`overdraw`]: the number of triangles drawn;
//! - [`reclassify`]: vertices move to clusters of their neighbours, within a budget of error;
//! - [`Superclusters`]: groups of clusters that are drawn as one, up to the number of constant registers; they do not
//!   change the error.

mod reclassify;
mod supercluster;

pub use reclassify::{Reclassified, reclassify};
pub use supercluster::{ConstantRegisters, Superclusters};

use crate::clustering::{Clustering, Signal};
use crate::error::{InputError, ensure, input_error};

/// The number of triangles drawn: the sum over triangles of the number of different clusters of their vertices. Divided
/// by the number of triangles, it is the overdraw that the paper prints. Panics if a triangle has a vertex without a
/// cluster.
pub fn overdraw(triangles: &[[u32; 3]], of_point: &[u32]) -> u64 {
    triangles.iter().map(|corners| distinct(corners.map(|corner| of_point[corner as usize]))).sum()
}

/// The number of different values among three.
fn distinct([a, b, c]: [u32; 3]) -> u64 {
    1 + u64::from(b != a) + u64::from(c != a && c != b)
}

fn check_triangles(triangles: &[[u32; 3]], points: usize) -> Result<(), InputError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&found) = corners.iter().find(|&&corner| corner as usize >= points) {
            return Err(input_error!(
                "triangle {triangle} has the vertex {found}, expected one of the clustering's {points} points"
            ));
        }
    }
    Ok(())
}

fn check_shape(signal: &Signal, clustering: &Clustering) -> Result<(), InputError> {
    let (found_points, found_dimension) = (signal.points(), signal.dimension());
    let (points, dimension) = (clustering.points(), clustering.dimension());
    ensure!(
        (points, dimension) == (found_points, found_dimension),
        "expected a signal of {points} x {dimension} numbers, found {found_points} x {found_dimension}"
    );
    Ok(())
}
