//! Table II on stand-ins: biclusters of models of as many vertices as printed.

use super::printed::{BUNNIES, PrintedScene};
use super::stand_in::{LOG2_SAMPLES, StandIn};
use super::{
    Bound, EntryFindings, HOST, Method, ModelSize, PaperFigure, PaperRow, Prose, ReproduceError, Shared, Standing,
    failed, number,
};
use crate::prt::all_frequency::visibility::Horizon;
use crate::prt::bi_scale::bicluster::{BiclusterOptions, Biclustering, bicluster};
use crate::prt::bi_scale::matrix::SparseMatrix;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;

const HOW: &str = "The paper's bunnies are not at hand: ours are smooth closed bodies with as many vertices, and {} x {} local directions of {} x {} visibility \
    samples per light texel. A vertex sees what triangles leave free; without what lies below the plane of its normal there are fewer values by {} %. \
    Which share of operations is left depends on how smooth a model is, which is why it is judged and not explained. With printed sizes of models \
    the two larger ones are computed too.";
const QUESTION: &str = "the models; whether a vertex sees below the plane of its normal; how the paper draws start points and breaks ties.";
const MODELS: [TransferModel; 3] =
    [TransferModel::BiScaleBunny, TransferModel::BiScaleBunnyMiddle, TransferModel::BiScaleBunnyFine];

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut table = Table::of(
        "Biclusters of the stand-ins",
        "scene vertices nonzeros_M_printed nonzeros_M biclusters rows_of_biclusters columns_of_biclusters \
         operations_left_%_printed operations_left_% MB_printed MB by_rows_3_bytes_MB",
    );
    let computed = if shared.models == ModelSize::Reduced { 1 } else { BUNNIES.len() };
    let (mut rows, mut fewer) = (Vec::new(), 0.0);
    for (scene, model) in BUNNIES.into_iter().zip(MODELS).take(computed) {
        let matrix = StandIn::new(model.mesh(1), scene.side, Horizon::Geometry)?.matrix;
        if rows.is_empty() {
            let above = StandIn::new(model.mesh(1), scene.side, Horizon::Normal)?.matrix;
            fewer = 100.0 * (1.0 - above.nonzeros() as f64 / matrix.nonzeros() as f64);
        }
        let found =
            bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).map_err(|error| failed(HOST)(&error))?;
        rows.extend(scene_rows(scene, &matrix, &found));
        table.push(line(scene, &matrix, &found));
    }
    let side = BUNNIES[0].side as f64;
    let samples = f64::from(1_u32 << LOG2_SAMPLES);
    let values = [number(side, 0), number(side, 0), number(samples, 0), number(samples, 0), number(fewer, 1)];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, values)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    })
}

/// Bytes of biclusters: four per row, eight per column.
fn megabytes(found: &Biclustering) -> f64 {
    4e-6 * (found.row_entries() + 2 * found.column_entries()) as f64
}

fn operations_left(matrix: &SparseMatrix, found: &Biclustering) -> f64 {
    100.0 * found.cost() as f64 / (2 * matrix.nonzeros()) as f64
}

fn scene_rows(scene: &PrintedScene, matrix: &SparseMatrix, found: &Biclustering) -> [PaperRow; 3] {
    let row = |what: &str, value, unit, ours| {
        let target = PaperFigure::printed(value, 1, unit, "table 2");
        let name = format!("{}: {what}", scene.name);
        PaperRow::new(name, (HOST, Method::Solver), target, (ours, Standing::Counted), Bound::PREDICTION)
    };
    [
        row("values other than 0", scene.nonzeros, "million", 1e-6 * matrix.nonzeros() as f64),
        row("operations left", scene.operations_left, "%", operations_left(matrix, found)),
        row("biclusters", scene.megabytes[1], "MB", megabytes(found)),
    ]
}

fn line(scene: &PrintedScene, matrix: &SparseMatrix, found: &Biclustering) -> Vec<Cell> {
    vec![
        scene.name.into(),
        scene.vertices.into(),
        Cell::decimals(scene.nonzeros, 1),
        Cell::decimals(1e-6 * matrix.nonzeros() as f64, 2),
        found.len().into(),
        found.row_entries().into(),
        found.column_entries().into(),
        Cell::decimals(scene.operations_left, 1),
        Cell::decimals(operations_left(matrix, found), 1),
        Cell::decimals(scene.megabytes[1], 1),
        Cell::decimals(megabytes(found), 1),
        Cell::decimals(3e-6 * matrix.nonzeros() as f64, 1),
    ]
}
