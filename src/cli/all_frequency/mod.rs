//! `crossbar all-frequency`: transfer for light of all frequencies.

mod compress;
mod draw;
mod factor;
mod lighting;
mod precompute;
mod show;

use super::{CommandLine, Out, Verdict, study};

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency factor --brdf cook-torrance
      reflectance as a sum of products: a function of the view times a function of the light
  crossbar all-frequency lighting --light sky:1,-1,1 --keep 800
      light as Haar wavelets, and the energy in 800 of the wavelets
  crossbar all-frequency precompute docs/examples/step.obj --out step.npz
      which directions every vertex sees
  crossbar all-frequency compress docs/examples/step_all.npz --model docs/examples/step.obj --points-per-cluster 40 --vectors 4 --out small.npz
      compresses the transfer, segment by segment, to clusters of principal components, and codes them
  crossbar all-frequency render docs/examples/step_all_small.npz --model docs/examples/step.obj --size 64x48
      draws the model from this transfer
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --size 64x48
      draws the model on an emulated card

docs/npz.md describes the files, and docs/papers/all_frequency.md describes the computation.";

/// Precomputed transfer for light of all frequencies, factored, compressed by segments and coded
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    Factor(factor::Args),
    Lighting(lighting::Args),
    Precompute(precompute::Args),
    Compress(compress::Args),
    Show(show::Args),
    Render(draw::Render),
    Card(draw::Card),
}

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    let found = match &args.verb {
        Verb::Factor(args) => return study::run(args, command_line, out),
        Verb::Lighting(args) => lighting::run(args)?,
        Verb::Precompute(args) => precompute::run(args)?,
        Verb::Compress(args) => compress::run(args, command_line)?,
        Verb::Show(args) => show::run(args)?,
        Verb::Render(args) => return study::run(args, command_line, out),
        Verb::Card(args) => return study::run(args, command_line, out),
    };
    study::show(&found, out)
}
