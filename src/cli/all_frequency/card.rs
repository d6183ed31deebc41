//! `crossbar all-frequency card`: coded transfer on an emulated card.

use std::path::PathBuf;

use clap::ValueEnum;
use refsim::device::Profile;
use refsim::texture::TexelFormat;

use super::file::LitArgs;
use crate::all_frequency::on_card::{ProductOptions, ProductPlace, VertexColors};
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::on_card::OnCardArgs;
use crate::study::prt::AllFrequencyOnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --way colors --size 64x48
      on the Radeon 9800, colors of vertices interpolated as its authors did
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --original docs/examples/step_all.npz --sweep --size 64x48
      the error of fewer bits in representatives, weights, maps and arithmetic, and of compression
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --ground docs/examples/step_all_small.ground.npz --size 64x48
      with the ground below the model, and its shadow

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, blame.csv, with --sweep precision.csv. \
docs/papers/all_frequency.md explains all of it.";

/// The part of the work that the card does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WayArg {
    /// None: the host makes colors of vertices, which are interpolated
    Colors,
    /// The product with factors of the view, which are in textures, for each pixel
    Products,
}

/// Draw a model under distant light on an emulated card, from coded transfer
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    lit: LitArgs,

    /// The part of the work that the card does
    #[arg(long, value_enum, value_name = "WAY", default_value = "products")]
    way: WayArg,

    #[command(flatten)]
    card: OnCardArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency-card")]
    out: PathBuf,
}

impl Args {
    /// Where products are computed: maps of signed 16 bits where the card has them, else of 8.
    fn place(&self, profile: &Profile) -> ProductPlace {
        if self.way == WayArg::Colors {
            return ProductPlace::Vertices(VertexColors::Bytes);
        }
        let has = |format: &TexelFormat| profile.limits.texture_formats.contains(format);
        let fractions = [TexelFormat::Rgba16Snorm, TexelFormat::Rg16Snorm].into_iter().find(has);
        let map_format = fractions.unwrap_or(TexelFormat::Rgba8Snorm);
        ProductPlace::Pixels(ProductOptions { map_format, ..ProductOptions::default() })
    }
}

impl StudyArgs for Args {
    type Study = AllFrequencyOnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), None, self.lit.inputs())
    }

    fn study(&self) -> miette::Result<AllFrequencyOnCard> {
        let card = self.card.setting("r350")?;
        let place = self.place(&card.profile);
        Ok(AllFrequencyOnCard { lit: self.lit.load()?, place, card })
    }
}
