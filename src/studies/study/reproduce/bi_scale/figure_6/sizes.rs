//! Bytes of the chair for each method, from printed numbers alone.

use super::super::scenes::SCENES;
use super::{StudyError, printed_value};
use crate::report::{Cell, Table};
use crate::transfer::grid::LIGHT_TEXELS;

/// Printed values: clusters of rows, vectors per cluster, wavelets per row.
const CLUSTERS: usize = 32;
const VECTORS: usize = 8;
const WAVELETS: usize = 12;
/// Name of the figure with the wavelets' megabytes.
const PRINTED_WAVELETS: &str = "bi-scale/wavelets-chair";
/// Bytes per wavelet: two for its index, one for its value.
const WAVELET_BYTES: usize = 3;

fn wavelets(bytes: usize) -> Result<f64, StudyError> {
    Ok(1e-6 * (SCENES[2].rows()? * WAVELETS * bytes) as f64)
}

/// Table of every method and layout, with the printed values; the size of clusters is illegible in the scan.
pub(super) fn chair_sizes() -> Result<Table, StudyError> {
    let mut table = Table::of("The chair, from printed numbers", "way layout MB MiB MB_printed");
    let of_print = |what: &str| Ok::<_, StudyError>(SCENES[2].printed(what)?.value);
    let nonzeros = 1e6 * of_print("nonzeros")?;
    let (rows, vectors) = (SCENES[2].rows()? as f64, (CLUSTERS * VECTORS * LIGHT_TEXELS) as f64);
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
    line("dense", "1 byte per value", 1e-6 * rows * LIGHT_TEXELS as f64, Some(of_print("dense")?));
    line("rows", "8 bytes per entry, 4 per row", 1e-6 * (8.0 * nonzeros + 4.0 * rows), None);
    line("rows", "3 bytes per entry, 4 per row", 1e-6 * (3.0 * nonzeros + 4.0 * rows), None);
    line("biclusters", "4 bytes per operation", 4.0 * of_print("operations-after")?, Some(of_print("biclusters")?));
    line("clusters of rows", "4 bytes per number, no means", 4e-6 * (weights + vectors), None);
    line("clusters of rows", "4 bytes per number", 4e-6 * (weights + vectors + means), None);
    line("wavelets", "3 bytes each", wavelets(WAVELET_BYTES)?, Some(printed_value(PRINTED_WAVELETS)?));
    line("wavelets", "6 bytes each", wavelets(2 * WAVELET_BYTES)?, None);
    Ok(table)
}
