//! A mesh's atlas: how good it is, how it looks, and its files.

mod export;
mod pictures;
mod report;

use crate::atlas::{Atlas, AtlasError, AtlasQuality};
use crate::geom::Mesh;
use crate::report::{Findings, Provenance, ReportError};
use crate::scene::Camera;
use crate::study::{ProgressFn, Study};

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

impl Study for AtlasStudy {
    type Error = AtlasStudyError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, AtlasStudyError> {
        let steps = if self.camera.is_some() { 3 } else { 2 };
        progress("clustering faces", 0, steps);
        let atlas = Atlas::new(&self.mesh, self.side)?;
        progress("measuring", 1, steps);
        let quality = AtlasQuality::of(&atlas);
        if self.camera.is_some() {
            progress("drawing", 2, steps);
        }
        Ok(report::findings(self, &atlas, &quality))
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}
