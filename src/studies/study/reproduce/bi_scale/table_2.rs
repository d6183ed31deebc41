//! Table II on the Stanford bunny, refined to the printed vertex counts.

use super::models::{BUNNY, ClusteredModel, LOG2_SAMPLES, ModelVisibility};
use super::scenes::{BUNNIES, PrintedScene};
use super::{EntryFindings, ModelSize, PaperRow, Prose, Shared, StudyError, number, solved};
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The Stanford bunny, closed and refined to the printed numbers, with {} x {} local directions of {} x {} visibility \
    samples per light texel. A vertex sees what triangles leave free; without what lies below the plane of its normal there are fewer values by {} %. \
    Which share of operations is left depends on how smooth a model is: the scan that was refined has no finer detail. With printed sizes of models \
    the two larger ones are computed too.";
const QUESTION: &str = "how the paper's bunnies were made of the scan; whether a vertex sees below the plane of its normal; how the paper draws start points and breaks ties.";
const MODELS: [TransferModel; 3] = [BUNNY, TransferModel::BiScaleBunnyMiddle, TransferModel::BiScaleBunnyFine];

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Biclusters of the bunnies",
        "scene vertices nonzeros_M_printed nonzeros_M biclusters rows_of_biclusters columns_of_biclusters \
         operations_left_%_printed operations_left_% MB_printed MB by_rows_3_bytes_MB",
    );
    let computed = if shared.models == ModelSize::Reduced { 1 } else { BUNNIES.len() };
    let mut fewer = 0.0;
    for (at, (scene, model)) in BUNNIES.into_iter().zip(MODELS).take(computed).enumerate() {
        let larger;
        let found = if at == 0 {
            let found = shared.get::<ClusteredModel>(BUNNY)?;
            let above = ModelVisibility::new(&model.mesh(1), Horizon::Normal)?.matrix(scene.side)?;
            fewer = 100.0 * (1.0 - above.nonzeros() as f64 / found.nonzeros as f64);
            found
        } else {
            larger = ModelVisibility::new(&model.mesh(1), Horizon::Geometry)?.clustered(scene.side)?;
            &larger
        };
        table.push(line(scene, found)?);
    }
    let side = BUNNIES[0].side as f64;
    let samples = f64::from(1_u32 << LOG2_SAMPLES);
    let values = [number(side, 0), number(side, 0), number(samples, 0), number(samples, 0), number(fewer, 1)];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, values)],
        rows: rows(shared.get::<ClusteredModel>(BUNNY)?)?,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    })
}

/// Rows of the small bunny. The rows of the larger ones are those of sizes; what full size gives stands in the table.
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
