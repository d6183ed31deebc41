//! Figure 6: a chair whose biclusters lose nothing, and the bytes that the paper's other ways to store transfer take.

use super::models::ModelVisibility;
use super::scenes::SCENES;
use super::{
    EntryFindings, HOST, ModelSize, PaperRow, RunResult, Shared, StudyError, number, paragraph, printed_value, solved,
};
use crate::bi_scale::bicluster::{SEED, bicluster};
use crate::bi_scale::matrix::SparseMatrix;
use crate::report::{Cell, Table};
use crate::scene::built::flat_models::FlatModel;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::visibility::Horizon;

const HOW: &str = "Figure 6 has a chair with {} vertices that is not at hand; ours is made by code and has {}. Its biclusters are added up again, \
    and the sum is held against the rows of its transfer. The bytes of other ways to store transfer follow from printed numbers.";
const CAPTIONS: &str = "The text calls (c) the picture of biclusters and (d) the reference. By the captions these are clusters of rows and wavelets, biclusters \
    and the reference are (a) and (b), and only so what the text says of them makes sense.";
const QUESTION: &str =
    "the chair, its light and camera; whether clusters had means, and their size, which the scan has lost.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let coarser = match shared.models {
        ModelSize::Reduced => 4,
        ModelSize::Printed => 1,
    };
    let seen = ModelVisibility::new(&FlatModel::Chair.model(coarser).mesh, Horizon::Normal)?;
    let vertices = [SCENES[2].vertices()?, seen.vertices.len()].map(|count| number(count as f64, 0));
    Ok(EntryFindings::new(
        [paragraph(HOW, vertices), CAPTIONS.into()],
        [lossless(&seen.matrix(SCENES[2].side)?)?],
        [QUESTION],
        [chair_sizes()?],
    ))
}

/// Row for the share of a matrix's rows that its biclusters give back.
fn lossless(matrix: &SparseMatrix) -> Result<PaperRow, StudyError> {
    let biclusters = bicluster(matrix, SEED, &mut |_| ()).on(HOST)?;
    let sum = biclusters.sum().on(HOST)?;
    let given_back = (0..matrix.rows()).filter(|&row| matrix.row(row) == sum.row(row)).count();
    let share = 100.0 * given_back as f64 / matrix.rows() as f64;
    Ok(solved("lossless", share)?.confined([100.0; 2], "Algorithm 1 moves values, and rounds none"))
}

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
fn chair_sizes() -> Result<Table, StudyError> {
    let mut table = Table::of("The chair by printed numbers", "way layout MB MiB MB_printed");
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
    line("dense", "a byte a value", 1e-6 * rows * LIGHT_TEXELS as f64, Some(of_print("dense")?));
    line("rows", "8 bytes an entry, 4 a row", 1e-6 * (8.0 * nonzeros + 4.0 * rows), None);
    line("rows", "3 bytes an entry, 4 a row", 1e-6 * (3.0 * nonzeros + 4.0 * rows), None);
    line("biclusters", "4 bytes an operation", 4.0 * of_print("operations-after")?, Some(of_print("biclusters")?));
    line("clusters of rows", "4 bytes a number, no means", 4e-6 * (weights + vectors), None);
    line("clusters of rows", "4 bytes a number", 4e-6 * (weights + vectors + means), None);
    line("wavelets", "3 bytes each", wavelets(WAVELET_BYTES)?, Some(printed_value(PRINTED_WAVELETS)?));
    line("wavelets", "6 bytes each", wavelets(2 * WAVELET_BYTES)?, None);
    Ok(table)
}
