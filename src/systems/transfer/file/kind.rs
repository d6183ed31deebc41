//! The metadata of a file: its system, and information that its arrays do not contain.

use std::io;
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::MAX_BYTES;
use crate::error::{InputError, input_error};
use crate::io::{NpzReader, NpzWriter, read_file};

/// Format version, the same for all kinds of files.
const VERSION: u32 = 1;
/// Name of the array of metadata, JSON in UTF-8.
const METADATA: &str = "metadata";

/// The system that a file of transfer belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PrtKind {
    /// [`PrtFile`](super::PrtFile): real orthonormal harmonics, function l(l+1)+m, no Condon-Shortley sign (l = 1 is y,
    /// z, x), light in the mesh's axes, exit radiance in the vertex's local axes with the normal as z.
    #[strum(to_string = "low-frequency transfer")]
    LowFrequency,
    /// [`AllFrequencyFile`](crate::all_frequency::file::AllFrequencyFile).
    #[strum(to_string = "transfer of all frequencies")]
    AllFrequency,
    /// [`BiScaleFile`](crate::bi_scale::file::BiScaleFile).
    #[strum(to_string = "bi-scale transfer")]
    BiScale,
}

impl PrtKind {
    /// The command that reads such files.
    pub const fn command(self) -> &'static str {
        match self {
            Self::LowFrequency => "cpca",
            Self::AllFrequency => "all-frequency",
            Self::BiScale => "bi-scale",
        }
    }
}

/// The fields that all metadata begin with.
#[derive(Serialize, Deserialize)]
struct Head {
    kind: PrtKind,
    version: u32,
}

#[derive(Serialize)]
struct Metadata<'a, T> {
    #[serde(flatten)]
    head: Head,
    #[serde(flatten)]
    rest: &'a T,
}

/// All bytes of a file of any kind.
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, InputError> {
    read_file(path, ".npz file", MAX_BYTES)
}

/// The arrays and the metadata of a file of this kind.
pub(crate) fn begin_reading<'a, T: DeserializeOwned>(
    bytes: &'a [u8],
    name: &'a Path,
    expected: PrtKind,
) -> Result<(NpzReader<'a>, T), InputError> {
    let mut arrays = NpzReader::new(bytes, name)?;
    let json = arrays.bytes(METADATA)?;
    let invalid =
        |error: serde_json::Error| arrays.refuse(METADATA, "JSON as described in docs/npz.md", error.to_string());
    let Head { kind, version } = serde_json::from_slice(json).map_err(invalid)?;
    if kind != expected {
        return Err(input_error!("crossbar::prt::kind" =>
            "expected a file of {expected}, found one of {kind}"; help "`crossbar {}` reads it", kind.command())
        .at(name));
    }
    if version != VERSION {
        return Err(arrays.refuse("version", VERSION.to_string(), version.to_string()));
    }
    let rest = serde_json::from_slice(json).map_err(invalid)?;
    Ok((arrays, rest))
}

/// Begins a file of this kind with its metadata.
pub(crate) fn begin_writing<'a>(
    out: &'a mut dyn io::Write,
    kind: PrtKind,
    rest: &impl Serialize,
) -> io::Result<NpzWriter<'a>> {
    let mut arrays = NpzWriter::new(out);
    let metadata = Metadata { head: Head { kind, version: VERSION }, rest };
    arrays.bytes(METADATA, &serde_json::to_vec(&metadata)?)?;
    Ok(arrays)
}

/// The error for inconsistent contents, before anything is written.
pub(crate) fn contradiction((field, expected, found): (&str, String, String)) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, format!("{field}: expected {expected}, found {found}"))
}
