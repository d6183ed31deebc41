//! `crossbar timeline`: the modelled time of a run on an emulated card, by cause.

mod run;
mod show;

use std::path::PathBuf;

use refsim::event::ReadBackMode;
use refsim::timing::Level;

use super::{Out, Problem, Verdict, study};
use crate::io::write_file;
use crate::options::Size;
use crate::options::one_of::{OneOf, one_of};
use crate::study::timeline_trace::trace;
use run::{CardRun, TimedLog};

const EXAMPLES: &str = "\
Examples:
  crossbar timeline fixtures/cases/modulate.toml
      both models of a case: what each draw costs, what each unit does, the critical path
  crossbar timeline --eye-rays 64x64 --device r200 --readback async --double-buffer --perfetto out.json
      the Ray Engine's crossbar on the teapot, as a trace for https://ui.perfetto.dev or chrome://tracing
  crossbar timeline fixtures/cases/modulate.toml --sensitivity
      and the effect on the total if a guessed figure is halved or doubled

The model `rates` has a fill rate and the rates of the bus (equation 11 of the Ray Engine paper), and commands are \
free; `pipeline` has clocks of the units, memory traffic, latencies and the cost of a command on the host. Both put \
the same log on the time axis; the log is the same for every executor. With `--readback async` no read-back is waited \
for: the result is a lower bound on the time. The trace is that of `pipeline`. docs/timing.md explains all of it.

Exit codes: 0 done, 2 the case cannot be run, or the device has no timing.";

/// Model the time of a run on a card: cost of each draw, busy and waiting units, the critical path
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// The case, a TOML file: see `crossbar run`
    #[arg(required_unless_present = "eye_rays", conflicts_with = "eye_rays")]
    case: Option<PathBuf>,

    /// Instead of a case: the Ray Engine's crossbar on the teapot with this many eye rays, bucket after bucket on one card
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    eye_rays: Option<Size>,

    /// The card [default: the case's; r200 for --eye-rays]
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// Read-back mode: the host waits, or not [default: the run's]
    #[arg(long, value_name = "MODE", value_parser = readback())]
    readback: Option<ReadBackMode>,

    /// Keep two copies of every texture and target: one is overwritten while the card uses the other
    #[arg(long)]
    double_buffer: bool,

    /// Run the texture cache over every address that the run reads, instead of estimating its misses; slower
    #[arg(long)]
    cache: bool,

    /// Halve and double each guessed figure, and show the effect on the total
    #[arg(long)]
    sensitivity: bool,

    /// Write the timeline as a trace for Perfetto and chrome://tracing
    #[arg(long, value_name = "FILE")]
    perfetto: Option<PathBuf>,
}

fn readback() -> OneOf<ReadBackMode> {
    one_of([
        ("sync", "The host waits for all earlier work and the transfer", ReadBackMode::Synchronous),
        ("async", "The host continues", ReadBackMode::Asynchronous),
    ])
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let same = |case: &PathBuf, trace: &PathBuf| matches!((case.canonicalize(), trace.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if args.case.as_ref().zip(args.perfetto.as_ref()).is_some_and(|(case, trace)| same(case, trace)) {
        return Err(Problem::usage("`--perfetto` names the case itself", "name another file").into());
    }
    let run = CardRun::new(args)?;
    let timed = [TimedLog::new(Level::Rates, &run, args)?, TimedLog::new(Level::Pipeline, &run, args)?];
    if let Some(path) = &args.perfetto {
        let trace = trace(&run.profile, timed[1].name(), &run.title, &timed[1].replay.timeline);
        write_file(path, |file| trace.write(file)).map_err(Problem::from)?;
    }
    study::show(&show::findings(args, &run, &timed), out)
}
