//! Reading: nothing is allocated that the bytes at hand do not fill.

use std::fmt::Display;
use std::path::Path;

use glam::DVec3;

use super::{
    ANY_TANGENTS, AXIS_TANGENTS, CLUSTERING, MAGIC, MAX_BYTES, MeshDigest, PrtFile, PrtKind, PrtMeaning, SECTIONS,
    SUPERCLUSTERS, TEXTURE_TANGENTS, TRANSFER, VERSION,
};
use crate::error::{InputError, input_error};
use crate::geom::vector::unit;
use crate::io::read_file;
use crate::transfer::clustering::{AffineSubspace, Clustering};
use crate::transfer::file::other_mesh_error;
use crate::transfer::{Signal, Tangents};

/// Fields of 32 bits between the conventions and the axis of tangents.
const FIELDS: usize = 11;

/// Reads a file; of `mesh`, if one is given.
///
/// # Errors
/// [`InputError`].
pub fn load_prt(path: &Path, mesh: Option<&MeshDigest>) -> Result<PrtFile, InputError> {
    let bytes = bytes_of(path)?;
    let file = parse_prt(&bytes, path)?;
    mesh.map_or(Ok(()), |expected| file.require_mesh(expected, path))?;
    Ok(file)
}

/// All bytes of a file of any kind.
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, InputError> {
    read_file(path, ".prt file", MAX_BYTES)
}

/// Reads a file from bytes; `name` is its name in messages.
///
/// # Errors
/// [`InputError`].
pub fn parse_prt(bytes: &[u8], name: &Path) -> Result<PrtFile, InputError> {
    let mut reader = Reader { bytes, at: 0, name };
    let header = reader.header()?;
    let mut file = PrtFile {
        meaning: header.meaning,
        mesh: header.mesh,
        transfer: None,
        clustering: None,
        superclusters: None,
        provenance: None,
    };
    let dimension = file.meaning.dimension().unwrap_or(usize::MAX);
    let mut left = &SECTIONS[..];
    for _ in 0..header.sections {
        let (tag, mut section) = reader.section()?;
        let Some(at) = left.iter().position(|expected| **expected == tag) else {
            let expected = "\"TRAN\", \"CLUS\", \"SUPR\" and \"MADE\" in this order, each at most once";
            return Err(reader.field("section", expected, format!("{:?}", String::from_utf8_lossy(&tag))));
        };
        left = &left[at + 1..];
        match &tag {
            TRANSFER => file.transfer = Some(section.transfer(header.points, dimension)?),
            CLUSTERING => file.clustering = Some(section.clustering(header.points, dimension)?),
            SUPERCLUSTERS => {
                let clusters = file.clustering.as_ref().map_or(0, |clustering| clustering.subspaces().len());
                file.superclusters = Some(section.integers(clusters, "superclusters")?);
            }
            // The last of them, provenance.
            _ => file.provenance = Some(section.line()?),
        }
        section.end()?;
    }
    reader.end()?;
    match file.fault() {
        Some((field, expected, found)) => Err(reader.field(field, expected, found)),
        None => Ok(file),
    }
}

impl PrtFile {
    /// Refuses a file of another mesh, or of the same with other tangents; `path` is named in the message.
    ///
    /// # Errors
    /// [`InputError`].
    pub fn require_mesh(&self, expected: &MeshDigest, path: &Path) -> Result<(), InputError> {
        match self.mesh {
            Some(found) if found == *expected => Ok(()),
            found => Err(other_mesh_error(path, *expected, found)),
        }
    }
}

struct PrtHeader {
    meaning: PrtMeaning,
    mesh: Option<MeshDigest>,
    points: usize,
    sections: u32,
}

/// Bytes, from a place on. A section's reader ends with the section.
pub(crate) struct Reader<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) at: usize,
    pub(crate) name: &'a Path,
}

impl<'a> Reader<'a> {
    pub(crate) fn field(&self, field: &'static str, expected: impl Display, found: impl Display) -> InputError {
        input_error!("crossbar::prt::field" =>
            "{field}: expected {expected}, found {found}"; help "docs/prt-format.md says what belongs there")
        .at(self.name)
    }

    /// The next `needed` bytes.
    pub(crate) fn take(&mut self, needed: u64, what: &'static str) -> Result<&'a [u8], InputError> {
        let rest = &self.bytes[self.at..];
        match usize::try_from(needed).ok().and_then(|needed| rest.get(..needed)) {
            Some(taken) => {
                self.at += taken.len();
                Ok(taken)
            }
            None => {
                let offset = self.at;
                Err(input_error!("crossbar::prt::truncated" =>
                    "expected {needed} bytes of {what} at {offset}, found {}", rest.len();
                    help "the file is cut; copy or write it again")
                .at(self.name))
            }
        }
    }

    pub(crate) fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], InputError> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N as u64, what)?);
        Ok(bytes)
    }

    pub(crate) fn integer(&mut self, what: &'static str) -> Result<u32, InputError> {
        self.array(what).map(u32::from_le_bytes)
    }

    /// The next `count` numbers of N bytes.
    pub(crate) fn numbers<const N: usize>(
        &mut self,
        count: usize,
        what: &'static str,
    ) -> Result<&'a [[u8; N]], InputError> {
        let bytes = (count as u64).saturating_mul(N as u64);
        Ok(self.take(bytes, what)?.as_chunks().0)
    }

    pub(crate) fn doubles(&mut self, count: usize, what: &'static str) -> Result<Vec<f64>, InputError> {
        Ok(self.numbers(count, what)?.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect())
    }

    pub(crate) fn integers(&mut self, count: usize, what: &'static str) -> Result<Vec<u32>, InputError> {
        Ok(self.numbers(count, what)?.iter().map(|&bytes| u32::from_le_bytes(bytes)).collect())
    }

    /// Compares the checksum that follows with that of all bytes from `first` on.
    pub(crate) fn checksum(&mut self, first: usize, what: &'static str) -> Result<(), InputError> {
        let found = crc32fast::hash(&self.bytes[first..self.at]);
        let expected = self.integer("checksum")?;
        if found == expected {
            return Ok(());
        }
        Err(input_error!("crossbar::prt::checksum" =>
            "{what} at {first}: expected the checksum {expected:08x}, found {found:08x}";
            help "the file is damaged; copy or write it again")
        .at(self.name))
    }

    pub(crate) fn end(&self) -> Result<(), InputError> {
        match self.bytes.len() - self.at {
            0 => Ok(()),
            found => Err(input_error!("crossbar::prt::trailing" =>
                "expected the end of the file at {}, found {found} more bytes", self.at;
                help "the file is damaged; copy or write it again")
            .at(self.name)),
        }
    }

    /// The beginning, up to the conventions, on which the rest of the header depends; returns the version.
    pub(crate) fn begin(&mut self, expected: PrtKind) -> Result<u32, InputError> {
        if !self.bytes.starts_with(MAGIC) {
            return Err(input_error!("crossbar::prt::magic" =>
                "expected a .prt file, found another beginning"; help "is it a .prt file, and copied as one?")
            .at(self.name));
        }
        self.at = MAGIC.len();
        let (version, number) = (self.integer("header")?, self.integer("header")?);
        let most = expected.latest_version();
        let other_version = || {
            input_error!("crossbar::prt::version" =>
                "expected a .prt file of version 1 to {most}, found version {version}";
                help "a newer crossbar has written it: use that one, or write it again")
            .at(self.name)
        };
        if !(VERSION..=PrtKind::LATEST_VERSION).contains(&version) {
            return Err(other_version());
        }
        match PrtKind::from_repr(number) {
            Some(found) if found == expected && version > most => Err(other_version()),
            Some(found) if found == expected => Ok(version),
            Some(found) => Err(input_error!("crossbar::prt::kind" =>
                "expected a file of {expected}, found one of {found}"; help "`crossbar {}` takes it", found.command())
            .at(self.name)),
            None => Err(self.field("conventions", "1 to 3", number.to_string())),
        }
    }

    fn header(&mut self) -> Result<PrtHeader, InputError> {
        self.begin(PrtKind::LowFrequency)?;
        let mut fields = [0; FIELDS];
        for field in &mut fields {
            *field = self.integer("header")?;
        }
        let [channels, rows, columns, albedo, points, sections, digest @ .., tangents] = fields;
        let axis = self.doubles(3, "axis of tangents")?;
        let exit_functions = self.numbers(rows as usize, "exit functions")?;
        let exit_functions: Vec<u16> = exit_functions.iter().map(|&bytes| u16::from_le_bytes(bytes)).collect();
        self.checksum(0, "the header")?;
        // Unused fields are 0, so that equal contents have equal bytes.
        let (matrix, of_mesh) = (u32::from(channels > 0), u32::from(tangents > 0));
        let fields = [
            ("number of exit functions", rows, 0..=matrix * u32::MAX),
            ("albedo", albedo, 0..=matrix),
            ("tangents", tangents, 0..=AXIS_TANGENTS),
            ("mesh's digest", digest.iter().copied().max().unwrap_or(0), 0..=of_mesh * u32::MAX),
            ("number of sections", sections, 1..=SECTIONS.len() as u32),
        ];
        for (field, found, expected) in fields {
            if !expected.contains(&found) {
                return Err(self.field(
                    field,
                    format!("{} to {}", expected.start(), expected.end()),
                    found.to_string(),
                ));
            }
        }
        let tangents = self.tangents(tangents, DVec3::from_slice(&axis))?;
        let [vertices, triangles, vertex_crc, triangle_crc] = digest;
        let mesh = tangents.map(|tangents| MeshDigest { tangents, vertices, triangles, vertex_crc, triangle_crc });
        let meaning = match channels {
            0 => PrtMeaning::Numbers { dimension: columns },
            _ => PrtMeaning::Transfer { channels, exit_functions, light_order: columns, includes_albedo: albedo == 1 },
        };
        Ok(PrtHeader { meaning, mesh, points: points as usize, sections })
    }

    /// The source of the tangents; `None` without a mesh.
    pub(crate) fn tangents(&self, number: u32, axis: DVec3) -> Result<Option<Tangents>, InputError> {
        let is_axis = number == AXIS_TANGENTS;
        let is_used = axis.to_array().iter().any(|value| value.to_bits() != 0);
        if is_used != is_axis || (is_axis && unit(axis).is_none()) {
            let expected = if is_axis { "a finite length above 0" } else { "zeros" };
            return Err(self.field("axis of tangents", expected, Tangents::Along(axis).to_string()));
        }
        Ok(match number {
            ANY_TANGENTS => Some(Tangents::Any),
            TEXTURE_TANGENTS => Some(Tangents::Texture),
            AXIS_TANGENTS => Some(Tangents::Along(axis)),
            _ => None,
        })
    }

    /// The next section, its checksum compared.
    pub(crate) fn section(&mut self) -> Result<([u8; 4], Self), InputError> {
        let first = self.at;
        let tag = self.array("section")?;
        let length = u64::from_le_bytes(self.array("section")?);
        let begin = self.at;
        self.take(length, "section")?;
        let end = self.at;
        self.checksum(first, "a section")?;
        Ok((tag, Self { bytes: &self.bytes[..end], at: begin, name: self.name }))
    }

    /// The rest of a section, as text.
    fn line(&mut self) -> Result<String, InputError> {
        let bytes = self.take((self.bytes.len() - self.at) as u64, "provenance")?;
        let text = std::str::from_utf8(bytes).map_err(|_| self.field("provenance", "UTF-8", "other bytes"))?;
        Ok(text.to_owned())
    }

    fn transfer(&mut self, points: usize, dimension: usize) -> Result<Signal, InputError> {
        let values = self.numbers(points.saturating_mul(dimension), "transfer")?;
        let values = values.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        Signal::new(dimension, values)
            .map_err(|reason| input_error!("crossbar::prt::transfer" => "{reason}").at(self.name))
    }

    fn clustering(&mut self, points: usize, dimension: usize) -> Result<Clustering, InputError> {
        let clusters = self.integer("number of clusters")? as usize;
        let counts = self.integers(clusters, "numbers of vectors")?;
        let mut subspaces = Vec::new();
        for &count in &counts {
            subspaces.push(AffineSubspace {
                mean: self.doubles(dimension, "mean")?,
                eigenvalues: self.doubles(count as usize, "eigenvalues")?,
                vectors: self.doubles((count as usize).saturating_mul(dimension), "vectors")?,
            });
        }
        let of_point = self.integers(points, "clusters of points")?;
        let count = |&cluster: &u32| counts.get(cluster as usize).map_or(0, |&count| count as usize);
        let weights = of_point.iter().map(count).fold(0, usize::saturating_add);
        let weights = self.doubles(weights, "weights")?;
        Clustering::new(subspaces, of_point, weights)
            .map_err(|reason| input_error!("crossbar::prt::clustering" => "{reason}").at(self.name))
    }
}
