//! Files of bi-scale transfer: a sparse matrix in the form of SciPy's `csr_array`, its biclusters, or both. docs/npz.md
//! describes their contents.

use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::bi_scale::bicluster::{Bicluster, Biclustering};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::{MOST_FRACTION_BITS, MatrixEntry, SparseMatrix};
use crate::error::InputError;
use crate::io::{NpzReader, NpzWriter, WriteError, write_file};
use crate::transfer::file::kind::{begin_reading, begin_writing, bytes_of, contradiction};
use crate::transfer::file::{MeshDigest, PrtKind, front};
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::visibility::Horizon;

/// The meaning of the rows of a transfer matrix.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiScaleMeaning {
    /// The mesh of the vertices.
    pub mesh: MeshDigest,
    /// Local directions along an edge of the square: M = side^2 per vertex.
    pub side: u32,
    /// The horizon that limits the visibility of a vertex.
    pub horizon: Horizon,
}

/// A sparse matrix, its biclusters, or both: the transfer of a mesh, or any other matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct BiScaleFile {
    /// The meaning of the rows, if the matrix is transfer.
    pub meaning: Option<BiScaleMeaning>,
    /// The matrix.
    pub matrix: Option<SparseMatrix>,
    /// The matrix as a sum of biclusters.
    pub biclusters: Option<Biclustering>,
}

#[derive(Serialize, Deserialize)]
struct MatrixMetadata {
    meaning: Option<BiScaleMeaning>,
    shape: Shape,
    /// Entries of the matrix.
    entries: Option<usize>,
    biclusters: Option<BiclusterSizes>,
}

/// Number of biclusters, and total numbers of their rows and columns.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct BiclusterSizes {
    count: usize,
    rows: usize,
    columns: usize,
}

/// Reads a file.
pub fn load_bi_scale(path: &Path) -> Result<BiScaleFile, InputError> {
    parse_bi_scale(&bytes_of(path)?, path)
}

/// Reads a file from bytes; `name` identifies it in messages.
pub fn parse_bi_scale(bytes: &[u8], name: &Path) -> Result<BiScaleFile, InputError> {
    let (mut arrays, metadata) = begin_reading(bytes, name, PrtKind::BiScale)?;
    let MatrixMetadata { meaning, shape, entries, biclusters } = metadata;
    for (field, found, expected) in [
        ("rows", shape.rows, 1..=u32::MAX as usize),
        ("columns", shape.columns, 1..=u32::MAX as usize),
        ("bits behind the point", shape.fraction_bits as usize, 0..=MOST_FRACTION_BITS as usize),
    ] {
        if !expected.contains(&found) {
            let expected = format!("{} to {}", expected.start(), expected.end());
            return Err(arrays.refuse(field, expected, found.to_string()));
        }
    }
    let matrix = entries.map(|entries| matrix(&mut arrays, shape, entries)).transpose()?;
    let biclusters = biclusters.map(|sizes| read_biclusters(&mut arrays, shape, sizes)).transpose()?;
    let file = BiScaleFile { meaning, matrix, biclusters };
    if let Some((field, expected, found)) = file.fault() {
        return Err(arrays.refuse(field, expected, found));
    }
    arrays.finish()?;
    Ok(file)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Shape {
    rows: usize,
    columns: usize,
    fraction_bits: u32,
}

impl BiScaleFile {
    /// Number f of fraction bits: values are multiples of 2^-f; `None` for a file without matrix and biclusters.
    pub fn fraction_bits(&self) -> Option<u32> {
        self.shapes().next().map(|shape| shape.fraction_bits)
    }

    fn shapes(&self) -> impl Iterator<Item = Shape> {
        let of_matrix = self.matrix.as_ref().map(|matrix| Shape {
            rows: matrix.rows(),
            columns: matrix.columns(),
            fraction_bits: matrix.fraction_bits(),
        });
        let of_biclusters = self.biclusters.as_ref().map(|biclusters| {
            let [rows, columns] = biclusters.matrix_size();
            Shape { rows, columns, fraction_bits: biclusters.fraction_bits() }
        });
        [of_matrix, of_biclusters].into_iter().flatten()
    }

    /// The first inconsistency between the parts: the field, the expected and the found value.
    fn fault(&self) -> Option<(&'static str, String, String)> {
        let mut shapes = self.shapes();
        let say = |shape: Shape| format!("{} x {} in 2^-{}", shape.rows, shape.columns, shape.fraction_bits);
        let Some(shape) = shapes.next() else {
            return Some(("contents", "a matrix or biclusters".to_owned(), "neither".to_owned()));
        };
        if let Some(other) = shapes.next().filter(|&other| other != shape) {
            return Some(("biclusters", say(shape), say(other)));
        }
        let meaning = self.meaning?;
        let local = (meaning.side as usize).pow(2);
        let expected = Shape {
            rows: (meaning.mesh.vertices as usize).saturating_mul(local),
            columns: LIGHT_TEXELS,
            fraction_bits: shape.fraction_bits,
        };
        (expected != shape || !(1..=LocalDirections::MOST as u32).contains(&meaning.side))
            .then(|| ("size of the transfer", say(expected), say(shape)))
    }
}

fn entries(
    arrays: &mut NpzReader<'_>,
    [indices, data]: [&str; 2],
    count: usize,
) -> Result<Vec<MatrixEntry>, InputError> {
    let indices: Vec<u32> = arrays.integers(indices, &[count])?;
    let values: Vec<i32> = arrays.integers(data, &[count])?;
    Ok(indices.into_iter().zip(values).map(|(index, value)| MatrixEntry { index, value }).collect())
}

fn matrix(arrays: &mut NpzReader<'_>, shape: Shape, count: usize) -> Result<SparseMatrix, InputError> {
    let begins: Vec<u32> = arrays.integers("indptr", &[shape.rows + 1])?;
    let entries = entries(arrays, ["indices", "data"], count)?;
    let refused = |reason: String| arrays.refuse("matrix", "rows in order", reason);
    if begins[0] != 0 || begins[shape.rows] as usize != count {
        return Err(refused(format!("rows from {} to {} of {count}", begins[0], begins[shape.rows])));
    }
    let mut matrix =
        SparseMatrix::new(shape.columns, shape.fraction_bits).map_err(|reason| refused(reason.to_string()))?;
    for row in begins.windows(2) {
        let row = entries.get(row[0] as usize..row[1] as usize).ok_or_else(|| refused(format!("{row:?}")))?;
        matrix.push_row(row).map_err(|reason| refused(reason.to_string()))?;
    }
    Ok(matrix)
}

fn read_biclusters(
    arrays: &mut NpzReader<'_>,
    shape: Shape,
    sizes: BiclusterSizes,
) -> Result<Biclustering, InputError> {
    let row_counts: Vec<u32> = arrays.integers("r", &[sizes.count])?;
    let column_counts: Vec<u32> = arrays.integers("l", &[sizes.count])?;
    let rows: Vec<u32> = arrays.integers("j", &[sizes.rows])?;
    let columns = entries(arrays, ["k", "t"], sizes.columns)?;
    let sum = |counts: &[u32]| counts.iter().fold(0_u64, |sum, &count| sum + u64::from(count));
    let sums = [sum(&row_counts), sum(&column_counts)];
    if sums != [rows.len() as u64, columns.len() as u64] {
        let expected = format!("{} and {} in all", rows.len(), columns.len());
        return Err(arrays.refuse("r and l", expected, format!("{} and {}", sums[0], sums[1])));
    }
    let (mut rows, mut columns) = (&rows[..], &columns[..]);
    let mut biclusters = Biclustering::empty(shape.rows, shape.columns, shape.fraction_bits);
    for (r, l) in row_counts.into_iter().zip(column_counts) {
        let bicluster = Bicluster { rows: front(&mut rows, r as usize), columns: front(&mut columns, l as usize) };
        if !bicluster.fits([shape.rows, shape.columns]) {
            let expected = "rows and columns of the matrix in increasing order, values other than 0";
            return Err(arrays.refuse("bicluster", expected, format!("others in bicluster {}", biclusters.len())));
        }
        biclusters.push(&bicluster);
    }
    Ok(biclusters)
}

/// Writes a file atomically. Fails with [`WriteError`], of kind [`io::ErrorKind::InvalidInput`] if the parts contradict
/// each other.
pub fn save_bi_scale(file: &BiScaleFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_bi_scale(file, out))
}

/// Writes the bytes of a file. Fails with errors of `out`, and with [`io::ErrorKind::InvalidInput`], before anything is
/// written, if the parts contradict each other.
pub fn write_bi_scale(file: &BiScaleFile, out: &mut dyn Write) -> io::Result<()> {
    let Some(shape) = file.shapes().next().filter(|_| file.fault().is_none()) else {
        return Err(contradiction(file.fault().unwrap_or_default()));
    };
    let sizes = |found: &Biclustering| BiclusterSizes {
        count: found.len(),
        rows: found.row_entries(),
        columns: found.column_entries(),
    };
    let entries = file.matrix.as_ref().map(SparseMatrix::nonzeros);
    let biclusters = file.biclusters.as_ref().map(sizes);
    let metadata = MatrixMetadata { meaning: file.meaning, shape, entries, biclusters };
    let mut arrays = begin_writing(out, PrtKind::BiScale, &metadata)?;
    if let Some(matrix) = &file.matrix {
        let rows = || (0..matrix.rows()).map(|row| matrix.row(row));
        let ends = rows().scan(0, |end: &mut i64, row| {
            *end += row.len().cast_signed() as i64;
            Some(*end)
        });
        arrays.integers("indptr", &[matrix.rows() + 1], std::iter::once(0).chain(ends))?;
        write_entries(&mut arrays, ["indices", "data"], matrix.nonzeros(), rows().flatten())?;
    }
    if let (Some(found), Some(sizes)) = (&file.biclusters, biclusters) {
        let rows = || (0..found.len()).map(|number| found.rows_of(number));
        let columns = || (0..found.len()).map(|number| found.columns_of(number));
        arrays.integers("r", &[sizes.count], rows().map(|rows| rows.len() as u32))?;
        arrays.integers("l", &[sizes.count], columns().map(|columns| columns.len() as u32))?;
        arrays.integers("j", &[sizes.rows], rows().flatten().copied())?;
        write_entries(&mut arrays, ["k", "t"], sizes.columns, columns().flatten())?;
    }
    arrays.finish()
}

fn write_entries<'a>(
    arrays: &mut NpzWriter<'_>,
    [indices, data]: [&str; 2],
    count: usize,
    entries: impl Iterator<Item = &'a MatrixEntry> + Clone,
) -> io::Result<()> {
    arrays.integers(indices, &[count], entries.clone().map(|entry| entry.index))?;
    arrays.integers(data, &[count], entries.map(|entry| entry.value))
}
