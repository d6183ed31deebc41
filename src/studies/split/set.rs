//! All parts of a run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::error::PartError;
use super::file::{PartHeader, SplitCommand};

/// Numbers of missing parts that a message names.
const MAX_NAMED: usize = 20;

/// All parts of one run, in order.
#[derive(Clone, Debug)]
pub struct PartSet {
    parts: Vec<(PathBuf, PartHeader)>,
}

impl PartSet {
    /// Opens the parts of a run, in any order, and checks that each is whole, that all are of `program` and of one
    /// command, and that none is missing and none twice.
    ///
    /// # Errors
    /// [`PartError`] with the files that do not fit.
    pub fn open(paths: &[PathBuf], program: &str) -> Result<Self, PartError> {
        let mut parts: Vec<(PathBuf, PartHeader)> = Vec::with_capacity(paths.len());
        for path in paths {
            let (header, _) = PartHeader::read(path)?;
            if header.command.program != program {
                let (expected, found) = (program.to_owned(), header.command.program);
                return Err(PartError::Program { path: path.clone(), expected, found });
            }
            if let Some((first, other)) = parts.first() {
                same_run([first, path], [other, &header])?;
            }
            parts.push((path.clone(), header));
        }
        parts.sort_by_key(|(_, header)| header.part.number());
        if let Some(pair) = parts.windows(2).find(|pair| pair[0].1.part == pair[1].1.part) {
            let paths = [pair[0].0.clone(), pair[1].0.clone()];
            return Err(PartError::Twice { paths, number: pair[0].1.part });
        }
        missing(&parts)?;
        Ok(Self { parts })
    }

    /// The command that all parts are of.
    pub fn command(&self) -> &SplitCommand {
        &self.parts[0].1.command
    }

    /// The parts in order, at least one.
    pub(super) fn parts(&self) -> &[(PathBuf, PartHeader)] {
        &self.parts
    }

    /// Checks that every part was computed from the files that have now been read.
    ///
    /// # Errors
    /// [`PartError::Input`] with the part and the file.
    pub(super) fn check_inputs(&self, now: &BTreeMap<String, String>) -> Result<(), PartError> {
        for (path, header) in &self.parts {
            let names = header.inputs.keys().chain(now.keys());
            let differs = names.into_iter().find(|&name| header.inputs.get(name) != now.get(name));
            if let Some(name) = differs {
                let digest = |of: &BTreeMap<String, String>| of.get(name).cloned().unwrap_or_else(|| "none".to_owned());
                let (expected, found) = (digest(&header.inputs), digest(now));
                return Err(PartError::Input { path: path.clone(), input: name.clone(), expected, found });
            }
        }
        Ok(())
    }
}

/// Checks that two parts are of one command and one division.
fn same_run(paths: [&PathBuf; 2], headers: [&PartHeader; 2]) -> Result<(), PartError> {
    let paths = paths.map(PathBuf::clone);
    let [one, other] = headers;
    if one.command.arguments != other.command.arguments {
        return Err(PartError::Command { paths, commands: headers.map(|header| header.command.line()) });
    }
    if one.part.of() != other.part.of() {
        return Err(PartError::Divisions { paths, numbers: headers.map(|header| header.part) });
    }
    Ok(())
}

/// Checks that the parts, sorted and none twice, are all.
fn missing(parts: &[(PathBuf, PartHeader)]) -> Result<(), PartError> {
    let (_, first) = parts.first().ok_or(PartError::Empty)?;
    let of = first.part.of();
    let mut found = parts.iter().map(|(_, header)| header.part.number()).peekable();
    let mut missing = (1..=of).filter(|&number| found.next_if_eq(&number).is_none());
    let named: Vec<String> = missing.by_ref().take(MAX_NAMED).map(|number| number.to_string()).collect();
    let count = of - parts.len() as u32;
    if named.is_empty() {
        return Ok(());
    }
    let more = if count as usize > named.len() { ", ..." } else { "" };
    let missing = format!("{}{more}", named.join(", "));
    Err(PartError::Missing { of, count, missing, command: first.command.line() })
}
