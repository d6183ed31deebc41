//! `crossbar reproduce`: the papers' tables and figures, ours beside theirs.

use std::path::{Path, PathBuf};

use super::Out;
use super::memory::MemoryNeed;
use super::study::{self, StudyArgs};
use crate::report::{Table, Verdict};
use crate::study::reproduce::{ENTRIES, ModelSize, Parameters, choose};

const EXAMPLES: &str = "\
Examples:
  crossbar reproduce
      every entry, in out/reproduce/index.html
  crossbar reproduce equation-11 figure-7 --json
      two of them, as JSON on standard output
  crossbar reproduce cpca-table-1 --full-size
      on models of the paper's size
  crossbar reproduce --list
      the entries

Written to --out: index.html (self-contained), rows.csv, tally.csv, study.json, a drawing NAME.svg
per chart and a picture NAME.png.
Each printed figure has one row, with a bound that was stated beforehand, and a verdict: predicted
(measured on our side, within a bound in numbers), order only, consistency of print (nothing is
run), calibrated (within its bound, but no evidence), explained (a sweep of the same run over
something that the paper leaves open reaches the value), missed, contradictory (the paper
contradicts itself: the computation is shown), or too vague to judge.
Interrupted, it leaves nothing half-written; the next run starts from the beginning, or from the
entries that are named.
Exits with 1 if a figure is missed. Some are: docs/papers lists them with the open questions.";

/// Reproduce printed tables and figures: the papers' values beside ours, judged by stated bounds
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Entries to reproduce [default: everything]
    #[arg(value_name = "ID")]
    entries: Vec<String>,

    /// Say what there is, and do nothing
    #[arg(long)]
    list: bool,

    /// Models as large as the papers', where an entry has smaller ones by default: minutes to hours
    #[arg(long)]
    full_size: bool,

    /// Where to write the page, the tables and the drawings
    #[arg(long, value_name = "DIR", default_value = "out/reproduce")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, command_line: &str, out: &mut Out) -> miette::Result<Verdict> {
    if args.list { list(out) } else { study::run(args, command_line, out) }
}

impl StudyArgs for Args {
    type Study = Parameters;
    const COMMAND: &'static str = "reproduce";
    const QUICKER: &'static str = "the names of single entries (`crossbar reproduce --list`)";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn inputs(&self) -> Vec<&Path> {
        Vec::new()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(None)
    }

    fn study(&self) -> miette::Result<Parameters> {
        let models = if self.full_size { ModelSize::Printed } else { ModelSize::Reduced };
        Ok(Parameters { entries: choose(&self.entries)?, models })
    }
}

fn list(out: &mut Out) -> miette::Result<Verdict> {
    let mut table = Table::new("Entries", &["id", "what"]);
    for entry in ENTRIES {
        table.push([entry.id.into(), entry.title.into()]);
    }
    if out.json() {
        out.document(&table.json())?;
    } else {
        out.table(&table)?;
    }
    Ok(Verdict::Done)
}
