//! `crossbar timeline`: the modelled time of a run on an emulated card, by cause.

mod args;
mod run;
mod sensitivity;
mod show;

use std::path::PathBuf;

use refsim::timing::Level;

use super::{Out, Problem, ProgressBar, Verdict, study};
use crate::io::write_file;
use crate::study::timeline_trace::trace;
use run::{Input, TimedLog};

pub(super) use args::Args;

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let same = |case: &PathBuf, trace: &PathBuf| matches!((case.canonicalize(), trace.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if args.case.as_ref().zip(args.perfetto.as_ref()).is_some_and(|(case, trace)| same(case, trace)) {
        return Err(Problem::usage("`--perfetto` names the case itself", "name another file").into());
    }
    let input = Input::read(args)?;
    // A single step, shown because it takes long with `--cache`.
    let bar = ProgressBar::new("drawing", 1);
    let log = input.log(args.cache)?;
    drop(bar);
    let mut timed = Vec::new();
    for level in [Level::Rates, Level::Pipeline] {
        timed.push(TimedLog::new(level, &input, &log, args)?);
    }
    if let (Some(path), Some(last)) = (&args.perfetto, timed.last()) {
        let trace = trace(input.profile(), last.name(), &input.title(), &last.replay.timeline);
        write_file(path, |file| trace.write(file)).map_err(Problem::from)?;
    }
    study::show(&show::findings(args, &input, &log, &timed), out)
}
