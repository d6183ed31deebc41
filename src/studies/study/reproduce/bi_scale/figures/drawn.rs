//! Pictures of a figure: by transfer, by rays, by low-frequency light, and for the causes of error.

use super::scene::{FigureSize, TexturedModel};
use super::{HOST, RunResult, StudyError};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::low_frequency::LowFrequencyTransfer;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::study::prt::{BiScaleDrawing, BiScaleRendering, CausePictures};

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

/// Computes L~ by low-frequency bi-scale transfer, with harmonics for both directions.
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
