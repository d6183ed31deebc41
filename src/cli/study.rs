//! The runner of all studies: progress, an output folder written all at once, tables on standard output, the exit code.
//! Commands that write no page [`show`] their findings in the same form.
//!
//! A study's command declares its options and converts them to parameters; [`run`] does everything else.

use std::fs::File;
use std::path::Path;

use serde_json::json;

use super::{CommandLine, Out, Problem, ProgressBar};
use crate::io::{require_writable, write_files};
use crate::report::{Findings, Provenance, Verdict, sha256};
use crate::study::Study;

/// The options of a study's command.
pub(super) trait StudyArgs {
    /// The study with these options.
    type Study: Study;

    /// Options that would make the study faster, shown for long work; empty if there are none.
    const QUICKER: &'static str = "";

    /// The files that the study writes and reads.
    fn files(&self) -> StudyFiles<'_>;

    /// Creates the study: looks up all names, and reads all files.
    fn study(&self) -> miette::Result<Self::Study>;
}

/// Output folder and input files of a study.
pub(super) struct StudyFiles<'a> {
    folder: Option<&'a Path>,
    inputs: Vec<&'a Path>,
}

impl<'a> StudyFiles<'a> {
    pub(super) fn new(folder: Option<&'a Path>, inputs: Vec<&'a Path>) -> Self {
        Self { folder, inputs }
    }
}

/// Runs a study; `command_line` is the command that reproduces its findings.
pub(super) fn run<A: StudyArgs>(args: &A, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    let study = args.study()?;
    let StudyFiles { folder, inputs } = args.files();
    out.outlive_reader();
    // Checked before the long work, so that an unwritable folder is found at once.
    folder.map(require_writable).transpose().map_err(Problem::from)?;
    let bar = ProgressBar::new("", 1).quicker(A::QUICKER);
    let mut found = study.findings(&mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let provenance = study.provenance(with_inputs(Provenance::new(&command_line.text), &inputs));
    if let Some(folder) = folder {
        write_files(folder, &found.take_files(&provenance)?).map_err(Problem::from)?;
    }
    if out.json() {
        let mut document = found.document(&provenance);
        document["out"] = json!(folder);
        out.document(&document)?;
        return Ok(found.verdict());
    }
    print(&found, folder, out)?;
    Ok(found.verdict())
}

/// Shows the findings of a command without a page: the JSON document, or tables and lines.
pub(super) fn show(found: &Findings, out: &mut Out) -> miette::Result<Verdict> {
    out.outlive_reader();
    if out.json() {
        out.document(&found.plain_document())?;
    } else {
        print(found, None, out)?;
    }
    Ok(found.verdict())
}

/// Adds the files that a command wrote: a field for each possible file, a line for each requested file.
pub(super) fn written<'a>(found: &mut Findings, files: impl IntoIterator<Item = (&'a str, Option<&'a Path>)>) {
    for (name, path) in files {
        found.field(name, json!(path));
        if let Some(path) = path {
            found.print(format!("written   {}", path.display()));
        }
    }
}

/// Prints the introduction, each table, and the other lines with the path of the page, separated by empty lines.
fn print(found: &Findings, folder: Option<&Path>, out: &mut Out) -> miette::Result<()> {
    let mut is_first = found.introduction().is_empty();
    let mut apart = |out: &mut Out| if std::mem::take(&mut is_first) { Ok(()) } else { out.line("") };
    found.introduction().iter().try_for_each(|line| out.sentence(line))?;
    for table in found.printed_tables() {
        apart(out)?;
        out.sentence(table.title())?;
        out.table(table)?;
    }
    let lines: Vec<&String> = found.conclusions().iter().chain(found.printed_lines()).collect();
    if !lines.is_empty() || folder.is_some() {
        apart(out)?;
    }
    lines.into_iter().try_for_each(|line| out.sentence(line))?;
    if let Some(folder) = folder {
        out.line(format_args!("pictures and tables: {}", folder.join("index.html").display()))?;
    }
    Ok(())
}

/// The provenance with digests of the inputs; names of scenes and piped input have no digests.
pub(super) fn with_inputs(mut provenance: Provenance, inputs: &[&Path]) -> Provenance {
    // Opening a pipe would wait for its writer.
    let digest = |path: &Path| sha256(path.is_file().then(|| File::open(path).ok())??).ok();
    let digested = inputs.iter().filter_map(|path| Some((path.display().to_string(), digest(path)?)));
    provenance.inputs = digested.collect();
    provenance
}
