//! `crossbar reproduce`: the papers' tables and figures, ours beside theirs.

use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::LazyLock;
use std::time::Instant;

use super::study::{self, StudyArgs, StudyFiles};
use super::version::{self, COMMIT};
use super::{CommandLine, Out, Problem, ProgressBar};
use crate::io::atomic::{FileSet, write_file};
use crate::report::{Cell, Findings, FoundTable, Table, Verdict};
use crate::split::{KeptResults, SpentTime, SplitCommand};
use crate::study::reproduce::{
    ENTRIES, EntryRecord, ModelSize, Parameters, RecordMade, ReproduceEntry, SmokeRun, choose,
};

const EXAMPLES: &str = "\
Examples:
  crossbar reproduce
      every entry, in out/reproduce/index.html
  crossbar reproduce ray-engine-equation-11 ray-engine-figure-7 --json
      two of them, as JSON on standard output
  crossbar reproduce radiosity
      all of a paper: ray-engine, radiosity, subsurface, cpca, all-frequency or bi-scale
  crossbar reproduce cpca-table-1 --full-size
      on models of the paper's size
  crossbar reproduce --record out/records
      the runs at full size that judge rows, entry by entry
  crossbar reproduce --list
      the entries

Written to --out: index.html (self-contained), rows.csv, tally.csv, study.json, a drawing NAME.svg
per chart and a picture NAME.png.
Each printed figure has one row, with a bound and the date on which it was stated, and a verdict:
predicted (measured on our side, within a bound in numbers), order only, consistency of print
(nothing is measured), by construction (no value that can come out is outside the bound),
calibrated (within its bound, but no evidence), explained (a sweep of the same run over something
that the paper leaves open reaches the value), missed, contradictory (the paper contradicts itself,
and ours agrees with one of its values), or too vague to judge. All bounds were restated on
2026-11-26: after the first results of most rows, before the recorded runs.
Where the size of models decides, rows are those of recorded runs at full size, which the program
contains; --full-size computes them anew and holds them against the record. The source of each row
says which. Pictures, and rows without a record, are of reduced models: these are not judged.
Interrupted, it leaves nothing half-written; the next run starts from the beginning, or from the
entries that are named. --record goes on: what it has recorded stays, unless it is of another
program; so do the finished pieces of all-frequency-table-1 and all-frequency-figures, which take
hours, in FOLDER/ID.pieces.
A missed figure is a finding, and docs/papers lists it with the open question: the exit code is 0. It
is 1 only if --full-size computes a value that is not as recorded.";

/// Reproduce printed tables and figures: the papers' values beside ours, judged by stated bounds
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Entries to reproduce, or papers with all their entries [default: everything]
    #[arg(value_name = "ID")]
    entries: Vec<String>,

    /// Say what there is, and do nothing
    #[arg(long)]
    list: bool,

    /// Compute anew on models as large as the papers', where rows are recorded by default: minutes for most entries,
    /// hours for two
    #[arg(long)]
    full_size: bool,

    /// Run entries at full size, and keep the rows of each in FOLDER/ID.toml
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["list", "full_size", "out"])]
    record: Option<PathBuf>,

    /// Where to write the page, the tables and the drawings
    #[arg(long, value_name = "DIR", default_value = "out/reproduce")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    match &args.record {
        Some(folder) => record(args, folder, out),
        None if args.list => list(out),
        None => study::run(args, command_line, out),
    }
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "the names of single entries (`crossbar reproduce --list`)";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), None, Vec::new())
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

/// Records the entries that are asked for, but for those whose record in the folder is of this program.
fn record(args: &Args, folder: &Path, out: &mut Out) -> miette::Result<Verdict> {
    let mut entries = choose(&args.entries)?;
    entries.retain(ReproduceEntry::is_sized);
    if entries.is_empty() {
        let help = "without names, `--record` records every entry whose rows depend on the size of models";
        return Err(Problem::usage("the entries have no choice of model size: there is nothing to record", help).into());
    }
    // Before the long work, so that a folder that cannot be written is found out at once.
    drop(FileSet::new(folder).map_err(Problem::from)?);
    let bar = ProgressBar::new("", 1).quicker("names of single entries; interrupted, it goes on");
    let mut table = Table::of("Records", "entry rows processor_s wall_s record");
    for (done, entry) in (0..).zip(&entries) {
        bar.show(entry.id.to_owned(), done, entries.len() as u64);
        let path = folder.join(format!("{}.toml", entry.id));
        let Some(smoke) = SmokeRun::of(entry)? else { continue };
        let kept = kept(&smoke, entry.id, &path);
        let (record, state) = match kept {
            Ok(record) => (record, "kept".to_owned()),
            Err(why) => (made(&smoke, entry.id, &path)?, why),
        };
        let made = record.made();
        let times = [made.processor_s, Some(made.wall_s)].map(|time| time.map_or(Cell::Empty, Cell::measured));
        let [processor, wall] = times;
        table.push([entry.id.into(), record.len().into(), processor, wall, state.into()]);
    }
    drop(bar);
    let mut found = Findings::new("Records");
    found.table(FoundTable::from(table).field("records"));
    study::written(&mut found, [("folder", Some(folder))]);
    study::show(&found, out)
}

/// The record in a file, or in words why it is made anew.
fn kept(smoke: &SmokeRun, entry: &str, path: &Path) -> Result<EntryRecord, String> {
    let text = fs::read_to_string(path).map_err(|_| "new".to_owned())?;
    let record = EntryRecord::parse(entry, &text).map_err(|error| format!("anew: {error}"))?;
    match smoke.stale(&record) {
        Some(stale) => Err(format!("anew: {stale}")),
        None => Ok(record),
    }
}

/// Runs an entry at full size, and writes its record. What a run before it has finished is beside the record.
fn made(smoke: &SmokeRun, entry: &str, path: &Path) -> miette::Result<EntryRecord> {
    let arguments = ["reproduce", entry, "--record"].map(str::to_owned).to_vec();
    let command = SplitCommand { program: version::program()?, arguments };
    let kept = Rc::new(KeptResults::new(path.with_extension("pieces"), command, clock)?);
    let run = smoke.record(Rc::clone(&kept))?;
    let spent = kept.spent();
    let record = run.made_by(RecordMade {
        command: format!("crossbar reproduce {entry} --full-size"),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: COMMIT.to_owned(),
        processor_s: spent.processor_s.map(hundredths),
        wall_s: hundredths(spent.wall_s),
    });
    let text = record.text().map_err(crate::study::StudyError::from)?;
    write_file(path, |file| file.write_all(text.as_bytes())).map_err(Problem::from)?;
    kept.remove()?;
    Ok(record)
}

/// Rounds to hundredths.
fn hundredths(seconds: f64) -> f64 {
    (100.0 * seconds).round() / 100.0
}

/// Time that the program has taken so far.
fn clock() -> SpentTime {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    SpentTime { processor_s: processor_time(), wall_s: START.elapsed().as_secs_f64() }
}

/// Processor time of all threads so far, in seconds; `None` where the system does not say it.
fn processor_time() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, which may have blanks: state, ten numbers, then ticks in the program and in the system.
    let (_, rest) = stat.rsplit_once(')')?;
    let ticks = |at: usize| rest.split_whitespace().nth(at)?.parse::<u64>().ok();
    Some((ticks(11)? + ticks(12)?) as f64 / ticks_per_second() as f64)
}

#[cfg(unix)]
fn ticks_per_second() -> u64 {
    rustix::param::clock_ticks_per_second()
}

#[cfg(not(unix))]
const fn ticks_per_second() -> u64 {
    1
}
