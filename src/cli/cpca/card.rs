//! `crossbar cpca card`: compressed transfer on an emulated card.

use std::path::PathBuf;

use refsim::texture::TexelFormat;

use super::file::{FileOfModel, clusters_of, light_order};
use crate::cli::memory::MemoryNeed;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::light::HarmonicLightArgs;
use crate::cli::transfer::on_card::OnCardArgs;
use crate::cli::transfer::picture::PictureArgs;
use crate::cpca::coherence::Superclusters;
use crate::cpca::on_card::{PrtCardOptions, WeightFormat};
use crate::options::one_of::variants;
use crate::study::prt::OnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --size 64x48
      on the Radeon 9700: picture, how far it is off the host's, modelled time of a frame
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --device r350 --weights unorm8 --target-format rgba16 --size 64x48
      on the Radeon 9800, with weights of 8 bits, into 16 bits per channel
  crossbar cpca card docs/examples/step_small.npz --model docs/examples/step.obj --sweep --size 64x48
      weights, maps, arithmetic and targets made coarse one after the other: what shows

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, with --sweep precision.csv, with --values the radiance of \
vertices as the host computes it from the numbers that the card draws. docs/papers/cpca.md explains \
all of it.";

/// Draw a model under distant light on an emulated card, from clusters
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Clusters of transfer, as `crossbar cpca compress` writes them
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    #[command(flatten)]
    light: HarmonicLightArgs,

    /// Format of weights at vertices
    #[arg(long, value_name = "F", default_value = "fp32", value_parser = variants::<WeightFormat>())]
    weights: WeightFormat,

    /// Texels along a side of the maps of harmonics; the paper has 32
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=4096))]
    map_side: u32,

    /// Format of these maps [default: rgba16s where the card has it, else rgba8s]
    #[arg(long, value_name = "F")]
    map_format: Option<TexelFormat>,

    #[command(flatten)]
    card: OnCardArgs,

    #[command(flatten)]
    picture: PictureArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/cpca-card")]
    out: PathBuf,
}

impl Args {
    fn options(&self, formats: &[TexelFormat]) -> PrtCardOptions {
        let has = formats.contains(&TexelFormat::Rgba16Snorm);
        PrtCardOptions {
            superclusters: true,
            map_side: self.map_side as usize,
            map_format: self.map_format.unwrap_or(if has { TexelFormat::Rgba16Snorm } else { TexelFormat::Rgba8Snorm }),
            weights: self.weights,
        }
    }
}

impl StudyArgs for Args {
    type Study = OnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        let inputs =
            [Some(self.file.as_path()), self.light.file()].into_iter().flatten().chain(self.picture.inputs()).collect();
        StudyFiles::new(Some(&self.out), None, inputs)
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.picture.memory_on_card()))
    }

    fn study(&self) -> miette::Result<OnCard> {
        let mut card = self.card.setting("r300")?;
        let FileOfModel { mut file, model, vertices, .. } = FileOfModel::load(&self.file, &self.picture.model)?;
        card.values = self.card.values.of(&self.picture.model, &vertices);
        let clustering = clusters_of(&mut file, &self.file)?;
        let light_order = light_order(&file)?;
        let superclusters = file.superclusters.as_deref().and_then(Superclusters::of_numbers);
        Ok(OnCard {
            view: self.picture.view(&model.mesh, self.light.name())?,
            light: self.light.of_order(light_order)?,
            options: self.options(&card.profile.limits.texture_formats),
            card,
            meaning: file.meaning,
            vertices,
            clustering,
            superclusters,
        })
    }
}
