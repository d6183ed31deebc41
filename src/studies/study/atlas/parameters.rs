//! Parameters and errors of the study.

use crate::atlas::AtlasError;
use crate::geom::Mesh;
use crate::report::ReportError;
use crate::scene::Camera;

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

/// Error of the study.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum AtlasStudyError {
    /// The mesh has no atlas of this size.
    #[error(transparent)]
    #[diagnostic(code(crossbar::atlas))]
    Atlas(#[from] AtlasError),
    /// A file cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Report(#[from] ReportError),
}
