//! Finished segments of a compression in a folder, so that one that was stopped goes on where it was.
//!
//! `work.json` says what is compressed and how; `segment-07.prt` is the code of a segment, a file of conventions 2 with
//! that segment alone, and `segment-07.json` what became of it. A segment is finished where the latter is.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use miette::Diagnostic;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::tally::SegmentTally;
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodedSegment, CodedTransfer};
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency, save_all_frequency};
use crate::io::{WriteError, write_file};
use crate::transfer::file::{MeshDigest, PrtFileError};
use crate::transfer::hats::HatWidth;

/// A folder of finished segments.
#[derive(Debug)]
pub struct KeptSegments {
    folder: PathBuf,
    mesh: MeshDigest,
    work: Work,
}

/// What the segments belong to: names of settings, and the settings.
type Work = BTreeMap<String, String>;

/// What became of a segment: nothing where all of its transfer is 0.
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

/// Why finished segments cannot be kept or taken.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
pub enum KeptSegmentsError {
    /// The folder cannot be made, or a file in it not read.
    #[error("cannot use {}", path.display())]
    #[diagnostic(code(crossbar::prt::kept), help("name another folder for finished segments"))]
    Unusable {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The segments are of other transfer, or were made by other options.
    #[error("{}: expected segments with {setting} {expected}, found {found}", path.display())]
    #[diagnostic(code(crossbar::prt::kept), help("compress with the options of the first run, or name another folder"))]
    OtherWork {
        /// The file that says so.
        path: PathBuf,
        /// What differs.
        setting: String,
        /// What is asked for.
        expected: String,
        /// What the folder has.
        found: String,
    },
    /// A file in the folder is not what was written there.
    #[error("{}: expected {expected}, found something else", path.display())]
    #[diagnostic(code(crossbar::prt::kept), help("delete the file, and its segment is computed again"))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What belongs there.
        expected: &'static str,
    },
    /// The same, of the code.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] PrtFileError),
    /// The folder cannot be written to.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::kept), help("free some space, or name another folder"))]
    Write(#[from] WriteError),
}

impl KeptSegments {
    /// Makes the folder, or takes one with segments of the same mesh and `settings`: names and
    /// what they are set to.
    ///
    /// # Errors
    /// [`KeptSegmentsError`].
    pub fn open(
        folder: &Path,
        mesh: MeshDigest,
        settings: impl IntoIterator<Item = (&'static str, String)>,
    ) -> Result<Self, KeptSegmentsError> {
        let work: Work = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        fs::create_dir_all(folder).map_err(|source| KeptSegmentsError::Unusable { path: folder.to_owned(), source })?;
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
                Err(KeptSegmentsError::OtherWork { path, setting: name.clone(), expected, found })
            }
        }
    }

    /// A finished segment: its code, unless its transfer is 0 everywhere.
    ///
    /// # Errors
    /// [`KeptSegmentsError`].
    pub(super) fn load(
        &self,
        segment: usize,
    ) -> Result<Option<Option<(CodedSegment, SegmentTally)>>, KeptSegmentsError> {
        let path = self.path(segment, "json");
        let Some(FinishedSegment(record)) = read_json(&path, "what became of a segment")? else { return Ok(None) };
        let Some(record) = record else { return Ok(Some(None)) };
        let code_path = self.path(segment, "prt");
        let found = load_all_frequency(&code_path, Some(&self.mesh))?;
        let mut segments = found.coded.map_or_else(Vec::new, |coded| coded.segments);
        let code = segments.pop().filter(|code| code.segment == segment && segments.is_empty());
        let Some(code) = code else {
            return Err(KeptSegmentsError::Damaged { path: code_path, expected: "the code of one segment" });
        };
        let number = |text: &str| {
            text.parse::<f64>().map_err(|_| KeptSegmentsError::Damaged {
                path: path.clone(),
                expected: "numbers for the sums of squares",
            })
        };
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
    /// [`KeptSegmentsError::Write`].
    pub(super) fn keep_empty(&self, segment: usize) -> Result<(), KeptSegmentsError> {
        write_json(&self.path(segment, "json"), &FinishedSegment(None))
    }

    /// Keeps a segment; `coded` has it alone.
    ///
    /// # Errors
    /// [`KeptSegmentsError::Write`].
    pub(super) fn keep(
        &self,
        tally: &SegmentTally,
        (hats, reflectance): (HatWidth, &Reflectance),
        coded: CodedTransfer,
    ) -> Result<(), KeptSegmentsError> {
        let (mesh, reflectance) = (self.mesh, reflectance.clone());
        let file = AllFrequencyFile { mesh, hats, reflectance, visibility: None, coded: Some(coded) };
        save_all_frequency(&file, &self.path(tally.segment, "prt"))?;
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

/// What a file holds, if there is one.
fn read_json<T: for<'a> Deserialize<'a>>(path: &Path, expected: &'static str) -> Result<Option<T>, KeptSegmentsError> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(KeptSegmentsError::Unusable { path: path.to_owned(), source }),
    };
    let damaged = || KeptSegmentsError::Damaged { path: path.to_owned(), expected };
    serde_json::from_slice(&bytes).map(Some).map_err(|_| damaged())
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<(), KeptSegmentsError> {
    Ok(write_file(path, |out| serde_json::to_writer_pretty(out, value).map_err(io::Error::from))?)
}
