//! The `.prt` file of bi-scale transfer, which is kind 3. docs/prt-format.md specifies it. A file without tables of
//! values has version 1, like the other kinds; one with tables, `file_table.rs`, version 2.

use std::io::{self, Write};
use std::path::Path;

use glam::DVec3;

use crate::bi_scale::bicluster::{Bicluster, Biclustering};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file_table::{table_bytes, table_of};
use crate::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crate::bi_scale::values::EntryValues;
use crate::error::InputError;
use crate::io::{WriteError, write_file};
use crate::transfer::file::read::{Reader, bytes_of};
use crate::transfer::file::write::{Section, digest_fields, tangent_fields};
use crate::transfer::file::{MAGIC, MeshDigest, PrtKind, VERSION};
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::visibility::Horizon;

const MATRIX: &[u8; 4] = b"MATR";
const BICLUSTERS: &[u8; 4] = b"BICL";
/// The version of files with tables of values.
const TABLE_VERSION: u32 = PrtKind::BiScale.latest_version();
/// The field of fraction bits where the values of the matrix have no unit.
const NO_UNIT: u32 = u32::MAX;
/// Number of 32-bit fields between the conventions and the axis of tangents.
const FIELDS: usize = 11;

/// The meaning of the rows of a transfer matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// The same as a sum of biclusters.
    pub biclusters: Option<Biclustering>,
}

/// Reads a file.
///
/// # Errors
/// [`InputError`].
pub fn load_bi_scale(path: &Path) -> Result<BiScaleFile, InputError> {
    parse_bi_scale(&bytes_of(path)?, path)
}

/// Reads a file from bytes; `name` stands for it in messages.
///
/// # Errors
/// [`InputError`].
pub fn parse_bi_scale(bytes: &[u8], name: &Path) -> Result<BiScaleFile, InputError> {
    let mut reader = Reader { bytes, at: 0, name };
    let version = reader.begin(PrtKind::BiScale)?;
    let mut fields = [0; FIELDS];
    for field in &mut fields {
        *field = reader.integer("header")?;
    }
    let [side, horizon, rows, columns, fraction_bits, sections, digest @ .., tangents] = fields;
    let fraction_bits = Some(fraction_bits).filter(|&bits| version == VERSION || bits != NO_UNIT);
    let axis = reader.doubles(3, "axis of tangents")?;
    reader.checksum(0, "the header")?;
    let is_transfer = u32::from(side > 0);
    for (field, found, expected) in [
        ("local directions along an edge", side, 0..=LocalDirections::MOST as u32),
        ("horizon", horizon, is_transfer..=2 * is_transfer),
        ("rows", rows, 1..=u32::MAX),
        ("columns", columns, 1..=u32::MAX),
        ("bits behind the point", fraction_bits.unwrap_or(0), 0..=EntryValues::MOST_FRACTION_BITS),
        ("number of sections", sections, 1..=2),
        ("tangents", tangents, is_transfer..=3 * is_transfer),
        ("mesh's digest", digest.iter().copied().max().unwrap_or(0), 0..=is_transfer * u32::MAX),
    ] {
        if !expected.contains(&found) {
            let expected = format!("{} to {}", expected.start(), expected.end());
            return Err(reader.field(field, expected, found.to_string()));
        }
    }
    let [vertices, triangles, vertex_crc, triangle_crc] = digest;
    let meaning = reader.tangents(tangents, DVec3::from_slice(&axis))?.map(|tangents| BiScaleMeaning {
        mesh: MeshDigest { tangents, vertices, triangles, vertex_crc, triangle_crc },
        side,
        horizon: if horizon == 1 { Horizon::Normal } else { Horizon::Geometry },
    });
    let shape = Shape { rows: rows as usize, columns: columns as usize, fraction_bits };
    let mut file = BiScaleFile { meaning, matrix: None, biclusters: None };
    for _ in 0..sections {
        let (tag, mut section) = reader.section()?;
        match &tag {
            MATRIX if file.matrix.is_none() && file.biclusters.is_none() => {
                file.matrix = Some(section.matrix(shape)?);
            }
            BICLUSTERS if file.biclusters.is_none() => file.biclusters = Some(section.biclusters(shape)?),
            other => {
                let found = format!("{:?}", String::from_utf8_lossy(other));
                return Err(reader.field("section", "\"MATR\", then \"BICL\", each at most once", found));
            }
        }
        section.end()?;
    }
    reader.end()?;
    match file.fault() {
        Some((field, expected, found)) => Err(reader.field(field, expected, found)),
        None if file.version() != version => {
            let expected = if version == VERSION { "1 for values in units" } else { "a table of values for version 2" };
            Err(reader.field("values", expected, "others"))
        }
        None => Ok(file),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Shape {
    rows: usize,
    columns: usize,
    fraction_bits: Option<u32>,
}

impl BiScaleFile {
    /// The numbers behind entries of the matrix, else of its biclusters.
    pub fn values(&self) -> Option<&EntryValues> {
        let of_biclusters = || self.biclusters.as_ref().map(Biclustering::values);
        self.matrix.as_ref().map(SparseMatrix::values).or_else(of_biclusters)
    }

    fn shapes(&self) -> impl Iterator<Item = Shape> {
        let of_matrix = self.matrix.as_ref().map(|matrix| Shape {
            rows: matrix.rows(),
            columns: matrix.columns(),
            fraction_bits: matrix.values().fraction_bits(),
        });
        let of_biclusters = self.biclusters.as_ref().map(|biclusters| {
            let [rows, columns] = biclusters.matrix_size();
            Shape { rows, columns, fraction_bits: biclusters.values().fraction_bits() }
        });
        [of_matrix, of_biclusters].into_iter().flatten()
    }

    /// The version that its values need.
    fn version(&self) -> u32 {
        let of_matrix = self.matrix.as_ref().map(SparseMatrix::values);
        let mut all = of_matrix.into_iter().chain(self.biclusters.as_ref().map(Biclustering::values));
        if all.any(|values| values.table_len().is_some()) { TABLE_VERSION } else { VERSION }
    }

    /// The first contradiction between the parts: the field, the expected and the found value.
    fn fault(&self) -> Option<(&'static str, String, String)> {
        let mut shapes = self.shapes();
        let unit = |shape: Shape| shape.fraction_bits.map_or("no unit".to_owned(), |bits| format!("2^-{bits}"));
        let say = |shape: Shape| format!("{} x {} in {}", shape.rows, shape.columns, unit(shape));
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

impl Reader<'_> {
    /// Entries of `counts.len()` lines with `counts[i]` entries each: the table of values if there is one, then all
    /// indices along the lines, then all values.
    fn entries(
        &mut self,
        counts: &[u32],
        fraction_bits: Option<u32>,
    ) -> Result<(EntryValues, Vec<MatrixEntry>), InputError> {
        let what = "entries";
        let count = counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count as usize));
        let [index_bytes, value_bytes, has_table, zero] = self.array::<4>(what)?;
        let values_of_entries = match (has_table, fraction_bits) {
            (0, Some(bits)) => EntryValues::units(bits),
            (1, _) => table_of(self, fraction_bits)?,
            _ => {
                return Err(self.field(
                    "table of values",
                    "0 or 1, and 1 for values without a unit",
                    has_table.to_string(),
                ));
            }
        };
        let short = |bytes: &[u8; 2]| u32::from(u16::from_le_bytes(*bytes));
        let indices: Vec<u32> = match index_bytes {
            2 => self.numbers(count, what)?.iter().map(short).collect(),
            4 => self.integers(count, what)?,
            _ => return Err(self.field("bytes of a column", "2 or 4", index_bytes.to_string())),
        };
        let values: Vec<i32> = match value_bytes {
            1 => self.numbers(count, what)?.iter().map(|&[value]| i32::from(value.cast_signed())).collect(),
            2 => self.numbers(count, what)?.iter().map(|&value| i32::from(i16::from_le_bytes(value))).collect(),
            4 => self.numbers(count, what)?.iter().map(|&value| i32::from_le_bytes(value)).collect(),
            _ => return Err(self.field("bytes of a value", "1, 2 or 4", value_bytes.to_string())),
        };
        let entries: Vec<MatrixEntry> =
            indices.into_iter().zip(values).map(|(index, value)| MatrixEntry { index, value }).collect();
        // The shortest widths are required, so that equal contents have equal bytes.
        let least = widths(entries.iter());
        if [index_bytes, value_bytes, zero] != [least[0], least[1], 0] {
            let found = format!("{index_bytes} and {value_bytes}");
            return Err(self.field("bytes of columns and values", format!("{} and {}", least[0], least[1]), found));
        }
        let mut named: Vec<i32> = entries.iter().map(|entry| entry.value).collect();
        named.sort_unstable();
        named.dedup();
        if let Some(expected) = values_of_entries.table_len().filter(|&length| length != named.len()) {
            let found = named.len().to_string();
            return Err(self.field("values of entries", format!("all {expected} of the table"), found));
        }
        Ok((values_of_entries, entries))
    }

    fn matrix(&mut self, shape: Shape) -> Result<SparseMatrix, InputError> {
        let counts = self.integers(shape.rows, "entries of rows")?;
        let (values, entries) = self.entries(&counts, shape.fraction_bits)?;
        if values.table_len().is_some() && shape.fraction_bits.is_some() {
            return Err(self.field("matrix", "values in its unit", "a table of values"));
        }
        let mut rest = &entries[..];
        let mut matrix =
            SparseMatrix::of_values(shape.columns, values).map_err(|e| self.field("matrix", "one", e.to_string()))?;
        for count in counts {
            let (row, after) = rest.split_at(count as usize);
            rest = after;
            matrix.push_row(row).map_err(|reason| self.field("matrix", "rows in order", reason.to_string()))?;
        }
        Ok(matrix)
    }

    fn biclusters(&mut self, shape: Shape) -> Result<Biclustering, InputError> {
        let count = self.integer("number of biclusters")? as usize;
        let row_counts = self.integers(count, "rows of biclusters")?;
        let column_counts = self.integers(count, "columns of biclusters")?;
        let sum = row_counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count as usize));
        let rows = self.integers(sum, "rows")?;
        let (values, columns) = self.entries(&column_counts, shape.fraction_bits)?;
        let (mut rows, mut columns) = (&rows[..], &columns[..]);
        let mut biclusters = Biclustering::empty(shape.rows, shape.columns, values);
        for (r, l) in row_counts.into_iter().zip(column_counts) {
            let (own_rows, other_rows) = rows.split_at(r as usize);
            let (own_columns, other_columns) = columns.split_at(l as usize);
            (rows, columns) = (other_rows, other_columns);
            let bicluster = Bicluster { rows: own_rows.to_vec(), columns: own_columns.to_vec() };
            if !bicluster.fits([shape.rows, shape.columns], biclusters.values()) {
                let expected = "rows and columns of the matrix in increasing order, values other than 0";
                return Err(self.field("bicluster", expected, format!("others in bicluster {}", biclusters.len())));
            }
            biclusters.push(&bicluster);
        }
        Ok(biclusters)
    }
}

/// The least numbers of bytes for indices (2 or 4) and values (1, 2 or 4).
fn widths<'a>(entries: impl Iterator<Item = &'a MatrixEntry>) -> [u8; 2] {
    let (mut index, mut low, mut high) = (0, 0, 0);
    for entry in entries {
        (index, low, high) = (index.max(entry.index), low.min(entry.value), high.max(entry.value));
    }
    let fits = |least: i32, most: i32| low >= least && high <= most;
    let value_bytes = match () {
        () if fits(i8::MIN.into(), i8::MAX.into()) => 1,
        () if fits(i16::MIN.into(), i16::MAX.into()) => 2,
        () => 4,
    };
    [if u16::try_from(index).is_ok() { 2 } else { 4 }, value_bytes]
}

/// Writes a file completely or not at all.
///
/// # Errors
/// [`WriteError`]; with an [`io::ErrorKind::InvalidInput`] if the parts contradict each other.
pub fn save_bi_scale(file: &BiScaleFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_bi_scale(file, out))
}

/// Writes the bytes of a file.
///
/// # Errors
/// Those of `out`; [`io::ErrorKind::InvalidInput`], before anything is written, if the parts contradict each other.
pub fn write_bi_scale(file: &BiScaleFile, out: &mut dyn Write) -> io::Result<()> {
    let invalid = |message: String| io::Error::new(io::ErrorKind::InvalidInput, message);
    if let Some((field, expected, found)) = file.fault() {
        return Err(invalid(format!("{field}: expected {expected}, found {found}")));
    }
    let shape = file.shapes().next().ok_or_else(|| invalid("neither matrix nor biclusters".to_owned()))?;
    let sections = u32::from(file.matrix.is_some()) + u32::from(file.biclusters.is_some());
    let (side, horizon, digest, (tangents, axis)) = match file.meaning {
        Some(BiScaleMeaning { mesh, side, horizon }) => {
            let horizon = if horizon == Horizon::Normal { 1 } else { 2 };
            (side, horizon, digest_fields(mesh), tangent_fields(mesh.tangents))
        }
        None => (0, 0, [0; 4], (0, [0.0; 3])),
    };
    let mut header = MAGIC.to_vec();
    let first = [
        file.version(),
        PrtKind::BiScale as u32,
        side,
        horizon,
        shape.rows as u32,
        shape.columns as u32,
        shape.fraction_bits.unwrap_or(NO_UNIT),
        sections,
    ];
    header.extend(first.into_iter().chain(digest).chain([tangents]).flat_map(u32::to_le_bytes));
    header.extend(axis.into_iter().flat_map(f64::to_le_bytes));
    header.extend(crc32fast::hash(&header).to_le_bytes());
    out.write_all(&header)?;
    if let Some(matrix) = &file.matrix {
        let rows = || (0..matrix.rows()).map(|row| matrix.row(row));
        let layout = EntryLayout::new(rows().flatten(), matrix.values());
        let mut section = Section::begin(out, MATRIX, 4 * matrix.rows() as u64 + layout.bytes(matrix.nonzeros()))?;
        section.write_all(rows().map(|row| (row.len() as u32).to_le_bytes()))?;
        layout.write(&|| rows().flatten(), &mut section)?;
        section.end()?;
    }
    if let Some(found) = &file.biclusters {
        let columns = || (0..found.len()).flat_map(|number| found.columns_of(number));
        let rows = || (0..found.len()).map(|number| found.rows_of(number));
        let layout = EntryLayout::new(columns(), found.values());
        let length = 4 + 8 * found.len() as u64 + 4 * found.row_entries() as u64;
        let mut section = Section::begin(out, BICLUSTERS, length + layout.bytes(found.column_entries()))?;
        section.write(&(found.len() as u32).to_le_bytes())?;
        section.write_all(rows().map(|rows| (rows.len() as u32).to_le_bytes()))?;
        section.write_all((0..found.len()).map(|number| (found.columns_of(number).len() as u32).to_le_bytes()))?;
        section.write_all(rows().flatten().map(|row| row.to_le_bytes()))?;
        layout.write(&columns, &mut section)?;
        section.end()?;
    }
    Ok(())
}

/// Bytes of indices and of values, and the table of values.
struct EntryLayout {
    index_bytes: u8,
    value_bytes: u8,
    table: Option<Vec<u8>>,
}

impl EntryLayout {
    fn new<'a>(entries: impl Iterator<Item = &'a MatrixEntry>, values: &EntryValues) -> Self {
        let [index_bytes, value_bytes] = widths(entries);
        Self { index_bytes, value_bytes, table: table_bytes(values) }
    }

    /// Bytes of so many entries with all before them.
    fn bytes(&self, count: usize) -> u64 {
        let table = self.table.as_ref().map_or(0, Vec::len) as u64;
        4 + table + (u64::from(self.index_bytes) + u64::from(self.value_bytes)) * count as u64
    }

    fn write<'a, I: Iterator<Item = &'a MatrixEntry>>(
        &self,
        entries: &dyn Fn() -> I,
        section: &mut Section<'_>,
    ) -> io::Result<()> {
        section.write(&[self.index_bytes, self.value_bytes, u8::from(self.table.is_some()), 0])?;
        section.write(self.table.as_deref().unwrap_or_default())?;
        match self.index_bytes {
            2 => section.write_all(entries().map(|entry| (entry.index as u16).to_le_bytes()))?,
            _ => section.write_all(entries().map(|entry| entry.index.to_le_bytes()))?,
        }
        match self.value_bytes {
            1 => section.write_all(entries().map(|entry| (entry.value as i8).to_le_bytes())),
            2 => section.write_all(entries().map(|entry| (entry.value as i16).to_le_bytes())),
            _ => section.write_all(entries().map(|entry| entry.value.to_le_bytes())),
        }
    }
}
