//! Values of sections III and IV and of both tables that follow from sizes.

use super::printed::{PrintedScene, SCENES};
use super::{Bound, EntryFindings, HOST, Method, PaperFigure, PaperRow, Prose, Standing, number};
use crate::report::{Cell, Table};
use crate::transfer::grid::LIGHT_TEXELS;

const HOW: &str = "Nothing is run. Operations are two per value other than zero; a dense matrix takes {} byte per value, biclusters {} bytes per operation: \
    {} per row, and {} for place and value of a column, which cost one operation and two.";
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
const VERTICES: &str = "printed vertices and local directions";
/// The patch of Figure 3.
const PATCH: f64 = 0.69;

pub(in crate::study::reproduce) fn findings() -> EntryFindings {
    let example = (15_000 * 64 * LIGHT_TEXELS) as f64;
    let printed = PaperFigure::printed;
    // A vertex that sees all of its hemisphere sends each of half the texels to one of its directions.
    let open = 100.0 * 0.5 / 64.0;
    let mut rows = vec![
        PaperRow::new(
            "values of T with 15,000 vertices",
            (HOST, Method::Equation),
            printed(6.0, 0, "thousand millions", "section 3"),
            (1e-9 * example, Standing::Counted),
            Bound::PREDICTION,
        ),
        PaperRow::new(
            "values other than 0 where nothing is hidden",
            (HOST, Method::Equation),
            printed(PATCH, 2, "%", "section 4"),
            (open, Standing::Counted),
            Bound::PREDICTION,
        ),
    ];
    let mut table = Table::of(
        "Tables I and II, by sizes alone",
        "scene vertices local_directions nonzeros_M dense_MB_printed dense_MB bytes_per_operation \
         bytes_per_nonzero_printed rows_of_3_bytes_MB biclusters_of_them_% rows_of_8_bytes_MB biclusters_of_these_%",
    );
    for scene in &SCENES {
        rows.extend(scene_rows(scene));
        rows.extend(texture_row(scene));
        let [_, after] = scene.operations;
        let [narrow, wide] = [NARROW, WIDE].map(|bytes| scene.sparse_megabytes(bytes));
        table.push([
            scene.name.into(),
            scene.vertices.into(),
            (scene.side * scene.side).into(),
            Cell::decimals(scene.nonzeros, 1),
            Cell::decimals(scene.megabytes[0], 0),
            Cell::decimals(scene.dense_megabytes(), 0),
            Cell::measured(scene.megabytes[1] / after),
            Cell::measured(scene.megabytes[1] / scene.nonzeros),
            Cell::decimals(narrow, 1),
            Cell::decimals(100.0 * scene.megabytes[1] / narrow, 0),
            Cell::decimals(wide, 1),
            Cell::decimals(100.0 * scene.megabytes[1] / wide, 0),
        ]);
    }
    rows.extend(range_rows());
    EntryFindings {
        text: vec![Prose::new(HOW, [DENSE, PER_ROW, PER_ROW, PER_COLUMN].map(|bytes| number(bytes, 0)))],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    }
}

/// Rows on the remaining computation, from minimum to maximum: the conclusion's range against the tables.
fn range_rows() -> [PaperRow; 2] {
    let left = || SCENES.iter().map(|scene| 100.0 * scene.operations[1] / scene.operations[0]);
    let row = |what: &str, printed, found| {
        let target = PaperFigure::printed(printed, 0, "%", "section 7");
        let standing = Standing::Predicted { from: OPERATIONS };
        PaperRow::new(what, (HOST, Method::Equation), target, (found, standing), Bound::PREDICTION)
    };
    [
        row("least share of operations left", 5.0, left().fold(f64::INFINITY, f64::min)),
        row("largest share of operations left", 30.0, left().fold(0.0, f64::max)),
    ]
}

impl PrintedScene {
    /// Megabytes of storage by rows with `bytes` bytes per entry, and four per row.
    fn sparse_megabytes(&self, bytes: f64) -> f64 {
        bytes * self.nonzeros + 4e-6 * (self.vertices * self.side * self.side) as f64
    }

    fn dense_megabytes(&self) -> f64 {
        1e-6 * DENSE * (self.vertices * self.side * self.side * LIGHT_TEXELS) as f64
    }
}

/// Row on the size of bidirectional textures; the text states the sizes of patches for the temple alone.
fn texture_row(scene: &PrintedScene) -> Option<PaperRow> {
    let (counts, megabytes) = scene.textures?;
    let texels: usize = counts.into_iter().zip(PATCHES).map(|(count, side)| count * side * side).sum();
    let bytes = TEXEL_BYTES * texels * VIEWS * VIEWS * scene.side * scene.side;
    Some(PaperRow::new(
        format!("{}: bidirectional textures", scene.name),
        (HOST, Method::Equation),
        PaperFigure::printed(megabytes, 1, "MB", scene.place),
        (1e-6 * bytes as f64, Standing::Predicted { from: "printed numbers of textures and directions" }),
        Bound::Print,
    ))
}

fn scene_rows(scene: &PrintedScene) -> [PaperRow; 5] {
    let row = |what: &str, (value, decimals, unit), found, from, bound| {
        let target = PaperFigure::printed(value, decimals, unit, scene.place);
        let name = format!("{}: {what}", scene.name);
        PaperRow::new(name, (HOST, Method::Equation), target, (found, Standing::Predicted { from }), bound)
    };
    let ([before, after], [dense, biclusters]) = (scene.operations, scene.megabytes);
    let (left, decimals) = scene.megabytes_left;
    [
        row("operations", (before, 1, "million"), 2.0 * scene.nonzeros, NONZEROS, Bound::PREDICTION),
        row("operations left", (scene.operations_left, 1, "%"), 100.0 * after / before, OPERATIONS, Bound::PREDICTION),
        row("dense matrix", (dense, 0, "MB"), scene.dense_megabytes(), VERTICES, Bound::PREDICTION),
        row("biclusters", (biclusters, 1, "MB"), PER_ROW * after, OPERATIONS, Bound::PREDICTION),
        row("bytes left", (left, decimals, "%"), 100.0 * biclusters / dense, "printed sizes", Bound::PREDICTION),
    ]
}
