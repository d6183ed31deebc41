//! Writing.

use std::io::{self, Write};
use std::path::Path;

use super::{
    ANY_TANGENTS, AXIS_TANGENTS, CLUSTERING, MAGIC, MeshDigest, PrtFile, PrtKind, PrtMeaning, TEXTURE_TANGENTS,
    TRANSFER, VERSION,
};
use crate::io::{WriteError, write_file};
use crate::transfer::clustering::{AffineSubspace, Clustering};
use crate::transfer::{Signal, Tangents};

/// Writes a file completely or not at all.
///
/// # Errors
/// [`WriteError`]; with an [`io::ErrorKind::InvalidInput`] if the parts contradict each other.
pub fn save_prt(file: &PrtFile, path: &Path) -> Result<(), WriteError> {
    write_file(path, |out| write_prt(file, out))
}

/// Writes the bytes of a file.
///
/// # Errors
/// Those of `out`; [`io::ErrorKind::InvalidInput`], before anything is written, if the parts contradict each other.
pub fn write_prt(file: &PrtFile, out: &mut dyn Write) -> io::Result<()> {
    if let Some((field, expected, found)) = file.fault() {
        let message = format!("{field}: expected {expected}, found {found}");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    out.write_all(&header(file))?;
    if let Some(transfer) = &file.transfer {
        let mut section = Section::begin(out, TRANSFER, 4 * transfer.values().len() as u64)?;
        write_transfer(transfer, &mut section)?;
        section.end()?;
    }
    if let Some(clustering) = &file.clustering {
        let mut section = Section::begin(out, CLUSTERING, clustering_length(clustering))?;
        write_clustering(clustering, &mut section)?;
        section.end()?;
    }
    Ok(())
}

fn header(file: &PrtFile) -> Vec<u8> {
    let (channels, functions, columns, albedo) = match &file.meaning {
        PrtMeaning::Numbers { dimension } => (0, &[][..], *dimension, 0),
        PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo } => {
            (*channels, &exit_functions[..], *light_order, u32::from(*includes_albedo))
        }
    };
    let sections = u32::from(file.transfer.is_some()) + u32::from(file.clustering.is_some());
    let digest = file.mesh.map_or([0; 4], digest_fields);
    let (tangents, axis) = file.mesh.map_or((0, [0.0; 3]), |mesh| tangent_fields(mesh.tangents));
    let fields = [
        [VERSION, PrtKind::LowFrequency as u32, channels, functions.len() as u32],
        [columns, albedo, file.points() as u32, sections],
        digest,
    ];
    let mut bytes = MAGIC.to_vec();
    bytes.extend(fields.as_flattened().iter().chain([&tangents]).flat_map(|field| field.to_le_bytes()));
    bytes.extend(axis.iter().flat_map(|value| value.to_le_bytes()));
    bytes.extend(functions.iter().flat_map(|function| function.to_le_bytes()));
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

pub(crate) fn digest_fields(mesh: MeshDigest) -> [u32; 4] {
    [mesh.vertices, mesh.triangles, mesh.vertex_crc, mesh.triangle_crc]
}

/// The number of tangents, and their axis.
pub(crate) fn tangent_fields(tangents: Tangents) -> (u32, [f64; 3]) {
    match tangents {
        Tangents::Any => (ANY_TANGENTS, [0.0; 3]),
        Tangents::Texture => (TEXTURE_TANGENTS, [0.0; 3]),
        Tangents::Along(axis) => (AXIS_TANGENTS, axis.to_array()),
    }
}

fn write_transfer(transfer: &Signal, section: &mut Section<'_>) -> io::Result<()> {
    section.write_all(transfer.values().iter().map(|value| value.to_le_bytes()))
}

fn clustering_length(clustering: &Clustering) -> u64 {
    let of_cluster = |s: &AffineSubspace| 4 + 8 * (s.mean.len() + s.len() + s.vectors.len()) as u64;
    let clusters: u64 = clustering.subspaces().iter().map(of_cluster).sum();
    4 + clusters + 4 * clustering.points() as u64 + 8 * clustering.all_weights().len() as u64
}

fn write_clustering(clustering: &Clustering, section: &mut Section<'_>) -> io::Result<()> {
    section.write(&(clustering.subspaces().len() as u32).to_le_bytes())?;
    section.write_all(clustering.subspaces().iter().map(|subspace| (subspace.len() as u32).to_le_bytes()))?;
    for subspace in clustering.subspaces() {
        let numbers = subspace.mean.iter().chain(&subspace.eigenvalues).chain(&subspace.vectors);
        section.write_all(numbers.map(|value| value.to_le_bytes()))?;
    }
    section.write_all(clustering.of_point().iter().map(|cluster| cluster.to_le_bytes()))?;
    section.write_all(clustering.all_weights().iter().map(|weight| weight.to_le_bytes()))
}

/// Numbers that are written at a time.
const BUFFERED: usize = 1 << 14;

/// A part with its length before and its checksum behind it.
pub(crate) struct Section<'a> {
    out: &'a mut dyn Write,
    crc: crc32fast::Hasher,
}

impl<'a> Section<'a> {
    pub(crate) fn begin(out: &'a mut dyn Write, tag: &[u8; 4], length: u64) -> io::Result<Self> {
        let mut section = Self { out, crc: crc32fast::Hasher::new() };
        section.write(tag)?;
        section.write(&length.to_le_bytes())?;
        Ok(section)
    }

    pub(crate) fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.crc.update(bytes);
        self.out.write_all(bytes)
    }

    /// Writes numbers, many at a time.
    pub(crate) fn write_all<const N: usize>(&mut self, mut numbers: impl Iterator<Item = [u8; N]>) -> io::Result<()> {
        loop {
            let some: Vec<u8> = numbers.by_ref().take(BUFFERED).flatten().collect();
            if some.is_empty() {
                return Ok(());
            }
            self.write(&some)?;
        }
    }

    pub(crate) fn end(self) -> io::Result<()> {
        self.out.write_all(&self.crc.finalize().to_le_bytes())
    }
}
