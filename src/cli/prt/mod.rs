//! `crossbar prt`: precomputed radiance transfer, one file a verb.

mod all_frequency;
mod bi_scale;
mod card;
mod card_values;
mod compress;
mod error;
mod factor;
mod factor_values;
mod light;
mod lighting;
mod model;
mod precompute;
mod render;
mod segments;
mod show;
mod values;

use super::{Out, Verdict, study};

const EXAMPLES: &str = "\
Examples:
  crossbar prt precompute docs/examples/step.obj --out step.prt
      transfer of every vertex
  crossbar prt compress docs/examples/step.prt --clusters 8 --vectors 3 --out small.prt
      the same by 8 clusters of 3 vectors
  crossbar prt error docs/examples/step.prt docs/examples/step_small.prt
      what compression costs
  crossbar prt show docs/examples/step_small.prt --vertex 12
      what is in a file
  crossbar prt render docs/examples/step_small.prt --model docs/examples/step.obj --size 64x48
      pictures of it
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --size 64x48
      the same on an emulated card
  crossbar prt factor --brdf cook-torrance
      reflectance as a sum of products of a function of view and one of light

docs/prt-format.md specifies the files, docs/papers/cpca.md and docs/papers/all_frequency.md what is computed.";

/// Precomputed radiance transfer: compute it, compress it by clustered principal components, draw it
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    Bicluster(bi_scale::bicluster::Args),
    Card(card::Args),
    Compare(bi_scale::compare::Args),
    Compress(compress::Args),
    Error(error::Args),
    Factor(factor::Args),
    Lighting(lighting::Args),
    Multiply(bi_scale::multiply::Args),
    Precompute(precompute::Args),
    Render(render::Args),
    Show(show::Args),
    Texture(bi_scale::texture::Args),
}

pub(super) fn run(args: &Args, command_line: &str, out: &mut Out) -> miette::Result<Verdict> {
    // Which of the kinds of transfer the verb is about.
    let bi_scale = match &args.verb {
        Verb::Card(args) => bi_scale::is_asked(args.kind, args.file())?,
        Verb::Render(args) => bi_scale::is_asked(args.kind, args.file())?,
        Verb::Show(args) => bi_scale::is_asked(args.kind, &args.file)?,
        _ => false,
    };
    let all = match &args.verb {
        _ if bi_scale => false,
        Verb::Card(args) => all_frequency::is_asked(args.kind, args.file())?,
        Verb::Compress(args) => all_frequency::is_asked(args.kind, &args.signal)?,
        Verb::Error(args) => all_frequency::is_asked(args.kind, &args.signal)?,
        Verb::Render(args) => all_frequency::is_asked(args.kind, args.file())?,
        _ => false,
    };
    match &args.verb {
        Verb::Bicluster(args) => bi_scale::bicluster::run(args, out)?,
        Verb::Card(args) if bi_scale => {
            return study::run(&bi_scale::card::Args(args), command_line, out);
        }
        Verb::Card(args) if all => return study::run(&all_frequency::card::Args(args), command_line, out),
        Verb::Card(args) => return study::run(args, command_line, out),
        Verb::Compare(args) => bi_scale::compare::run(args, out)?,
        Verb::Compress(args) if all => all_frequency::compress::run(args, out)?,
        Verb::Compress(args) => compress::run(args, out)?,
        Verb::Error(args) if all => all_frequency::error::run(args, out)?,
        Verb::Error(args) => error::run(args, out)?,
        Verb::Factor(args) => return study::run(args, command_line, out),
        Verb::Lighting(args) => lighting::run(args, out)?,
        Verb::Multiply(args) => bi_scale::multiply::run(args, out)?,
        Verb::Precompute(args) => precompute::run(args, out)?,
        Verb::Render(args) if bi_scale => {
            return study::run(&bi_scale::render::Args(args), command_line, out);
        }
        Verb::Render(args) if all => {
            return study::run(&all_frequency::render::Args(args), command_line, out);
        }
        Verb::Render(args) => return study::run(args, command_line, out),
        Verb::Show(args) if bi_scale => bi_scale::show::run(args, out)?,
        Verb::Show(args) => show::run(args, out)?,
        Verb::Texture(args) => bi_scale::texture::run(args, out)?,
    }
    Ok(Verdict::Done)
}
