//! Figures 1 and 5: pictures by transfer and by low-frequency light compared with pictures by rays; errors by cause.

mod drawn;

use super::models::{ModelVisibility, filled};
use super::{EntryFindings, HOST, ModelSize, PaperRow, RunResult, Shared, StudyError, number, paragraph, solved};
use crate::bi_scale::texture::PatchKind;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::stand_ins::HARD_SUN;
use crate::transfer::visibility::Horizon;
use drawn::{DrawnFigure, FigureSize, ORDER, TexturedModel};

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
    let sizes = [width as usize, height as usize, texels, texels, views, views, ORDER];
    let mut found = EntryFindings::new(
        [paragraph(HOW, sizes.map(|size| number(size as f64, 0)))],
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
