//! `crossbar cpca`: low-frequency transfer and its clusters.

mod compress;
mod draw;
mod precompute;
mod show;

use super::{CommandLine, Out, Verdict, study};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca precompute docs/examples/step.obj --out step.npz
      computes the transfer of every vertex
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --out small.npz
      compresses the transfer to 8 clusters with 3 vectors each
  crossbar cpca show docs/examples/step_small.npz
      shows the contents of a file
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      draws the model from this transfer
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      draws the model on an emulated card

docs/npz.md describes the files, and docs/papers/cpca.md describes the computation.";

/// Precomputed radiance transfer in harmonics, compressed by clustered principal components
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    Precompute(Box<precompute::Args>),
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
