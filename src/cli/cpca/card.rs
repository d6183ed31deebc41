//! `crossbar cpca card`: compressed transfer on an emulated card.

use std::path::PathBuf;

use refsim::texture::TexelFormat;

use super::file::{FileOfModel, clusters_of, light_order};
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::light::{DEFAULT_LIGHT, DistantLightArg, HARMONIC_LIGHT};
use crate::cli::transfer::on_card::OnCardArgs;
use crate::cli::transfer::picture::PictureArgs;
use crate::cpca::on_card::PrtCardOptions;
use crate::study::prt::OnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      on the Radeon 9700: picture, its difference from the host's, modelled time of a frame
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --device r350 --size 64x48
      on the Radeon 9800
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --sweep --size 64x48
      the error of coarser weights, maps, arithmetic and targets, one at a time

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, with --sweep precision.csv. \
docs/papers/cpca.md explains all of it.";

/// Draw a model under distant light on an emulated card, from clusters
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Clusters of transfer, as `crossbar cpca compress` writes them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = HARMONIC_LIGHT)]
    light: DistantLightArg,

    #[command(flatten)]
    card: OnCardArgs,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/cpca-card")]
    out: PathBuf,
}

impl StudyArgs for Args {
    type Study = OnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        let inputs =
            [Some(self.file.as_path()), self.light.file()].into_iter().flatten().chain(self.picture.inputs()).collect();
        StudyFiles::new(Some(&self.out), inputs)
    }

    fn study(&self) -> miette::Result<OnCard> {
        let card = self.card.setting("r300")?;
        let FileOfModel { mut file, model, vertices, .. } = FileOfModel::load(&self.file, &self.picture.model)?;
        let clustering = clusters_of(&mut file, &self.file)?;
        let light_order = light_order(&file)?;
        Ok(OnCard {
            view: self.picture.view(&model.mesh, self.light.name())?,
            light: self.light.of_order(light_order)?,
            options: options(&card.profile.limits.texture_formats),
            card,
            meaning: file.meaning,
            vertices,
            clustering,
        })
    }
}

/// Options of the card: signed 16-bit maps if it has them, otherwise signed 8-bit maps.
fn options(formats: &[TexelFormat]) -> PrtCardOptions {
    let fine = formats.contains(&TexelFormat::Rgba16Snorm);
    let map_format = if fine { TexelFormat::Rgba16Snorm } else { TexelFormat::Rgba8Snorm };
    PrtCardOptions { map_format, ..PrtCardOptions::default() }
}
