//! Figures 1 and 5: pictures by transfer and by low-frequency light compared with pictures by rays; errors by cause.

use super::models::{ModelVisibility, filled};
use super::{EntryFindings, HOST, ModelSize, PaperRow, RunResult, Shared, StudyError, paragraph, solved};
use crate::bi_scale::bicluster::{SEED, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, BiScaleMeaning};
use crate::bi_scale::low_frequency::LowFrequencyTransfer;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::texture::PatchKind;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::geom::Mesh;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::prt::{BiScaleDrawing, BiScaleRendering, CausePictures, LitView, SurfaceTexture, TexturedSurface};
use crate::study::reproduce::shared::HARD_SUN;
use crate::transfer::file::MeshDigest;
use crate::transfer::light::DistantLight;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The paper's models, materials, light and cameras are not available. Stand-ins are drawn in {} x {} pixels under a clear sky with \
    a small sun: by biclusters of transfer, with textures of {} x {} texels and {} x {} views; and by ray casting every pixel, with patches of \
    heights. Intermediate pictures replace ray casting by transfer one step at a time; the error of a step is its difference from the picture \
    before, in percent of the ray-cast picture's RMS. Low frequency is transfer of harmonics of order {} on both sides, as in low-frequency bi-scale \
    rendering, with the same textures.";
const QUESTION: &str = "the models, their textures, the light and the cameras; whether the references are ray-cast per pixel or drawn by uncompressed transfer.";
/// Number of local directions per side for the bunny, and for the armor.
const SIDE: usize = 8;
const ARMOR_SIDE: usize = 12;

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let size = FigureSize::new(shared.models);
    let FigureSize { picture: [width, height], texels, views, .. } = size;
    let mut found = EntryFindings::new(
        [paragraph(HOW, &[&width, &height, &texels, &texels, &views, &views, &ORDER])],
        [nonzero_share(size.coarser)?],
        [QUESTION],
        [],
    );
    let mut smooth = Table::of(
        "Low frequency and biclusters: errors against ray casting, and against ray casting with the same textures",
        "figure biclusters_% low_frequency_% biclusters_with_textures_% low_frequency_with_textures_%",
    );
    for (place, name, model, patch, side) in [
        ("figure 1", "bunny", TransferModel::BiScaleBunny, PatchKind::Bumps, SIDE),
        ("figure 5", "armor", TransferModel::BiScaleArmor, PatchKind::Mail, ARMOR_SIDE),
    ] {
        let model = TexturedModel { name, mesh: model.mesh(size.coarser), patch };
        let drawn = DrawnFigure::new(&model, side, size)?;
        found.tables.push(drawn.causes.table(&format!("Error by cause, {place}: {name}")));
        let [ours, low] = [drawn.causes.drawn(), &drawn.smooth].map(|picture| drawn.errors(picture));
        let errors = [ours[0], low[0], ours[1], low[1]].map(Cell::measured);
        smooth.push(std::iter::once(Cell::from(place)).chain(errors));
        found.rows.push(solved(&format!("low-frequency-{name}"), low[1] / ours[1])?);
    }
    found.tables.insert(0, smooth);
    Ok(found)
}

/// Row for section IV's fraction of nonzero entries in the bunny's matrix.
fn nonzero_share(coarser: u32) -> Result<PaperRow, StudyError> {
    let seen = ModelVisibility::new(&TransferModel::BiScaleBunny.mesh(coarser), Horizon::Normal)?;
    let matrix = seen.matrix(SIDE)?;
    solved("nonzero-share", 100.0 * matrix.nonzeros() as f64 / (matrix.rows() * matrix.columns()) as f64)
}

#[derive(Clone, Copy, Debug)]
struct FigureSize {
    /// Edge length of models, as a multiple of the paper's.
    coarser: u32,
    /// Size of the pictures, in pixels.
    picture: [u32; 2],
    /// Number of texels per side of a patch.
    texels: usize,
    /// Number of view directions per side.
    views: usize,
    /// Repetitions of a patch per unit of texture coordinates, so that patches are visible at this picture size.
    repeat: f64,
}

impl FigureSize {
    fn new(models: ModelSize) -> Self {
        let printed = Self { coarser: 1, picture: [160, 120], texels: 64, views: 12, repeat: 5.0 };
        models.pick(printed, Self { coarser: 3, picture: [40, 30], texels: 16, repeat: 2.0, ..printed })
    }
}

struct TexturedModel {
    name: &'static str,
    mesh: Mesh,
    patch: PatchKind,
}

impl TexturedModel {
    /// Computes the transfer to `side` local directions per side as biclusters, with the texture and a camera, under a
    /// clear sky with a sun.
    fn rendering(&self, side: usize, size: FigureSize) -> Result<BiScaleRendering, StudyError> {
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
const ORDER: usize = 5;

struct DrawnFigure {
    causes: CausePictures,
    /// Colors from low-frequency light.
    smooth: Vec<[f64; 3]>,
}

impl DrawnFigure {
    /// Draws a model with `side` local directions per side.
    fn new(model: &TexturedModel, side: usize, size: FigureSize) -> Result<Self, StudyError> {
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
    fn errors(&self, picture: &[[f64; 3]]) -> [f64; 2] {
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
