//! Parameters and errors of the study.

use crate::error::InputError;
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::study::StudyError;

/// Error of a mesh without an atlas.
pub fn no_atlas(error: InputError) -> StudyError {
    StudyError::coded("crossbar::atlas", error)
}

/// Parameters: an atlas to build and measure.
#[derive(Debug, Clone)]
pub struct AtlasStudy {
    /// Name of the mesh.
    pub name: String,
    /// Mesh.
    pub mesh: Mesh,
    /// Side of the atlas, in texels.
    pub side: u32,
    /// Camera of the pictures of the mesh; `None` for no pictures and no files.
    pub camera: Option<Camera>,
}
