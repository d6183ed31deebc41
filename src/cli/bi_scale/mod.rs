//! `crossbar bi-scale`: transfer at two scales.

mod bicluster;
mod draw;
mod file;
mod precompute;
mod show;
mod texture;

use super::{CommandLine, Out, Verdict, study};

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale precompute docs/examples/court.obj --directions 4 --out court.npz
      which light texels every vertex sees, by local direction
  crossbar bi-scale bicluster docs/examples/quarters.mtx
      a sparse matrix as a sum of biclusters
  crossbar bi-scale texture mail --texels 8 --directions 4 --views 4 --out mail.npy
      how a patch of heights reflects light, by place, view and light
  crossbar bi-scale render docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --size 64x48
      draws the model from transfer and texture
  crossbar bi-scale card docs/examples/court_biclusters.npz --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --size 64x48
      draws the model on an emulated card

docs/npz.md describes the files, and docs/papers/bi_scale.md describes the computation.";

/// Bi-scale transfer: a sparse matrix of visibility as biclusters, times bidirectional textures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    Precompute(precompute::Args),
    Bicluster(bicluster::Args),
    Texture(texture::Args),
    Show(show::Args),
    Render(draw::Render),
    Card(draw::Card),
}

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    let found = match &args.verb {
        Verb::Precompute(args) => precompute::run(args)?,
        Verb::Bicluster(args) => bicluster::run(args)?,
        Verb::Texture(args) => texture::run(args)?,
        Verb::Show(args) => show::run(args)?,
        Verb::Render(args) => return study::run(args, command_line, out),
        Verb::Card(args) => return study::run(args, command_line, out),
    };
    study::show(&found, out)
}
