//! `crossbar cpca`: low-frequency transfer and its clusters.

mod compress;
mod draw;
mod precompute;
mod show;

use super::{CommandLine, Out, Verdict, study};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca precompute docs/examples/step.obj --out step.npz
      transfer of every vertex
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --out small.npz
      the same by 8 clusters of 3 vectors
  crossbar cpca show docs/examples/step_small.npz
      the contents of a file
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      pictures of it
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      the same on an emulated card

docs/npz.md describes the files, docs/papers/cpca.md the computation.";

/// Precomputed radiance transfer in harmonics, compressed by clustered principal components
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    Precompute(precompute::Args),
    Compress(compress::Args),
    Show(show::Args),
    Render(draw::Render),
    Card(draw::Card),
}

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    let found = match &args.verb {
        Verb::Precompute(args) => precompute::run(args)?,
        Verb::Compress(args) => compress::run(args)?,
        Verb::Show(args) => show::run(args)?,
        Verb::Render(args) => return study::run(args, command_line, out),
        Verb::Card(args) => return study::run(args, command_line, out),
    };
    study::show(&found, out)
}
