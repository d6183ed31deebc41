//! Values of sections III and IV and of both tables that follow from sizes.

use super::scenes::{PrintedScene, SCENES};
use super::{Contradiction, EntryFindings, HOST, Method, PaperRow, Prose, Standing, StudyError, number, paper_row};
use crate::report::{Cell, Table};
use crate::transfer::grid::LIGHT_TEXELS;

const HOW: &str = "Nothing is run. Operations are two per value other than zero; a dense matrix takes {} byte per value, biclusters {} bytes per operation: \
    {} per row, and {} for place and value of a column, which cost one operation and two; a texel has {} bytes. These bytes were read off the \
    printed sizes, so that rows on megabytes are calibrated.";
const QUESTION: &str =
    "why the small bunny's dense matrix is printed larger than its vertices make it, where the other five fit.";
/// Bytes per value of a dense matrix, per row of a bicluster, and per column.
const DENSE: f64 = 1.0;
const PER_ROW: f64 = 4.0;
const PER_COLUMN: f64 = 8.0;
/// Bytes of an entry stored by rows: position and value of two and one bytes, or of four each.
const NARROW: f64 = 3.0;
const WIDE: f64 = 8.0;
/// Texels along an edge of a patch, view directions along an edge, and bytes of a texel: three channels.
const PATCHES: [usize; 2] = [64, 32];
const VIEWS: usize = 12;
const TEXEL_BYTES: usize = 3;
const NONZEROS: &str = "printed non-zeros";
const OPERATIONS: &str = "printed operations";
const BYTES: &str = "these megabytes, which chose the bytes per value";

pub(in crate::study::reproduce) fn findings() -> Result<EntryFindings, StudyError> {
    let example = (15_000 * 64 * LIGHT_TEXELS) as f64;
    let mut rows = vec![equation("bi-scale/example", (1e-9 * example, Standing::Counted))?];
    let mut table = Table::of(
        "Tables I and II, by sizes alone",
        "scene vertices local_directions nonzeros_M dense_MB_printed dense_MB bytes_per_operation \
         bytes_per_nonzero_printed rows_of_3_bytes_MB biclusters_of_them_% rows_of_8_bytes_MB biclusters_of_these_%",
    );
    for scene in &SCENES {
        rows.extend(scene_rows(scene)?);
        rows.extend(texture_row(scene)?);
        let of_print = |what: &str| scene.printed(what);
        let (biclusters, nonzeros) = (of_print("biclusters")?.value, of_print("nonzeros")?);
        let [narrow, wide] = [scene.sparse_megabytes(NARROW)?, scene.sparse_megabytes(WIDE)?];
        table.push([
            scene.name.into(),
            scene.vertices()?.into(),
            (scene.side * scene.side).into(),
            nonzeros.cell(),
            of_print("dense")?.cell(),
            Cell::decimals(scene.dense_megabytes()?, 0),
            Cell::measured(biclusters / of_print("operations-after")?.value),
            Cell::measured(biclusters / nonzeros.value),
            Cell::decimals(narrow, 1),
            Cell::decimals(100.0 * biclusters / narrow, 0),
            Cell::decimals(wide, 1),
            Cell::decimals(100.0 * biclusters / wide, 0),
        ]);
    }
    rows.extend(range_rows()?);
    let bytes = [DENSE, PER_ROW, PER_ROW, PER_COLUMN, TEXEL_BYTES as f64].map(|bytes| number(bytes, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, bytes)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    })
}

fn equation(id: &str, ours: (f64, Standing)) -> Result<PaperRow, StudyError> {
    paper_row(id, (HOST, Method::Equation), ours)
}

/// Rows on the remaining computation, from minimum to maximum: the conclusion's range, which the tables contradict.
fn range_rows() -> Result<[PaperRow; 2], StudyError> {
    let left: Vec<f64> = SCENES.iter().map(PrintedScene::operations_left).collect::<Result<_, _>>()?;
    let row = |id: &str, found: f64| {
        let row = equation(id, (found, Standing::Predicted { from: OPERATIONS }))?;
        let contradiction = Contradiction::between(
            &row.target,
            found,
            "operations of biclusters over those of the matrix, tables 1 and 2",
        );
        Ok::<_, StudyError>(row.contradicted(contradiction))
    };
    Ok([
        row("bi-scale/left-least", left.iter().copied().fold(f64::INFINITY, f64::min))?,
        row("bi-scale/left-largest", left.iter().copied().fold(0.0, f64::max))?,
    ])
}

impl PrintedScene {
    /// Percentage of the operations that biclusters leave, from the printed operations.
    fn operations_left(&self) -> Result<f64, StudyError> {
        Ok(100.0 * self.printed("operations-after")?.value / self.printed("operations")?.value)
    }

    /// Megabytes of storage by rows with `bytes` bytes per entry, and four per row.
    fn sparse_megabytes(&self, bytes: f64) -> Result<f64, StudyError> {
        Ok(bytes * self.printed("nonzeros")?.value + 4e-6 * self.rows()? as f64)
    }

    fn dense_megabytes(&self) -> Result<f64, StudyError> {
        Ok(1e-6 * DENSE * (self.rows()? * LIGHT_TEXELS) as f64)
    }
}

/// Row on the size of bidirectional textures; the text states the sizes of patches for the temple alone. The formula
/// gives three of the four sizes to the digit, and contradicts the other one.
fn texture_row(scene: &PrintedScene) -> Result<Option<PaperRow>, StudyError> {
    let Some(counts) = scene.textures else { return Ok(None) };
    let texels: usize = counts.into_iter().zip(PATCHES).map(|(count, side)| count * side * side).sum();
    let megabytes = 1e-6 * (TEXEL_BYTES * texels * VIEWS * VIEWS * scene.side * scene.side) as f64;
    let row = equation(&scene.figure("textures"), (megabytes, Standing::Calibrated { on: BYTES }))?;
    let how = "three bytes per texel, view and light direction, which is exact for the other scenes";
    let contradiction = Contradiction::between(&row.target, megabytes, how);
    Ok(Some(row.contradicted(contradiction)))
}

/// Rows of a scene. Operations left and the biclusters' megabytes have rows where a model of ours is computed.
fn scene_rows(scene: &PrintedScene) -> Result<Vec<PaperRow>, StudyError> {
    let row = |what: &str, ours| equation(&scene.figure(what), ours);
    let predicted = |value: f64, from: &'static str| (value, Standing::Predicted { from });
    let calibrated = |value: f64| (value, Standing::Calibrated { on: BYTES });
    let (dense, biclusters) = (scene.printed("dense")?.value, scene.printed("biclusters")?.value);
    let mut rows = vec![
        row("operations", predicted(2.0 * scene.printed("nonzeros")?.value, NONZEROS))?,
        row("dense", calibrated(scene.dense_megabytes()?))?,
        row("bytes-left", predicted(100.0 * biclusters / dense, "printed sizes"))?,
    ];
    if scene.textures.is_none() {
        rows.push(row("left", predicted(scene.operations_left()?, OPERATIONS))?);
    }
    if scene.id != SCENES[0].id {
        rows.push(row("biclusters", calibrated(PER_ROW * scene.printed("operations-after")?.value))?);
    }
    Ok(rows)
}
