//! The file of a part.
//!
//! Layout: a line with the version, a line of JSON ([`PartHeader`]), the results in postcard's encoding, and the 32
//! bytes of the SHA-256 of everything before. Numbers keep all their bits.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::number::PartNumber;
use crate::error::{InputError, ensure, input_error};
use crate::io::{WriteError, files_read, write_file};
use crate::report::sha256;

/// The first line, without the version.
const MAGIC: &str = "crossbar part, version ";
/// The version of the layout.
const VERSION: u32 = 1;
/// Bytes of the digest at the end.
const DIGEST: usize = 32;

/// The command that is split, and the program version that runs it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SplitCommand {
    /// The program: version, and commit or digest.
    pub program: String,
    /// The arguments without the program's name: with defaults filled in, and without `--part`, `--out` and other
    /// options that change no result.
    pub arguments: Vec<String>,
}

impl SplitCommand {
    /// The command as a line.
    pub fn line(&self) -> String {
        format!("crossbar {}", self.arguments.join(" "))
    }
}

/// Description of a part: its run, and its position in the run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartHeader {
    /// The command.
    pub command: SplitCommand,
    /// Number of this part, and total number of parts.
    pub part: PartNumber,
    /// The SHA-256 of every input file, by its path as opened.
    pub inputs: BTreeMap<String, String>,
    /// Noun for the items that are split, in the plural.
    pub items: String,
    /// Number of items in all parts.
    pub count: u64,
    /// Length of this part's results in the file.
    bytes: u64,
}

impl PartHeader {
    /// Creates a header for results that are not encoded yet.
    pub(super) fn new(
        command: SplitCommand,
        part: PartNumber,
        inputs: BTreeMap<String, String>,
        (items, count): (&str, usize),
    ) -> Self {
        Self { command, part, inputs, items: items.to_owned(), count: count as u64, bytes: 0 }
    }

    /// Returns `true` if both headers describe the same results.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        Self { bytes: 0, ..self.clone() } == Self { bytes: 0, ..other.clone() }
    }

    /// Writes a part atomically, and returns the length of the file.
    pub(super) fn write(mut self, results: &[u8], path: &Path) -> Result<u64, InputError> {
        self.bytes = results.len() as u64;
        let mut head = format!("{MAGIC}{VERSION}\n").into_bytes();
        // Strings and numbers always encode.
        serde_json::to_writer(&mut head, &self).map_err(|reason| unreadable(path, reason.into()))?;
        head.push(b'\n');
        let digest = Sha256::new().chain_update(&head).chain_update(results).finalize();
        write_file(path, |file: &mut dyn io::Write| {
            file.write_all(&head)?;
            file.write_all(results)?;
            file.write_all(&digest)
        })
        .map_err(unwritable)?;
        Ok((head.len() + results.len() + DIGEST) as u64)
    }

    /// Reads a part, and checks its digest; returns its header, and its results, still encoded. Fails if it cannot be
    /// read, is not a part, or was changed.
    pub(super) fn read(path: &Path) -> Result<(Self, Vec<u8>), InputError> {
        let mut bytes = fs::read(path).map_err(|source| unreadable(path, source))?;
        let wrong = |found: String, help| InputError::new("crossbar::part::file", found).at(path).with_help(help);
        let other = || {
            let found = "expected a part that `--part` wrote, found another file".to_owned();
            wrong(found, "name the files that `--part K/N --out FILE` wrote")
        };
        let mut lines = bytes.splitn(3, |&byte| byte == b'\n');
        let (Some(first), Some(second)) = (lines.next(), lines.next()) else { return Err(other()) };
        let version = first.strip_prefix(MAGIC.as_bytes()).ok_or_else(other)?;
        if version != VERSION.to_string().as_bytes() {
            let found: String = String::from_utf8_lossy(version).chars().take(20).collect();
            let found = format!("expected a part file of version {VERSION}, found version {found}");
            return Err(wrong(found, "compute the part again with this program"));
        }
        let digested = |bytes: &[u8]| {
            let (contents, digest) = bytes.split_at(bytes.len().saturating_sub(DIGEST));
            Sha256::digest(contents).as_slice() == digest
        };
        let damaged = || damaged(path);
        // The length in a damaged header cannot be trusted.
        let header: Self = serde_json::from_slice(second).map_err(|_| damaged())?;
        let start = (first.len() + second.len() + 2) as u64;
        let (expected, found) = (start.saturating_add(header.bytes).saturating_add(DIGEST as u64), bytes.len() as u64);
        if found != expected {
            let help = "the file is truncated, or something was appended: copy it again, or compute the part again";
            return Err(wrong(format!("expected {expected} bytes, found {found}"), help));
        }
        let part = header.part;
        if !digested(&bytes) || PartNumber::new(part.number(), part.of()).is_none() {
            return Err(damaged());
        }
        bytes.truncate(bytes.len() - DIGEST);
        bytes.drain(..start as usize);
        Ok((header, bytes))
    }
}

/// The digests of all files that were read so far, by their paths. Fails if input cannot be read a second time, or a
/// name is not UTF-8.
pub(super) fn inputs_read() -> Result<BTreeMap<String, String>, InputError> {
    let digest = |path: std::path::PathBuf| {
        let name = path.to_str().ok_or_else(|| not_utf8(path.as_os_str()))?;
        // Opening a pipe would wait for its writer.
        ensure!(
            path.is_file(), "crossbar::part::input" =>
            "expected input from files, found {}, which cannot be read a second time", path.display();
            help "save it to a file: a part holds the digests of its input"
        );
        let digest = File::open(&path).and_then(sha256).map_err(|source| unreadable(&path, source))?;
        Ok((name.to_owned(), digest))
    };
    files_read().into_iter().map(digest).collect()
}

/// Error for an argument or a path that a part cannot hold.
pub fn not_utf8(found: &OsStr) -> InputError {
    input_error!("crossbar::part::input" => "expected names and values in UTF-8, found {}", found.display();
        help "give the file another name")
}

/// Error for contents that do not match their digest.
pub(super) fn damaged(path: &Path) -> InputError {
    let found = "the contents do not have the SHA-256 at the end of the file";
    let help = "the file was damaged or edited: copy it again, or compute the part again";
    InputError::new("crossbar::part::file", found).at(path).with_help(help)
}

/// Error for a file that cannot be read.
pub fn unreadable(path: &Path, source: io::Error) -> InputError {
    input_error!("crossbar::part::unreadable" => "cannot read {}", path.display()).with_source(source)
}

/// Error for a part's file that cannot be written; no incomplete file remains.
pub(super) fn unwritable(error: WriteError) -> InputError {
    InputError::of("crossbar::part::unwritable", error)
}
