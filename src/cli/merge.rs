//! `crossbar merge`: joins the parts of a run.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::version;
use crate::error::{InputError, ensure};
use crate::split::PartSet;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca precompute docs/examples/step.obj --part 1/2 --out step_1.part
      the first half of a command's work; `--part 2/2` computes the other, perhaps on another machine
  crossbar merge step_1.part step_2.part --out step.npz
      both, in any order: the file that one run of the command writes

Each part records its command. `merge` reruns that command with the stored results instead of computing them, so that the \
output equals that of one run, byte for byte, except for \
`--out`. Run it where the paths of the command's input lead to the \
same files. `merge` refuses parts that are missing or given twice, parts of other commands, inputs or programs, and \
parts that have changed since they were written. docs/scaling.md lists the commands that support parts, and the gain.";

/// Merge the parts of a run that another command wrote with `--part`
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// All parts, in any order
    #[arg(value_name = "PART", required = true)]
    parts: Vec<PathBuf>,

    /// The file or folder that the parts' command writes to its `--out`
    #[arg(long, value_name = "X")]
    out: PathBuf,
}

impl Args {
    /// Opens the parts; fails unless this program wrote them.
    pub(super) fn open(&self) -> miette::Result<PartSet> {
        Ok(PartSet::open(&self.parts, &version::program()?)?)
    }

    /// The command of the parts, as arguments of the program.
    pub(super) fn command(&self, parts: &PartSet) -> Vec<OsString> {
        let mut out = OsString::from("--out=");
        out.push(&self.out);
        let words = parts.command().arguments.iter().map(OsString::from);
        std::iter::once(OsString::from("crossbar")).chain(words).chain([out]).collect()
    }

    /// Rejects a command that has no `--part`: this program did not write its parts.
    pub(super) fn require_divisible(&self, program: &clap::Command, parts: &PartSet) -> Result<(), InputError> {
        let mut command = program;
        for word in &parts.command().arguments {
            let Some(found) = command.find_subcommand(word) else { break };
            command = found;
        }
        let path = self.parts.first().map_or(Path::new(""), PathBuf::as_path);
        ensure!(
            command.get_arguments().any(|arg| arg.get_id() == "part"), "crossbar::part::command" =>
            "{}: expected a part of a command with `--part`, found one of `{}`", path.display(), parts.command().line()
        );
        Ok(())
    }
}
