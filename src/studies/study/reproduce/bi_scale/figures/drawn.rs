//! Pictures of a figure: by transfer, by rays, by low-frequency light, and of the sources of error.

use super::scene::{FigureSize, SAMPLES, TexturedModel};
use super::{HOST, StudyError, failed};
use crate::bi_scale::baselines::{HarmonicRows, LocalTransfer, StoredTransfer};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::picture::Picture;
use crate::report::{NamedPicture, PictureGrid};
use crate::study::prt::{BiScaleDrawing, BiScaleRendering, CausePictures, auto_exposure, filtered, linear_picture};

/// Order of the harmonics of low-frequency bi-scale transfer.
pub(super) const ORDER: usize = 5;

/// Renderings of a figure.
pub(super) struct DrawnFigure {
    pub(super) causes: CausePictures,
    /// Picture by low-frequency light.
    pub(super) smooth: Option<Vec<[f64; 3]>>,
    /// Larger pictures that the model fills: by biclusters, and by low-frequency light.
    fine: Vec<Picture>,
    /// Rendering of the model.
    pub(super) rendering: BiScaleRendering,
}

impl DrawnFigure {
    /// Draws a model with `side` local directions along an edge.
    pub(super) fn new(
        model: &TexturedModel,
        side: usize,
        size: FigureSize,
        has_smooth: bool,
    ) -> Result<Self, StudyError> {
        let fail = failed(HOST);
        let rendering = model.rendering(side, size)?;
        let drawing = BiScaleDrawing::new(&rendering).map_err(|e| fail(&e))?;
        let cube = drawing.cube().map_err(|e| fail(&e))?;
        let local = drawing.local(&cube).map_err(|e| fail(&e))?;
        let drawn = drawing.shade(&local.rows);
        let causes = drawing.causes(&cube, &drawn, &mut |_, _, _| ()).map_err(|e| fail(&e))?;
        let mut fine = vec![fine_picture(&drawing, model, size, &local.rows)?];
        let smooth = match &rendering.file.matrix {
            Some(matrix) if has_smooth => {
                let low = low_frequency(&rendering, matrix, side, &light_vectors(&cube))?;
                fine.push(fine_picture(&drawing, model, size, &low)?);
                Some(drawing.shade(&low))
            }
            _ => None,
        };
        Ok(Self { causes, smooth, fine, rendering })
    }

    /// Errors of a picture relative to that by rays, and to that by rays with the same textures, in percent.
    pub(super) fn errors(&self, picture: &[[f64; 3]]) -> [f64; 2] {
        [self.causes.exact(), self.causes.textured()].map(|other| self.causes.apart(other, picture))
    }

    /// Returns the pictures with the same exposure; `name` is the prefix of their file names. First the larger ones
    /// and the one by rays, of which every pixel takes many rays, then those that are compared with it.
    pub(super) fn grid(&self, title: &str, name: &str) -> Result<PictureGrid, StudyError> {
        let model = &self.rendering.view.model;
        let ways = ["by biclusters".to_owned(), format!("harmonics of order {ORDER} on both sides")];
        let mut fine = Vec::new();
        for ((picture, how), ending) in self.fine.iter().zip(&ways).zip(["", "-low"]) {
            fine.push(self.fine_picture(&format!("{name}{ending}"), picture, format!("{model}, {how}"))?);
        }
        let mut compared = vec![self.compared(&format!("{name}-transfer"), self.causes.drawn(), &ways[0])?];
        if let Some(smooth) = &self.smooth {
            compared.push(self.compared(&format!("{name}-smooth"), smooth, &ways[1])?);
        }
        fine.push(self.by_rays(name)?);
        let columns = ways.into_iter().take(self.fine.len()).chain(["by rays, of few pixels".to_owned()]);
        let [width, height] = [self.rendering.view.camera.width(), self.rendering.view.camera.height()];
        let label = format!("as compared, {width} x {height} pixels");
        Ok(PictureGrid::new(title, columns).row("", fine).row(label, compared))
    }

    /// The picture by rays.
    pub(super) fn by_rays(&self, name: &str) -> Result<NamedPicture, StudyError> {
        self.compared(&format!("{name}-rays"), self.causes.exact(), "by rays")
    }

    fn compared(&self, name: &str, colors: &[[f64; 3]], how: &str) -> Result<NamedPicture, StudyError> {
        self.fine_picture(
            name,
            &linear_picture(&self.rendering.view.camera, colors),
            format!("{}, {how}", self.rendering.view.model),
        )
    }

    /// Shows a picture with the exposure of that by rays.
    pub(super) fn fine_picture(
        &self,
        name: &str,
        picture: &Picture,
        caption: String,
    ) -> Result<NamedPicture, StudyError> {
        let image = picture.display(auto_exposure(self.causes.exact())).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(format!("bi-scale-{name}"), image, caption))
    }

    /// Larger picture by biclusters.
    pub(super) fn fine(&self) -> &Picture {
        &self.fine[0]
    }
}

/// Larger picture of light at vertices, which the model fills.
fn fine_picture(
    drawing: &BiScaleDrawing<'_>,
    model: &TexturedModel,
    size: FigureSize,
    local: &[[f64; 3]],
) -> Result<Picture, StudyError> {
    let samples = drawing.shade_from(&model.camera(size.shown.map(|side| side * SAMPLES))?, local);
    let colors = filtered(&samples, size.shown, SAMPLES);
    let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
    Ok(Picture::rgb(size.shown[0], size.shown[1], &single))
}

/// Renders a model by biclusters alone: as compared, and the larger picture.
pub(super) fn by_transfer(
    model: &TexturedModel,
    side: usize,
    size: FigureSize,
) -> Result<(Vec<[f64; 3]>, Picture), StudyError> {
    let fail = failed(HOST);
    let rendering = model.rendering(side, size)?;
    let drawing = BiScaleDrawing::new(&rendering).map_err(|e| fail(&e))?;
    let cube = drawing.cube().map_err(|e| fail(&e))?;
    let local = drawing.local(&cube).map_err(|e| fail(&e))?;
    Ok((drawing.shade(&local.rows), fine_picture(&drawing, model, size, &local.rows)?))
}

/// Computes L~ by low-frequency bi-scale transfer: harmonics on both sides.
fn low_frequency(
    rendering: &BiScaleRendering,
    matrix: &SparseMatrix,
    side: usize,
    channels: &[Vec<f64>; 3],
) -> Result<Vec<[f64; 3]>, StudyError> {
    let fail = failed(HOST);
    let directions = LocalDirections::new(side).map_err(|e| fail(&e))?;
    let transfer =
        LocalTransfer::new(matrix, rendering.surface.vertices.frames(), &directions).map_err(|e| fail(&e))?;
    let rows = HarmonicRows::of_both(&transfer, ORDER).map_err(|e| fail(&e))?;
    Ok(side_by_side(channels.each_ref().map(|channel| rows.multiply(channel))))
}
