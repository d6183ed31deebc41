//! The model, light and camera that studies of all-frequency transfer share.

use crate::all_frequency::file::AllFrequencyFile;
use crate::geom::Mesh;
use crate::study::prt::LitView;
use crate::transfer::Vertices;
use crate::transfer::light::{Decimation, DistantLight};

/// A model with its transfer, a light and a camera.
#[derive(Debug)]
pub struct LitModel {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's mesh.
    pub mesh: Mesh,
    /// The model's vertices.
    pub vertices: Vertices,
    /// Surface color per material.
    pub colors: Vec<[f64; 3]>,
    /// Visibility, coded transfer or both; if there is coded transfer, it is drawn.
    pub file: AllFrequencyFile,
    /// A file with visibility, for measuring the loss of compression.
    pub original: Option<AllFrequencyFile>,
    /// The light.
    pub light: DistantLight,
    /// Decimation of the light.
    pub decimation: Decimation,
    /// Number of light coefficients kept, the largest by area times magnitude; `None` for all.
    pub keep: Option<usize>,
}
