//! Table II: the Stanford bunny, coarsened or refined to the three printed vertex counts.

use super::models::{
    CARD, ClusteredModel, LOG2_SAMPLES, ModelVisibility, PrintedScene, SCENES, display, of_bunny, picture,
};
use super::{EntryFindings, PaperRow, Shared, StudyError, drawn, paragraph, solved};
use crate::elementary::ln;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel::{self, BiScaleBunny, BiScaleBunnyFine, BiScaleBunnyMiddle};
use crate::transfer::visibility::Horizon;

const HOW: &str = "The bunnies are the Stanford bunny's scan with its holes filled, coarsened or refined to the printed numbers, with {} x {} local \
    directions of {} x {} visibility samples per light texel. A vertex sees whatever no triangle blocks; without the directions below the plane of \
    its normal, the smallest bunny has {} % fewer values. The emulated card draws views in {} x {} pixels.";
const QUESTION: &str = "how the paper's bunnies were made from the scan; whether a vertex sees below the plane of its \
    normal; how the paper draws start points and breaks ties; how large the models appear in the pictures.";
/// Scenes by size: index in [`SCENES`], and model.
const BUNNIES: [(usize, TransferModel); 3] = [(0, BiScaleBunny), (4, BiScaleBunnyMiddle), (5, BiScaleBunnyFine)];

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let coarser = shared.models.pick(1, 6);
    let mut table = Table::of(
        "Biclusters of the bunnies",
        "scene vertices nonzeros_M_printed nonzeros_M biclusters rows_of_biclusters columns_of_biclusters \
         operations_left_%_printed operations_left_% MB_printed MB by_rows_3_bytes_MB",
    );
    let (mut rows, mut ends, mut fewer) = (Vec::new(), Vec::new(), f64::NAN);
    for (at, model) in BUNNIES {
        let (scene, mesh) = (&SCENES[at], model.mesh(coarser));
        let seen = ModelVisibility::new(&mesh, Horizon::Geometry)?;
        let (vertices, found) = (seen.vertices.len(), seen.clustered(scene.side)?);
        if at == 0 {
            let above = ModelVisibility::new(&mesh, Horizon::Normal)?.matrix(scene.side)?;
            fewer = 100.0 * (1.0 - above.nonzeros() as f64 / found.nonzeros as f64);
        } else {
            let run = display((&seen.mesh, &seen.vertices), scene.side, of_bunny(picture(shared.models))?)?;
            rows.push(drawn(&format!("{}-2", scene.figure("view")), CARD, run.time.per_second())?);
        }
        rows.extend(scene_rows(scene, &found)?);
        ends.push((vertices as f64, found.biclusters.cost() as f64, found.operations_left()));
        table.push(line(scene, vertices, &found)?);
    }
    if let [first, .., last] = ends[..] {
        rows.push(solved("left-steady", last.2 / first.2)?);
        rows.push(solved("operations-power", ln(last.1 / first.1) / ln(last.0 / first.0))?);
    }
    let (side, samples, [width, height]) = (SCENES[0].side, 1_u32 << LOG2_SAMPLES, picture(shared.models));
    let how = paragraph(HOW, &[&side, &side, &samples, &samples, &(fewer, 1), &width, &height]);
    Ok(EntryFindings::new([how], rows, [QUESTION], [table]))
}

fn scene_rows(scene: &PrintedScene, found: &ClusteredModel) -> Result<[PaperRow; 3], StudyError> {
    let row = |what: &str, ours| solved(&format!("{what}-{}", scene.id), ours);
    Ok([
        row("nonzeros", 1e-6 * found.nonzeros as f64)?,
        row("left", found.operations_left())?,
        row("biclusters", found.megabytes())?,
    ])
}

fn line(scene: &PrintedScene, vertices: usize, found: &ClusteredModel) -> Result<Vec<Cell>, StudyError> {
    let printed = |what: &str| Ok::<_, StudyError>(scene.printed(what)?.cell());
    Ok(vec![
        scene.name.into(),
        vertices.into(),
        printed("nonzeros")?,
        Cell::decimals(1e-6 * found.nonzeros as f64, 2),
        found.biclusters.len().into(),
        found.biclusters.row_entries().into(),
        found.biclusters.column_entries().into(),
        printed("left")?,
        Cell::decimals(found.operations_left(), 1),
        printed("biclusters")?,
        Cell::decimals(found.megabytes(), 1),
        Cell::decimals(3e-6 * found.nonzeros as f64, 1),
    ])
}
