//! Bytes of the chair by each method, from printed numbers alone.

use super::super::printed::SCENES;
use super::{Bound, HOST, Method, PaperFigure, PaperRow, Standing};
use crate::report::{Cell, Table};
use crate::transfer::grid::LIGHT_TEXELS;

pub(super) const PLACE: &str = "figure 6";
/// Printed values: clusters of rows, vectors of each, wavelets per row.
const CLUSTERS: usize = 32;
const VECTORS: usize = 8;
const WAVELETS: usize = 12;
/// Printed megabytes of wavelets.
const PRINTED_WAVELETS: f64 = 37.1;
/// Bytes of a wavelet: two for its index, one for its value.
const WAVELET_BYTES: usize = 3;

/// Number of rows of the chair's matrix.
fn chair_rows() -> usize {
    SCENES[2].vertices * SCENES[2].side * SCENES[2].side
}

fn wavelets(bytes: usize) -> f64 {
    1e-6 * (chair_rows() * WAVELETS * bytes) as f64
}

/// Row on the size of wavelets, with a guessed number of bytes that reproduces it.
pub(super) fn wavelet_row() -> PaperRow {
    PaperRow::new(
        "chair: wavelets of all rows, three bytes each",
        (HOST, Method::Equation),
        PaperFigure::printed(PRINTED_WAVELETS, 1, "MB", PLACE),
        (wavelets(WAVELET_BYTES), Standing::Predicted { from: "printed vertices, directions and wavelets" }),
        Bound::Print,
    )
}

/// Table of every method with its layouts, beside the printed values; the size of clusters is illegible in the scan.
pub(super) fn chair_sizes() -> Table {
    let mut table = Table::of("The chair by printed numbers", "way layout MB MiB MB_printed");
    let nonzeros = 1e6 * SCENES[2].nonzeros;
    let (rows, vectors) = (chair_rows() as f64, (CLUSTERS * VECTORS * LIGHT_TEXELS) as f64);
    let (weights, means) = (rows * VECTORS as f64, (CLUSTERS * LIGHT_TEXELS) as f64);
    let mut line = |way: &str, layout: &str, megabytes: f64, printed: Option<f64>| {
        table.push([
            way.into(),
            layout.into(),
            Cell::decimals(megabytes, 1),
            Cell::decimals(1e6 * megabytes / f64::from(1 << 20), 1),
            printed.map_or(Cell::Empty, |printed| Cell::decimals(printed, 1)),
        ]);
    };
    let [_, biclusters] = SCENES[2].megabytes;
    line("dense", "a byte a value", 1e-6 * rows * LIGHT_TEXELS as f64, Some(SCENES[2].megabytes[0]));
    line("rows", "8 bytes an entry, 4 a row", 1e-6 * (8.0 * nonzeros + 4.0 * rows), None);
    line("rows", "3 bytes an entry, 4 a row", 1e-6 * (3.0 * nonzeros + 4.0 * rows), None);
    line("biclusters", "4 bytes an operation", 4.0 * SCENES[2].operations[1], Some(biclusters));
    line("clusters of rows", "4 bytes a number, no means", 4e-6 * (weights + vectors), None);
    line("clusters of rows", "4 bytes a number", 4e-6 * (weights + vectors + means), None);
    line("wavelets", "3 bytes each", wavelets(WAVELET_BYTES), Some(PRINTED_WAVELETS));
    line("wavelets", "6 bytes each", wavelets(2 * WAVELET_BYTES), None);
    table
}
