//! The model, light and camera of a picture.

use super::surface::TexturedSurface;
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::texture::{BidirectionalTexture, MesoPatch};
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::transfer::light::DistantLight;

/// A model with its transfer, its textures, a light and a camera.
#[derive(Debug)]
pub struct BiScaleRendering {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's mesh.
    pub surface: TexturedSurface,
    /// The model's transfer.
    pub file: BiScaleFile,
    /// The textures that the model's triangles refer to.
    pub textures: Vec<SurfaceTexture>,
    /// The light.
    pub light: DistantLight,
    /// `true` to compare the picture with a ray-traced one; all textures must have patches.
    pub reference: bool,
}

/// A bidirectional texture with its name.
#[derive(Debug)]
pub struct SurfaceTexture {
    /// The name.
    pub name: String,
    /// Its samples.
    pub samples: BidirectionalTexture,
    /// The patch that the texture was made from, if known.
    pub patch: Option<MesoPatch>,
}

/// Error for a file whose matrix is not the transfer of a mesh.
pub(super) fn no_mesh_transfer() -> StudyError {
    let help = "name what `crossbar bi-scale precompute` wrote, or its biclusters";
    let what = "expected transfer of a mesh, found another matrix";
    StudyError::new("crossbar::prt::meaning", what).with_help(help)
}
