//! Files of all-frequency transfer. docs/npz.md describes their contents.
//!
//! A file never stores raw transfer, which needs gigabytes. It stores visibility and reflectance, from which each
//! segment can be computed on demand, and coded transfer.

use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{BLOCK_ROWS, CodeOptions, CodedSegment, CodedTransfer, SparseRows};
use crate::all_frequency::factor::ProductFactors;
use crate::error::InputError;
use crate::io::{NpzReader, NpzWriter, WriteError, write_file};
use crate::sphere::ParabolicMap;
use crate::transfer::file::kind::{begin_reading, begin_writing, bytes_of, contradiction};
use crate::transfer::file::{MeshDigest, PrtKind, front, line_fault, require_mesh};
use crate::transfer::grid::Segmentation;
use crate::transfer::linear_basis::BasisWidth;
use crate::transfer::visibility::{VISIBILITY_BYTES, VisibilityMaps};

/// Maximum number of texels along an edge of a parabolic map.
const MAX_SIDE: usize = 1 << 12;
/// Light coefficients of a segment.
const COEFFICIENTS: usize = Segmentation::Quarters.len();

/// All-frequency transfer of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct AllFrequencyFile {
    /// Digest of the mesh.
    pub mesh: MeshDigest,
    /// The width of the light texels' hat functions.
    pub hats: BasisWidth,
    /// The reflectance; the color belongs to the mesh.
    pub reflectance: Reflectance,
    /// The visible directions of each vertex, one map per vertex.
    pub visibility: Option<VisibilityMaps>,
    /// Transfer, compressed and coded.
    pub coded: Option<CodedTransfer>,
    /// The file of the mesh, relative to the folder of this file; only for a ground, which has no name of its own.
    pub model: Option<String>,
}

#[derive(Serialize, Deserialize)]
struct TransferMetadata {
    mesh: MeshDigest,
    hats: BasisWidth,
    terms: usize,
    /// Texels along an edge of the maps of G and F.
    factors: Option<[usize; 2]>,
    code: Option<Code>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    model: Option<String>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
struct Code {
    segments: usize,
    options: CodeOptions,
}

/// Reads a file; if `mesh` is given, it must be the file's mesh.
pub fn load_all_frequency(path: &Path, mesh: Option<&MeshDigest>) -> Result<AllFrequencyFile, InputError> {
    let file = parse_all_frequency(&bytes_of(path)?, path)?;
    mesh.map_or(Ok(()), |expected| require_mesh(path, expected, Some(file.mesh)))?;
    Ok(file)
}

/// Reads a file from bytes; `name` is its name in messages.
pub fn parse_all_frequency(bytes: &[u8], name: &Path) -> Result<AllFrequencyFile, InputError> {
    let (mut arrays, metadata) = begin_reading(bytes, name, PrtKind::AllFrequency)?;
    let TransferMetadata { mesh, hats, terms, factors, code, model } = metadata;
    if !(1..=1024).contains(&terms) {
        return Err(arrays.refuse("terms of the reflectance", "1 to 1024", terms.to_string()));
    }
    let reflectance = match factors {
        Some([view, light]) => {
            let view = factor(&mut arrays, "G", view, terms)?;
            Reflectance::Factored(ProductFactors::new(terms, view, factor(&mut arrays, "F", light, terms)?))
        }
        None => Reflectance::Diffuse,
    };
    let vertices = mesh.vertices as usize;
    let visibility = arrays.has("visibility").then(|| visibility(&mut arrays, vertices)).transpose()?;
    let coded = code.map(|code| coded(&mut arrays, terms, vertices, code)).transpose()?;
    let file = AllFrequencyFile { mesh, hats, reflectance, visibility, coded, model };
    if let Some((field, expected, found)) = file.fault(terms) {
        return Err(arrays.refuse(field, expected, found));
    }
    arrays.finish()?;
    Ok(file)
}

impl AllFrequencyFile {
    /// The first inconsistency between the parts: the field, the expected and the found value.
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
        if let Some(fault) = line_fault("model", self.model.as_deref()) {
            return Some(fault);
        }
        let coded = self.coded.as_ref()?;
        let last = coded.segments.last().map_or(0, |part| part.segment);
        let shape = [coded.rows, coded.coefficients, last.max(23)];
        if shape != [terms, COEFFICIENTS, 23] {
            return Some(("shape of coded transfer", format!("{terms} x 256 in 24 segments"), format!("{shape:?}")));
        }
        coded.fault().map(|what| ("coded transfer", "parts that go together".to_owned(), format!("other {what}")))
    }
}

fn factor(
    arrays: &mut NpzReader<'_>,
    name: &str,
    side: usize,
    terms: usize,
) -> Result<(ParabolicMap, Vec<f64>), InputError> {
    if !(1..=MAX_SIDE).contains(&side) {
        return Err(arrays.refuse(name, format!("1 to {MAX_SIDE} texels along an edge"), side.to_string()));
    }
    Ok((ParabolicMap::new(side), arrays.doubles(name, &[side, side, terms])?))
}

/// Two words per row of 128 directions.
const fn visibility_shape(vertices: usize) -> [usize; 4] {
    [vertices, 6, 128, VISIBILITY_BYTES / 8 / (6 * 128)]
}

fn visibility(arrays: &mut NpzReader<'_>, vertices: usize) -> Result<VisibilityMaps, InputError> {
    let words = arrays.words("visibility", &visibility_shape(vertices))?;
    VisibilityMaps::from_words(words).ok_or_else(|| arrays.refuse("visibility", "whole maps", "incomplete maps"))
}

fn coded(
    arrays: &mut NpzReader<'_>,
    terms: usize,
    vertices: usize,
    Code { segments, options }: Code,
) -> Result<CodedTransfer, InputError> {
    let columns = terms * COEFFICIENTS;
    let sizes: Vec<u32> = arrays.integers("segments", &[segments, 5])?;
    let sizes: Vec<[usize; 5]> = sizes.as_chunks().0.iter().map(|sizes| sizes.map(|size| size as usize)).collect();
    let total = |at: usize| sizes.iter().map(|sizes| sizes[at]).sum::<usize>();
    let of_vertices = arrays.integers("vertices", &[total(1)])?;
    let cluster_of = arrays.integers("clusters", &[total(1)])?;
    let counts: Vec<u8> = arrays.integers("representatives", &[total(2)])?;
    let mut rest = &counts[..];
    let sum = |sizes: &[usize; 5]| front(&mut rest, sizes[2]).into_iter().map(usize::from).sum::<usize>();
    let rows: Vec<usize> = sizes.iter().map(sum).collect();
    let (blocks, all_rows): (usize, usize) =
        (rows.iter().map(|rows| rows.div_ceil(BLOCK_ROWS)).sum(), rows.iter().sum());
    let representative_steps = arrays.singles("representative_steps", &[all_rows])?;
    let weight_steps = arrays.singles("weight_steps", &[all_rows])?;
    let of_columns = arrays.integers("nonzeros", &[blocks, terms, COEFFICIENTS])?;
    let row_in_block = arrays.integers("rows", &[total(3)])?;
    let numbers = arrays.integers("numbers", &[total(3)])?;
    let weights = arrays.integers("weights", &[total(4)])?;
    let (mut of_vertices, mut cluster_of, mut counts) = (&of_vertices[..], &cluster_of[..], &counts[..]);
    let (mut representative_steps, mut weight_steps) = (&representative_steps[..], &weight_steps[..]);
    let (mut of_columns, mut row_in_block) = (&of_columns[..], &row_in_block[..]);
    let (mut numbers, mut weights) = (&numbers[..], &weights[..]);
    let segment = |(&[segment, vertices, clusters, nonzeros, of_weights], rows): (&[usize; 5], usize)| {
        let in_columns = front(&mut of_columns, rows.div_ceil(BLOCK_ROWS) * columns);
        let (in_rows, numbers) = (front(&mut row_in_block, nonzeros), front(&mut numbers, nonzeros));
        let representatives = SparseRows::from_parts(rows, columns, in_columns, in_rows, numbers);
        Some(CodedSegment {
            segment,
            vertices: front(&mut of_vertices, vertices),
            cluster_of: front(&mut cluster_of, vertices),
            counts: front(&mut counts, clusters),
            representatives: representatives?,
            representative_steps: front(&mut representative_steps, rows),
            weights: front(&mut weights, of_weights),
            weight_steps: front(&mut weight_steps, rows),
        })
    };
    let segments: Option<Vec<CodedSegment>> = sizes.iter().zip(rows).map(segment).collect();
    let segments = segments
        .ok_or_else(|| arrays.refuse("representatives", "numbers other than 0 in order of rows", "other numbers"))?;
    Ok(CodedTransfer { rows: terms, coefficients: COEFFICIENTS, vertices, options, segments })
}

/// Writes a file atomically. Fails with [`WriteError`], of kind [`io::ErrorKind::InvalidInput`] if the parts contradict
/// each other.
pub fn save_all_frequency(file: &AllFrequencyFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_all_frequency(file, out))
}

/// Writes the bytes of a file. Fails with errors of `out`, and with [`io::ErrorKind::InvalidInput`], before anything is
/// written, if the parts contradict each other.
pub fn write_all_frequency(file: &AllFrequencyFile, out: &mut dyn Write) -> io::Result<()> {
    let terms = file.reflectance.terms();
    if let Some(fault) = file.fault(terms) {
        return Err(contradiction(fault));
    }
    let factors = if let Reflectance::Factored(factors) = &file.reflectance { Some(factors) } else { None };
    let sides = |factors: &ProductFactors| [factors.view_map().side(), factors.light_map().side()];
    let code = |coded: &CodedTransfer| Code { segments: coded.segments.len(), options: coded.options };
    let (factor_sides, code) = (factors.map(sides), file.coded.as_ref().map(code));
    let model = file.model.clone();
    let metadata = TransferMetadata { mesh: file.mesh, hats: file.hats, terms, factors: factor_sides, code, model };
    let mut arrays = begin_writing(out, PrtKind::AllFrequency, &metadata)?;
    if let Some(factors) = factors {
        for ((name, side), values) in ["G", "F"].into_iter().zip(sides(factors)).zip(factors.values()) {
            arrays.doubles(name, &[side, side, terms], values.iter())?;
        }
    }
    if let Some(maps) = &file.visibility {
        arrays.words("visibility", &visibility_shape(maps.len()), maps.words())?;
    }
    if let Some(coded) = &file.coded {
        write_coded(coded, &mut arrays)?;
    }
    arrays.finish()
}

fn write_coded(coded: &CodedTransfer, arrays: &mut NpzWriter<'_>) -> io::Result<()> {
    let parts = || coded.segments.iter();
    let sparse = || parts().map(|part| part.representatives.parts());
    let sizes = |part: &CodedSegment| {
        let counts = [part.vertices.len(), part.counts.len(), part.representatives.nonzeros(), part.weights.len()];
        [part.segment, counts[0], counts[1], counts[2], counts[3]].map(|count| count as u32)
    };
    let [vertices, clusters, nonzeros, weights] =
        [1, 2, 3, 4].map(|at: usize| parts().map(|part| sizes(part)[at] as usize).sum::<usize>());
    let rows = parts().map(|part| part.representative_steps.len()).sum();
    let blocks = parts().map(|part| part.representatives.block_count()).sum();
    arrays.integers("segments", &[coded.segments.len(), 5], parts().flat_map(sizes))?;
    arrays.integers("vertices", &[vertices], parts().flat_map(|part| part.vertices.iter().copied()))?;
    arrays.integers("clusters", &[vertices], parts().flat_map(|part| part.cluster_of.iter().copied()))?;
    arrays.integers("representatives", &[clusters], parts().flat_map(|part| part.counts.iter().copied()))?;
    arrays.singles("representative_steps", &[rows], parts().flat_map(|part| &part.representative_steps))?;
    arrays.singles("weight_steps", &[rows], parts().flat_map(|part| &part.weight_steps))?;
    let columns = sparse().flat_map(|(columns, ..)| columns.iter().copied());
    arrays.integers("nonzeros", &[blocks, coded.rows, coded.coefficients], columns)?;
    arrays.integers("rows", &[nonzeros], sparse().flat_map(|(_, rows, _)| rows.iter().copied()))?;
    arrays.integers("numbers", &[nonzeros], sparse().flat_map(|(.., numbers)| numbers.iter().copied()))?;
    arrays.integers("weights", &[weights], parts().flat_map(|part| part.weights.iter().copied()))
}
