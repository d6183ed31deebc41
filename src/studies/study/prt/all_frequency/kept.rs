//! Finished segments of a compression in a folder, so that one that was stopped goes on where it was.
//!
//! `work.json` says what is compressed and how; `segment-07.prt` is the code of a segment, a file of conventions 2 with
//! that segment alone, and `segment-07.json` what became of it. A segment is finished where the latter is.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use serde::{Deserialize, Serialize};

use super::tally::SegmentTally;
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodedSegment, CodedTransfer};
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency, save_all_frequency};
use crate::io::{WriteError, write_file};
use crate::study::StudyError;
use crate::transfer::file::MeshDigest;
use crate::transfer::linear_basis::BasisWidth;

/// Code of the errors.
const CODE: &str = "crossbar::prt::kept";

/// A folder of finished segments.
#[derive(Debug)]
pub struct KeptSegments {
    folder: PathBuf,
    mesh: MeshDigest,
    work: Work,
}

/// Settings of the work that the segments belong to, by name.
type Work = BTreeMap<String, String>;

/// Result for a segment; none where all of its transfer is 0.
#[derive(Debug, Serialize, Deserialize)]
struct FinishedSegment(Option<SegmentRecord>);

/// Sums stand as text, which is read back to the same bits.
#[derive(Debug, Serialize, Deserialize)]
struct SegmentRecord {
    squares: String,
    squared_error: String,
    coded_squared_error: String,
    seconds: [f64; 3],
}

impl KeptSegments {
    /// Makes the folder, or takes one with segments of the same mesh and `settings`: names and
    /// what they are set to.
    ///
    /// # Errors
    /// If the folder cannot be used, or has segments of other work or a damaged one.
    pub fn open(
        folder: &Path,
        mesh: MeshDigest,
        settings: impl IntoIterator<Item = (&'static str, String)>,
    ) -> Result<Self, StudyError> {
        let work: Work = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        fs::create_dir_all(folder).map_err(|source| unusable(folder, source))?;
        let kept = Self { folder: folder.to_owned(), mesh, work };
        let path = folder.join("work.json");
        let Some(found) = read_json::<Work>(&path, "the settings of a compression")? else {
            write_json(&path, &kept.work)?;
            return Ok(kept);
        };
        let names = kept.work.keys().chain(found.keys());
        match names.into_iter().find(|&name| kept.work.get(name) != found.get(name)) {
            None => Ok(kept),
            Some(name) => {
                let of = |work: &Work| work.get(name).cloned().unwrap_or_else(|| "not set".to_owned());
                let (expected, found) = (of(&kept.work), of(&found));
                let what = format!("{}: expected segments with {name} {expected}, found {found}", path.display());
                let help = "compress with the options of the first run, or name another folder";
                Err(StudyError::new(CODE, what).with_help(help))
            }
        }
    }

    /// A finished segment: its code, unless its transfer is 0 everywhere.
    ///
    /// # Errors
    /// If the folder cannot be used, or has segments of other work or a damaged one.
    pub(super) fn load(&self, segment: usize) -> Result<Option<Option<(CodedSegment, SegmentTally)>>, StudyError> {
        let path = self.path(segment, "json");
        let Some(FinishedSegment(record)) = read_json(&path, "what became of a segment")? else { return Ok(None) };
        let Some(record) = record else { return Ok(Some(None)) };
        let code_path = self.path(segment, "prt");
        let found = load_all_frequency(&code_path, Some(&self.mesh))?;
        let mut segments = found.coded.map_or_else(Vec::new, |coded| coded.segments);
        let code = segments.pop().filter(|code| code.segment == segment && segments.is_empty());
        let Some(code) = code else {
            return Err(damaged(&code_path, "the code of one segment"));
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| damaged(&path, "numbers for the sums of squares"));
        let tally = SegmentTally {
            segment,
            vertices: code.vertices.len(),
            clusters: code.counts.len(),
            squares: number(&record.squares)?,
            squared_error: number(&record.squared_error)?,
            coded_squared_error: number(&record.coded_squared_error)?,
            seconds: record.seconds,
        };
        Ok(Some(Some((code, tally))))
    }

    /// Keeps a segment whose transfer is 0 everywhere.
    ///
    /// # Errors
    /// If the folder cannot be written to.
    pub(super) fn keep_empty(&self, segment: usize) -> Result<(), StudyError> {
        write_json(&self.path(segment, "json"), &FinishedSegment(None))
    }

    /// Keeps a segment; `coded` has it alone.
    ///
    /// # Errors
    /// If the folder cannot be written to.
    pub(super) fn keep(
        &self,
        tally: &SegmentTally,
        (hats, reflectance): (BasisWidth, &Reflectance),
        coded: CodedTransfer,
    ) -> Result<(), StudyError> {
        let (mesh, reflectance) = (self.mesh, reflectance.clone());
        let file = AllFrequencyFile { mesh, hats, reflectance, visibility: None, coded: Some(coded) };
        save_all_frequency(&file, &self.path(tally.segment, "prt")).map_err(unwritable)?;
        let record = SegmentRecord {
            squares: tally.squares.to_string(),
            squared_error: tally.squared_error.to_string(),
            coded_squared_error: tally.coded_squared_error.to_string(),
            seconds: tally.seconds,
        };
        write_json(&self.path(tally.segment, "json"), &FinishedSegment(Some(record)))
    }

    fn path(&self, segment: usize, ending: &str) -> PathBuf {
        self.folder.join(format!("segment-{segment:02}.{ending}"))
    }
}

/// Reads a JSON file, if there is one.
fn read_json<T: for<'a> Deserialize<'a>>(path: &Path, expected: &'static str) -> Result<Option<T>, StudyError> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(unusable(path, source)),
    };
    serde_json::from_slice(&bytes).map(Some).map_err(|_| damaged(path, expected))
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<(), StudyError> {
    write_file(path, |out| serde_json::to_writer_pretty(out, value).map_err(io::Error::from)).map_err(unwritable)
}

/// Error of a folder that cannot be created, or of a file in it that cannot be read.
fn unusable(path: &Path, source: io::Error) -> StudyError {
    let error = StudyError::new(CODE, format!("cannot use {}", path.display())).with_source(source);
    error.with_help("name another folder for finished segments")
}

/// Error of a file that is not what was written there.
fn damaged(path: &Path, expected: &str) -> StudyError {
    let what = format!("{}: expected {expected}, found something else", path.display());
    StudyError::new(CODE, what).with_help("delete the file, and its segment is computed again")
}

/// Error of a folder that cannot be written to.
fn unwritable(error: WriteError) -> StudyError {
    StudyError::coded(CODE, error).with_help("free some space, or name another folder")
}
