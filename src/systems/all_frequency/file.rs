//! The `.prt` file of all-frequency transfer: conventions 2 of the same version. docs/prt-format.md specifies it.
//!
//! Raw transfer is nowhere stored, since it takes gigabytes: visibility and reflectance are, of which each segment is
//! computed when it is needed, and coded transfer.

use std::io::{self, Write};
use std::path::Path;

use glam::DVec3;

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{BLOCK_ROWS, CodeOptions, CodedSegment, CodedTransfer, ScaleOf, SparseRows};
use crate::all_frequency::factor::ProductFactors;
use crate::error::InputError;
use crate::io::{WriteError, write_file};
use crate::sphere::ParabolicMap;
use crate::transfer::file::other_mesh_error;
use crate::transfer::file::read::{Reader, bytes_of};
use crate::transfer::file::write::{Section, digest_fields, tangent_fields};
use crate::transfer::file::{MAGIC, MeshDigest, PrtKind, VERSION};
use crate::transfer::grid::Segmentation;
use crate::transfer::linear_basis::BasisWidth;
use crate::transfer::visibility::{VISIBILITY_BYTES, VisibilityMaps};

const FACTORS: &[u8; 4] = b"FACT";
const VISIBILITY: &[u8; 4] = b"VISI";
const CODE: &[u8; 4] = b"CODE";
/// Fields of 32 bits between the conventions and the axis of tangents.
const FIELDS: usize = 8;
/// Texels along an edge of a parabolic map, at most.
const MAX_SIDE: u32 = 1 << 12;

/// All-frequency transfer of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct AllFrequencyFile {
    /// The mesh whose vertices it belongs to.
    pub mesh: MeshDigest,
    /// The width of the light texels' hat functions.
    pub hats: BasisWidth,
    /// The reflectance; its color is the mesh's.
    pub reflectance: Reflectance,
    /// The visible directions of each vertex, one map per vertex.
    pub visibility: Option<VisibilityMaps>,
    /// Transfer, compressed and coded.
    pub coded: Option<CodedTransfer>,
}

/// Reads a file; of `mesh`, if one is given.
///
/// # Errors
/// [`InputError`].
pub fn load_all_frequency(path: &Path, mesh: Option<&MeshDigest>) -> Result<AllFrequencyFile, InputError> {
    let file = parse_all_frequency(&bytes_of(path)?, path)?;
    mesh.map_or(Ok(()), |expected| file.require_mesh(expected, path))?;
    Ok(file)
}

/// Reads a file from bytes; `name` is its name in messages.
///
/// # Errors
/// [`InputError`].
pub fn parse_all_frequency(bytes: &[u8], name: &Path) -> Result<AllFrequencyFile, InputError> {
    let mut reader = Reader { bytes, at: 0, name };
    reader.begin(PrtKind::AllFrequency)?;
    let mut fields = [0; FIELDS];
    for field in &mut fields {
        *field = reader.integer("header")?;
    }
    let [terms, hats, sections, digest @ .., tangents] = fields;
    let axis = reader.doubles(3, "axis of tangents")?;
    reader.checksum(0, "the header")?;
    for (field, found, expected) in [
        ("terms of the reflectance", terms, 1..=1024),
        ("width of hats in texels", hats, 1..=2),
        ("number of sections", sections, 1..=3),
    ] {
        if !expected.contains(&found) {
            let expected = format!("{} to {}", expected.start(), expected.end());
            return Err(reader.field(field, expected, found.to_string()));
        }
    }
    let Some(tangents) = reader.tangents(tangents, DVec3::from_slice(&axis))? else {
        return Err(reader.field("tangents", "those of a mesh", "none"));
    };
    let [vertices, triangles, vertex_crc, triangle_crc] = digest;
    let mesh = MeshDigest { tangents, vertices, triangles, vertex_crc, triangle_crc };
    let hats = if hats == 1 { BasisWidth::OneTexel } else { BasisWidth::TwoTexels };
    let mut file = AllFrequencyFile { mesh, hats, reflectance: Reflectance::Diffuse, visibility: None, coded: None };
    let mut before = 0;
    for _ in 0..sections {
        let (tag, mut section) = reader.section()?;
        let order = [FACTORS, VISIBILITY, CODE].iter().position(|known| **known == tag).map_or(0, |at| at + 1);
        if order <= before {
            let found = format!("{:?}", String::from_utf8_lossy(&tag));
            return Err(reader.field("section", "\"FACT\", \"VISI\", \"CODE\", each at most once", found));
        }
        before = order;
        match &tag {
            FACTORS => file.reflectance = Reflectance::Factored(section.factors(terms as usize)?),
            VISIBILITY => file.visibility = Some(section.visibility(vertices as usize)?),
            _ => file.coded = Some(section.coded(terms as usize, vertices as usize)?),
        }
        section.end()?;
    }
    reader.end()?;
    match file.fault(terms as usize) {
        Some((field, expected, found)) => Err(reader.field(field, expected, found)),
        None => Ok(file),
    }
}

impl AllFrequencyFile {
    /// Refuses a file of another mesh, or of the same with other tangents; `path` is named in the message.
    ///
    /// # Errors
    /// [`InputError`].
    pub fn require_mesh(&self, expected: &MeshDigest, path: &Path) -> Result<(), InputError> {
        let found = self.mesh;
        if found == *expected {
            return Ok(());
        }
        Err(other_mesh_error(path, *expected, Some(found)))
    }

    /// The first contradiction between the parts: the field, the expected and the found value.
    fn fault(&self, terms: usize) -> Option<(&'static str, String, String)> {
        if self.reflectance.terms() != terms {
            return Some(("terms of the reflectance", self.reflectance.terms().to_string(), terms.to_string()));
        }
        if self.visibility.is_none() && self.coded.is_none() {
            return Some(("contents", "visibility or coded transfer".to_owned(), "neither".to_owned()));
        }
        let vertices = self.mesh.vertices as usize;
        let counts = [self.visibility.as_ref().map(VisibilityMaps::len), self.coded.as_ref().map(|c| c.vertices)];
        if let Some(found) = counts.into_iter().flatten().find(|&found| found != vertices) {
            return Some(("vertices", vertices.to_string(), found.to_string()));
        }
        let coded = self.coded.as_ref()?;
        let last = coded.segments.last().map_or(0, |part| part.segment);
        let shape = [coded.rows, coded.coefficients, last.max(23)];
        if shape != [terms, Segmentation::Quarters.len(), 23] {
            return Some(("shape of coded transfer", format!("{terms} x 256 in 24 segments"), format!("{shape:?}")));
        }
        coded.fault().map(|what| ("coded transfer", "parts that go together".to_owned(), format!("other {what}")))
    }
}

impl Reader<'_> {
    fn factors(&mut self, terms: usize) -> Result<ProductFactors, InputError> {
        let mut map = |what| {
            let side = self.integer(what)?;
            if !(1..=MAX_SIDE).contains(&side) {
                return Err(self.field(what, format!("1 to {MAX_SIDE}"), side.to_string()));
            }
            let values = self.doubles((side as usize).pow(2).saturating_mul(terms), what)?;
            if !values.iter().all(|value| value.is_finite()) {
                return Err(self.field(what, "finite numbers", "others"));
            }
            Ok((ParabolicMap::new(side as usize), values))
        };
        let (view, light) = (map("the map of view factors")?, map("the map of light factors")?);
        Ok(ProductFactors::new(terms, view, light))
    }

    fn visibility(&mut self, vertices: usize) -> Result<VisibilityMaps, InputError> {
        let words = self.numbers(vertices.saturating_mul(VISIBILITY_BYTES / 8), "visibility")?;
        let words = words.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
        VisibilityMaps::from_words(words).ok_or_else(|| self.field("visibility", "whole maps", "others"))
    }

    fn coded(&mut self, rows: usize, vertices: usize) -> Result<CodedTransfer, InputError> {
        let coefficients = self.integer("light coefficients of a segment")? as usize;
        let [representative_bits, weight_bits, scale, zero] = self.array("bits")?;
        let scale = match (scale, zero) {
            (0, 0) => ScaleOf::Representative,
            (1, 0) => ScaleOf::Segment,
            _ => return Err(self.field("scale", "0 or 1", scale.to_string())),
        };
        let options = CodeOptions { representative_bits, weight_bits, scale };
        let count = self.integer("number of segments")?;
        let columns = rows.saturating_mul(coefficients);
        let segments = (0..count).map(|_| self.coded_segment(columns)).collect::<Result<_, _>>()?;
        Ok(CodedTransfer { rows, coefficients, vertices, options, segments })
    }

    fn shorts(&mut self, count: usize, what: &'static str) -> Result<Vec<i16>, InputError> {
        Ok(self.numbers(count, what)?.iter().map(|&bytes| i16::from_le_bytes(bytes)).collect())
    }

    fn coded_segment(&mut self, columns: usize) -> Result<CodedSegment, InputError> {
        let what = "a coded segment";
        let [segment, vertices, clusters, nonzeros] =
            [self.integer(what)?, self.integer(what)?, self.integer(what)?, self.integer(what)?].map(|n| n as usize);
        let of_vertices = self.integers(vertices, what)?;
        let cluster_of = self.numbers(vertices, what)?.iter().map(|&bytes| u16::from_le_bytes(bytes)).collect();
        let counts = self.numbers(clusters, what)?.iter().map(|&[count]| count).collect::<Vec<u8>>();
        let rows: usize = counts.iter().map(|&count| usize::from(count)).sum();
        let mut steps = || -> Result<Vec<f32>, InputError> {
            Ok(self.numbers(rows, what)?.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect())
        };
        let (representative_steps, weight_steps) = (steps()?, steps()?);
        let of_columns = self.numbers(rows.div_ceil(BLOCK_ROWS).saturating_mul(columns), what)?;
        let of_columns = of_columns.iter().map(|&bytes| u16::from_le_bytes(bytes)).collect();
        let row_in_block = self.numbers(nonzeros, what)?.iter().map(|&[row]| row).collect();
        let numbers = self.shorts(nonzeros, what)?;
        let weights = self.integer(what)? as usize;
        let weights = self.shorts(weights, what)?;
        let representatives = SparseRows::from_parts(rows, columns, of_columns, row_in_block, numbers);
        let representatives = representatives
            .ok_or_else(|| self.field("representatives", "numbers other than 0 in order of rows", "others"))?;
        Ok(CodedSegment {
            segment,
            vertices: of_vertices,
            cluster_of,
            counts,
            representatives,
            representative_steps,
            weights,
            weight_steps,
        })
    }
}

/// Writes a file completely or not at all.
///
/// # Errors
/// [`WriteError`]; with an [`io::ErrorKind::InvalidInput`] if the parts contradict each other.
pub fn save_all_frequency(file: &AllFrequencyFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_all_frequency(file, out))
}

/// Writes the bytes of a file.
///
/// # Errors
/// Those of `out`; [`io::ErrorKind::InvalidInput`], before anything is written, if the parts contradict each other.
pub fn write_all_frequency(file: &AllFrequencyFile, out: &mut dyn Write) -> io::Result<()> {
    let terms = file.reflectance.terms();
    if let Some((field, expected, found)) = file.fault(terms) {
        let message = format!("{field}: expected {expected}, found {found}");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let factors = if let Reflectance::Factored(factors) = &file.reflectance { Some(factors) } else { None };
    let sections = [factors.is_some(), file.visibility.is_some(), file.coded.is_some()];
    let hats = if file.hats == BasisWidth::OneTexel { 1 } else { 2 };
    let (tangents, axis) = tangent_fields(file.mesh.tangents);
    let mut header = MAGIC.to_vec();
    let first = [VERSION, PrtKind::AllFrequency as u32, terms as u32, hats, sections.map(u32::from).iter().sum()];
    let fields = first.into_iter().chain(digest_fields(file.mesh)).chain([tangents]);
    header.extend(fields.flat_map(u32::to_le_bytes));
    header.extend(axis.into_iter().flat_map(f64::to_le_bytes));
    header.extend(crc32fast::hash(&header).to_le_bytes());
    out.write_all(&header)?;
    if let Some(factors) = factors {
        let (sides, values) = ([factors.view_map().side(), factors.light_map().side()], factors.values());
        let mut section = Section::begin(out, FACTORS, 8 + 8 * (values[0].len() + values[1].len()) as u64)?;
        for (side, values) in sides.into_iter().zip(values) {
            section.write(&(side as u32).to_le_bytes())?;
            section.write_all(values.iter().map(|value| value.to_le_bytes()))?;
        }
        section.end()?;
    }
    if let Some(maps) = &file.visibility {
        let mut section = Section::begin(out, VISIBILITY, 8 * maps.words().len() as u64)?;
        section.write_all(maps.words().iter().map(|word| word.to_le_bytes()))?;
        section.end()?;
    }
    if let Some(coded) = &file.coded {
        let length = coded.segments.iter().map(segment_bytes).sum::<u64>();
        let mut section = Section::begin(out, CODE, 12 + length)?;
        write_coded(coded, &mut section)?;
        section.end()?;
    }
    Ok(())
}

/// Bytes of a segment in the file.
fn segment_bytes(part: &CodedSegment) -> u64 {
    let (columns, rows, values) = part.representatives.parts();
    let vertices = 6 * part.vertices.len() + part.counts.len() + 8 * part.weight_steps.len();
    (20 + vertices + 2 * columns.len() + rows.len() + 2 * values.len() + 2 * part.weights.len()) as u64
}

fn write_coded(coded: &CodedTransfer, section: &mut Section<'_>) -> io::Result<()> {
    section.write(&(coded.coefficients as u32).to_le_bytes())?;
    let scale = u8::from(coded.options.scale == ScaleOf::Segment);
    section.write(&[coded.options.representative_bits, coded.options.weight_bits, scale, 0])?;
    section.write(&(coded.segments.len() as u32).to_le_bytes())?;
    for part in &coded.segments {
        let (columns, rows, values) = part.representatives.parts();
        let counts = [part.segment, part.vertices.len(), part.counts.len(), values.len()];
        section.write_all(counts.into_iter().map(|count| (count as u32).to_le_bytes()))?;
        section.write_all(part.vertices.iter().map(|vertex| vertex.to_le_bytes()))?;
        section.write_all(part.cluster_of.iter().map(|cluster| cluster.to_le_bytes()))?;
        section.write(&part.counts)?;
        section.write_all(part.representative_steps.iter().map(|step| step.to_le_bytes()))?;
        section.write_all(part.weight_steps.iter().map(|step| step.to_le_bytes()))?;
        section.write_all(columns.iter().map(|count| count.to_le_bytes()))?;
        section.write(rows)?;
        section.write_all(values.iter().map(|value| value.to_le_bytes()))?;
        section.write(&(part.weights.len() as u32).to_le_bytes())?;
        section.write_all(part.weights.iter().map(|weight| weight.to_le_bytes()))?;
    }
    Ok(())
}
