//! `--part`: one part of a command's work, for `crossbar merge`.

use std::ffi::OsString;
use std::path::Path;

use serde_json::json;

use super::resolved::CommandLine;
use super::version;
use super::words::counted;
use super::{Problem, given};
use crate::error::InputError;
use crate::report::Findings;
use crate::split::{PartNumber, SplitCommand, SplitRun, WrittenPart, not_utf8};
use crate::study::caster::CasterOptions;

/// The option of commands whose work can be divided.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct PartArgs {
    /// Compute only part K of N, and write it to --out; `crossbar merge` merges all parts
    #[arg(long, value_name = "K/N", requires = "out")]
    part: Option<PartNumber>,
}

impl PartArgs {
    /// Returns `true` if the option was given.
    pub(super) const fn is_given(self) -> bool {
        self.part.is_some()
    }

    /// Rejects parts if the Ray Engine casts the rays: in short formats, its hits depend on which rays wait together.
    pub(super) fn refuse_engine(self, caster: &CasterOptions) -> Result<(), Problem> {
        let part = [("--part", self.part.is_some() && caster.is_engine())];
        given::refuse(part, "rays of the host", "leave it out, or name `--caster host`")
    }

    /// How the command's items are computed: all of them, only those of the part with the file `out`, or none. Fails
    /// for an argument that is not UTF-8, or if the program cannot be identified.
    pub(super) fn split(self, line: &CommandLine, out: &Path) -> Result<SplitRun, InputError> {
        match (&line.parts, self.part) {
            (Some(parts), _) => Ok(SplitRun::Merge(parts.clone())),
            (None, None) => Ok(SplitRun::Whole),
            (None, Some(part)) => Ok(SplitRun::Part { part, command: command(line)?, path: out.into() }),
        }
    }
}

/// The command whose results are stored in files. Fails for an argument that is not UTF-8, or if the program cannot be
/// identified.
pub(super) fn command(line: &CommandLine) -> Result<SplitCommand, InputError> {
    let utf8 = |argument: &OsString| argument.to_str().map(str::to_owned).ok_or_else(|| not_utf8(argument));
    let arguments = line.arguments.iter().map(utf8).collect::<Result<_, _>>()?;
    Ok(SplitCommand { program: version::program()?, arguments })
}

/// Findings of a command that computed a part.
pub(super) fn findings(written: &WrittenPart) -> Findings {
    let WrittenPart { part, items, count, range, path, bytes } = written;
    let mut found = Findings::new("Part");
    found.fields(json!({
        "part": part.number(), "of": part.of(), "items": items, "count": count, "first": range.start,
        "computed": range.len(), "bytes": bytes, "out": path,
    }));
    let of = format!("of {} {items}", counted(*count));
    found.print(match range.len() {
        0 => format!("part      {part}: none {of}"),
        computed => format!("part      {part}: {} {of}, from number {} on", counted(computed), counted(range.start)),
    });
    found.print(format!("written   {}, {} bytes", path.display(), counted(*bytes as usize)));
    found
}
