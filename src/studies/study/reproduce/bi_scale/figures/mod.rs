//! Figures 1, 3 and 5 to 8: pictures by transfer beside pictures by rays, with errors by cause.

mod drawn;
mod matrix;
mod models;
mod scene;

use super::figure_6::SAMPLED_ROWS;
use super::{EntryFindings, HOST, ModelSize, PaperRow, Prose, Shared, StudyError, failed, number, solved};
use crate::report::{Cell, PictureGrid, Table};
use crate::study::prt::{light_picture, of_texels};
use crate::study::reproduce::sky::HARD_SUN;
use crate::transfer::light::{Decimation, DistantLight};
use drawn::{DrawnFigure, ORDER, by_transfer};
use glam::DMat3;
use scene::{FigureSize, TexturedModel};

const HOW: &str = "Models, materials, light and cameras are not at hand. Stand-ins are drawn in {} x {} pixels under a clear sky with a small sun: by biclusters of \
    transfer, with textures of {} x {} or {} x {} texels and {} x {} views, and by rays, every pixel for itself, with patches of heights. Between them stand \
    pictures that do one thing after the other as transfer does it; a step is how far one lies from the one before, in percent of the root mean square of the \
    picture by rays. Low frequency is transfer of harmonics of order {} on both sides, as low-frequency bi-scale rendering has it, with the same textures.";
const QUESTION: &str = "the models, their textures, the light and the cameras; whether the references are by rays at every pixel or by transfer that was not compressed.";
/// Local directions along an edge of Table I's scenes, and of the armor.
const SIDE: usize = 8;
const ARMOR_SIDE: usize = 12;
/// Local directions along an edge in Figure 8.
const SIDES: [usize; 4] = [8, 12, 16, 32];

/// Parameters of runs at full size, of all entries on the paper.
pub(in crate::study::reproduce) fn full_size() -> String {
    format!("{:?} {SAMPLED_ROWS}", FigureSize::of(ModelSize::Printed))
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let size = FigureSize::of(shared.models);
    let ([width, height], [fine, coarse]) = (size.picture, size.texels);
    let sizes = [width as usize, height as usize, fine, fine, coarse, coarse, size.views, size.views, ORDER];
    let mut found = EntryFindings {
        text: vec![Prose::new(HOW, sizes.map(|size| number(size as f64, 0)))],
        questions: vec![QUESTION],
        ..EntryFindings::default()
    };
    let figure_3 = matrix::figure(size.coarser, SIDE)?;
    found.text.push(figure_3.text);
    found.rows.push(figure_3.row);
    let mut smooth = Table::of(
        "Low frequency beside biclusters: off the picture by rays, and off that with the same textures",
        "figure biclusters_% low_frequency_% biclusters_with_textures_% low_frequency_with_textures_%",
    );
    let drawn_alone = FigureSize::of_pictures(shared.models);
    for (figure, place, (model, size), side) in [
        ("figure-1", "figure 1", (models::bunny(size), size), SIDE),
        ("figure-5", "figure 5", (models::armor(size), size), ARMOR_SIDE),
        ("figure-6", "figure 6", (models::chair(drawn_alone), drawn_alone), SIDE),
        ("figure-7", "figure 7", (models::temple(drawn_alone), drawn_alone), SIDE),
    ] {
        let drawn = DrawnFigure::new(&model, side, size, true)?;
        found.pictures.push(drawn.grid(&format!("{}: {}", place.replacen('f', "F", 1), model.name), figure)?);
        found.tables.push(drawn.causes.table(&format!("Error by cause, {place}: {}", model.name)));
        let ours = drawn.errors(drawn.causes.drawn());
        let low = drawn.smooth.as_deref().map_or([0.0; 2], |picture| drawn.errors(picture));
        let errors = [ours[0], low[0], ours[1], low[1]].map(Cell::measured);
        smooth.push(std::iter::once(Cell::from(place)).chain(errors));
        if ["figure 1", "figure 5"].contains(&place) {
            found.rows.push(solved(&format!("low-frequency-{}", model.name), low[1] / ours[1])?);
        }
    }
    found.tables.insert(0, smooth);
    found.pictures.insert(1, figure_3.pictures);
    let (table, grid) = more_directions(&models::rough_bunny(drawn_alone), drawn_alone)?;
    found.tables.push(table);
    found.pictures.push(grid);
    let light = DistantLight::Sky(HARD_SUN).cube(&DMat3::IDENTITY, Decimation::SolidAngle);
    let light = light.map_err(|e| failed(HOST)(&e))?;
    let light = light_picture("bi-scale-light", "a clear sky with a small sun", of_texels(light.texels()));
    let light = light.map_err(|e| failed(HOST)(&e))?;
    found.pictures.push(PictureGrid::new("The light of these figures", ["light"]).row("", [light]));
    Ok(found)
}

/// Figure 8: effect of more local directions on the picture.
fn more_directions(model: &TexturedModel, size: FigureSize) -> Result<(Table, PictureGrid), StudyError> {
    let mut table =
        Table::of("Figure 8: off the picture by rays, and off that of most directions", "along_an_edge rays_% most_%");
    // Textures of many directions are large.
    let size = FigureSize { texels: [size.texels[1]; 2], ..size };
    let first = DrawnFigure::new(model, SIDES[0], size, false)?;
    let caption = |side: usize| format!("{}, {side} x {side} local directions", model.name);
    let mut pictures = vec![first.fine_picture("figure-8-8", first.fine(), caption(SIDES[0]))?];
    let mut drawn = vec![first.causes.drawn().to_vec()];
    for side in &SIDES[1..] {
        let (colors, fine) = by_transfer(model, *side, size)?;
        pictures.push(first.fine_picture(&format!("figure-8-{side}"), &fine, caption(*side))?);
        drawn.push(colors);
    }
    let most = &drawn[SIDES.len() - 1];
    for (side, colors) in SIDES.into_iter().zip(&drawn) {
        let of_most = first.causes.apart(most, colors);
        table.push([side.into(), Cell::measured(first.errors(colors)[0]), Cell::measured(of_most)]);
    }
    pictures.push(first.by_rays("figure-8")?);
    let columns = SIDES.map(|side| format!("{side} x {side} directions")).into_iter().chain(["by rays".to_owned()]);
    Ok((table, PictureGrid::new("Figure 8", columns).row("", pictures)))
}
