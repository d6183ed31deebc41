//! `crossbar reproduce`: the papers' tables and figures, ours beside theirs.

use std::path::PathBuf;

use super::{Out, Problem, Progress, Verdict, view};
use crate::io::atomic::FileSet;
use crate::report::{Provenance, Table};
use crate::study::reproduce::report::{files, held, json, notes, questions, tables, tally_line};
use crate::study::reproduce::{ENTRIES, choose, reproduce};

const EXAMPLES: &str = "\
Examples:
  crossbar reproduce
      every entry, in out/reproduce/index.html
  crossbar reproduce equation-11 figure-7 --json
      two of them, as JSON on standard output
  crossbar reproduce --list
      the entries

Written to --out: index.html (self-contained), rows.csv, tally.csv, reproduce.json, and a drawing
NAME.svg per chart.
Each row has a bound that was stated beforehand, and a verdict: reproduced, calibrated (within its
bound, but no evidence), explained (a sweep of the same run reaches the value), missed, or too
vague to judge.
Exits with 1 if a figure is missed. Some are: docs/papers lists them with the open questions.";

/// Reproduce printed tables and figures: the papers' values beside ours, judged by stated bounds
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// What to reproduce [default: everything]
    #[arg(value_name = "ID")]
    entries: Vec<String>,

    /// Say what there is, and do nothing
    #[arg(long)]
    list: bool,

    /// Where to write the page, the tables and the drawings
    #[arg(long, value_name = "DIR", default_value = "out/reproduce")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    if args.list {
        return list(out);
    }
    let chosen = choose(&args.entries)?;
    let mut command = "crossbar reproduce".to_owned();
    for name in &args.entries {
        command.push_str(&format!(" {name}"));
    }
    let provenance = Provenance::new(command);
    let folder = FileSet::new(&args.out).map_err(Problem::from)?;
    let bar = Progress::new("reproducing", chosen.len() as u64);
    let found = reproduce(&chosen, &mut || bar.advance(1))?;
    drop(bar);
    view::write_folder(folder, &files(&found, &provenance)?)?;
    let verdict = Verdict::held(held(&found));
    if out.json() {
        out.document(&json(&found, &provenance))?;
        return Ok(verdict);
    }
    for table in tables(&found).into_iter().chain([notes(&found)]) {
        if !table.rows().is_empty() {
            print(&table, out)?;
        }
    }
    out.line(format_args!("tally: {}", tally_line(&found)))?;
    for (entry, question) in questions(&found) {
        out.line(format_args!("open ({entry}): {question}"))?;
    }
    out.line(format_args!("page, tables and drawings: {}", args.out.join("index.html").display()))?;
    Ok(verdict)
}

fn print(table: &Table, out: &mut Out) -> miette::Result<()> {
    out.line(table.title())?;
    let text = out.columns().map_or_else(|| table.text(), |columns| table.text_within(columns));
    out.line(text)?;
    out.line("")?;
    Ok(())
}

fn list(out: &mut Out) -> miette::Result<Verdict> {
    let mut table = Table::new("Entries", &["id", "what"]);
    for entry in ENTRIES {
        table.push([entry.id.into(), entry.title.into()]);
    }
    if out.json() {
        out.document(&table.json())?;
    } else {
        out.line(table.text())?;
    }
    Ok(Verdict::Done)
}
