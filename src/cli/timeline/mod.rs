//! `crossbar timeline`: the modelled time of a run on an emulated card, by cause.

mod run;
mod show;

use refsim::timing::Level;

use super::{Out, Problem, Verdict, study};
use crate::io::write_file;
use crate::study::timeline_trace::trace;
use run::{CardRun, TimedLog};

pub(super) use run::Args;

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let run = CardRun::new(args)?;
    let timed = [TimedLog::new(Level::Rates, &run, args)?, TimedLog::new(Level::Pipeline, &run, args)?];
    if let Some(path) = &args.perfetto {
        let trace = trace(&run.profile, timed[1].name(), &run.title, &timed[1].replay.timeline);
        write_file(path, |file| trace.write(file)).map_err(Problem::from)?;
    }
    study::show(&show::findings(args, &run, &timed), out)
}
