//! Values of both tables that follow from the sizes alone. The rows are expressions in `src/studies/papers`.

use super::scenes::{PrintedScene, SCENES};
use super::{EntryFindings, Shared, StudyError, number, paragraph};
use crate::report::{Cell, Table};
use crate::transfer::grid::LIGHT_TEXELS;

const HOW: &str = "Nothing is run. Each nonzero value costs two operations. A dense matrix takes {} byte per value, biclusters {} bytes per \
    operation: {} per row, which costs one operation, and {} for a column's place and value, which cost two. A texel has {} bytes. These byte counts \
    were read off the printed sizes, so rows in megabytes are calibrated.";
const QUESTION: &str =
    "why the small bunny's dense matrix is printed larger than its vertices imply, while the other five fit.";
/// Bytes per value of a dense matrix, per row of a bicluster, and per column.
const DENSE: f64 = 1.0;
const PER_ROW: f64 = 4.0;
const PER_COLUMN: f64 = 8.0;
/// Bytes per entry stored by rows: position and value of two and one bytes, or of four bytes each.
const NARROW: f64 = 3.0;
const WIDE: f64 = 8.0;
/// Bytes per texel: three channels.
const TEXEL_BYTES: f64 = 3.0;

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let mut table = Table::of(
        "Tables I and II, from sizes alone",
        "scene vertices local_directions nonzeros_M dense_MB_printed dense_MB bytes_per_operation \
         bytes_per_nonzero_printed rows_of_3_bytes_MB biclusters_of_them_% rows_of_8_bytes_MB biclusters_of_these_%",
    );
    for scene in &SCENES {
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
    let bytes = [DENSE, PER_ROW, PER_ROW, PER_COLUMN, TEXEL_BYTES].map(|bytes| number(bytes, 0));
    Ok(EntryFindings::new([paragraph(HOW, bytes)], [], [QUESTION], [table]))
}

impl PrintedScene {
    /// Megabytes of storage by rows with `bytes` bytes per entry, and four per row.
    fn sparse_megabytes(&self, bytes: f64) -> Result<f64, StudyError> {
        Ok(bytes * self.printed("nonzeros")?.value + 4e-6 * self.rows()? as f64)
    }

    fn dense_megabytes(&self) -> Result<f64, StudyError> {
        Ok(1e-6 * DENSE * (self.rows()? * LIGHT_TEXELS) as f64)
    }
}
