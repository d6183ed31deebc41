//! The model, light and camera of a picture, and the product of its light and transfer.

use super::surface::TexturedSurface;
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::paper;
use crate::bi_scale::product::{Gather, by_rows};
use crate::bi_scale::texture::{BidirectionalTexture, MesoPatch};
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::transfer::light::{CubeLight, DistantLight};

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

/// L~ of all vertices.
#[derive(Clone, Debug)]
pub(in crate::study) struct LocalLight {
    /// `biclusters` or `rows`.
    pub(super) way: &'static str,
    /// Red, green and blue of each row of the transfer.
    pub(in crate::study) rows: Vec<[f64; 3]>,
}

impl LocalLight {
    /// The light times a file's transfer, by its biclusters in f32 if it has any, otherwise by its matrix in f64; `None`
    /// without both. Panics if the transfer does not have one column per light texel.
    pub(super) fn new(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let Some(biclusters) = &file.biclusters else { return Self::exact(file, light) };
        let light = side_by_side(light_vectors(light));
        let single: Vec<[f32; 3]> = light.into_iter().map(|texel| texel.map(|value| value as f32)).collect();
        let rows = Gather::new(biclusters).multiply(&single);
        Some(Self { way: "biclusters", rows: rows.into_iter().map(|row| row.map(f64::from)).collect() })
    }

    /// Local light in f64, by the file's matrix if it has one, else by its biclusters. Panics as [`Self::new`] does.
    pub(super) fn exact(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let channels = light_vectors(light);
        let (way, channels) = match (&file.matrix, &file.biclusters) {
            (Some(matrix), _) => ("rows", channels.map(|channel| by_rows(matrix, &channel))),
            (None, Some(biclusters)) => ("biclusters", channels.map(|channel| paper::multiply(biclusters, &channel))),
            (None, None) => return None,
        };
        Some(Self { way, rows: side_by_side(channels) })
    }
}

/// Error for a file whose matrix is not the transfer of a mesh.
pub(super) fn no_mesh_transfer() -> StudyError {
    let help = "name what `crossbar bi-scale precompute` wrote, or its biclusters";
    let what = "expected transfer of a mesh, found another matrix";
    StudyError::new("crossbar::prt::meaning", what).with_help(help)
}
