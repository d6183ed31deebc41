//! Input and output of the verbs of `crossbar bi-scale`: matrices, biclusters, models.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};

use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::file::{BiScaleFile, load_bi_scale};
use crate::bi_scale::matrix::SparseMatrix;
use crate::cli::Problem;
use crate::cli::words::counted;
use crate::io::load_matrix_market;
use crate::options::number;
use crate::report::{Cell, Table};

/// An angle from 0 to 180 degrees.
pub(super) fn angle(text: &str) -> Result<f64, String> {
    let degrees = number::not_negative(text)?;
    if degrees <= 180.0 {
        return Ok(degrees);
    }
    Err(format!("expected an angle from 0 to 180 degrees, found `{text}`"))
}

/// Reads a Matrix Market file, or a `.npz` file of bi-scale transfer, by the extension.
pub(super) fn load(path: &Path) -> miette::Result<BiScaleFile> {
    let ends = |with: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(with));
    if !ends("mtx") {
        let help = "give a Matrix Market file (.mtx), or a .npz file that `crossbar bi-scale` wrote";
        let file = load_bi_scale(path).map_err(|error| if ends("npz") { error } else { error.with_help(help) })?;
        require_size(path, file.biclusters.as_ref().map_or([0; 2], Biclustering::matrix_size))?;
        return Ok(file);
    }
    let coordinates = load_matrix_market(path)?;
    require_size(path, [coordinates.rows, coordinates.columns])?;
    let matrix = SparseMatrix::from_coordinates(&coordinates)
        .map_err(|reason| Problem::usage(format!("{}: {reason}", path.display()), "use another matrix"))?;
    Ok(BiScaleFile { meaning: None, matrix: Some(matrix), biclusters: None })
}

/// Rejects a matrix with more rows and columns than any model has, even if few of them have entries.
fn require_size(path: &Path, [rows, columns]: [usize; 2]) -> Result<(), Problem> {
    /// A row or a column needs some 32 bytes.
    const MOST: usize = 1 << 28;
    if rows.saturating_add(columns) <= MOST {
        return Ok(());
    }
    let what = format!("{}: expected at most {MOST} rows and columns, found {rows} x {columns}", path.display());
    Err(Problem::usage(what, "use a smaller matrix"))
}

/// The unit of values, in words.
pub(super) fn unit(fraction_bits: u32) -> String {
    if fraction_bits == 0 { "whole numbers".to_owned() } else { format!("multiples of 2^-{fraction_bits}") }
}

/// Values with their counts: of a matrix, or of biclusters, in their columns times their rows.
pub(super) fn value_counts(file: &BiScaleFile) -> Vec<(f64, u64)> {
    let mut counts: BTreeMap<i32, u64> = BTreeMap::new();
    if let Some(matrix) = &file.matrix {
        let entries = (0..matrix.rows()).flat_map(|row| matrix.row(row));
        entries.for_each(|entry| *counts.entry(entry.value).or_insert(0) += 1);
        return counts.into_iter().map(|(value, count)| (matrix.value(value), count)).collect();
    }
    let Some(biclusters) = &file.biclusters else { return Vec::new() };
    for number in 0..biclusters.len() {
        for entry in biclusters.columns_of(number) {
            *counts.entry(entry.value).or_insert(0) += biclusters.rows_of(number).len() as u64;
        }
    }
    counts.into_iter().map(|(value, count)| (biclusters.value(value), count)).collect()
}

/// Table of values with their counts; a limited number of rows.
pub(super) fn histogram(values: &[(f64, u64)]) -> Table {
    const MOST: usize = 17;
    let shown = values.iter().take(MOST).map(|&(value, count)| [Cell::measured(value), count.into()]);
    let mut table = Table::new("Values", &["value", "count"]).with(shown);
    if let Some(more @ [_, ..]) = values.get(MOST..) {
        let count: u64 = more.iter().map(|(_, count)| count).sum();
        table.push([format!("{} more", counted(more.len())).into(), count.into()]);
    }
    table
}

pub(super) fn values_document(values: &[(f64, u64)]) -> Vec<Value> {
    values.iter().map(|(value, count)| json!({ "value": value, "count": count })).collect()
}
