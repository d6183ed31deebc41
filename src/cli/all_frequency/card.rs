//! `crossbar all-frequency card`: coded transfer on an emulated card.

use std::path::PathBuf;

use clap::ValueEnum;
use refsim::device::Profile;
use refsim::texture::TexelFormat;

use super::file::LitArgs;
use crate::all_frequency::kernels::MapFilter;
use crate::all_frequency::on_card::{ProductOptions, ProductPlace, VertexColors};
use crate::cli::memory::MemoryNeed;
use crate::cli::study::{StudyArgs, StudyFiles};
use crate::cli::transfer::on_card::OnCardArgs;
use crate::cli::{Problem, given};
use crate::options::one_of::variants;
use crate::study::prt::AllFrequencyOnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --way colors --size 64x48
      on the Radeon 9800, colors of vertices interpolated as its authors did
  crossbar all-frequency card docs/examples/step_all_small.npz --model docs/examples/step.obj --original docs/examples/step_all.npz --sweep --size 64x48
      bits of representatives, weights and maps, arithmetic; what of it shows, and what compression costs

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, blame.csv, with --sweep precision.csv, with --values the radiance of \
vertices as the host computes it from the numbers that the card draws. \
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

    /// Format of the maps of reflectance factors, for products [default: rgba16s or rg16s where the card has them, else
    /// rgba8s]
    #[arg(long, value_name = "F")]
    map_format: Option<TexelFormat>,

    /// Filter between their texels, for products [default: sampler]
    #[arg(long, value_name = "WHO", value_parser = variants::<MapFilter>())]
    filter: Option<MapFilter>,

    /// Ask for the card's partial precision, for products
    #[arg(long)]
    partial: bool,

    #[command(flatten)]
    card: OnCardArgs,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/all-frequency-card")]
    out: PathBuf,
}

impl Args {
    fn place(&self, profile: &Profile) -> Result<ProductPlace, Problem> {
        if self.way == WayArg::Colors {
            let of_products = [
                ("--map-format", self.map_format.is_some()),
                ("--filter", self.filter.is_some()),
                ("--partial", self.partial),
            ];
            given::refuse(of_products, "`--way products`, found `--way colors`", "leave it out")?;
            return Ok(ProductPlace::Vertices(VertexColors::Bytes));
        }
        let without = [("--partial", self.partial && profile.rules.partial.is_none())];
        given::refuse(without, "cards with a partial precision", "choose one with `--device`, or leave it out")?;
        let has = |format: &TexelFormat| profile.limits.texture_formats.contains(format);
        let fractions = [TexelFormat::Rgba16Snorm, TexelFormat::Rg16Snorm].into_iter().find(has);
        Ok(ProductPlace::Pixels(ProductOptions {
            map_format: self.map_format.or(fractions).unwrap_or(TexelFormat::Rgba8Snorm),
            filter: self.filter.unwrap_or_default(),
            is_partial: self.partial,
            ..ProductOptions::default()
        }))
    }
}

impl StudyArgs for Args {
    type Study = AllFrequencyOnCard;
    const QUICKER: &'static str = "a smaller `--size`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(Some(&self.out), None, self.lit.inputs())
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.lit.picture.memory_on_card()))
    }

    fn study(&self) -> miette::Result<AllFrequencyOnCard> {
        let mut card = self.card.setting("r350")?;
        let place = self.place(&card.profile)?;
        let lit = self.lit.load()?;
        card.values = self.card.values.of(&self.lit.picture.model, &lit.vertices);
        Ok(AllFrequencyOnCard { lit, place, card })
    }
}
