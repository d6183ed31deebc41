//! The one place where a command's items are computed, divided, or read from parts.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::file::{PartHeader, SplitCommand, damaged, inputs_read, unwritable};
use super::number::PartNumber;
use super::set::{self, PartSet};
use crate::error::{InputError, input_error};
use crate::io::FileSet;

/// Results of consecutive items, which are stored without loss of bits and joined in order.
pub trait Concatenate: Serialize + DeserializeOwned {
    /// Returns `true` for complete results of the items of a range. A wrong part is rejected, not merged.
    fn are_of(&self, range: &Range<usize>) -> bool;

    /// Appends the results of the next items.
    fn append(&mut self, next: Self);
}

impl<T: Serialize + DeserializeOwned> Concatenate for Vec<T> {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.len() == range.len()
    }

    fn append(&mut self, next: Self) {
        self.extend(next);
    }
}

/// How a command's items are computed: all, only a part, or read from parts.
#[derive(Clone, Debug, Default)]
pub enum SplitRun {
    /// Computes all items.
    #[default]
    Whole,
    /// Computes the items of a part, and writes them to a file.
    Part {
        /// The part.
        part: PartNumber,
        /// The command, which is divided into parts.
        command: SplitCommand,
        /// The file.
        path: PathBuf,
    },
    /// Computes nothing: reads the results of these parts.
    Merge(PartSet),
}

/// A part that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenPart {
    /// Number of this part, and total number of parts.
    pub part: PartNumber,
    /// Noun for the items that are split, in the plural.
    pub items: &'static str,
    /// Number of items in all parts.
    pub count: usize,
    /// The items of this part.
    pub range: Range<usize>,
    /// The file.
    pub path: PathBuf,
    /// Length of the file, in bytes.
    pub bytes: u64,
}

/// Results of all items, or the part that was computed and written.
#[derive(Clone, Debug)]
pub enum Computed<T> {
    /// Results of all items; the command continues.
    Whole(T),
    /// The part that was written; the command ends.
    Part(WrittenPart),
}

impl<T> Computed<T> {
    /// Continues with the results of all items. Fails if `then` does.
    pub fn and_then<U, E>(self, then: impl FnOnce(T) -> Result<U, E>) -> Result<Computed<U>, E> {
        match self {
            Self::Whole(results) => then(results).map(Computed::Whole),
            Self::Part(written) => Ok(Computed::Part(written)),
        }
    }

    /// Results of an ordinary run or of a merge. Panics if a part was computed.
    pub fn whole(self) -> T {
        match self {
            Self::Whole(results) => results,
            Self::Part(written) => panic!("expected a run as a whole, found part {}", written.part),
        }
    }
}

impl SplitRun {
    /// Like [`Self::compute`], for commands that compute items as they need them: `None` in an ordinary run. Fails as
    /// [`Self::compute`] does.
    pub fn known<T: Concatenate, E: From<InputError>>(
        &self,
        items: &'static str,
        count: usize,
        compute: impl FnOnce(Range<usize>) -> Result<T, E>,
    ) -> Result<Computed<Option<T>>, E> {
        match self {
            Self::Whole => Ok(Computed::Whole(None)),
            _ => self.compute(items, count, compute)?.and_then(|known| Ok(Some(known))),
        }
    }

    /// Returns `true` if only a part is computed, without the command's own results.
    pub fn is_part(&self) -> bool {
        matches!(self, Self::Part { .. })
    }

    /// Computes `count` items by `compute`, which receives a range of them. A part computes only its range, and writes
    /// the results; a merge reads all results from parts. The result must depend only on the item and on earlier input.
    /// A command calls this once. Fails as `compute` does, and if a part cannot be written or parts do not fit.
    pub fn compute<T: Concatenate, E: From<InputError>>(
        &self,
        items: &'static str,
        count: usize,
        compute: impl FnOnce(Range<usize>) -> Result<T, E>,
    ) -> Result<Computed<T>, E> {
        match self {
            Self::Whole => compute(0..count).map(Computed::Whole),
            Self::Merge(parts) => Ok(Computed::Whole(merged(parts, items, count)?)),
            Self::Part { part, command, path } => {
                let header = PartHeader::new(command.clone(), *part, inputs_read()?, (items, count));
                require_writable(path)?;
                let range = part.range(count);
                let results = compute(range.clone())?;
                let bytes = postcard::to_stdvec(&results).map_err(|_| other_contents(path, items, range.len()))?;
                drop(results);
                let bytes = header.write(&bytes, path)?;
                let written = WrittenPart { part: *part, items, count, range, path: path.clone(), bytes };
                Ok(Computed::Part(written))
            }
        }
    }
}

/// Checks, before long work, that a file can be written.
fn require_writable(path: &Path) -> Result<(), InputError> {
    match path.parent() {
        // A device or a pipe is written directly, without a temporary file.
        Some(folder) if path.is_file() || !path.exists() => FileSet::new(folder).map(drop).map_err(unwritable),
        _ => Ok(()),
    }
}

fn merged<T: Concatenate>(parts: &PartSet, items: &'static str, count: usize) -> Result<T, InputError> {
    parts.check_inputs(&inputs_read()?)?;
    let mut whole: Option<T> = None;
    for (path, opened) in parts.parts() {
        let (header, bytes) = PartHeader::read(path)?;
        // The file may have been replaced since the set was opened.
        if header != *opened {
            return Err(damaged(path));
        }
        let range = header.part.range(count);
        let contents = || other_contents(path, items, range.len());
        if header.items != items || header.count != count as u64 {
            return Err(contents());
        }
        let (next, rest) = postcard::take_from_bytes::<T>(&bytes).map_err(|_| contents())?;
        if !next.are_of(&range) || !rest.is_empty() {
            return Err(contents());
        }
        match &mut whole {
            Some(whole) => whole.append(next),
            None => whole = Some(next),
        }
    }
    whole.ok_or_else(set::none)
}

/// Error for contents that match their digest but are not the command's results.
fn other_contents(path: &Path, items: &str, count: usize) -> InputError {
    input_error!("crossbar::part::file" => "expected the results of {count} {items}, found something else";
        help "compute the part again")
    .at(path)
}
