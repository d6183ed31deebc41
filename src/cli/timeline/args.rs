//! The arguments of `crossbar timeline`.

use std::path::PathBuf;

use refsim::event::ReadBackMode;

use crate::options::Size;
use crate::options::one_of::{OneOf, one_of};

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
    pub(super) case: Option<PathBuf>,

    /// Instead of a case: the Ray Engine's crossbar on the teapot with this many eye rays, bucket after bucket on one card
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    pub(super) eye_rays: Option<Size>,

    /// The card [default: the case's; r200 for --eye-rays]
    #[arg(long, value_name = "D")]
    pub(super) device: Option<String>,

    /// Read-back mode: the host waits, or not [default: the run's]
    #[arg(long, value_name = "MODE", value_parser = readback())]
    pub(super) readback: Option<ReadBackMode>,

    /// Keep two copies of every texture and target: one is overwritten while the card uses the other
    #[arg(long)]
    pub(super) double_buffer: bool,

    /// Run the texture cache over every address that the run reads, instead of estimating its misses; slower
    #[arg(long)]
    pub(super) cache: bool,

    /// Halve and double each guessed figure, and show the effect on the total
    #[arg(long)]
    pub(super) sensitivity: bool,

    /// Write the timeline as a trace for Perfetto and chrome://tracing
    #[arg(long, value_name = "FILE")]
    pub(super) perfetto: Option<PathBuf>,
}

fn readback() -> OneOf<ReadBackMode> {
    one_of([
        ("sync", "The host waits for all earlier work and the transfer", ReadBackMode::Synchronous),
        ("async", "The host continues", ReadBackMode::Asynchronous),
    ])
}
