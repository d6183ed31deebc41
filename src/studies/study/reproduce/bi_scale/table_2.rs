//! Table II on the Stanford bunny, refined to the smallest of the printed vertex counts.

use super::models::{BUNNY, ClusteredModel, LOG2_SAMPLES, ModelVisibility};
use super::scenes::{PrintedScene, SCENES};
use super::{EntryFindings, PaperRow, Shared, StudyError, number, paragraph, solved};
use crate::report::{Cell, Table};
use crate::transfer::visibility::Horizon;

const HOW: &str = "The Stanford bunny, closed and refined to the printed numbers, with {} x {} local directions of {} x {} visibility \
    samples per light texel. A vertex sees what triangles leave free; without what lies below the plane of its normal there are fewer values by {} %. \
    Which share of operations is left depends on how smooth a model is: the scan that was refined has no finer detail.";
const QUESTION: &str = "how the paper's bunnies were made of the scan; whether a vertex sees below the plane of its normal; how the paper draws start points and breaks ties.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Biclusters of the bunnies",
        "scene vertices nonzeros_M_printed nonzeros_M biclusters rows_of_biclusters columns_of_biclusters \
         operations_left_%_printed operations_left_% MB_printed MB by_rows_3_bytes_MB",
    );
    let (scene, found) = (&SCENES[0], shared.get::<ClusteredModel>(BUNNY)?);
    let above = ModelVisibility::new(&BUNNY.mesh(1), Horizon::Normal)?.matrix(scene.side)?;
    let fewer = 100.0 * (1.0 - above.nonzeros() as f64 / found.nonzeros as f64);
    table.push(line(scene, found)?);
    let side = scene.side as f64;
    let samples = f64::from(1_u32 << LOG2_SAMPLES);
    let values = [number(side, 0), number(side, 0), number(samples, 0), number(samples, 0), number(fewer, 1)];
    Ok(EntryFindings::new([paragraph(HOW, values)], rows(found)?, [QUESTION], [table]))
}

/// Rows of the small bunny. The rows of the larger ones are those of sizes.
fn rows(found: &ClusteredModel) -> Result<Vec<PaperRow>, StudyError> {
    Ok(vec![
        solved("nonzeros-bunny", 1e-6 * found.nonzeros as f64)?,
        solved("left-bunny", found.operations_left())?,
        solved("biclusters-bunny", found.megabytes())?,
    ])
}

fn line(scene: &PrintedScene, found: &ClusteredModel) -> Result<Vec<Cell>, StudyError> {
    let printed = |what: &str| Ok::<_, StudyError>(scene.printed(what)?.cell());
    Ok(vec![
        scene.name.into(),
        scene.vertices()?.into(),
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
