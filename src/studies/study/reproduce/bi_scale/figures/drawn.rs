//! Models with a bidirectional texture, and their pictures: by transfer, by rays, by low-frequency light, and for the
//! causes of error.

use super::{HARD_SUN, HOST, Horizon, ModelSize, ModelVisibility, RunResult, StudyError, filled};
use crate::bi_scale::bicluster::{SEED, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, BiScaleMeaning};
use crate::bi_scale::low_frequency::LowFrequencyTransfer;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::texture::PatchKind;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::geom::Mesh;
use crate::study::prt::{BiScaleDrawing, BiScaleRendering, CausePictures, LitView, SurfaceTexture, TexturedSurface};
use crate::transfer::file::MeshDigest;
use crate::transfer::light::DistantLight;

#[derive(Clone, Copy, Debug)]
pub(super) struct FigureSize {
    /// Edge length of models, as a multiple of the paper's.
    pub(super) coarser: u32,
    /// Size of the pictures, in pixels.
    pub(super) picture: [u32; 2],
    /// Number of texels per side of a patch.
    pub(super) texels: usize,
    /// Number of view directions per side.
    pub(super) views: usize,
    /// Repetitions of a patch per unit of texture coordinates, so that patches are visible at this picture size.
    repeat: f64,
}

impl FigureSize {
    pub(super) fn new(models: ModelSize) -> Self {
        let printed = Self { coarser: 1, picture: [160, 120], texels: 64, views: 12, repeat: 5.0 };
        models.pick(printed, Self { coarser: 3, picture: [40, 30], texels: 16, repeat: 2.0, ..printed })
    }
}

pub(super) struct TexturedModel {
    pub(super) name: &'static str,
    pub(super) mesh: Mesh,
    pub(super) patch: PatchKind,
}

impl TexturedModel {
    /// Computes the transfer to `side` local directions per side as biclusters, with the texture and a camera, under a
    /// clear sky with a sun.
    pub(super) fn rendering(&self, side: usize, size: FigureSize) -> Result<BiScaleRendering, StudyError> {
        let mesh = &self.mesh;
        let seen = ModelVisibility::new(mesh, Horizon::Normal)?;
        let matrix = seen.matrix(side)?;
        let biclusters = bicluster(&matrix, SEED, &mut |_| ()).on(HOST)?;
        let meaning =
            BiScaleMeaning { mesh: MeshDigest::new(&seen.vertices), side: side as u32, horizon: Horizon::Normal };
        let file = BiScaleFile { meaning: Some(meaning), matrix: Some(matrix), biclusters: Some(biclusters) };
        let surface = TexturedSurface::new(mesh.clone(), seen.vertices, vec![0; mesh.len()], size.repeat);
        Ok(BiScaleRendering {
            view: LitView {
                model: self.name.to_owned(),
                light: "a clear sky with a sun".to_owned(),
                camera: filled(mesh, size.picture)?,
                exposure: None,
            },
            surface: surface.on(HOST)?,
            file,
            textures: vec![self.texture(side, size)?],
            light: DistantLight::Sky(HARD_SUN),
            reference: true,
        })
    }

    fn texture(&self, side: usize, size: FigureSize) -> Result<SurfaceTexture, StudyError> {
        let directions = |side| LocalDirections::new(side).on(HOST);
        let (view, light) = (directions(size.views)?, directions(side)?);
        let patch = self.patch.patch(1.0);
        let samples = patch.texture(size.texels, &view, &light, &mut |_, _| ()).on(HOST)?;
        Ok(SurfaceTexture { name: self.patch.to_string(), samples, patch: Some(patch) })
    }
}

/// Order of the harmonics in low-frequency bi-scale transfer.
pub(super) const ORDER: usize = 5;

pub(super) struct DrawnFigure {
    pub(super) causes: CausePictures,
    /// Colors from low-frequency light.
    pub(super) smooth: Vec<[f64; 3]>,
}

impl DrawnFigure {
    /// Draws a model with `side` local directions per side.
    pub(super) fn new(model: &TexturedModel, side: usize, size: FigureSize) -> Result<Self, StudyError> {
        let rendering = model.rendering(side, size)?;
        let drawing = BiScaleDrawing::new(&rendering).on(HOST)?;
        let cube = drawing.cube().on(HOST)?;
        let local = drawing.local(&cube).on(HOST)?;
        let drawn = drawing.shade(&local.rows);
        let causes = drawing.causes(&cube, &drawn, &mut |_, _, _| ()).on(HOST)?;
        let matrix = rendering.file.matrix.as_ref().ok_or("the rendering has no transfer matrix").on(HOST)?;
        let low = low_frequency(&rendering, matrix, side, &light_vectors(&cube))?;
        Ok(Self { causes, smooth: drawing.shade(&low) })
    }

    /// RMS errors of a picture in percent: relative to the picture ray-traced with patches, and relative to the picture
    /// ray-traced with textures, as in transfer.
    pub(super) fn errors(&self, picture: &[[f64; 3]]) -> [f64; 2] {
        [self.causes.exact(), self.causes.textured()].map(|other| self.causes.apart(other, picture))
    }
}

/// Computes the local light L~ by low-frequency bi-scale transfer, with harmonics for both directions.
fn low_frequency(
    rendering: &BiScaleRendering,
    matrix: &SparseMatrix,
    side: usize,
    channels: &[Vec<f64>; 3],
) -> Result<Vec<[f64; 3]>, StudyError> {
    let directions = LocalDirections::new(side).on(HOST)?;
    let frames = rendering.surface.vertices.frames();
    let transfer = LowFrequencyTransfer::new(matrix, frames, &directions, ORDER).on(HOST)?;
    Ok(side_by_side(channels.each_ref().map(|channel| transfer.multiply(channel))))
}
