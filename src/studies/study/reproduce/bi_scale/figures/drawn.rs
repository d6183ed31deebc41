//! Pictures of a figure: by transfer, by rays, by low-frequency light, and of the sources of error.

use glam::DMat3;

use super::scene::{FigureSize, SAMPLES, TexturedModel};
use super::{HOST, StudyError, failed};
use crate::bi_scale::baselines::{HarmonicRows, LocalTransfer, StoredTransfer};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::picture::Picture;
use crate::report::NamedPicture;
use crate::study::prt::{BiScaleDrawing, BiScaleRendering, CausePictures, auto_exposure, filtered, linear_picture};

/// Order of the harmonics of low-frequency bi-scale transfer.
pub(super) const ORDER: usize = 5;

/// Renderings of a figure.
pub(super) struct DrawnFigure {
    pub(super) causes: CausePictures,
    /// Picture by low-frequency light.
    pub(super) smooth: Option<Vec<[f64; 3]>>,
    /// Larger picture by biclusters, which the model fills.
    fine: Picture,
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
        let cube = drawing.cube(&DMat3::IDENTITY).map_err(|e| fail(&e))?;
        let local = drawing.local(&cube).map_err(|e| fail(&e))?;
        let drawn = drawing.shade(&local.rows);
        let causes = drawing.causes(&cube, &drawn, &mut |_, _, _| ()).map_err(|e| fail(&e))?;
        let smooth = match &rendering.file.matrix {
            Some(matrix) if has_smooth => {
                let channels = light_vectors(&cube);
                Some(drawing.shade(&low_frequency(&rendering, matrix, side, &channels)?))
            }
            _ => None,
        };
        let samples = drawing.shade_from(&model.fine_camera(size)?, &local.rows);
        let colors = filtered(&samples, size.shown, SAMPLES);
        let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
        let fine = Picture::rgb(size.shown[0], size.shown[1], &single);
        Ok(Self { causes, smooth, fine, rendering })
    }

    /// Errors of a picture relative to that by rays, and to that by rays with the same textures, in percent.
    pub(super) fn errors(&self, picture: &[[f64; 3]]) -> [f64; 2] {
        [self.causes.exact(), self.causes.textured()].map(|other| self.causes.apart(other, picture))
    }

    /// Returns the pictures with the same exposure; `name` is the prefix of their file names.
    pub(super) fn pictures(&self, name: &str) -> Result<Vec<NamedPicture>, StudyError> {
        let model = &self.rendering.view.model;
        let (exact, drawn) = (self.causes.exact(), self.causes.drawn());
        let fine = self.fine.display(auto_exposure(exact)).map_err(|e| failed(HOST)(&e))?;
        let mut shown = vec![
            NamedPicture::new(format!("bi-scale-{name}"), fine, format!("{model}, by biclusters")),
            self.picture(&format!("{name}-rays"), exact, format!("{model}, by rays"))?,
            self.picture(&format!("{name}-transfer"), drawn, format!("{model}, by biclusters, as compared"))?,
        ];
        if let Some(smooth) = &self.smooth {
            let caption = format!("{model}, harmonics of order {ORDER} on both sides");
            shown.push(self.picture(&format!("{name}-smooth"), smooth, caption)?);
        }
        Ok(shown)
    }

    /// Creates a picture with the exposure of that by rays.
    pub(super) fn picture(&self, name: &str, colors: &[[f64; 3]], caption: String) -> Result<NamedPicture, StudyError> {
        let exposure = auto_exposure(self.causes.exact());
        let image =
            linear_picture(&self.rendering.view.camera, colors).display(exposure).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(format!("bi-scale-{name}"), image, caption))
    }
}

/// Renders a model by biclusters alone.
pub(super) fn by_transfer(model: &TexturedModel, side: usize, size: FigureSize) -> Result<Vec<[f64; 3]>, StudyError> {
    let fail = failed(HOST);
    let rendering = model.rendering(side, size)?;
    let drawing = BiScaleDrawing::new(&rendering).map_err(|e| fail(&e))?;
    let cube = drawing.cube(&DMat3::IDENTITY).map_err(|e| fail(&e))?;
    Ok(drawing.shade(&drawing.local(&cube).map_err(|e| fail(&e))?.rows))
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
