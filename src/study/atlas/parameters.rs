//! What is asked for, and why there may be no answer.

use crate::atlas::AtlasError;
use crate::geom::Mesh;
use crate::report::ReportError;
use crate::scene::Camera;

/// An atlas to be made and measured.
#[derive(Debug, Clone)]
pub struct AtlasStudy {
    /// What the mesh is called.
    pub name: String,
    /// The mesh.
    pub mesh: Mesh,
    /// Texels along a side.
    pub side: u32,
    /// The camera of the pictures of the mesh; `None` for no pictures and no files.
    pub camera: Option<Camera>,
}

/// Why there is no atlas, or no page of it.
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
