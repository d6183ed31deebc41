//! The model, light and camera that studies of all-frequency transfer share.

use super::part::Part;
use crate::all_frequency::file::AllFrequencyFile;
use crate::geom::Mesh;
use crate::study::prt::LitView;
use crate::transfer::Vertices;
use crate::transfer::light::DistantLight;

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
    /// The ground below the model.
    pub ground: Option<LitGround>,
    /// The light.
    pub light: DistantLight,
    /// Number of light coefficients kept, the largest by area times magnitude; `None` for all.
    pub keep: Option<usize>,
}

/// The ground below a model, with transfer of its own.
#[derive(Debug)]
pub struct LitGround {
    /// The ground's mesh.
    pub mesh: Mesh,
    /// The ground's vertices.
    pub vertices: Vertices,
    /// Color per material.
    pub colors: Vec<[f64; 3]>,
    /// Visibility, coded transfer or both.
    pub file: AllFrequencyFile,
}

impl LitModel {
    /// The model, then the ground below it.
    pub(in crate::study::prt) fn parts(&self) -> Vec<Part<'_>> {
        let ground = self.ground.as_ref().map(|ground| Part::new(&ground.vertices, &ground.colors, &ground.file));
        std::iter::once(Part::new(&self.vertices, &self.colors, &self.file)).chain(ground).collect()
    }
}
