//! Figure 3: light directions of a local direction, and the matrix of its vertex.

use super::super::models::ModelVisibility;
use super::{PaperRow, Prose, StudyError, number, solved};
use crate::bi_scale::matrix::SparseMatrix;
use crate::picture::rgb8;
use crate::report::{NamedPicture, PictureGrid};
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::grid::{LIGHT_SIDE, LIGHT_TEXELS};
use crate::transfer::visibility::Horizon;

const HOW: &str = "Figure 3 is drawn of the vertex that sees least of the light on a bunny with {} vertices, and of the one of its {} local directions to which \
    most light texels belong: {} of {}.";
/// Columns per pixel of the matrix's picture.
const COLUMNS_PER_PIXEL: usize = 8;
/// Pixels along an edge of a light texel, and per row of the matrix.
const SCALE: usize = 3;

/// Contribution of Figure 3 to the entry.
pub(super) struct MatrixFigure {
    pub(super) text: Prose,
    pub(super) row: PaperRow,
    pub(super) pictures: PictureGrid,
}

pub(super) fn figure(coarser: u32, side: usize) -> Result<MatrixFigure, StudyError> {
    let seen = ModelVisibility::new(&TransferModel::BiScaleBunny.mesh(coarser), Horizon::Normal)?;
    let matrix = seen.matrix(side)?;
    let lights = side * side;
    let of_vertex = |vertex: usize| (vertex * lights..(vertex + 1) * lights).map(|row| matrix.row(row).len());
    let vertex = (0..seen.vertices.len()).min_by_key(|&vertex| of_vertex(vertex).sum::<usize>()).unwrap_or_default();
    // The first of equals.
    let most = of_vertex(vertex).max().unwrap_or_default();
    let direction = of_vertex(vertex).position(|texels| texels == most).unwrap_or_default();
    let share = 100.0 * matrix.nonzeros() as f64 / (matrix.rows() * matrix.columns()) as f64;
    let row = solved("nonzero-share", share)?;
    let sizes = [seen.vertices.len(), lights, most, LIGHT_TEXELS].map(|size| number(size as f64, 0));
    let rows = Rows { matrix: &matrix, first: vertex * lights, count: lights, marked: vertex * lights + direction };
    let pictures = PictureGrid::new("Figure 3", ["(a) light", "(b) rows of T"]).row("", [rows.cube(), rows.picture()]);
    Ok(MatrixFigure { text: Prose::new(HOW, sizes), row, pictures })
}

/// Rows of a vertex, one of them marked.
struct Rows<'a> {
    matrix: &'a SparseMatrix,
    first: usize,
    count: usize,
    marked: usize,
}

impl Rows<'_> {
    /// Figure 3(a): visibility of the vertex in grey, light of the marked row in red; the faces side by side.
    fn cube(&self) -> NamedPicture {
        let mut texels = vec![[0_u8; 3]; LIGHT_TEXELS];
        for row in self.first..self.first + self.count {
            for entry in self.matrix.row(row) {
                let value = grey(self.matrix.value(entry.value));
                let is_marked = row == self.marked;
                texels[entry.index as usize] = if is_marked { [value, 0, 0] } else { [value; 3] };
            }
        }
        let (width, height) = (6 * LIGHT_SIDE * SCALE, LIGHT_SIDE * SCALE);
        let pixel = |at: usize| {
            let (column, row) = (at % width / SCALE, at / width / SCALE);
            texels[(column / LIGHT_SIDE * LIGHT_SIDE + row) * LIGHT_SIDE + column % LIGHT_SIDE]
        };
        let image = rgb8(width as u32, height as u32, (0..width * height).map(pixel));
        let caption = "3 (a): faces +x, -x, +y, -y, +z, -z of the light as the vertex sees them; red: what belongs to one \
            local direction";
        NamedPicture::new("bi-scale-figure-3-cube", image, caption)
    }

    /// Figure 3(b): matrix of the vertex, each pixel the mean of some columns, the marked row in red.
    fn picture(&self) -> NamedPicture {
        let width = LIGHT_TEXELS / COLUMNS_PER_PIXEL;
        let mut shares = vec![0.0; self.count * width];
        for row in 0..self.count {
            for entry in self.matrix.row(self.first + row) {
                let value = self.matrix.value(entry.value);
                shares[row * width + entry.index as usize / COLUMNS_PER_PIXEL] += value / COLUMNS_PER_PIXEL as f64;
            }
        }
        let pixel = |at: usize| {
            let row = at / width / SCALE;
            let share = shares[row * width + at % width];
            if self.first + row == self.marked { [255, grey(1.0 - share), grey(1.0 - share)] } else { [grey(share); 3] }
        };
        let pixels = width * self.count * SCALE;
        let image = rgb8(width as u32, (self.count * SCALE) as u32, (0..pixels).map(pixel));
        let caption = "3 (b): the vertex's rows of T, a row per local direction, eight light texels a pixel; the row of \
            (a) on red";
        NamedPicture::new("bi-scale-figure-3-matrix", image, caption)
    }
}

/// Converts a fraction to a byte.
fn grey(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u8
}
