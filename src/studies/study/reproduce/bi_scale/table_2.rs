//! Table II on the Stanford bunny, coarsened or refined to the printed vertex counts.

use super::models::{BUNNY, ClusteredModel, LOG2_SAMPLES, ModelVisibility};
use super::scenes::{PrintedScene, SCENES};
use super::{EntryFindings, ModelSize, Shared, StudyError, number, paragraph, solved};
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The Stanford bunny, closed and refined to the printed numbers, with {} x {} local directions of {} x {} visibility \
    samples per light texel. A vertex sees what triangles leave free; without what lies below the plane of its normal there are fewer values by {} %. \
    Algorithm 1 is the paper's, word by word, but for start points and ties, which are not printed: ours leaves fewer operations of all three, and of each about \
    the same share. The scan that was refined has no finer detail.";
const QUESTION: &str = "how the paper's bunnies were made of the scan; whether a vertex sees below the plane of its normal; how the paper draws start points and breaks ties.";

/// Scenes of the table, with our models.
const BUNNIES: [(&PrintedScene, TransferModel); 3] = [
    (&SCENES[0], BUNNY),
    (&SCENES[4], TransferModel::BiScaleBunnyMiddle),
    (&SCENES[5], TransferModel::BiScaleBunnyFine),
];
/// Edge length of reduced models, relative to full ones.
const COARSER: u32 = 4;

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Biclusters of the bunnies",
        "scene vertices nonzeros_M_printed nonzeros_M biclusters rows_of_biclusters columns_of_biclusters \
         operations_left_%_printed operations_left_% MB_printed MB by_rows_3_bytes_MB",
    );
    let coarser = if shared.models == ModelSize::Reduced { COARSER } else { 1 };
    let (mut rows, mut left) = (Vec::new(), Vec::new());
    let mut fewer = f64::NAN;
    for (scene, model) in BUNNIES {
        let mesh = model.mesh(coarser);
        let found = ModelVisibility::new(&mesh, Horizon::Geometry)?.clustered(scene.side)?;
        if model == BUNNY {
            let above = ModelVisibility::new(&mesh, Horizon::Normal)?.matrix(scene.side)?;
            fewer = 100.0 * (1.0 - above.nonzeros() as f64 / found.nonzeros as f64);
        }
        let row = |what: &str, ours| solved(&format!("{what}-{}", scene.id), ours);
        rows.push(row("nonzeros", 1e-6 * found.nonzeros as f64)?);
        rows.push(row("left", found.operations_left())?);
        rows.push(row("biclusters", found.megabytes())?);
        left.push(found.operations_left());
        table.push(line(scene, &found)?);
    }
    rows.push(solved("steady", left[2] / left[0])?);
    let side = SCENES[0].side as f64;
    let samples = f64::from(1_u32 << LOG2_SAMPLES);
    let values = [number(side, 0), number(side, 0), number(samples, 0), number(samples, 0), number(fewer, 1)];
    Ok(EntryFindings::new([paragraph(HOW, values)], rows, [QUESTION], [table]))
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
