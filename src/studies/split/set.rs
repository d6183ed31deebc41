//! All parts of a run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::file::{PartHeader, SplitCommand};
use crate::error::{InputError, ensure, input_error};

/// Maximum number of missing parts that a message names.
const MAX_NAMED: usize = 20;

/// All parts of one run, in order.
#[derive(Clone, Debug)]
pub struct PartSet {
    parts: Vec<(PathBuf, PartHeader)>,
}

impl PartSet {
    /// Opens the parts of a run, in any order. Checks that each is whole, that all are of `program` and of one command,
    /// and that none is missing or duplicate. The error names the files that do not fit.
    pub fn open(paths: &[PathBuf], program: &str) -> Result<Self, InputError> {
        let mut parts: Vec<(PathBuf, PartHeader)> = Vec::with_capacity(paths.len());
        for path in paths {
            let (header, _) = PartHeader::read(path)?;
            let found = &header.command.program;
            ensure!(
                found == program, "crossbar::part::program" =>
                "{}: expected a part of this program, crossbar {program}, found one of crossbar {found}", path.display();
                help "compute the part again with this program, or merge with that one"
            );
            if let Some((first, other)) = parts.first() {
                same_run([first, path], [other, &header])?;
            }
            parts.push((path.clone(), header));
        }
        parts.sort_by_key(|(_, header)| header.part.number());
        if let Some([one, other]) = parts.array_windows().find(|[one, other]| one.1.part == other.1.part) {
            return Err(input_error!(
                "crossbar::part::number" => "{} and {} both are part {}", one.0.display(), other.0.display(), one.1.part;
                help "leave one of them out"
            ));
        }
        missing(&parts)?;
        Ok(Self { parts })
    }

    /// The command of all parts.
    pub fn command(&self) -> &SplitCommand {
        &self.parts[0].1.command
    }

    /// The parts in order, at least one.
    pub(super) fn parts(&self) -> &[(PathBuf, PartHeader)] {
        &self.parts
    }

    /// Checks that every part was computed from the files that have now been read. The error names the part and the
    /// file.
    pub(super) fn check_inputs(&self, now: &BTreeMap<String, String>) -> Result<(), InputError> {
        for (path, header) in &self.parts {
            let names = header.inputs.keys().chain(now.keys());
            let differs = names.into_iter().find(|&name| header.inputs.get(name) != now.get(name));
            if let Some(name) = differs {
                let digest = |of: &BTreeMap<String, String>| of.get(name).cloned().unwrap_or_else(|| "none".to_owned());
                let (expected, found) = (digest(&header.inputs), digest(now));
                return Err(input_error!(
                    "crossbar::part::input" =>
                    "{}: computed from another `{name}` than there is now: expected SHA-256 {expected}, found {found}",
                    path.display();
                    help "restore the file that the part was computed from, or compute all parts again"
                ));
            }
        }
        Ok(())
    }
}

/// Checks that two parts are of the same command and the same division.
fn same_run(paths: [&PathBuf; 2], [one, other]: [&PartHeader; 2]) -> Result<(), InputError> {
    let [path, another] = paths.map(|path| path.display());
    ensure!(
        one.command.arguments == other.command.arguments, "crossbar::part::command" =>
        "{path} and {another} are parts of two commands:\n{}\n{}", one.command.line(), other.command.line();
        help "name parts of one command, with one path per input"
    );
    ensure!(
        one.part.of() == other.part.of(), "crossbar::part::number" =>
        "{path} is part {}, and {another} is part {}", one.part, other.part;
        help "name parts of one division: all of them with one N"
    );
    Ok(())
}

/// Checks that sorted, distinct parts are complete.
fn missing(parts: &[(PathBuf, PartHeader)]) -> Result<(), InputError> {
    let (_, first) = parts.first().ok_or_else(none)?;
    let of = first.part.of();
    let mut found = parts.iter().map(|(_, header)| header.part.number()).peekable();
    let mut missing = (1..=of).filter(|&number| found.next_if_eq(&number).is_none());
    let named: Vec<String> = missing.by_ref().take(MAX_NAMED).map(|number| number.to_string()).collect();
    let count = of as usize - parts.len();
    let more = if count > named.len() { ", ..." } else { "" };
    ensure!(
        named.is_empty(), "crossbar::part::number" =>
        "expected {of} parts, found {}; missing: {}{more}", parts.len(), named.join(", ");
        help "compute these with `--part`: the command of the others is\n{}", first.command.line()
    );
    Ok(())
}

/// Error for an empty list of parts.
pub(super) fn none() -> InputError {
    InputError::new("crossbar::part::number", "expected the parts of a run, found none")
}
