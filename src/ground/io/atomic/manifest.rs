//! The list of written files in an output folder, by which a later run finds files that are no longer written.
//!
//! One line per file: its length, its CRC-32, its writer, its name. Length and CRC distinguish unchanged files from
//! those that the user has changed or replaced since, which are kept.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// The list's name in the folder.
pub(super) const FILE_NAME: &str = ".crossbar_files";

const HEAD: &str = "# Written by crossbar: length, CRC-32, command, name. The same command, run again, removes what it no \
                    longer writes.";

/// A file as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Written {
    length: u64,
    crc: u32,
    writer: String,
    name: PathBuf,
}

/// A list of files with their writers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Manifest(Vec<Written>);

impl Manifest {
    /// The list at `path`. Lines that cannot be read are ignored, so that their files are kept.
    pub(super) fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_default();
        Self(text.lines().filter_map(Written::parse).collect())
    }

    /// Adds the file `name`, which `writer` has written to the path `staged`.
    pub(super) fn add(&mut self, writer: &str, name: &Path, staged: &Path) -> io::Result<()> {
        let (length, crc) = length_and_crc(staged)?;
        self.0.push(Written { length, crc, writer: one_line(writer), name: name.into() });
        Ok(())
    }

    /// This list after a new run of `writer`, and the list of its files that it no longer writes.
    pub(super) fn replaced(self, writer: &str, written: Self) -> (Self, Self) {
        let writer = one_line(writer);
        let gone = self.0.into_iter().filter(|old| written.0.iter().all(|new| new.name != old.name));
        let (stale, mut list): (Vec<_>, Vec<_>) = gone.partition(|old| old.writer == writer);
        list.extend(written.0);
        (Self(list), Self(stale))
    }

    /// Removes the files below `folder` that are unchanged since they were written. Failures are ignored.
    pub(super) fn remove_files(&self, folder: &Path) {
        for file in self.0.iter().filter(|file| file.is_unchanged(folder)) {
            let _ = fs::remove_file(folder.join(&file.name));
        }
    }
}

impl fmt::Display for Manifest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{HEAD}")?;
        for Written { length, crc, writer, name } in &self.0 {
            // A name that is no UTF-8, or has control characters, is not listed, so that its file is never removed.
            if let Some(name) = name.to_str().filter(|name| one_line(name) == *name) {
                writeln!(f, "{length}\t{crc:08x}\t{writer}\t{name}")?;
            }
        }
        Ok(())
    }
}

impl Written {
    fn parse(line: &str) -> Option<Self> {
        let mut fields = line.split('\t');
        let mut field = || fields.next();
        let (length, crc, writer, name) = (field()?, field()?, field()?, PathBuf::from(field()?));
        // Rejects paths outside the folder, in case the list was edited.
        let plain = name.components().all(|part| matches!(part, Component::Normal(_))) && name.file_name().is_some();
        let crc = u32::from_str_radix(crc, 16).ok()?;
        (plain && fields.next().is_none()).then_some(Self {
            length: length.parse().ok()?,
            crc,
            writer: writer.into(),
            name,
        })
    }

    /// True if the file below `folder` is unchanged since it was written, and no part of its path is a link.
    fn is_unchanged(&self, folder: &Path) -> bool {
        let mut path = folder.to_path_buf();
        let no_link = self.name.iter().all(|part| {
            path.push(part);
            fs::symlink_metadata(&path).is_ok_and(|place| !place.is_symlink())
        });
        no_link
            && fs::metadata(&path).is_ok_and(|place| place.is_file() && place.len() == self.length)
            && length_and_crc(&path).is_ok_and(|found| found == (self.length, self.crc))
    }
}

/// The text with control characters, which separate fields and lines, replaced by spaces.
fn one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control(), " ")
}

fn length_and_crc(path: &Path) -> io::Result<(u64, u32)> {
    let mut file = File::open(path)?;
    let mut crc = crc32fast::Hasher::new();
    let mut length = 0;
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok((length, crc.finalize())),
            read => {
                crc.update(&buffer[..read]);
                length += read as u64;
            }
        }
    }
}
