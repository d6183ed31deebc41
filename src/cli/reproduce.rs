//! `crossbar reproduce`: the papers' tables and figures, compared with ours.

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::LazyLock;
use std::time::Instant;

use super::study::{self, StudyArgs, StudyFiles};
use super::version::{self, COMMIT};
use super::{CommandLine, Out, Problem, ProgressBar};
use crate::io::{require_writable, write_file};
use crate::kept::{KeptResults, KeptWork, SpentTime};
use crate::report::{Cell, Findings, FoundTable, Table, Verdict};
use crate::study::reproduce::{EntryRecord, Parameters, RecordMade, ReproduceEntry, choose, recorded};

const EXAMPLES: &str = "\
Examples:
  crossbar reproduce
      computes all entries; the page is out/reproduce/index.html
  crossbar reproduce ray-engine-equation-11 ray-engine-figure-7 --json
      two entries, as JSON on standard output
  crossbar reproduce radiosity
      all entries of a paper: ray-engine, radiosity, subsurface, cpca, all-frequency or bi-scale
  crossbar reproduce cpca-table-1 --full-size
      repeats the run of a recorded entry
  crossbar reproduce --record out/records
      repeats all recorded runs, and writes their records
  crossbar reproduce --list
      lists the entries

Written to --out: index.html (self-contained), rows.csv, tally.csv, unjudged.csv, study.json, and a
drawing NAME.svg for each chart.
Each printed figure has one row, with its verdict, its bound, and the date on which the bound was stated. The page
explains the verdicts. Entries that take minutes to hours come from recorded runs, stored in the program; --full-size
repeats the runs and compares the results with the records. The source of a row says whether the row was recorded.
An interrupted run leaves no incomplete files; the next run starts from the beginning. With --record,
it continues where the last run stopped: existing records are kept, and so are the finished pieces of
all-frequency-table-1 and all-frequency-figures, which take hours; the pieces are in FOLDER/ID.pieces.
The exit code is 0 even if figures are missed: a missed figure is a finding, and docs/papers lists the figure with its \
open question. The exit code is 1 if --full-size computes a value that differs from its record.";

/// Reproduce printed tables and figures: the papers' values beside ours, judged by stated bounds
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Names of entries, or of papers for all their entries [default: all entries]
    #[arg(value_name = "ID")]
    entries: Vec<String>,

    /// List the entries, and compute nothing
    #[arg(long, conflicts_with_all = ["full_size", "out"])]
    list: bool,

    /// Repeat recorded runs and compare them with their records; most runs take minutes, two take hours
    #[arg(long)]
    full_size: bool,

    /// Run entries at full size, and record the findings of each in FOLDER/ID.toml
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["list", "full_size", "out"])]
    record: Option<PathBuf>,

    /// Where to write the page, the tables and the drawings
    #[arg(long, value_name = "DIR", default_value = "out/reproduce")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    match &args.record {
        Some(folder) => record(args, folder, out),
        None if args.list => list(&args.entries, out),
        None => study::run(args, command_line, out),
    }
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "the names of single entries (`crossbar reproduce --list`)";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), Vec::new())
    }

    fn study(&self) -> miette::Result<Parameters> {
        Ok(Parameters { entries: choose(&self.entries)?, full_size: self.full_size })
    }
}

fn list(entries: &[String], out: &mut Out) -> miette::Result<Verdict> {
    let mut table = Table::new("Entries", &["id", "what"]);
    for entry in choose(entries)? {
        table.push([entry.id.into(), entry.title.into()]);
    }
    if out.json() {
        out.document(&table.json())?
    } else {
        out.table(&table)?
    }
    Ok(Verdict::Done)
}

/// Records the requested entries, or all that have a record; existing files are kept.
fn record(args: &Args, folder: &Path, out: &mut Out) -> miette::Result<Verdict> {
    let mut entries = choose(&args.entries)?;
    if args.entries.is_empty() {
        entries.retain(|entry| recorded(entry).is_ok_and(|record| record.is_some()));
    }
    // Checked before the long work, so that an unwritable folder is found at once.
    require_writable(folder).map_err(Problem::from)?;
    let bar = ProgressBar::new("", 1).quicker("names of single entries; an interrupted run continues where it stopped");
    let mut table = Table::of("Records", "entry record processor_s wall_s");
    for (done, entry) in (0..).zip(&entries) {
        bar.show(entry.id.to_owned(), done, entries.len() as u64);
        let path = folder.join(format!("{}.toml", entry.id));
        if path.exists() {
            table.push([entry.id.into(), "kept".into()]);
        } else {
            let made = made(entry, &path)?;
            let times = [made.processor_s, Some(made.wall_s)].map(|time| time.map_or(Cell::Empty, Cell::measured));
            table.push([entry.id.into(), "new".into()].into_iter().chain(times));
        }
    }
    drop(bar);
    let mut found = Findings::new("Records");
    found.table(FoundTable::from(table).field("records"));
    study::written(&mut found, [("folder", Some(folder))]);
    study::show(&found, out)
}

/// Runs an entry at full size, and writes its record. Pieces of an interrupted run are stored next to the record.
fn made(entry: &ReproduceEntry, path: &Path) -> miette::Result<RecordMade> {
    let work = KeptWork::new(&version::program()?, format!("crossbar reproduce {} --record", entry.id), &[])?;
    let kept = Rc::new(KeptResults::new(path.with_extension("pieces"), work, clock));
    let found = entry.at_full_size(Rc::clone(&kept))?;
    let spent = kept.spent();
    let made = RecordMade {
        command: format!("crossbar reproduce {} --full-size", entry.id),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: COMMIT.unwrap_or("unknown").to_owned(),
        processor_s: spent.processor_s.map(hundredths),
        wall_s: hundredths(spent.wall_s),
    };
    let text = EntryRecord::new(entry.id, &found, made.clone()).text()?;
    write_file(path, |file| file.write_all(text.as_bytes())).map_err(Problem::from)?;
    kept.remove()?;
    Ok(made)
}

/// Rounds to hundredths.
fn hundredths(seconds: f64) -> f64 {
    (100.0 * seconds).round() / 100.0
}

/// Time that the program has used so far.
fn clock() -> SpentTime {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    SpentTime { processor_s: processor_time(), wall_s: START.elapsed().as_secs_f64() }
}

/// Processor time of all threads so far, in seconds; `None` if the system does not report it.
#[cfg(unix)]
fn processor_time() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 / 1e9)
}

#[cfg(not(unix))]
const fn processor_time() -> Option<f64> {
    None
}
