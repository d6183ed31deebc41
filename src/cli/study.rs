//! The one runner of studies: memory, progress, an output folder that appears at once, tables on standard output, the
//! exit code.
//!
//! A study's command says what its options are and what they ask for; [`run`] does the rest.

use std::path::Path;

use serde_json::json;

use super::memory::MemoryNeed;
use super::{Out, Problem, ProgressBar, view};
use crate::io::atomic::FileSet;
use crate::report::{Provenance, Verdict};
use crate::study::Study;

/// The options of a study's command.
pub(super) trait StudyArgs {
    /// The study that they ask for.
    type Study: Study;

    /// Where its files go.
    fn folder(&self) -> &Path;

    /// The memory that it takes at most, by the options alone; `None` if that is little.
    fn memory(&self) -> miette::Result<Option<MemoryNeed>>;

    /// The study, with everything looked up and read.
    fn study(&self) -> miette::Result<Self::Study>;
}

/// Runs a study; `command_line` is what its findings come from.
pub(super) fn run(args: &impl StudyArgs, command_line: &str, out: &mut Out) -> miette::Result<Verdict> {
    if let Some(need) = args.memory()? {
        need.require()?;
    }
    let study = args.study()?;
    // Before the long work, so that a folder that cannot be written is found out at once.
    let folder = FileSet::new(args.folder()).map_err(Problem::from)?;
    let bar = ProgressBar::new("", 1);
    let mut found = study.findings(&mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let provenance = study.provenance(Provenance::new(command_line));
    view::write_folder(folder, &found.take_files(&provenance)?)?;
    if out.json() {
        let mut document = found.document(&provenance);
        document["out"] = json!(args.folder());
        out.document(&document)?;
        return Ok(found.verdict());
    }
    for table in found.printed_tables() {
        out.titled_table(table)?;
        out.line("")?;
    }
    for line in found.printed_lines() {
        out.sentence(line)?;
    }
    out.line(format_args!("pictures and tables: {}", args.folder().join("index.html").display()))?;
    Ok(found.verdict())
}
