//! `crossbar cpca render` and `card`: pictures of a model from its transfer, on the host and on an emulated card.

use std::path::PathBuf;

use crate::cli::Problem;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::model::model_of;
use crate::cli::transfer::picture::{OnCardArgs, PictureArgs, TransferFiles};
use crate::study::prt::{OnCard, Rendering};
use crate::transfer::file::{PrtFile, PrtMeaning, load_prt};

const RENDER_EXAMPLES: &str = "\
Examples:
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      under a clear sky with a sun: a picture, the clusters and a page
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --original docs/examples/step.npz --light disk:1,0,2:20 --size 64x48
      compared with the uncompressed transfer: differences, and the error of every vertex
  crossbar cpca render docs/examples/step.npz --model docs/examples/step.obj --light red-and-blue --size 64x48
      from uncompressed transfer
  crossbar cpca render docs/examples/step_small.npz --model docs/examples/step.obj --light scene:cornell-box@0.28,0.28,0.4 --size 64x48
      under the path-traced light at a place in a room

Written to --out: index.html (self-contained), pictures, picture.exr. The host interpolates vertex radiance over \
triangles.";

/// Draw a model under distant light from its transfer, compressed or not
#[derive(Debug, clap::Args)]
#[command(after_help = RENDER_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Render {
    #[command(flatten)]
    transfer: TransferFiles,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures and the page
    #[arg(long, value_name = "DIR", default_value = "out/cpca")]
    out: PathBuf,
}

impl StudyArgs for Render {
    type Study = Rendering;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.picture.inputs(self.transfer.paths()))
    }

    fn study(&self) -> miette::Result<Rendering> {
        let TransferFiles { file: path, original } = &self.transfer;
        let file = load_prt(path, None)?;
        let (model, vertices, digest) = model_of(path, file.mesh, &self.picture.model, None)?;
        let light_order = light_order(&file)?;
        let original = original.as_ref().map(|path| -> miette::Result<_> {
            let PrtFile { meaning, transfer, .. } = load_prt(path, Some(&digest))?;
            let fits = transfer.filter(|_| meaning == file.meaning);
            Ok(fits.ok_or_else(|| {
                let what = format!("{}: expected uncompressed transfer of the same kind, found none", path.display());
                Problem::usage(what, "give the file from which the transfer was compressed")
            })?)
        });
        Ok(Rendering {
            original: original.transpose()?,
            view: self.picture.view(&model.mesh)?,
            light: self.picture.light.of_order(light_order)?,
            mesh: model.mesh,
            vertices,
            file,
        })
    }
}

/// The order of the light that a file's transfer takes.
fn light_order(file: &PrtFile) -> Result<usize, Problem> {
    match file.meaning {
        PrtMeaning::Transfer { light_order, .. } => Ok(light_order as usize),
        PrtMeaning::Numbers { .. } => Err(Problem::usage(
            "expected transfer, found a signal that is not transfer",
            "compress a file that `crossbar cpca precompute` wrote",
        )),
    }
}

const CARD_EXAMPLES: &str = "\
Examples:
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      on the Radeon 9700: the picture, its difference from the host's picture, and the modelled time of a frame
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --device r350 --size 64x48
      on the Radeon 9800
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --sweep --size 64x48
      the error of coarser weights, maps, arithmetic and targets, changed one at a time

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, with --sweep precision.csv. \
docs/papers/cpca.md explains these files.";

/// Draw a model under distant light on an emulated card, from clusters
#[derive(Debug, clap::Args)]
#[command(after_help = CARD_EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Card {
    /// Clusters of transfer, as `crossbar cpca compress` writes them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    card: OnCardArgs,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/cpca-card")]
    out: PathBuf,
}

impl StudyArgs for Card {
    type Study = OnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), self.picture.inputs([&self.file]))
    }

    fn study(&self) -> miette::Result<OnCard> {
        let card = self.card.setting("r300")?;
        let mut file = load_prt(&self.file, None)?;
        let (model, vertices, _) = model_of(&self.file, file.mesh, &self.picture.model, None)?;
        let clustering = file.clustering.take().ok_or_else(|| {
            let what = format!("{}: expected clusters, found transfer only", self.file.display());
            Problem::usage(what, "run `crossbar cpca compress` to make clusters")
        })?;
        let light_order = light_order(&file)?;
        Ok(OnCard {
            view: self.picture.view(&model.mesh)?,
            light: self.picture.light.of_order(light_order)?,
            card,
            meaning: file.meaning,
            vertices,
            clustering,
        })
    }
}
